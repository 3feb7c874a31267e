"""The summary of ``furiko stress``: the records of its JSON document, which the pages and the terminal show.

A JSON key is the field's name unless ``name=`` says otherwise. None stands for what is not known yet or does not exist.
"""

from __future__ import annotations

from typing import Literal

import msgspec

HALF_THE_DIGITS = 2.0**-26  # relative error: of the 53 bits of a double 27 are lost


class CurvePoint(msgspec.Struct, frozen=True, kw_only=True):
    """Accelerations on one rung of an axis; errors are relative to the largest acceleration of the state."""

    value: float  # in the unit of the axis
    at: str | None  # the value with its unit
    error: float | None  # of a typical state: the median
    worst_error: float | None = msgspec.field(name="worst error")
    digits: float | None  # correct decimal digits of a typical state
    one_ulp: float | None = msgspec.field(name="one ulp does")  # change when one input moves by one ulp
    condition: float | None  # of the mass matrix, in the coordinates of the engine
    error_over_condition: float | None = msgspec.field(name="error over ε·cond")
    failure: str | None
    # Of open mechanisms: the residual of the worst state over what rounding may do to it; above 1 none explains it
    error_over_bound: float | None = msgspec.field(name="error over bound", default=None)


class AxisFrontier(msgspec.Struct, frozen=True, kw_only=True):
    """Up to which rung of an axis, or of a pair of axes, the accelerations of an engine keep half their digits."""

    axis: str
    says: str  # the axis in words
    engine: str
    pair: bool  # two axes at once
    closed: bool  # no rung is left between the last that holds and the first that fails
    status: Literal["open", "holds", "fails"]
    holds: int  # last rung that holds; -1: none
    fails: int | None  # first rung that fails
    holds_at: str | None = msgspec.field(name="holds at")
    fails_at: str | None = msgspec.field(name="fails at")
    top: int  # last rung of the axis for this engine
    failure: str | None
    reason: str
    curve: list[CurvePoint]
    mechanism: str | None = None  # the open mechanism that the axis is on; None: the documents'


class KernelCase(msgspec.Struct, frozen=True, kw_only=True):
    """One case in which the error of furiko's own kernels is above the promised bound."""

    axis: str
    at: str | None
    measured: float | None
    allowed: float | None
    reason: str


class KernelErrors(msgspec.Struct, frozen=True, kw_only=True):
    """Errors of furiko's own kernels, relative to the largest acceleration of the state."""

    cases: int
    promised: float
    worst: float | None
    broken: list[KernelCase]  # above every bound
    exceptions: list[KernelCase]  # above ``promised``, but within ten times what one ulp of the input does


class ConditionGrowth(msgspec.Struct, frozen=True, kw_only=True):
    """Condition number of the mass matrix against the number of links, in one posture and one kind of angles."""

    posture: str
    coordinates: str  # absolute or relative
    n: list[int]
    condition: list[float]
    power: float | None  # of n, with which it grows


class StepRun(msgspec.Struct, frozen=True, kw_only=True):
    """One run at one step size."""

    rung: int
    step: float  # [s]
    failure: str | None


class StableStep(msgspec.Struct, frozen=True, kw_only=True):
    """Largest stable step size of one integrator at one value of what is varied."""

    engine: str
    integrator: str
    stress: str  # what is varied: links, speed or length
    value: float
    unit: str
    closed: bool
    rung: int  # last rung that holds; -1: none
    step: float | None  # its step size [s]
    fails_at: float | None = msgspec.field(name="fails at")  # [s]
    failure: str | None
    reason: str
    runs: list[StepRun] = msgspec.field(name="cells")


class TreeRunPoint(msgspec.Struct, frozen=True, kw_only=True):
    """One run of so long: how far its end is off. None: it is not finite, or nothing was run."""

    time: float  # [s]
    phase_error: float | None = msgspec.field(name="phase error")  # [rad], or in parts of what moves
    energy_drift: float | None = msgspec.field(name="energy drift")  # over the motion's own energy
    length_drift: float | None = msgspec.field(name="length drift")  # of a quaternion's length from one
    failure: str | None


class TreeRun(msgspec.Struct, frozen=True, kw_only=True):
    """How long one integrator with one step keeps to a motion of an open mechanism that is known for ever."""

    engine: str
    integrator: str
    motion: str
    says: str  # the motion in words
    step: float  # [s]
    closed: bool
    holds_at: float | None = msgspec.field(name="holds at")  # the longest time [s] before the first that fails
    fails_at: float | None = msgspec.field(name="fails at")  # [s]
    failure: str | None
    reason: str
    runs: list[TreeRunPoint]


