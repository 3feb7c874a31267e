"""Engines that misread a model file: their text of it is changed on the way."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from furiko.engines.model_files.adapter import READERS, Reader
from furiko.models.readers.model_file import model_from_text

from .mechanisms import free, random_tree
from .writing import random_style, written


def misread(reader, change):
    """A reader to whom the file's text comes changed: what an engine with a faulty parser makes of it."""

    class Misreading:
        def __init__(self, given):
            self.given = given

        def load(self, model):
            return self.given.load(replace(model, text=change(model.text)))

        def __getattr__(self, name):
            return getattr(self.given, name)

    return Misreading(reader)


def no_rotation(text):
    """Inertials without their orientation."""
    return re.sub(r"(<inertial[^>]*?) quat='[^']*'", r"\1", re.sub(r'(<inertial[^>]*?) quat="[^"]*"', r"\1", text))


def unit_inertials(text):
    return re.sub(r"<inertial[^>]*/>", '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>', text)


def fixed_not_turned(text):
    """Bodies fixed to others as if they were not turned."""
    return re.sub(r'(<body name="[^"]*_fixed0"[^>]*?) quat="[^"]*"', r"\1", text)


def geoms_rule(text):
    return text.replace("<compiler ", '<compiler inertiafromgeom="true" ', 1)


def other_gravity(text):
    return re.sub(r'gravity="[^"]*"', 'gravity="0 0 -3.7"', text)


def misreading(cause, rng):
    """(file, readers, cause): one engine of three misreads the file, or all do."""
    style = random_style(rng, "mjcf")
    style.full, style.turn_inertials, style.split = False, True, False
    wanted = free(random_tree(rng, kind="chain", bobs=False))
    change = {
        "urdf-inertial-rpy-lost": no_rotation,
        "fused-static-frame": fixed_not_turned,
        "inertial-ignored": unit_inertials,
        "inertia-from-geoms": geoms_rule,
        "gravity": other_gravity,
        "theory-is-wrong": unit_inertials,
    }[cause]
    if cause == "fused-static-frame":
        style.split = True
    if cause == "gravity":
        style.turn_world = False
    if cause == "inertia-from-geoms":
        for i, link in enumerate(wanted.links):
            style.geoms[i] = f"<geom type='capsule' size='0.03 {link.length / 2!r}' contype='0' conaffinity='0'/>"
    file = model_from_text(written(wanted, style, rng), "planted.xml")
    readers: dict[str, Reader | Any] = dict(READERS)
    names = ("mujoco", "pinocchio-aba") if cause == "theory-is-wrong" else ("mujoco",)
    for name in names:
        readers[name] = misread(READERS[name], change)
    return file, readers


OF_READERS = ("urdf-inertial-rpy-lost", "fused-static-frame", "inertial-ignored", "inertia-from-geoms", "gravity",
              "theory-is-wrong")  # fmt: skip
