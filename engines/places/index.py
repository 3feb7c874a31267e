"""The releases that the user's package index has, asked by pip, so that the user's own configuration holds."""

from __future__ import annotations

import re
from functools import cache

from ..releases import ALSO_AS, is_final, release
from .installing import NotInstalled, pip, run

LIMIT = 60.0  # [s]
NEAR = 3  # releases before and after one that is not there


class NoIndex(RuntimeError):
    """The index cannot be asked; why, in one line."""


@cache
def versions_of(package: str) -> tuple[str, ...]:
    """The releases of one package that fit this Python, oldest first. Raises :class:`NoIndex`."""
    try:
        text = run([*pip(), "index", "versions", package], LIMIT)
    except NotInstalled as error:
        raise NoIndex(f"{package}: the package index does not say which releases there are: {error}") from None
    found = re.search(r"Available versions: *(.*)", text)
    names = [name.strip() for name in found.group(1).split(",")] if found else []
    return tuple(sorted(filter(is_final, names), key=release))


def releases(package: str) -> dict[str, str]:
    """The releases of an engine, oldest first, each with the package that has it. Raises :class:`NoIndex`."""
    found = dict.fromkeys(versions_of(package), package)
    for other in ALSO_AS.get(package, ()):
        try:
            for version in versions_of(other):
                found.setdefault(version, other)
        except NoIndex:
            continue
    return {version: found[version] for version in sorted(found, key=release)}


def near(package: str, version: str) -> list[str]:
    """The releases next to a version; none where the index cannot be asked."""
    try:
        known = list(releases(package))
    except NoIndex:
        return []
    before = [one for one in known if release(one) < release(version)]
    after = [one for one in known if release(one) > release(version)]
    return [*before[-NEAR:], *after[:NEAR]]


def provider(package: str, version: str) -> str:
    """The package to install for this version of an engine: its own unless only another one has that release."""
    if package not in ALSO_AS:
        return package
    try:
        known = releases(package)
    except NoIndex:
        return package
    wanted = release(version)
    return next((by for one, by in known.items() if release(one) == wanted), package)
