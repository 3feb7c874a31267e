"""Judges a derivation stage by stage, each against the truth given the stages before it.

A stage is *right* where it is the truth's own, *follows* where it comes correctly from the author's earlier stages
though these are wrong, and *wrong* elsewhere: then a mistake was made at this stage.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import product
from typing import Any, Literal

from ...algebra.equivalence import System, compare
from ...algebra.fingerprint import point_of
from ...algebra.multiples import is_multiple
from ...algebra.quotient import Budget
from ...algebra.trig import CONSTANT_ONE, HALF, Formula
from ...reading.forms.hamilton import places
from ...reading.submission import Submission
from ...steps.derivation import add, lagrange_rows
from ...steps.first_order import WORK, FirstOrder, Momenta, substituted, without_momenta
from ...steps.stages import Component, StageName, Stages
from ..differences import Scaled, differences_from, lagrangian_scalings, term_finding, terms, without_constants
from ..grade_record import StageMark, WrongTerm
from ..hypotheses import Hypothesis
from ..judge import one_scale

RIGHT = ("same", "incomplete", "not proved")
Frame = tuple[tuple[int, int], tuple[int, int]]  # x and y: which of right (0) and up (1) each is, and its sign
UPRIGHT: Frame = ((0, 1), (1, 1))
_WAYS = [((i, a), (1 - i, b)) for i in (0, 1) for a, b in product((1, -1), repeat=2)]
FRAMES: tuple[Frame, ...] = (UPRIGHT, *(frame for frame in _WAYS if frame != UPRIGHT))
WHERE: dict[StageName, tuple[str, str]] = {
    "positions": ("The position", "位置"), "velocities": ("The velocity", "速度"),
    "kinetic": ("The kinetic energy", "運動エネルギー"), "potential": ("The potential energy", "位置エネルギー"),
    "lagrangian": ("The Lagrangian", "ラグランジアン"), "momenta": ("The momentum", "運動量"),
    "hamiltonian": ("The Hamiltonian", "ハミルトニアン"), "equations": ("The equations of motion", "運動方程式"),
    "solved": ("The solved equations", "解いた式"),
}  # fmt: skip
Outcome = Literal["right", "follows", "wrong"]
Parts = Mapping[Component, Formula]


@dataclass(frozen=True)
class Said:
    """What has been stated up to a stage; what is not there is the truth's."""

    positions: Parts = field(default_factory=dict)
    velocities: Parts = field(default_factory=dict)
    kinetic: Formula | None = None
    potential: Formula | None = None
    lagrangian: Formula | None = None
    equations: tuple[Formula, ...] = ()


