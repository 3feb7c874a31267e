"""Why an engine does not do what the model file says: by switching off its features, then by what it compiled."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ...engines.model_files.adapter import Reader
from ...models.mechanism import Mechanism
from ...models.readers.model_file import ModelFile
from ...reference import planar_tree as planar
from ...reference.rounding.bounds import EPSILON
from ..differences import differences
from ..explain import explain
from ..finding import Finding
from ..measurement import Measurement, measure, probe_states
from ..reader_faults import inertia_from_geoms, possible_reader_faults
from .engine_view import EngineView, with_hinges_cleared

# Numbers of the hinges that an engine may hold and yet leave out of its equations of motion, likelier ones first.
IGNORED_TOGETHER: tuple[tuple[str, ...], ...] = (
    (),
    ("damping",),
    ("friction",),
    ("damping", "friction"),
    ("stiffness",),
    ("damping", "friction", "stiffness"),
)
CAUSE_OF_FEATURE = (("contact", "colliding-geoms"), ("limit", "joint-limit"))


def engine_causes(
    reader: Reader,
    view: EngineView,
    file: ModelFile,
    theory: Mechanism,
    measured: Measurement,
    compiled: Mechanism | None,
) -> list[Finding]:
    """Why the engine does not move as ``theory``, which is what the file says; the likeliest cause first."""
    switched = list(_by_switching_off(reader, view, theory))
    if switched:
        return switched
    if compiled is not None and compiled.n == theory.n and compiled.parents == theory.parents:
        held = with_hinges_cleared(compiled, ("friction",)) if view.without else compiled
        found = _by_what_it_compiled(held, file, theory, measured, reader.name)
        if found:
            return found
    return explain(view, theory, who=reader.name, accuracy=accuracy_for(theory), slight=False)


def accuracy_for(theory: Mechanism) -> float:
    """Relative accuracy to which engines are held: rounding, or how far the mechanism is from planar."""
    return max(EPSILON, theory.tilt)


def _by_switching_off(reader: Reader, view: EngineView, theory: Mechanism) -> Iterator[Finding]:
    """The feature without which the engine agrees is the cause."""
    for feature, cause in CAUSE_OF_FEATURE:
        if feature not in reader.features:
            continue
        without = view.switched_off(feature)
        if measure(without, theory, accuracy_for(theory)).worst(planar.parameters(theory)) > 1:
            continue
        theta, _ = probe_states(theory)
        contacts = getattr(view.engine, "contacts", None)
        touching = contacts(theta) if feature == "contact" and contacts is not None else []
        pairs = sorted({pair for _, pair in touching})
        words = f": {', '.join(pairs[:3])} are in contact in {len(touching)} of {len(theta)} states" if pairs else ""
        says = f"{reader.name}: agrees with the file when its {feature}s are switched off{words}"
        yield Finding(cause, reader.name, len(touching) if pairs else None, 0 if pairs else None, says)
        return


def _by_what_it_compiled(
    held: Mechanism, file: ModelFile, theory: Mechanism, measured: Measurement, who: str
) -> list[Finding]:
    """Whether the compiled model explains the motion, with or without its damping, friction and springs."""
    for ignored in IGNORED_TOGETHER:
        acting = with_hinges_cleared(held, ignored)
        if measured.worst(planar.parameters(acting)) <= 1:
            hinges = tuple(replace(h, limits=w.limits) for h, w in zip(acting.hinges, theory.hinges, strict=True))
            faults = possible_reader_faults(file)
            found = differences(replace(acting, hinges=hinges), theory, who, "the file says", faults)
            return inertia_from_geoms(file, found, who) + found
    return []
