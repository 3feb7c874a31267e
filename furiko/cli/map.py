"""``furiko map``."""

from __future__ import annotations

from pathlib import Path

import click

from ..records.exit_status import AGREES
from .options import json_option, scene_names, words
from .output import print_json, print_text

FOLDER = Path("furiko-map")
KINDS = ("flips", "stretching", "lyapunov")


@click.command("map")
@click.argument("scene", metavar="SCENE|FILE.toml", shell_complete=scene_names)
@click.option(
    "--of",
    "kind",
    type=click.Choice(KINDS),
    default="flips",
    show_default=True,
    shell_complete=words(*KINDS),
    help="What: the time to the first flip; the growth of the small difference that grows most; the largest Lyapunov "
    "exponent. Both exponents are of the time followed [1/s].",
)
@click.option(
    "--until",
    type=click.FloatRange(0, 1e6, min_open=True),
    default=10.0,
    show_default=True,
    help="How long each start is followed [s].",
)
@click.option("--points", type=click.IntRange(2, 2000), default=200, show_default=True, help="Starts a side.")
@click.option(
    "--links",
    nargs=2,
    type=click.IntRange(1),
    default=(1, 2),
    show_default=True,
    help="Whose angles vary, across and up.",
)
@click.option("--out", type=click.Path(path_type=Path), default=FOLDER, show_default=True, help="Folder for the page.")
@json_option
def map(scene: str, kind: str, until: float, points: int, links: tuple[int, int], out: Path, as_json: bool) -> int:
    """Draw flip times, stretching or chaos over a square of starts.

    Two angles vary over the whole circle; the other angles, and all rates, are those of the scene's state, or zero.
    Writes map.html, map.png (one pixel a start) and map.csv (the values, highest angle first).
    """
    from ..maps import draw, write
    from ..models.writers.whole_file import make_folder

    make_folder(out)
    found = draw(scene, kind, until=until, points=points, links=links)
    page = write(out, found)
    record = found.record
    if as_json:
        print_json(record)
        return AGREES
    square = f"{record.points} × {record.points} starts of {record.scene}"
    print_text(f"{square}, {record.until:g} s each, in {record.seconds:.1f} s")
    if record.least is not None and record.median is not None and record.most is not None:
        print_text(
            f"{kind}: {record.least:.3g} to {record.most:.3g} {record.unit}, median {record.median:.3g} {record.unit}"
        )
    if record.none:
        print_text(f"none within {record.until:g} s: {record.none} of {record.points**2} starts")
    print_text(f"Page: {page}")
    return AGREES
