"""An engine whose answers belong to another state than the one it was asked about: a buffer that was not renewed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from .explanation import Explanation, one_of
from .finding import Finding
from .measurement import Array, Measurement
from .question import Question, View

MOST_ALIKE = 2


@dataclass(frozen=True)
class Buffer:
    """A fault of bookkeeping: ``view`` is what was measured as it looks without the fault."""

    says: str
    view: View

    def finding(self, who: str) -> Finding:
        """The fault of this engine."""
        return Finding("stale-derived-state", who, -1.0, 0.0, f"{who}: {self.says}")


def stale_answers(q: Question) -> Explanation:
    """The buffers that explain everything."""
    found = [
        buffer.finding(q.who)
        for buffer in buffers(q.measured)
        if buffer.view(q.measured).worst(q.p) <= 1 and buffer.view(q.again).worst(q.p) <= 1
    ]
    return one_of(found[:MOST_ALIKE])


def buffers(measured: Measurement) -> Iterator[Buffer]:
    """Every bookkeeping fault that is known, in forward dynamics of several states at once."""
    if int(measured.forward.sum()) < 3:
        return
    yield Buffer("each answer is that to the state before: a buffer is read before it is renewed", _late(("alpha",)))
    yield Buffer("rates are those of the state before", _late(("theta", "alpha")))
    yield Buffer("angles are those of the state before", _late(("omega", "alpha")))
    yield Buffer("every answer is that to the last state: one buffer is returned again and again", _same(-1))
    yield Buffer("every answer is that to the first state", _same(0))


def _late(late: tuple[str, ...]) -> View:
    """``late``: what belongs to the state before; with the answer alone, the whole state is earlier."""

    def view(measured: Measurement) -> Measurement:
        forward = measured.only(measured.forward)
        kept = [name for name in ("theta", "omega") if late != ("alpha",) and name == late[0]]
        theta, omega = (
            values[1:] if name in kept else values[:-1]
            for name, values in (("theta", forward.theta), ("omega", forward.omega))
        )
        return _joined(theta, omega, forward, measured)

    return view


def _same(row: int) -> View:
    def view(measured: Measurement) -> Measurement:
        forward = measured.only(measured.forward)
        theta, omega = (np.repeat(values[[row]], len(forward), axis=0) for values in (forward.theta, forward.omega))
        return _joined(theta, omega, forward, measured)

    return view


def _joined(theta: Array, omega: Array, forward: Measurement, measured: Measurement) -> Measurement:
    """The last answers of forward dynamics as those to these states, and inverse dynamics as measured."""
    inverse, last = measured.only(~measured.forward), slice(len(forward) - len(theta), None)
    return replace(
        measured,
        theta=np.concatenate([theta, inverse.theta]),
        omega=np.concatenate([omega, inverse.omega]),
        alpha=np.concatenate([forward.alpha[last], inverse.alpha]),
        torque=np.concatenate([forward.torque[last], inverse.torque]),
        forward=np.concatenate([forward.forward[last], inverse.forward]),
    )