class StageJudge:
    """One staged derivation, held against one mechanism."""

    def __init__(self, s: Submission, h: Hypothesis) -> None:
        assert s.stages is not None
        self.s, self.space, self.mechanism = s, s.space, h.mechanism
        self.stages = _meant(s, s.stages, h)

    @cached_property
    def frame(self) -> Frame:
        """Which way the author counts x and y: so that most of what he writes is right."""
        given = self.stages.positions or self.stages.velocities
        slow = bool(self.stages.positions)

        def right(frame: Frame, key: Component) -> Formula:
            true = self._true(frame, key)
            return self.moving(true if slow else self.space.by_time(true))

        def score(frame: Frame) -> int:
            return sum(self.moving(f) == right(frame, key) for key, f in given.items() if key[0] != "v")

        return max(FRAMES, key=score)

    @property
    def frame_note(self) -> tuple[str, str] | None:
        """Which way x and y are counted, where that is not to the right and upwards."""
        frame = self.frame
        if frame == UPRIGHT or not (self.stages.positions or any(k[0] != "v" for k in self.stages.velocities)):
            return None
        ways = {(0, 1): ("to the right", "右"), (0, -1): ("to the left", "左"), (1, 1): ("upwards", "上"),
                (1, -1): ("downwards", "下")}  # fmt: skip
        (x, xja), (y, yja) = ways[frame[0]], ways[frame[1]]
        return f"x is counted {x} and y {y}.", f"x は{xja}向き、y は{yja}向きに測っています。"

    def marks(self) -> tuple[StageMark, ...]:
        """Every stage that is given, judged."""
        return tuple(self._marks())

    def is_right(self) -> bool:
        """Whether no stage is wrong; the first that is ends it."""
        return all(mark.outcome != "wrong" for mark in self._marks())

    def _marks(self) -> Iterator[StageMark]:
        said, truth = Said(), Said()
        for stage in self.stages.given:
            findings = self._findings(stage, truth)
            outcome: Outcome = "right"
            if findings:
                findings = self._findings(stage, said) if said != truth else findings
                outcome = "wrong" if findings else "follows"
            yield _mark(stage, outcome, findings, self._parts(stage))
            said = self._after(stage, said)

    def only(self, stage: StageName) -> Said:
        """What is stated at one stage, all else being right."""
        return self._after(stage, Said())

    # What each stage must be, given what was said before

    def _true(self, frame: Frame, key: Component) -> Formula:
        axis, sign = frame[key[0] == "y"]
        return self.mechanism.positions[key[1]][axis].times(sign)

    def position(self, said: Said, key: Component) -> Formula:
        """As it was stated, or right."""
        return said.positions.get(key, self._true(self.frame, key))

    def velocity(self, said: Said, key: Component) -> Formula:
        """As it was stated, or the derivative of the position."""
        found = said.velocities.get(key)
        return self.space.by_time(self.position(said, key)) if found is None else found

    def square(self, said: Said, b: int) -> Formula:
        """The square of a body's speed."""
        found = said.velocities.get(("v", b))
        if found is not None:
            return found
        return add(v * v for v in (self.velocity(said, (axis, b)) for axis in "xy"))

    def kinetic(self, said: Said) -> Formula:
        """Σ ½ m v² + ½ I ω²."""
        if said.kinetic is not None:
            return said.kinetic
        if not said.positions and not said.velocities:
            return self.mechanism.kinetic
        bodies = range(len(self.mechanism.bodies))
        moved = add(self.mechanism.mass(b).times(HALF) * self.square(said, b) for b in bodies)
        return moved + self.mechanism.rotation

    def potential(self, said: Said) -> Formula:
        """Σ m g y, y upwards, and what springs store."""
        if said.potential is not None:
            return said.potential
        name = "x" if self.frame[0][0] == 1 else "y"
        sign = self.frame[name == "y"][1]
        weight = self.mechanism.gravity.times(sign)
        bodies = range(len(self.mechanism.bodies))
        return (
            add(self.mechanism.mass(b) * weight * self.position(said, (name, b)) for b in bodies)
            + self.mechanism.springs
        )

    def lagrangian(self, said: Said) -> Formula:
        """T - U."""
        return self.kinetic(said) - self.potential(said) if said.lagrangian is None else said.lagrangian

    def momenta(self, said: Said) -> list[Formula]:
        """∂L/∂q̇ for each coordinate."""
        lagrangian = self.lagrangian(said)
        return [self.space.by_rate(lagrangian, k) for k in range(self.space.n)]

    def rows(self, said: Said) -> list[Formula]:
        """Lagrange's equations with the mechanism's forces."""
        return self._forced(lagrange_rows(self.space, self.lagrangian(said)))

    def _forced(self, free: Sequence[Formula]) -> list[Formula]:
        return [row - force for row, force in zip(free, self.mechanism.driven, strict=True)]

    def _after(self, stage: StageName, said: Said) -> Said:
        given = self.stages
        rows = tuple(f for _, f in given.equations) if len(given.equations) == self.space.n else ()
        changes: dict[str, dict[str, Any]] = {
            "positions": {"positions": given.positions}, "velocities": {"velocities": given.velocities},
            "kinetic": {"kinetic": given.kinetic}, "potential": {"potential": given.potential},
            "lagrangian": {"lagrangian": given.lagrangian}, "equations": {"equations": rows},
            "hamiltonian": {} if given.hamiltonian is None else {"lagrangian": given.hamiltonian},
        }  # fmt: skip
        return replace(said, **changes.get(stage, {}))

    # What differs

    def _findings(self, stage: StageName, said: Said) -> list[WrongTerm]:  # noqa: PLR0911 -- one for each stage
        match stage:
            case "positions":
                return self._positions(said)
            case "velocities":
                return self._velocities(said)
            case "kinetic":
                assert self.stages.kinetic is not None
                return self._compared(stage, self.stages.kinetic, self.kinetic(said))
            case "potential":
                assert self.stages.potential is not None
                return self._compared(stage, self.stages.potential, self.potential(said))
            case "lagrangian":
                assert self.stages.lagrangian is not None
                return self._lagrangian(stage, self.stages.lagrangian, said)
            case "momenta":
                return self._momenta(said)
            case "hamiltonian":
                return self._hamiltonian(said)
            case "equations":
                return self._equations(said)
            case "solved":
                return self._rows(self.stages.solved, list(said.equations) or self.rows(said))

    def _positions(self, said: Said) -> list[WrongTerm]:
        found: list[WrongTerm] = []
        off: list[Formula] = []  # by how much the bodies before are wrong, where that is judged already
        for key, f in sorted(self.stages.positions.items(), key=lambda item: (item[0][0], item[0][1])):
            expected = self.position(Said(), key)
            error = self.moving(f - expected)
            if not error or any(error == x.times(k) for x in off for k in (1, 2)):
                continue
            off.append(error)
            found += self._compared("positions", f, expected, _name(key))
        return found

    def _velocities(self, said: Said) -> list[WrongTerm]:
        found: list[WrongTerm] = []
        partial = replace(said, velocities={k: f for k, f in self.stages.velocities.items() if k[0] != "v"})
        for key, f in self.stages.velocities.items():
            expected = self.square(partial, key[1]) if key[0] == "v" else self.velocity(said, key)
            found += self._compared("velocities", f, expected, _name(key))
        return found

    def _compared(self, stage: StageName, given: Formula, expected: Formula, label: str = "") -> list[WrongTerm]:
        one, other = (without_constants(terms(self.space, f, apart=True)) for f in (given, expected))
        scaled = Scaled(one, other, CONSTANT_ONE)
        where, wo = WHERE[stage]
        name = f" {label}" if label else ""
        return [term_finding(self.s, scaled, key, label, where + name, wo + name) for key in scaled.wrong]

    def _lagrangian(self, stage: StageName, given: Formula, said: Said) -> list[WrongTerm]:
        expected = self.lagrangian(said)
        if self.moving(given) == self.moving(expected):
            return []
        rows = lagrange_rows(self.space, given)
        if one_scale(self.space, rows, lagrange_rows(self.space, expected)) or one_scale(
            self.space, rows, self.rows(said)
        ):
            return []
        scaled = lagrangian_scalings(self.space, given, expected)[0]
        where, wo = WHERE[stage]
        return [term_finding(self.s, scaled, key, "", where, wo) for key in scaled.wrong]

    def _momenta(self, said: Said) -> list[WrongTerm]:
        right, momenta = self.momenta(said), places(self.space).momenta
        found: list[WrongTerm] = []
        for label, relation in self.stages.momenta:
            own = [k for k, place in enumerate(momenta) if self.space.by_symbol(relation, place)]
            if len(own) != 1:
                continue
            given = self.space.symbol(momenta[own[0]]) - relation
            found += self._compared("momenta", given, right[own[0]], label)
        return found

    def _hamiltonian(self, said: Said) -> list[WrongTerm]:
        if self.stages.hamiltonian is not None:
            return self._lagrangian("hamiltonian", self.stages.hamiltonian, said)
        return [_whole("hamiltonian", "", "it does not belong to the Lagrangian", "ラグランジアンに対応していません")]

    def _equations(self, said: Said) -> list[WrongTerm]:
        """Equations of motion; with momenta, these as they were stated, or as the Lagrangian has them."""
        expected, written = self.rows(said), self.stages.written
        if written is None:
            return self._rows(self.stages.equations, expected)
        found: list[WrongTerm] = []
        for momenta in (written.momenta, Momenta(tuple(self.momenta(said)), CONSTANT_ONE)):
            budget = Budget(WORK)
            slopes = [f for _, f in written.slopes]
            rows = without_momenta(self.space, written.at, slopes, momenta, budget)
            labels = [label for label, _ in written.slopes]
            found = self._rates(written, momenta) + self._rows(tuple(zip(labels, rows, strict=True)), expected)
            if not found:
                return []
        return found

    def _rates(self, written: FirstOrder, momenta: Momenta) -> list[WrongTerm]:
        values = dict(zip(written.at.momenta, momenta.above, strict=True))
        weights = dict.fromkeys(values, 1)
        return [
            _whole("equations", label, "with the momenta put in, its sides differ", "運動量を代入しても一致しません")
            for label, f in written.relations
            if substituted(self.space, f, values, weights, momenta.below, Budget(WORK))
        ]

    def _rows(self, given: Sequence[tuple[str, Formula]], expected: list[Formula]) -> list[WrongTerm]:
        point = point_of(self.space)
        right = System(self.space, expected, point)
        if compare(System(self.space, [f for _, f in given], point), right).answer in RIGHT:
            return []
        split = self.space.split
        if len(given) == len(expected) and all(
            is_multiple(split(f), split(g)) for (_, f), g in zip(given, expected, strict=True)
        ):
            return []  # they say no acceleration, but say the same
        stand_in = replace(self.s, rows=tuple(given), stages=None)
        found = list(differences_from(stand_in, expected))
        return found or [_whole("equations", "", "they are not equivalent", "同値ではありません")]

    def _parts(self, stage: StageName) -> int:
        """How many terms the right stage has: what a wrong one costs its share of."""
        m, said = self.mechanism, Said()
        match stage:
            case "positions":
                formulas = [self.position(said, key) for key in self.stages.positions]
            case "velocities":
                formulas = [self.velocity(said, key) if key[0] != "v" else self.square(said, key[1])
                            for key in self.stages.velocities]  # fmt: skip
            case "kinetic":
                formulas = [m.kinetic]
            case "potential":
                formulas = [m.potential]
            case "lagrangian" | "hamiltonian":
                formulas = [m.lagrangian]
            case "momenta":
                formulas = self.momenta(said)
            case _:
                formulas = list(m.rows)
        return sum(len(without_constants(terms(self.space, f, apart=True))) for f in formulas)

    def moving(self, f: Formula) -> Formula:
        """Without what neither moves nor turns: where the zero of height or of x is, is the author's choice."""
        return Formula({
            (e, h, s): c for (e, h, s), c in f.terms.items() if h or self.space.motion(e) or self.space.outside(e)
        })  # fmt: skip


