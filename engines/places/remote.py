"""Engines in a place of their own, as adapters: the same methods, each of which is a question over the protocol."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ...models import System
from ...models.spatial_mechanism import SpatialMechanism
from ..protocol import Array, ModelFields
from .connection import Connection, EngineFailed, Model
from .mechanisms import mechanism_of, planar, spatial
from .messages import Message
from .questions import FIELDS, PLANAR, SPATIAL


def adapter_class(connection: Connection) -> Any:
    """The class of an engine behind a connection, with the methods that it offers; it is started to learn them."""
    connection.running()
    offered = connection.hello.get("questions", [])
    known = [name for name in PLANAR if isinstance(offered, list) and name in offered]
    methods: dict[str, Any] = {name: getattr(_Planar, f"_{name}") for name in known}
    return type("EngineElsewhere", (_Planar,), methods | {"connection": connection})


def tree_class(connection: Connection) -> Any:
    """The class of its open mechanisms."""
    return type("TreeElsewhere", (_Tree,), {"connection": connection})


class _Planar:
    """A mechanism of the documents in the engine."""

    connection: Connection

    def __init__(self, system: System) -> None:
        self._model = self.connection.model(planar(system))

    def _accelerations(self, theta: Array, omega: Array) -> Array:
        return _one(self._model, "accelerations", theta, omega)

    def _fields(self) -> ModelFields:
        answer = self._model.ask("fields", {})
        parents: Any = answer.head.get("parents")
        dofs: Any = answer.head.get("dofs")
        if not (isinstance(parents, list) and all(type(p) is int for p in [*parents, dofs])):
            raise EngineFailed("fields: dofs and parents are no whole numbers")
        return ModelFields(dofs=dofs, parents=tuple(parents), **{name: _array(answer, name) for name in FIELDS})

    def _inverse_dynamics(self, theta: Array, omega: Array, alpha: Array, *, gravity: bool = True) -> Array:
        return _one(self._model, "inverse_dynamics", theta, omega, alpha, gravity=bool(gravity))

    def _joint_forces(self, theta: Array, omega: Array, alpha: Array) -> Array:
        return _one(self._model, "joint_forces", theta, omega, alpha)

    def _derivatives(self, theta: Array, omega: Array) -> tuple[Array, Array]:
        return _both(self._model.ask("derivatives", {"theta": theta, "omega": omega}))

    def _inverse_mass(self, theta: Array) -> Array:
        return _one(self._model, "inverse_mass", theta)

    def _energy(self, theta: Array, omega: Array) -> Array:
        return _one(self._model, "energy", theta, omega)

    def _trajectory(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        return self._run("trajectory", theta, omega, integrator=integrator, step=step, steps=steps)

    def _path(self, theta: Array, omega: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        return self._run("path", theta, omega, integrator=integrator, step=step, steps=steps)

    def _adaptive(
        self, theta: Array, omega: Array, scheme: str, duration: float, tolerance: float
    ) -> tuple[Array, Array]:
        return self._run("adaptive", theta, omega, scheme=scheme, duration=duration, tolerance=tolerance)

    def _gap(self) -> float:
        value = self._model.ask("gap", {}).head.get("value")
        if not isinstance(value, int | float):
            raise EngineFailed("gap: no number came")
        return float(value)

    def _run(self, question: str, theta: Array, omega: Array, **words: Any) -> tuple[Array, Array]:
        answer = self._model.ask(question, {"theta": theta, "omega": omega}, **words)
        return _array(answer, "theta"), _array(answer, "omega")


class _Terms:
    """The terms of an open mechanism's equations of motion, asked of a model in the engine."""

    _model: Model

    def mass_matrix(self, q: Array) -> Array:
        return _spatial(self._model, "mass_matrix", q)

    def bias(self, q: Array, v: Array) -> Array:
        return _spatial(self._model, "bias", q, v)

    def passive(self, q: Array, v: Array) -> Array:
        return _spatial(self._model, "passive", q, v)


class _Tree(_Terms):
    """An open mechanism in the engine (:class:`~furiko.engines.protocol.TreeEngine`)."""

    connection: Connection

    def __init__(self, mechanism: SpatialMechanism) -> None:
        self._model = self.connection.model(spatial(mechanism))

    def accelerations(self, q: Array, v: Array) -> Array:
        return _spatial(self._model, "accelerations", q, v)

    def derivatives(self, q: Array, v: Array) -> tuple[Array, Array]:
        return _both(self._model.ask("derivatives", {"q": q, "v": v}, spatial=True))

    def inverse_mass(self, q: Array) -> Array:
        return _spatial(self._model, "inverse_mass", q)

    def joint_forces(self, q: Array, v: Array, a: Array) -> Array:
        return _spatial(self._model, "joint_forces", q, v, a)

    def energy(self, q: Array, v: Array) -> Array:
        return _spatial(self._model, "energy", q, v)

    def trajectory(self, q: Array, v: Array, integrator: str, step: float, steps: int) -> tuple[Array, Array]:
        words = {"integrator": integrator, "step": step, "steps": steps}
        answer = self._model.ask("trajectory", {"q": q, "v": v}, spatial=True, **words)
        return _array(answer, "q"), _array(answer, "v")


class RemoteRobot:
    """A user's file in the engine (:class:`~furiko.engines.model_files.robot.RobotEngine`)."""

    def __init__(self, connection: Connection, path: Path, language: str, folders: Sequence[Path] = ()) -> None:
        if folders:
            raise ValueError("folders of meshes reach no engine in a place of its own")
        self._model = connection.model({"kind": "file", "path": str(path.absolute()), "language": language})

    def compiled(self, like: SpatialMechanism | None = None) -> SpatialMechanism:
        answer = self._model.compiled(None if like is None else spatial(like))
        try:
            self._names = tuple(map(str, answer.head["joints"]))
            return mechanism_of(answer.head["mechanism"])
        except (KeyError, TypeError, ValueError) as error:
            raise EngineFailed(f"the mechanism that came is none: {error}") from None

    def joints(self) -> tuple[str, ...]:
        self.compiled()
        return self._names

    def bind(self, mechanism: SpatialMechanism) -> _BoundRobot:
        model = Model(self._model.connection, spatial(mechanism), of=self._model)
        model.built()
        return _BoundRobot(model)


class _BoundRobot(_Terms):
    """The same, asked in a mechanism's coordinates."""

    def __init__(self, model: Model) -> None:
        self._model = model

    def accelerations(self, q: Array, v: Array, torque: Array) -> Array:
        return _spatial(self._model, "driven_accelerations", q, v, torque)


def _one(model: Model, question: str, *arrays: Array, **words: Any) -> Array:
    asked = PLANAR[question]
    answer = model.ask(question, dict(zip(asked.takes, arrays, strict=True)), **words)
    return _array(answer, asked.gives[0])


def _spatial(model: Model, question: str, *arrays: Array) -> Array:
    asked = SPATIAL[question]
    answer = model.ask(question, dict(zip(asked.takes, arrays, strict=True)), spatial=True)
    return _array(answer, asked.gives[0])


def _both(answer: Message) -> tuple[Array, Array]:
    return _array(answer, "of_positions"), _array(answer, "of_rates")


def _array(answer: Message, name: str) -> Array:
    if name not in answer.arrays:
        raise EngineFailed(f"its answer has no array {name!r}; it has {', '.join(answer.arrays) or 'none'}"[:300])
    return np.asarray(answer.arrays[name])
