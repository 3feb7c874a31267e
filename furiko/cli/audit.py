"""``furiko audit``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_text

if TYPE_CHECKING:
    from ..derivations.audit.prose import Language, Prose


@click.command()
@click.argument("file", required=False, type=click.Path(path_type=Path))
@click.option("--out", metavar="PAGE", type=click.Path(path_type=Path, dir_okay=False), help="Write one HTML page.")
@click.option(
    "--lang", type=click.Choice(["en", "ja"]), default="en", show_default=True, help="Language of text and page."
)
@click.option("--japanese", is_flag=True, help="The same as --lang ja.")
@click.option(
    "--stress",
    metavar="FOLDER",
    type=click.Path(path_type=Path, exists=True, file_okay=False),
    help="Add what the run of 'furiko stress -a chain' in this folder says of the chain's tip.",
)
@json_option
def audit(file: Path | None, out: Path | None, lang: str, japanese: bool, stress: Path | None, as_json: bool) -> int:
    """Check the documents' 57 equations against first principles.

    With a FILE, a TOML list of any document's equations ([[entry]] tables), each of its entries is judged: it holds,
    holds on a condition, or is wrong, and why.
    """
    from ..derivations.audit.prose import of_documents, of_file

    language: Language = "ja" if japanese or lang == "ja" else "en"
    if file is not None:
        if stress is not None:
            raise click.UsageError("--stress goes with the documents, not with a FILE")
        from ..derivations.audit.audit_file import audit_file

        listed = audit_file(file)
        _show(of_file(listed, language), listed.to_dict(), out, as_json)
        return listed.exit_status
    from ..derivations.audit.audit import audit as audit_documents

    said: list[str] = []
    if stress is not None:
        from ..stress import tip_verdict

        said = tip_verdict(stress)
    found = audit_documents()
    _show(of_documents(found, language, said), found.to_dict(), out, as_json)
    return AGREES


def _show(prose: Prose, content: dict[str, object], out: Path | None, as_json: bool) -> None:
    if out is not None:
        from msgspec import to_builtins

        from ..models.writers.whole_file import write_whole
        from ..reports.pages.audit_page import to_audit_page

        write_whole(out, to_audit_page(to_builtins(prose)))
    if as_json:
        print_json(content)
    else:
        print_text(prose.text() + (f"\n\nwritten: {out}" if out is not None else ""))
