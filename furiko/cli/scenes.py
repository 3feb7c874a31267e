"""``furiko scenes``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES
from .options import json_option
from .output import print_json, print_table

if TYPE_CHECKING:
    from ..models import AnyScene
    from ..records.listings import SceneRow


@click.command()
@json_option
def scenes(as_json: bool) -> int:
    """List the scenes of the catalogue."""
    from ..models import find_scenes

    found = find_scenes(None)
    if as_json:
        print_json([_row(scene) for scene in found])
    else:
        rows = [(s.name, s.system.kind, str(s.system.n), f"{s.duration:g}", s.description) for s in found]
        print_table(("scene", "system", "freedoms", "seconds", "description"), rows)
    return AGREES


def _row(scene: AnyScene) -> SceneRow:
    from ..records.listings import SceneRow

    return SceneRow(
        name=scene.name,
        system=scene.system.kind,
        n=scene.system.n,
        duration=scene.duration,
        description=scene.description,
        equations=list(scene.equations),
        tags=list(scene.tags),
    )
