"""The ladders: what stands on a rung is what the axis promises, and the same for the same seed."""

import numpy as np
import pytest

from furiko.models import InvalidInput, RodChain
from furiko.studies.stress.axes import AXES, find_axes, pairs

BY_NAME = {axis.name: axis for axis in AXES}


@pytest.mark.parametrize(
    ("name", "end"),
    [
        ("links", 1000),
        ("legs", 1000),
        ("heavy-first", 1e12),
        ("light-first", 1e-12),
        ("heavy-leg", 1e12),
        ("light-leg", 1e-12),
        ("long-rods", 1e6),
        ("short-rods", 1e-6),
        ("long-legs", 1e6),
        ("short-legs", 1e-6),
        ("fast-rods", 1e6),
        ("fast-legs", 1e6),
        ("far-rods", 1e9),
        ("far-legs", 1e9),
        ("aligned-legs", 1e-12),
        ("straight-rods", 1e-12),
        ("folded-rods", 1e-12),
        ("strong-gravity", 9.81e12),
        ("weak-gravity", 9.81e-12),
    ],
)
def test_the_last_rung_is_the_end_that_was_asked_for(name, end):
    axis = BY_NAME[name]
    assert axis.value(axis.top) == pytest.approx(end, rel=1e-12)


def test_kernels_go_on_to_ten_thousand_links_and_engines_end_where_they_must():
    links = BY_NAME["links"]
    assert links.value(links.top_for(10_000, kernels=True)) == 10_000
    assert links.value(links.top_for(300, kernels=False)) <= 300 < links.value(links.top_for(300, kernels=False) + 1)
    assert links.recipe(links.top).system().n == 1000
    assert BY_NAME["legs"].recipe(0).system().n == 2


@pytest.mark.parametrize("axis", AXES, ids=lambda axis: axis.name)
def test_both_ends_of_each_ladder_make_a_mechanism_and_states(axis):
    for rung in (0, axis.top):
        recipe = axis.recipe(rung)
        theta, omega = recipe.draw("seed")
        assert theta.shape == omega.shape == (recipe.states, recipe.system().n)
        again, _ = recipe.draw("seed")
        other, _ = recipe.draw("other seed")
        assert (theta == again).all()
        assert (theta != other).any()


def test_numbers_are_put_where_the_axis_says():
    assert BY_NAME["heavy-first"].recipe(24).system().masses == pytest.approx((1e12, 1.0, 1.0, 1.0))
    assert BY_NAME["light-leg"].recipe(24).system().masses == pytest.approx((1.0, 1.0, 1e-12, 1.0), rel=1e-14, abs=0)
    assert BY_NAME["long-rods"].recipe(12).system().lengths == pytest.approx((1.0, 1e6, 1.0, 1e6, 1.0))
    assert BY_NAME["no-gravity"].recipe(0).system().gravity == 0
    theta, omega = BY_NAME["far-rods"].recipe(18).draw("")
    assert 1e8 < np.abs(theta).max() <= 1.001e9
    _, omega = BY_NAME["fast-rods"].recipe(12).draw("")
    assert 1e5 < np.abs(omega).max() <= 1e6


def test_aligned_legs_and_folded_rods_are_so():
    theta, _ = BY_NAME["aligned-legs"].recipe(24).draw("")
    assert 0 < np.ptp(theta, axis=1).max() <= 2.001e-12
    theta, _ = BY_NAME["folded-rods"].recipe(24).draw("")
    assert np.abs(np.diff(theta, axis=1)).min() == pytest.approx(np.pi, abs=1e-11)


@pytest.mark.parametrize("name", ["far-rods", "straight-rods", "aligned-legs", "links"])
def test_differences_of_angles_are_exact(name):
    # Else an engine in relative coordinates would be given another state than the truth.
    axis = BY_NAME[name]
    for rung in range(0, axis.top + 1, 6):
        theta, _ = axis.recipe(rung).draw("seed")
        exact = np.diff(theta.astype(np.longdouble), axis=1)
        assert (np.diff(theta, axis=1) == exact).all()


def test_pairs_change_two_things_together():
    (pair,) = find_axes(("long-rods x fast-rods",))
    system, (_, omega) = pair.recipe(pair.top).system(), pair.recipe(pair.top).draw("")
    assert isinstance(system, RodChain)
    assert max(system.lengths) == pytest.approx(1e6)
    assert np.abs(omega).max() > 1e5
    for pair in pairs():
        assert pair.first.base.kind == pair.second.base.kind
        assert pair.recipe(pair.top).system().n <= 201


def test_an_unknown_axis_is_refused_with_a_hint():
    with pytest.raises(InvalidInput, match=r"'long-rod'.*did you mean 'long-rods'"):
        find_axes(("long-rod",))