def _meant(s: Submission, stages: Stages, h: Hypothesis) -> Stages:
    """With what the author's symbols stand for in this hypothesis."""
    values = h.variant.given
    return stages.mapped(lambda f: s.space.replace(f, values)) if values else stages


def _name(key: Component) -> str:
    return f"v{key[1] + 1}^2" if key[0] == "v" else f"{key[0]}{key[1] + 1}"


def _whole(stage: StageName, label: str, english: str, japanese: str) -> WrongTerm:
    where, wo = WHERE[stage]
    row, rowja = (f", row {label}", f" 第{label}行") if label else ("", "")
    return WrongTerm("", "the whole", "", "", "stage-inconsistent", f"{where}{row}: {english}.",
                     f"{wo}{rowja}：{japanese}。", label)  # fmt: skip


def _mark(stage: StageName, outcome: Outcome, findings: Sequence[WrongTerm], parts: int) -> StageMark:
    where, wo = WHERE[stage]
    said: dict[Outcome, tuple[str, str]] = {
        "right": ("right", "正しい"),
        "follows": ("follows from what is written before it; not judged again", "前の段階から正しく導かれています"),
        "wrong": ("a mistake is made here", "ここに誤りがあります"),
    }  # fmt: skip
    english, japanese = said[outcome]
    return StageMark(stage, outcome, f"{where}: {english}.", f"{wo}：{japanese}。", tuple(findings), parts)
