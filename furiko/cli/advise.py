"""``furiko advise``."""

from __future__ import annotations

import click

from ..records.exit_status import AGREES, INCOMPLETE
from .options import engine_option, json_option, scene_names
from .output import print_json
from .progress import status_line


@click.command()
@click.argument("scene", metavar="SCENE|FILE.toml", shell_complete=scene_names)
@engine_option
@click.option(
    "--error",
    type=click.FloatRange(1e-13, 0.1),
    default=1e-6,
    show_default=True,
    help="The largest error that may be made, of angles [rad] and rates [rad/s].",
)
@click.option(
    "--until",
    type=click.FloatRange(0, min_open=True),
    help="How long the motion is [s]; the scene's own duration if not given.",
)
@click.option("--budget", type=click.FloatRange(1), default=30.0, show_default=True, help="How long to try, about [s].")
@json_option
def advise(
    scene: str, engines: tuple[str, ...], error: float, until: float | None, budget: float, as_json: bool
) -> int:
    """Say which engine, integrator and step to use for a scene.

    Each integrator runs in the scene itself, its step halved until the error asked for is kept. The fastest comes
    first. The exit status is 3 where no engine's integrator keeps it.

    Of an open mechanism it says besides whether each engine's accelerations are right, against proven ones, and how far
    the mechanism is from where they are not: heavier, longer, faster, farther away, nearer to a singular pose. Without
    a state and a duration that is all; the exit status is 3 where no engine's are right. With them it says, too, what
    each integrator keeps with its step in the long run, up to 1000 s: energy and quaternions of the scene itself, and
    the phase of motions that are known for ever.
    """
    from ..advise import advise as run

    with status_line() as watch:
        found = run(scene, error=error, until=until, engines=engines or None, budget=budget, watch=watch)
    if as_json:
        print_json(found)
    else:
        from ..reports.terminal.advice import print_advice

        print_advice(found)
    if found.trust and not found.duration:
        return AGREES if any(each.verdict == "right" for each in found.trust) else INCOMPLETE
    return AGREES if any(each.engine != "furiko" for each in found.advised) else INCOMPLETE
