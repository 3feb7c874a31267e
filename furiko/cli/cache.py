"""``furiko cache``."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_table, print_text

if TYPE_CHECKING:
    from ..checks.cache import Holding
    from ..records.listings import CacheContents, CacheKind


@click.command()
@click.option("--clear", is_flag=True, help="Delete all kept results.")
@json_option
def cache(clear: bool, as_json: bool) -> int:
    """Show or clear the results kept from earlier runs.

    Kinds: results of one scene on one engine, and truths, the reference values of one scene. Entries that were used
    least recently are deleted when the folder would exceed its limit.
    """
    import msgspec

    from ..checks.cache import user_cache
    from ..records.listings import CacheContents

    kept = user_cache()
    kinds = {kind: _kind(holding) for kind, holding in kept.holds().items()}
    deleted = kept.clear() if clear else msgspec.UNSET
    found = CacheContents(
        folder=str(kept.folder),
        entries=sum(kind.entries for kind in kinds.values()),
        bytes=sum(kind.bytes for kind in kinds.values()),
        limit=kept.largest,
        kinds=kinds,
        deleted=deleted,
    )
    if as_json:
        print_json(found)
    else:
        _print(found)
    return AGREES


def _kind(holding: Holding) -> CacheKind:
    from ..records.listings import CacheKind

    return CacheKind(
        entries=holding.entries,
        bytes=holding.size,
        least_recently_used=_time(holding.oldest),
        most_recently_used=_time(holding.newest),
    )


def _time(seconds: float | None) -> str | None:
    return None if seconds is None else datetime.fromtimestamp(seconds, UTC).isoformat(timespec="seconds")


def _print(found: CacheContents) -> None:
    rows = [
        (name, f"{kind.entries:,}", _size(kind.bytes), kind.least_recently_used or "-", kind.most_recently_used or "-")
        for name, kind in found.kinds.items()
    ]
    print_table(("kind", "entries", "size", "least recently used", "most recently used"), rows)
    done = "; all deleted now" if isinstance(found.deleted, int) else ""
    print_text(
        f"{found.entries:,} entries, {_size(found.bytes)} of at most {_size(found.limit)} in {found.folder}{done}"
    )


def _size(number: int) -> str:
    return f"{number / 1e6:,.1f} MB"
