"""An engine in its place: its Python, its version, the process that answers for it."""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, get_args

from ...models.errors import EngineMissing, InvalidInput
from ..info import EngineInfo, Integrator, Offer, Ordering, Quantity
from ..releases import ALSO_AS
from .connection import Connection
from .environments import Kept, ensure, kept, kept_name
from .index import provider
from .names import Place
from .surveys import survey

START = str(Path(__file__).with_name("start.py"))
PACKAGE = str(Path(__file__).parents[2])  # furiko's own folder, or in a checkout the root, where the rooms are
LONGEST = 500  # characters of a sentence that a program says of itself


def why_missing(place: Place, info: EngineInfo | None) -> str:
    """Why an engine cannot run in its place, in a sentence; empty where it can. An environment is made if need be."""
    try:
        if place.kind == "program" or info is None:
            program(place).running()
        elif not installed_version(place, info, make=True):
            executable = _executable(place)
            return f"not installed: {info.package} is not in {place.path}; {executable} -m pip install {info.package}"
    except (EngineMissing, InvalidInput) as error:
        return str(error)
    return ""


def installed_version(place: Place, info: EngineInfo, *, make: bool = False) -> str:
    """The version of an engine's package in its place; empty where it is not there.

    ``make``: the environment of a version is made where there is none; raises :class:`EngineMissing` if it cannot be.
    """
    if place.kind == "version":
        found = _environment(place, info) if make else _kept(place, info)
        return "" if found is None else _version_in(found.packages, info.package)
    return _version_in(survey(_executable(place)).packages, info.package)


def python_of(place: Place, info: EngineInfo) -> Path:
    """The Python that runs an engine. Raises :class:`EngineMissing` where its environment cannot be made."""
    return _environment(place, info).executable if place.kind == "version" else _executable(place)


def says_where(place: Place, info: EngineInfo) -> str:
    """A phrase on the environment, for reports; empty where it is not there."""
    if place.kind == "program":
        return "a program of its own"
    try:
        if place.kind == "version" and _kept(place, info) is None:
            return ""
        held = survey(python_of(place, info))
    except EngineMissing:
        return ""
    numpy = held.packages.get("numpy")
    whose = "made by furiko" if place.kind == "version" else place.path
    return f"an environment of its own ({whose}): Python {held.python}" + (f", NumPy {numpy}" if numpy else "")


def environment(place: Place, info: EngineInfo) -> tuple[str, tuple[str, ...], str, str] | None:
    """Its Python, that one's search path, the engine's package as it is called there, and its module; None: not there.

    Raises :class:`EngineMissing` where it cannot be made.
    """
    python = python_of(place, info)
    found = survey(python)
    names = (info.package, *ALSO_AS.get(info.package, ()))
    package = next((name for name in names if name in found.packages), "")
    return (str(python), found.path, package, info.module) if package and info.module else None


def connection(place: Place, info: EngineInfo, reader: str = "-") -> Connection:
    """The process that answers for an engine; one for each place and engine, started when it is first asked."""
    tree = info.tree.adapter if info.tree else "-"
    return _connection(place.name, str(python_of(place, info)), _module(info), info.adapter, tree, reader)


@cache
def program(place: Place) -> Connection:
    """The program that is an engine. Raises :class:`InvalidInput` where it cannot be run."""
    path = place.located
    if not os.path.isfile(path) or not os.access(path, os.X_OK):
        raise InvalidInput(f"engine: {place.name}: an engine is a program that can be run, or a file that ends in .py")
    return Connection(place.name, [path])


def program_info(place: Place) -> EngineInfo:
    """What a program says of itself. Raises :class:`EngineMissing` where it says nothing, InvalidInput for nonsense."""
    behind = program(place)
    behind.running()
    try:
        return _info(place.name, behind.hello)
    except (TypeError, ValueError, KeyError) as error:
        raise InvalidInput(f"engine: {place.name}: its hello is not as the protocol has it: {error}") from None


def program_version(place: Place) -> str:
    """The version that a program says it is; empty where it says none or cannot be asked."""
    try:
        program(place).running()
    except (EngineMissing, InvalidInput):
        return ""
    return _text(program(place).hello, "version") or "unversioned"


