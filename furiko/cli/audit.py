"""``furiko audit``."""

from __future__ import annotations

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_text


@click.command()
@json_option
def audit(as_json: bool) -> int:
    """Check the documents' 57 equations against first principles."""
    from ..derivations.audit.audit import audit as audit_documents

    found = audit_documents()
    if as_json:
        print_json(found.to_dict())
    else:
        print_text(found.text())
    return AGREES
