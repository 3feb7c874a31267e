"""``furiko diagnose --fix``: the file's mechanism, written so that all engines read it alike."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from ...models import InvalidInput
from ...models.readers.model_file import ModelFile
from ...models.spatial_mechanism import WORLD, SpatialMechanism
from ...models.writers.merged_links import without_idle_joints, without_weightless_links
from ...models.writers.spatial_mjcf import spatial_mjcf
from ...models.writers.spatial_urdf import spatial_urdf
from ...models.writers.whole_file import require_writable, write_whole
from ..robots.answer import listed
from ..robots.built import BUILT
from ..robots.moving_links import moving_links
from .result import Diagnosis, Written

# What an engine does with the file, by its status there.
READS = {"differs": "reads otherwise", "refused": "refuses", "failed": "fails with"}
WRITERS: dict[str, Callable[[SpatialMechanism], str]] = {
    ".xml": spatial_mjcf,
    ".mjcf": spatial_mjcf,
    ".urdf": spatial_urdf,
}


def write_fixed(model: ModelFile, out: Path) -> list[str]:
    """Write the mechanism of a file that was read to ``out``; its ending says in which format.

    Every number stands where it acts: inertials in place of geoms, no default classes, no includes, names on all. What
    comes back are sentences on what is written otherwise, and on what no file can say to all engines alike.
    Raises :class:`InvalidInput` for another ending, for the file itself, and where the format cannot hold the
    mechanism.
    """
    require_target(out, model.path)
    mechanism, idle = without_idle_joints(model.spatial)
    mechanism, left = without_weightless_links(mechanism) if out.suffix != ".urdf" else (mechanism, ())
    write_whole(out, WRITERS[out.suffix](mechanism))
    fixed = (
        "what a joint moves and weighs nothing is fixed where it is: nothing says how it would accelerate, and MuJoCo "
        f"refuses it; to keep the joint, give that a mass in the file: {listed(idle)}"
    )
    without = f"what weighs nothing and carries one link is left out, and that has its joints: {listed(left)}"
    return [*([fixed] if idle else ()), *([without] if left else ()), *_not_alike(mechanism, out)]


def require_target(out: Path, model: str | Path) -> None:
    """Raise :class:`InvalidInput` where :func:`write_fixed` could not write to ``out``, for another ending, and for the
    file itself: asked before engines are, which takes seconds."""
    if out.suffix not in WRITERS:
        raise InvalidInput(f"{out}: the name must end in .xml (MJCF) or .urdf (URDF)")
    require_other_file(out, model)


def require_other_file(out: Path, model: str | Path) -> None:
    """Raise :class:`InvalidInput` where ``out`` is the model's own file, or cannot be written."""
    if out.exists() and Path(model).exists() and out.samefile(model):
        raise InvalidInput(f"{out}: this is the file itself, which is not overwritten; give another name")
    require_writable(out)


def judged(out: Path, found: Diagnosis) -> Written:
    """The file that was written, by what engines were ``found`` to make of it: all that read it have to agree.

    Exudyn, which furiko builds, reads no file. An engine that cannot be imported says nothing of it either.
    """
    why = []
    for name, engine in found.engines.items():
        if name == BUILT.name or engine["status"] in ("agrees", "missing"):
            continue
        named = [finding.says for finding in found.findings if finding.where.startswith(name)]
        if engine["status"] != "differs" or not named:
            says = engine.get("says", "")
            named = [f"{name} {READS[engine['status']]}" + (f": {says}" if says else "")]
        why += named
    if why:
        return Written(str(out), tuple(why), 1)
    if not any(engine["status"] == "agrees" for name, engine in found.engines.items() if name != BUILT.name):
        return Written(str(out), ("no engine could be asked about it",), 3)
    return Written(str(out), (), 0)


def _not_alike(mechanism: SpatialMechanism, out: Path) -> Iterator[str]:
    roots = [link for link in moving_links(mechanism) if link.parent == WORLD]
    free = [link.name for link in roots if any(seen.joint.kind == "free" for seen in link.joints)]
    if out.suffix != ".urdf" and free and len(roots) > 1:
        yield (
            "what is free beside other bodies has three slides and a ball, since Pinocchio reads only the first body "
            f"of the world: {listed(free)}; the rates are the same, and the slides are zero where the body is"
        )
    acting = ("armature", "damping", "friction")
    turning = [joint for body in mechanism.bodies for joint in body.joints if joint.kind in ("free", "ball")]
    names = [joint.name for joint in turning if any(getattr(joint, name) for name in acting)]
    if names:
        what = "armature, damping and dry friction of free and ball joints"
        yield f"{what}, which MuJoCo alone has as written: {listed(names)}"
    weightless = [link.name for link in moving_links(mechanism) if link.inertial.weightless]
    if weightless:
        yield (f"MuJoCo refuses links that move and weigh nothing; give them a mass in the file: {listed(weightless)}")
