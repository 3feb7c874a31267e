"""``furiko cache``."""

from __future__ import annotations

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json


@click.command()
@click.option("--clear", is_flag=True, help="Delete all kept results.")
@json_option
def cache(clear: bool, as_json: bool) -> int:
    """Show or clear the results kept from earlier runs."""
    import msgspec

    from ..checks.cache import user_cache
    from ..records.listings import CacheContents

    kept = user_cache()
    entries = kept.entries()
    size = sum(path.stat().st_size for path in entries)
    deleted = kept.clear() if clear else msgspec.UNSET
    found = CacheContents(folder=str(kept.folder), entries=len(entries), bytes=size, deleted=deleted)
    if as_json:
        print_json(found)
    else:
        done = ", deleted now" if clear else ""
        click.echo(f"{found.entries} entries, {size / 1e6:.1f} MB in {found.folder}{done}")
    return AGREES