class EnergyDrift(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Energy in a long run of one integrator, relative to the energy above rest."""

    engine: str
    integrator: str
    steps: int  # done so far
    of: int  # planned
    closed: bool
    kind: str | None  # bounded, random walk, linear or exponential
    failure: str | None
    drift: list[float]  # at most some hundred samples
    largest: float
    exponent: float | None = None  # H of ⟨(E(t + τ) - E(t))²⟩ ~ τ^(2H)
    rate: float | None = None  # per step
    spread: float | None = None


class FailureCount(msgspec.Struct, frozen=True, kw_only=True):
    """How often an engine failed in one way, and the first case."""

    engine: str
    failure: str
    times: int
    where: str
    reason: str


class SwingError(msgspec.Struct, frozen=True, kw_only=True):
    """Error of the k-th natural frequency of the hanging chain, relative to Bernoulli's limit, for each n."""

    k: int
    errors: list[float]
    order: float | None  # of convergence in 1/n
    coefficient: float  # error · n^power at the largest n


class SmallSwings(msgspec.Struct, frozen=True, kw_only=True):
    """Natural frequencies of a chain of n links against those of a continuous chain."""

    links: str  # rods or point masses
    n: list[int]
    power: int  # expected order of convergence
    rows: list[SwingError]


class UsableStep(msgspec.Struct, frozen=True, kw_only=True):
    """Largest stable step size of the classical Runge-Kutta scheme for n rods."""

    n: int
    step: float | None  # [s]


class ChainMemory(msgspec.Struct, frozen=True, kw_only=True):
    """Additional peak memory while a chain of n rods moves."""

    n: int
    bytes: float | None


class ChainMotion(msgspec.Struct, frozen=True, kw_only=True):
    """Motion of a chain of n rods, 1 m long, from rest in a given curve. The support is the origin, z points up."""

    n: int
    amplitude: float  # of the curve; 1: the large motion
    tolerance: float
    closed: bool
    time: float  # [s], simulated so far
    tip: list[list[float]]  # x, z [m], equally spaced in time
    speed: list[float]  # of the tip [m/s], at the same times
    fastest_tip: float = msgspec.field(name="fastest tip")  # [m/s]
    fastest_tip_at: float = msgspec.field(name="fastest tip at")  # [s]
    fastest_turning: float = msgspec.field(name="fastest turning")  # largest angular rate of a rod [rad/s]
    energy_drift: float = msgspec.field(name="energy drift")  # relative
    steps: int
    mean_step: float = msgspec.field(name="mean step")  # [s]
    seconds: float  # of computing
    curves: dict[str, list[list[float]]]  # joints x, z [m], by time [s]


class TipConvergence(msgspec.Struct, frozen=True, kw_only=True):
    """Distance between the tips of chains of n and 2n rods."""

    amplitude: float
    n: int
    times: list[float]  # [s]
    largest: list[float] = msgspec.field(name="apart")  # largest distance until each of the times [m]
    series: list[float]  # distance [m], at the times of the motions
    order: list[float | None]  # of convergence in 1/n, at each of the times that the next doubling reaches too


class StepConvergence(msgspec.Struct, frozen=True, kw_only=True):
    """Distance between the tips of a fine and a coarse run of the same chain."""

    n: int
    times: list[float]  # [s]
    largest: list[float] = msgspec.field(name="apart")  # largest distance until each of the times [m]


class ChainSummary(msgspec.Struct, frozen=True, kw_only=True):
    """Takeno's chain: n rods of 1 m in all, n → ∞."""

    swings: list[SmallSwings]
    usable_steps: list[UsableStep] = msgspec.field(name="usable step")
    memory: list[ChainMemory]
    motions: list[ChainMotion]
    convergence: list[TipConvergence]
    step_convergence: list[StepConvergence] = msgspec.field(name="in step")
    verdict: list[str]  # sentences: is the violent motion of the tip physics or numerics


class StressSummary(msgspec.Struct, frozen=True, kw_only=True):
    """All of one stress test."""

    seed: int
    cases: int
    open: int  # questions without an answer yet
    frontiers: list[AxisFrontier]
    kernels: KernelErrors
    condition: list[ConditionGrowth]
    steps: list[StableStep]
    long_runs: list[EnergyDrift] = msgspec.field(name="long runs")
    failures: list[FailureCount]
    chain: ChainSummary
    tree_runs: list[TreeRun] = msgspec.field(name="tree runs", default=[])
