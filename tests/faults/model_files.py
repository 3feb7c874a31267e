"""Model files with one planted fault, and sound ones that look odd."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import furiko
from furiko.models.mechanism import Mechanism

from .mechanisms import free, fused, mass_moved, off, random_tree, with_hinge, with_link
from .writing import random_style, saved, written


def sound_model(rng):
    """(text, style, what is wanted): a file that looks suspicious and is not."""
    tree = random_tree(rng)
    wanted = free(tree)
    model = wanted
    if rng.random() < 0.3 and all(link.inertia for link in tree.links):
        model = mass_moved(model, rng)
    style = random_style(rng)
    return written(model, style, rng), style, wanted


@dataclass
class Planted:
    """``cause`` is what must be named; ``text`` the file, ``wanted`` what it is held against."""

    cause: str
    text: str
    language: str
    wanted: Mechanism
    n: int


def plant_armature(rng, style):
    wanted = free(random_tree(rng))
    i, all_of_them = int(rng.integers(wanted.n)), rng.random() < 0.3
    value = float(10 ** rng.uniform(-3, 0))
    model = wanted
    for k in range(wanted.n) if all_of_them else [i]:
        model = with_hinge(model, k, armature=value)
    return model, wanted


def plant_damping(rng, style):
    wanted = free(random_tree(rng))
    return with_hinge(wanted, int(rng.integers(wanted.n)), damping=float(10 ** rng.uniform(-3, 0))), wanted


def plant_friction(rng, style):
    wanted = free(random_tree(rng))
    return with_hinge(wanted, int(rng.integers(wanted.n)), friction=float(10 ** rng.uniform(-3, 0))), wanted


def plant_stiffness(rng, style):
    wanted = free(random_tree(rng))
    rest = float(rng.uniform(-1, 1))
    return with_hinge(wanted, int(rng.integers(wanted.n)), stiffness=float(rng.uniform(0.1, 5)), rest=rest), wanted


def plant_limit(rng, style):
    style.turn_zero = False
    wanted = free(random_tree(rng))
    stops = (-float(rng.uniform(0.5, 3)), float(rng.uniform(0.5, 3)))
    return with_hinge(wanted, int(rng.integers(wanted.n)), limits=stops), wanted


def plant_mass(rng, style):
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, mass=wanted.links[i].mass * off(rng)), wanted


def plant_length(rng, style):
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11)), kind=str(rng.choice(["chain", "star"]))))
    i = wanted.links[int(rng.integers(1, wanted.n))].parent
    factor = off(rng)
    model = wanted
    for c in range(wanted.n):
        if wanted.links[c].parent == i:
            model = with_link(model, c, hinge=tuple(factor * x for x in wanted.links[c].hinge))
    return model, wanted


def plant_inertia(rng, style):
    wanted = free(random_tree(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, inertia=wanted.links[i].inertia * off(rng)), wanted


def plant_gravity(rng, style):
    style.language = "mjcf"
    wanted = free(random_tree(rng))
    g = wanted.gravity[0] * off(rng)
    return replace(wanted, gravity=(g, 0.0)), wanted


def plant_gravity_turned(rng, style):
    style.language, style.turn_world, style.turn_zero = "mjcf", False, False
    wanted = free(random_tree(rng, straight=True))
    g, angle = wanted.gravity[0], float(rng.choice([-1, 1]) * rng.uniform(0.05, 1.0))
    inside = rng.random() < 0.5
    style.aslant = (
        (g * math.cos(angle), g * math.sin(angle), 0.0) if inside else (g * math.cos(angle), 0.0, g * math.sin(angle))
    )
    return wanted, wanted


def plant_com(rng, style):
    style.turn_zero = False
    wanted = free(random_tree(rng, bobs=False))
    i = int(rng.integers(wanted.n))
    a, b = wanted.links[i].com
    return with_link(wanted, i, com=(a + float(rng.uniform(0.02, 0.2)), b + float(rng.uniform(0.02, 0.2)))), wanted


def plant_com_turned(rng, style):
    style.turn_zero = False
    # Of a link that carries nothing, turning its centre about its hinge is counting its angle from elsewhere.
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11)), kind=str(rng.choice(["chain", "star"])), bobs=False))
    i = int(rng.choice([link.parent for link in wanted.links if link.parent >= 0]))
    angle = float(rng.choice([-1, 1]) * rng.uniform(0.1, 3.0))
    z = complex(*wanted.links[i].com) * complex(math.cos(angle), math.sin(angle))
    return with_link(wanted, i, com=(z.real, z.imag)), wanted


def plant_point_mass(rng, style):
    wanted = free(random_tree(rng, bobs=True))
    i = int(rng.integers(wanted.n))
    return with_link(wanted, i, inertia=float(10 ** rng.uniform(-8, -3))), wanted


def plant_from_geoms(rng, style):
    style.language, style.split = "mjcf", False
    style.compiler = "angle='radian' inertiafromgeom='true'"
    wanted = free(random_tree(rng, bobs=False))
    for i, link in enumerate(wanted.links):
        half = link.length / 2
        style.geoms[i] = (
            f"<geom type='capsule' size='{link.length / 30!r} {half!r}' pos='0 0 {-half!r}' contype='0' "
            "conaffinity='0'/>"
        )
    return wanted, wanted


def plant_degrees(rng, style):
    style.language, style.turn_zero = "mjcf", False
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    if rng.random() < 0.5:
        wanted = with_hinge(
            wanted, i, stiffness=float(rng.uniform(0.5, 3)), rest=float(rng.choice([-1, 1]) * rng.uniform(0.3, 2))
        )
    else:
        wanted = with_hinge(wanted, i, limits=(-float(rng.uniform(0.5, 3)), float(rng.uniform(0.5, 3))))
    style.compiler = "angle='degree'"
    return wanted, wanted


def plant_spring_reference(rng, style):
    style.language, style.turn_zero = "mjcf", False
    wanted = free(random_tree(rng))
    i = int(rng.integers(wanted.n))
    wanted = with_hinge(wanted, i, stiffness=float(rng.uniform(0.5, 3)), rest=float(rng.uniform(0.3, 2)))
    return with_hinge(wanted, i, rest=float(rng.uniform(-2, 0))), wanted


def plant_dropped(rng, style):
    wanted = free(random_tree(rng, n=int(rng.integers(2, 11))))
    leaves = [i for i in range(wanted.n) if all(k.parent != i for k in wanted.links)]
    k = int(rng.choice([i for i in leaves if wanted.links[i].parent >= 0] or leaves))
    return fused(wanted, k), wanted


def plant_added(rng, style):
    model, wanted = plant_dropped(rng, style)
    return wanted, model


def plant_colliding(rng, style):
    style.language, style.split = "mjcf", False
    wanted = free(random_tree(rng, n=int(rng.integers(3, 8)), kind="chain", bobs=False))
    for i, link in enumerate(wanted.links):
        style.geoms[i] = f"<geom type='sphere' size='{0.45 * link.length!r}' mass='0'/>"
    return wanted, wanted


IN_FILES: dict[str, Callable[..., Any]] = {
    "armature": plant_armature,
    "damping": plant_damping,
    "dry-friction": plant_friction,
    "stiffness": plant_stiffness,
    "joint-limit": plant_limit,
    "mass": plant_mass,
    "length": plant_length,
    "inertia": plant_inertia,
    "gravity": plant_gravity,
    "gravity-turned": plant_gravity_turned,
    "com-displaced": plant_com,
    "inertial-com-rotated": plant_com_turned,
    "point-mass-patched": plant_point_mass,
    "inertia-from-geoms": plant_from_geoms,
    "degree-vs-radian": plant_degrees,
    "spring-reference": plant_spring_reference,
    "joint-dropped-by-parser": plant_dropped,
    "joint-added": plant_added,
    "colliding-geoms": plant_colliding,
}
ONLY_MJCF = {"armature", "stiffness"}


def planted_in_file(cause, rng):
    """A file with exactly this fault."""
    style = random_style(rng, "mjcf" if cause in ONLY_MJCF else None)
    model, wanted = IN_FILES[cause](rng, style)
    return Planted(cause, written(model, style, rng), style.language, wanted, model.n)


def diagnosed(text, language, wanted):
    """Findings of ``furiko.diagnose`` for a text, through a file."""
    with tempfile.TemporaryDirectory() as folder:
        return furiko.diagnose(saved(text, folder, language), wanted)
