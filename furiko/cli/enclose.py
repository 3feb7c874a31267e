"""``furiko enclose``."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import click

from ..records.exit_status import AGREES, INCOMPLETE
from .options import json_option, scene_names
from .output import print_json, print_table, print_text
from .progress import status_line

if TYPE_CHECKING:
    from ..models import AnyScene
    from ..records.motions import EnclosureDocument
    from ..reference.proved.enclose import Enclosed

LINES = 8  # times in the table where none are asked for


@click.command()
@click.argument("scene", shell_complete=scene_names)
@click.option(
    "--digits",
    type=click.IntRange(1, 1000),
    default=15,
    show_default=True,
    help="Decimals wanted: every interval reaches no further than 10^-DIGITS from its middle.",
)
@click.option("--until", type=float, help="Last time [s], negative for backwards; the scene's duration if not given.")
@click.option(
    "--radius",
    type=click.FloatRange(0, 1),
    default=0.0,
    help="Start from all states this near [rad, m, and per s] to the scene's, and enclose all their motions.",
)
@click.option("--seconds", type=click.FloatRange(0.1), help="Stop after so long, with what is proved by then.")
@json_option
def enclose(scene: str, digits: int, until: float | None, radius: float, seconds: float | None, as_json: bool) -> int:
    """Prove where a scene's motion is: intervals that contain it.

    The motion starts in the scene's own state. A chain, N legs, or an open mechanism that its joints keep in a plane:
    hinges about x, y or z, slides before them. Status 3 if it is proved for a part of the time only.
    """
    from ..models import InvalidInput, find_scene
    from ..reference.proved.enclose import enclose as prove

    found = find_scene(scene)
    start = _start(found)
    if start is None:
        raise InvalidInput(f"{found.name}: [state] is missing: it says where the motion starts")
    end = found.duration if until is None else until
    if not math.isfinite(end) or end == 0:
        raise InvalidInput(f"{found.name}: no duration is given: --until says how long to follow the motion [s]")
    times = [end * k / LINES for k in range(LINES + 1)]
    with status_line() as tell:
        result = prove(
            found.system,
            *start,
            times,
            digits,
            radius=radius,
            seconds=seconds,
            watch=lambda time, wide: tell(f"proved until {time:.4g} s of {end:g} s, to 1e{wide * math.log10(2):.0f}"),
        )
    document = _document(found, result, digits, end)
    if as_json:
        print_json(document)
    else:
        _print(document)
    return AGREES if result.complete else INCOMPLETE


def _start(scene: AnyScene) -> tuple[tuple[float, ...], tuple[float, ...]] | None:
    """The scene's own state, coordinates and rates."""
    from ..models import Scene

    q, v = (scene.theta, scene.omega) if isinstance(scene, Scene) else (scene.q, scene.v)
    return None if q is None or v is None else (q, v)


def _coordinates(scene: AnyScene) -> list[tuple[str, str]]:
    """Name and unit of each coordinate; an angle of a chain or leg has its number."""
    from ..models import Scene

    if isinstance(scene, Scene):
        return [(f"{i + 1}", "rad") for i in range(scene.system.n)]
    return [(joint.name, "m" if joint.kind == "slide" else "rad") for joint in scene.system.joints]


def _document(scene: AnyScene, found: Enclosed, digits: int, end: float) -> EnclosureDocument:
    import flint

    from ..records.motions import EnclosureDocument, EnclosureRow

    kept = digits + 5
    names, units = map(list, zip(*_coordinates(scene), strict=True))
    radius = found.radius.tolist()
    with flint.ctx.workprec(found.bits + 64):
        rows = [
            EnclosureRow(
                time=time,
                theta=[ball.str(kept) for ball in theta],
                omega=[ball.str(kept) for ball in omega],
                theta_low=low,
                theta_high=high,
                omega_low=slow,
                omega_high=fast,
                radius=wide,
            )
            for time, theta, omega, low, high, slow, fast, wide in zip(
                found.times.tolist(),
                found.theta,
                found.omega,
                found.theta_low.tolist(),
                found.theta_high.tolist(),
                found.omega_low.tolist(),
                found.omega_high.tolist(),
                radius,
                strict=True,
            )
        ]
    return EnclosureDocument(
        scene=scene.name,
        coordinates=names,
        units=units,
        until=end,
        proved_until=found.proved_until,
        complete=found.complete,
        why=found.why,
        digits=digits,
        bits=found.bits,
        steps=found.steps,
        seconds=round(found.seconds, 3),
        rows=rows,
    )


def _print(document: EnclosureDocument) -> None:
    rows = []
    for row in document.rows:
        proved = "all" if row.radius == 0 else str(max(0, math.floor(-math.log10(row.radius))))
        for i, (low, high, ball) in enumerate(zip(row.theta_low, row.theta_high, row.theta, strict=True)):
            time, of = (f"{row.time:g}", proved) if i == 0 else ("", "")
            rows.append((time, document.coordinates[i], ball if len(ball) < 60 else f"{low!r} … {high!r}", of))
    units = ", ".join(f"[{unit}]" for unit in dict.fromkeys(document.units))
    what = "angle" if document.coordinates[0].isdigit() else "joint"
    print_table(("time [s]", what, units, "proved decimals"), rows)
    ended = "" if document.complete else f" of {document.until:g} s: {document.why}"
    print_text(
        f"proved until {document.proved_until:g} s{ended}; {document.steps} steps, {document.bits} bits, "
        f"{document.seconds:.1f} s"
    )