@cache
def _connection(name: str, python: str, module: str, planar: str, tree: str, reader: str) -> Connection:
    return Connection(name, [python, "-I", START, PACKAGE, module, planar, tree, reader])


def _module(info: EngineInfo) -> str:
    return info.module or "numpy"


def _environment(place: Place, info: EngineInfo) -> Kept:
    found = _kept(place, info)
    if found is not None:
        return ensure(_package_of(found, info), place.version, _module(info))  # its needs may be others by now
    return ensure(provider(info.package, place.version), place.version, _module(info))


def _kept(place: Place, info: EngineInfo) -> Kept | None:
    names = (info.package, *ALSO_AS.get(info.package, ()))
    return next((found for name in names if (found := kept(kept_name(name, place.version))) is not None), None)


def _package_of(found: Kept, info: EngineInfo) -> str:
    return found.requirements[0].partition("==")[0] if found.requirements else info.package


def _executable(place: Place) -> Path:
    path = Path(place.located)
    if path.is_file():
        return path
    for name in ("bin/python", "bin/python3"):
        if (path / name).exists():
            return path / name
    raise InvalidInput(f"engine: {place.name}: {place.path!r} is no environment: it has no bin/python")


def _version_in(packages: Mapping[str, str], package: str) -> str:
    names = (package, *ALSO_AS.get(package, ()))
    return next((packages[name] for name in names if name in packages), "")


def _info(name: str, hello: Mapping[str, Any]) -> EngineInfo:
    """The hello of a program as an engine's info: every field is checked, since nobody has seen it before."""
    offered = hello["questions"]
    if not isinstance(offered, list) or "accelerations" not in offered:
        raise ValueError("'questions' is no list with 'accelerations' in it")
    integrators = tuple(_integrator(one) for one in hello.get("integrators", []))
    reasons = hello.get("missing", {})
    missing = {
        quantity: str(reasons.get(quantity) or "the program does not offer it")[:LONGEST]
        for quantity in get_args(Quantity)
        if quantity not in offered
    }
    if integrators and "trajectory" not in offered:
        raise ValueError("it has integrators and does not offer 'trajectory'")
    choices: dict[str, Any] = {
        "coordinates": _choice(hello, "coordinates", ("relative", "absolute", "maximal"), "absolute"),
        "algorithm": _choice(hello, "algorithm", ("aba", "crba", "other", "unknown"), "unknown"),
        "inverse": _choice(hello, "inverse", ("rnea", "crba", "matrix"), "matrix"),
        "ordering": _choice(hello, "ordering", get_args(Ordering), "unknown"),
    }
    largest = hello.get("largest_n", 1000)
    if type(largest) is not int or largest < 1:
        raise ValueError("'largest_n' is no whole number from 1 on")
    return EngineInfo(
        name=name,
        formulation=_text(hello, "formulation") or "a program over the protocol",
        adapter=name,
        module="",
        package="",
        homepage="",
        integrators=integrators,
        missing=missing,
        offers=tuple(quantity for quantity in get_args(Offer) if quantity in offered),
        lacks={
            quantity: str(reasons.get(quantity) or "the program does not offer it")[:LONGEST]
            for quantity in get_args(Offer)
            if quantity not in offered
        },
        largest_n=largest,
        largest_n_reason=_text(hello, "largest_n_reason") or "the program takes no more",
        no_point_masses=_text(hello, "no_point_masses"),
        interchanges=bool(hello["interchanges"]) if "interchanges" in hello else None,
        **choices,
    )


def _integrator(content: Any) -> Integrator:
    order = content["order"]
    if type(order) is not int or not 1 <= order <= 20:
        raise ValueError("an integrator's 'order' is no whole number from 1 to 20")
    return Integrator(str(content["name"])[:100], order)


def _choice(hello: Mapping[str, Any], field: str, known: tuple[str, ...], usual: str) -> str:
    value = hello.get(field, usual)
    if value not in known:
        raise ValueError(f"{field!r} is none of {', '.join(known)}")
    return str(value)


def _text(hello: Mapping[str, Any], field: str) -> str:
    return " ".join(str(hello.get(field, "")).split())[:LONGEST]
