"""What is wrong in a Hamiltonian, or in equations with momenta: each held to the truth in the form it is written in."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from ...algebra.division import exact_quotient
from ...algebra.equivalence import determinant
from ...algebra.multiples import divided
from ...algebra.quotient import Budget, TooLarge
from ...algebra.trig import CONSTANT_ONE, HALF, Formula, Space, digit
from ...reading.submission import Submission
from ...steps.derivation import add
from ...steps.first_order import WORK, FirstOrder, substituted
from ...steps.mechanism import Mechanism
from ..differences import Scaled, scalings, term_finding, terms, without_constants
from ..grade_record import WrongTerm
from ..hypotheses import Said


def first_order_differences(
    s: Submission, mechanism: Mechanism, given: dict[int, Formula] | None = None
) -> tuple[WrongTerm, ...]:
    """The wrong terms of a Hamiltonian, or of each equation with momenta; () where none can be told.

    ``given``: what symbols of the derivation stand for, by place.
    """
    assert s.first_order is not None
    stated = s.first_order.mapped(lambda f: s.space.replace(f, given)) if given else s.first_order
    try:
        if stated.hamiltonian is not None:
            return _of_hamiltonian(s, stated, mechanism)
        return (*_of_relations(s, stated, mechanism), *_of_slopes(s, stated, mechanism))
    except TooLarge:
        return ()


def canonical_momenta(mechanism: Mechanism) -> list[Formula]:
    """∂T/∂q̇ for each coordinate."""
    return [mechanism.space.by_rate(mechanism.kinetic, k) for k in range(mechanism.space.n)]


def scale_note(s: Submission, mechanism: Mechanism) -> list[Said]:
    """What momenta are that are not ∂(T - U)/∂q̇, though the motion is right."""
    stated = s.first_order
    if stated is None or not stated.canonical:
        return []
    momenta = stated.momenta
    right = canonical_momenta(mechanism)
    if list(momenta.above) == [p * momenta.below for p in right]:
        return []
    factors = {divided(p, q * momenta.below) for p, q in zip(momenta.above, right, strict=True)}
    (factor,) = factors if len(factors) == 1 else (None,)
    if factor is not None and factor.is_number():
        size = factor.number()
        return [(f"The momenta are {size} times those of T − U; the motion is the same.",
                 f"運動量は T − U のものの {size} 倍ですが、運動は同じです。")]  # fmt: skip
    return [("The momenta are not those of T − U; the motion is the same.",
             "運動量は T − U のものではありませんが、運動は同じです。")]  # fmt: skip


@lru_cache(maxsize=32)
def _inverted(mechanism: Mechanism) -> tuple[Formula, tuple[tuple[Formula, ...], ...]]:
    """The determinant of the mass matrix and its adjugate."""
    space, n = mechanism.space, mechanism.space.n
    matrix = [[space.by_rate(p, j) for j in range(n)] for p in canonical_momenta(mechanism)]
    budget = Budget(WORK)

    def cofactor(i: int, j: int) -> Formula:
        rest = [[x for c, x in enumerate(row) if c != j] for r, row in enumerate(matrix) if r != i]
        minor = determinant(rest, budget)
        return -minor if (i + j) % 2 else minor

    return determinant(matrix, budget), tuple(tuple(cofactor(j, i) for j in range(n)) for i in range(n))


def _of_hamiltonian(s: Submission, stated: FirstOrder, mechanism: Mechanism) -> tuple[WrongTerm, ...]:
    """Kinetic part: numerator and denominator; potential part by itself."""
    assert stated.hamiltonian is not None
    space, at = s.space, stated.at
    above, below = stated.hamiltonian
    whole, adjugate = _inverted(mechanism)
    p = [space.symbol(place) for place in at.momenta]
    right = add(adjugate[i][j] * p[i] * p[j] for i in range(space.n) for j in range(space.n))
    still = Formula({key: c for key, c in above.terms.items() if not _has(space, key[0], at.momenta)})
    moving = above - still
    findings: list[WrongTerm] = []
    height = exact_quotient(space, still, below)
    potential = mechanism.potential
    if height is None:  # a denominator below the potential energy: compared over the common one
        height, potential = still, potential * below
    pair = [without_constants(terms(space, f, apart=True)) for f in (height, potential)]
    energy = scalings(pair[0], pair[1])[0]
    direct = Scaled(pair[0], pair[1], CONSTANT_ONE)
    scaled = direct if direct.agreeing or not energy.agreeing else energy
    findings += [_said(s, scaled, key, "The Hamiltonian", "ハミルトニアン") for key in scaled.wrong]
    factor = exact_quotient(space, below, whole)
    if factor is not None and factor.is_monomial():
        kinetic = Scaled(_split(s, moving), _split(s, (right * factor).times(HALF)), CONSTANT_ONE)
        findings += [
            _said(s, kinetic, key, "The Hamiltonian's numerator", "ハミルトニアンの分子") for key in kinetic.wrong
        ]
        return tuple(findings)
    numerator = scalings(_split(s, moving), _split(s, right.times(HALF)))[0]
    findings += [_said(s, numerator, key, "The Hamiltonian's numerator", "ハミルトニアンの分子")
                 for key in numerator.wrong]  # fmt: skip
    denominator = Scaled(terms(space, below), terms(space, whole), numerator.factor)
    findings += [_said(s, denominator, key, "The Hamiltonian's denominator", "ハミルトニアンの分母")
                 for key in denominator.wrong]  # fmt: skip
    return tuple(findings)


def _has(space: Space, e: int, places: Sequence[int]) -> bool:
    return any(digit(e, place) for place in places)


def _of_relations(s: Submission, stated: FirstOrder, mechanism: Mechanism) -> list[WrongTerm]:
    """The relations that do not hold for the right momenta, each beside the right one that is most like it."""
    space, at = s.space, stated.at
    right = canonical_momenta(mechanism)
    values = dict(zip(at.momenta, right, strict=True))
    weights = dict.fromkeys(values, 1)
    wrong = [(label, f) for label, f in stated.relations
             if substituted(space, f, values, weights, CONSTANT_ONE, Budget(WORK))]  # fmt: skip
    if not wrong:
        return []
    whole, adjugate = _inverted(mechanism)
    p = [space.symbol(place) for place in at.momenta]
    solved = [whole * space.w(k) - add(a * x for a, x in zip(adjugate[k], p, strict=True)) for k in range(space.n)]
    plain = [x - f for x, f in zip(p, right, strict=True)]
    findings = []
    for label, f in wrong:
        given = _split(s, f)
        best = min((scalings(given, _split(s, g))[0] for g in (*solved, *plain)),
                   key=lambda x: (len(given) + len(x.right) - 2 * x.agreeing, len(x.wrong)))  # fmt: skip
        findings += [_said(s, best, key, f"Row {label}", f"第{label}行", label) for key in best.wrong]
    return findings


def _of_slopes(s: Submission, stated: FirstOrder, mechanism: Mechanism) -> list[WrongTerm]:
    """The derivatives of momenta that are wrong, with the right momenta put in."""
    space, at = s.space, stated.at
    values = dict(zip(at.momenta, canonical_momenta(mechanism), strict=True))
    forces = mechanism.driven
    rights = [space.symbol(at.slopes[k]) - space.by_angle(mechanism.lagrangian, k) - forces[k] for k in range(space.n)]
    findings: list[WrongTerm] = []
    for label, f in stated.slopes:
        given = substituted(space, f, values, dict.fromkeys(values, 1), CONSTANT_ONE, Budget(WORK))
        own = [k for k in range(space.n) if space.by_symbol(given, at.slopes[k])]
        if len(own) != 1:
            continue
        right = rights[own[0]]
        factor = space.by_symbol(given, at.slopes[own[0]])
        plain = exact_quotient(space, given, factor) if len(factor) > 1 else None
        best = scalings(_split(s, plain or given), _split(s, right))[0]
        findings += [_said(s, best, key, f"Row {label}", f"第{label}行", label) for key in best.wrong]
    return findings


def _split(s: Submission, f: Formula) -> dict[tuple[int, int, int], Formula]:
    assert s.first_order is not None
    at = s.first_order.at
    return terms(s.space, f, apart=True, beside=(*at.momenta, *at.slopes))


def _said(s: Submission, scaled: Scaled, key: tuple[int, int, int], where: str, wo: str, label: str = "") -> WrongTerm:
    return term_finding(s, scaled, key, label, where, wo)
