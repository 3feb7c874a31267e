"""What a proof rests on, part by part: the residual's bound, the tube's boxes and derivatives, turned directions."""

import numpy as np
import pytest
from flint import arb, arb_mat, arb_poly
from leaning_tree import general

from furiko.models import NLegPendulum, RodChain
from furiko.models.mechanism import mechanism_of
from furiko.reference import planar_tree
from furiko.reference.arithmetic import balls
from furiko.reference.proved import tube
from furiko.reference.proved.clouds import Cloud, box, spread_series
from furiko.reference.proved.defect import Defect
from furiko.reference.proved.form import form_of, planar
from furiko.reference.proved.series import motion_series
from furiko.reference.truth.enclosures import precision

SYSTEMS = {
    "n-leg": NLegPendulum((1.0, 0.8, 0.6), (1.0, 0.5, 2.0)),
    "rods": RodChain((1.0, 0.5, 0.7), 1.0),
    "tree": general(),
}
THETA, OMEGA = (2.0, 2.5, 1.0), (0.5, -1.0, 2.0)


def mechanism(system):
    return system if hasattr(system, "hinges") else mechanism_of(system.tree())


def rows(system, theta, omega, alpha):
    """The equations' rows by the recursive Newton-Euler algorithm, in balls."""
    one = mechanism(system)
    numbers = planar_tree.parameters(one, balls())
    arrays = (np.array(values, dtype=object) for values in (theta, omega, alpha))
    return planar_tree.inverse_dynamics(one.parents, numbers, *arrays)


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
@pytest.mark.parametrize("length", [0.06, -0.03])
def test_the_residual_is_within_its_bound_and_not_far_below(system, length):
    order = 12
    with precision(200):
        form = form_of(planar(system))
        series = motion_series(form, [*map(arb, THETA)], [*map(arb, OMEGA)], order)
        bound = Defect(form, series).rows(arb(length))
        largest = [0.0] * 3
        for part in np.linspace(0, 1, 11):
            time = arb(float(part)) * length
            theta = [arb_poly(c)(time) for c in series.x]
            omega = [arb_poly(c)(time) for c in series.v]
            alpha = [arb_poly(c).derivative()(time) for c in series.v]
            for i, row in enumerate(rows(system, theta, omega, alpha)):
                # rods: the tree's masses are rounded to doubles, the series' are not: 1e-16 of forces of some ten
                assert abs(row) <= bound[i] + (arb("1e-14") if isinstance(system, RodChain) else 0)
                largest[i] = max(largest[i], float(abs(row).upper()))
        # sums of absolute values instead of a sum: a power of ten or three, not ten
        assert all(float(b) < 1e4 * max(a, 1e-12) for a, b in zip(largest, bound, strict=True))


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_the_boxes_hold_the_polynomials(system, monkeypatch):
    def held():
        with precision(100):
            form = form_of(planar(system))
            series = motion_series(form, [*map(arb, THETA)], [*map(arb, OMEGA)], 10)
            found = tube.boxes(series, arb(0.1), arb("1e-9"), 3)
            return all(
                box.contains(arb_poly(c)(arb(0.1) * time))
                for time in np.linspace(0, 1, 31).tolist()
                for box, c in zip(
                    [*found[min(2, int(time * 3))][0], *found[min(2, int(time * 3))][1]],
                    [*series.x, *series.v],
                    strict=True,
                )
            )

    assert held()
    monkeypatch.setattr(tube, "_around", lambda polynomial, _half: polynomial.coeffs()[0])  # boxes too small
    assert not held()


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_the_tubes_derivatives_are_those_of_difference_quotients(system):
    one, n = mechanism(system), 3
    step = arb(2) ** -100
    with precision(400):
        numbers = planar_tree.parameters(one, balls())
        state = [arb(x) for x in (*THETA, *OMEGA)]

        def accelerations(y):
            return planar_tree.forward_dynamics(
                one.parents, numbers, np.array(y[:n], dtype=object), np.array(y[n:], dtype=object)
            )

        at = accelerations(state)
        slopes = np.zeros((n, 2 * n))
        for k in range(2 * n):
            moved = accelerations([y + step if j == k else y for j, y in enumerate(state)])
            slopes[:, k] = [float((a - b) / step) for a, b in zip(moved, at, strict=True)]
        by_x, by_v, off = tube._piece(form_of(planar(system)), (state[:n], state[n:]), [arb(1), arb(0), arb(0)])
        column = planar_tree.mass_matrix(one.parents, numbers, np.array(state[:n], dtype=object))
        inverse = arb_mat(n, n, column.ravel().tolist()).inv()
        largest = max(float(abs(inverse[i, 0])) for i in range(n))
    # difference quotients with a step of 1e-30; rods' masses rounded to doubles, 1e-16
    assert float(by_x) == pytest.approx(np.abs(slopes[:, :n]).sum(axis=1).max(), rel=1e-13)
    assert float(by_v) == pytest.approx(np.abs(slopes[:, n:]).sum(axis=1).max(), rel=1e-13, abs=1e-13)
    assert float(off) == pytest.approx(largest, rel=1e-13)


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=SYSTEMS)
def test_slopes_are_those_of_difference_quotients(system):
    n, order, step = 3, 9, arb(2) ** -100
    with precision(400):
        form = form_of(planar(system))
        state = [arb(x) for x in (*THETA, *OMEGA)]
        spread = spread_series(form, box(state[:n], state[n:], directions=True), order)
        point = motion_series(form, state[:n], state[n:], order)
        for j in range(2 * n):
            moved = [y + step if j == k else y for k, y in enumerate(state)]
            other = motion_series(form, moved[:n], moved[n:], order)
            for i, (a, b) in enumerate(zip([*point.x, *point.v], [*other.x, *other.v], strict=True)):
                for k in range(order + 1):
                    quotient = (b[k] - a[k]) / step
                    scale = 1e-20 * max(1.0, float(abs(quotient)))  # the step times the second derivative
                    assert abs(spread.slopes[i][j][k] - quotient) < scale


def test_turned_clouds_hold_what_they_held():
    random = np.random.default_rng(3)
    with precision(100):
        frame = [[arb(float(x)) for x in row] for row in random.normal(size=(4, 4))]
        reach = [arb(x) for x in (1e-3, 1e-9, 0.0, 2e-5)]
        cloud = Cloud([arb(1, 1e-12), arb(2)], [arb(3), arb(4, 1e-7)], frame, reach)
        turned = cloud.upright()
        q = np.array([[float(x) for x in row] for row in turned.frame])
        np.testing.assert_allclose(q.T @ q, np.eye(4), atol=1e-14)
        back = arb_mat(4, 4, q.ravel().tolist()).inv()
        for signs in random.choice([-1.0, 1.0], (20, 4)):
            point = [
                a + sum((f * r * s for f, r, s in zip(line, reach, signs.tolist(), strict=True)), arb(0))
                for a, line in zip([*cloud.x, *cloud.v], frame, strict=True)
            ]
            off = [(p.mid() - m) for p, m in zip(point, [*turned.x, *turned.v], strict=True)]
            along = (back * arb_mat(4, 1, off)).entries()
            assert all(abs(a) <= r * (1 + 1e-12) for a, r in zip(along, turned.reach, strict=True))
