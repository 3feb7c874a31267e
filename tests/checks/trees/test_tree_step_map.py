"""One step of an engine's integrators in trees: a right one is named, faults of a few roundings are found."""

import re
from dataclasses import replace

import fake_tree_engines
import numpy as np
import pytest
import spatial_trees
from fake_tree_engines import Components, Means, product, turned
from score_trees import cells

from furiko.checks.trees import step_map
from furiko.checks.trees.cell import TreeCell
from furiko.checks.trees.facts import tree_facts
from furiko.engines import engine_info, load_tree_engine
from furiko.engines.releases import within
from furiko.engines.trees.mujoco import VERSION, MujocoTree
from furiko.models.scene import scene_from_toml
from furiko.models.trees.scene import TreeScene
from furiko.models.trees.states import tree_states
from furiko.models.trees.system import tree_of

SMALL, BLOCK, FLOATING = fake_tree_engines.SMALL, fake_tree_engines.BLOCK, fake_tree_engines.FLOATING

ALONE = FLOATING[: FLOATING.index('[[system.links]]\nname = "arm"')]


class Runs(fake_tree_engines.Right):
    """MuJoCo's Runge-Kutta scheme, and what is done to the state after each of its steps."""

    info = fake_tree_engines.about("Runs")
    after = staticmethod(lambda q, v, before, step: (q, v))
    longer = 1.0

    def trajectory(self, q, v, integrator, step, steps):
        engine = MujocoTree(self.mechanism)
        for _ in range(steps):
            before = q, v
            q, v = (np.array(x) for x in engine.trajectory(q, v, "RK4", step * self.longer, 1))
            q, v = self.after(q, v, before, step)
        return q, v


def wrong(what, **fields):
    return type("Wrong", (Runs,), {"after": staticmethod(what), **fields})


def cell(text, engine=None, name="mujoco"):
    scene = scene_from_toml(text, "small")
    states = tree_states(scene, 4)
    facts = tree_facts(scene, states, motion=False, slopes=False)
    if engine is None:
        return TreeCell(scene, engine_info(name), load_tree_engine(name, scene.system), states, facts)
    return TreeCell(scene, engine.info, engine(scene.system.mechanism()), states, facts)


def compared(*given):
    return {result.check: result for result in step_map.compare(cell(*given))}


def test_each_integrator_of_an_engine_is_named():
    schemes = {check: result.details["scheme"] for check, result in compared(SMALL).items()}
    late = "semi-implicit Euler, dampers at the end of the step"
    assert schemes == {
        "step map Euler": late,
        "step map implicitfast": late,
        "step map RK4": "classical Runge-Kutta",
    }
    assert {result.outcome for result in compared(SMALL).values()} == {"agrees"}


def test_without_dampers_euler_is_semi_implicit():
    bare = SMALL.replace("damping = 0.3\n", "").replace("damping = 0.02\n", "")
    assert compared(bare)["step map Euler"].details["scheme"] == "semi-implicit Euler"


@pytest.mark.parametrize(
    "engine",
    [
        wrong(lambda q, v, before, step: (q, v * (1 - 1e-12 * step))),  # a damper of its own
        wrong(lambda q, v, before, step: (q + 1e-13, v)),  # drifts
        wrong(lambda q, v, before, step: (q, before[1])),  # rates of the step before
        wrong(lambda q, v, before, step: (q, v.astype(np.float32).astype(float))),
        wrong(lambda q, v, before, step: (q, v), longer=1 + 1e-11),  # another second
        fake_tree_engines.WrongScheme,
        fake_tree_engines.OneOrderLess,
    ],
    ids=["damped", "drifts", "late", "single", "longer", "order", "third"],
)
def test_a_step_that_is_no_schemes_differs(engine):
    (result,) = compared(SMALL, engine).values()
    assert result.outcome == "differs"
    assert "is no textbook scheme's; the nearest, " in result.reason or "is said to be of order 4" in result.reason


def test_the_same_engine_without_a_fault_agrees():
    (result,) = compared(SMALL, Runs).values()
    assert result.outcome == "agrees"


def test_steps_of_a_block_on_a_spring_are_those_written_down():
    """By hand, with m = 5/4, d = 3/4, k = 5, r = 1/4: v⁺ = (v − h k (q − r)/m) / (1 + h d/m) with the damper late."""
    here = cell(BLOCK)
    steps = step_map.chosen_steps(here)
    h, q, v = (np.asarray(x).astype(np.longdouble) for x in (steps.h, steps.q, steps.v))
    textbook = step_map.Textbook(steps)
    by_name = {scheme.name: textbook.end(scheme) for scheme in textbook.schemes}
    a = (-0.75 * v - 5 * (q - 0.25)) / 1.25
    explicit = v + h * a
    late = (v - h * 5 * (q - 0.25) / 1.25) / (1 + h * 0.75 / 1.25)
    for name, expected in {
        "explicit Euler": (q + h * v, explicit),
        "semi-implicit Euler": (q + h * explicit, explicit),
        "semi-implicit Euler, dampers at the end of the step": (q + h * late, late),
    }.items():
        assert np.abs(by_name[name] - np.hstack(expected)).max() < 1e-17  # some roundings of extended precision
    # The fastest rate is √(k/m) + d/m = 2.6 1/s: an eighth of its time, as a power of two.
    assert h == 2.0**-5


def test_each_integrator_of_an_engine_is_named_where_bodies_turn_in_all_directions():
    found = compared(FLOATING)
    late = "semi-implicit Euler, dampers at the end of the step"
    assert {result.outcome for result in found.values()} == {"agrees"}
    assert {check: result.details["scheme"] for check, result in found.items()} == {
        "step map Euler": late,
        "step map implicitfast": late,
        "step map RK4": "classical Runge-Kutta, rotations after Munthe-Kaas",
    }
    assert {result.unit for result in found.values()} <= {"rad", "m", "rad/s", "m/s", None}


def in_the_world(q, v, before, step):
    """Turned about the world's axes by as much as it should be about the body's."""
    found = q.copy()
    for at in (slice(3, 7), slice(7, 11)):
        start = before[0][at] / np.linalg.norm(before[0][at])
        turn = product(start * [1, -1, -1, -1], q[at])
        found[at] = product(turn, start)
    return found, v


def of_the_length_before(q, v, before, step):
    sizes = [np.linalg.norm(before[0][at]) for at in (slice(3, 7), slice(7, 11))]
    return turned(q, lambda quaternion, number: quaternion * sizes[number]), v


def beside(q, v, before, step):
    return turned(q, lambda quaternion, number: product(quaternion, [1, 0, 1e-13, 0])), v


@pytest.mark.parametrize(
    "engine",
    [
        wrong(lambda q, v, before, step: (q, v), longer=1 + 1e-11),
        wrong(lambda q, v, before, step: (q.astype(np.float32).astype(float), v)),
        wrong(lambda q, v, before, step: (q, v.astype(np.float32).astype(float))),
        wrong(lambda q, v, before, step: (q + 1e-13 * np.eye(len(q))[2], v)),
        wrong(in_the_world),
        wrong(of_the_length_before),
        wrong(beside),
    ],
    ids=["longer", "single places", "single rates", "shifted", "in the world", "length", "beside"],
)
def test_a_step_of_a_floating_body_that_is_no_schemes_differs(engine):
    (result,) = compared(FLOATING, engine).values()
    assert result.outcome == "differs"
    assert "is no textbook scheme's; the nearest, " in result.reason


def test_a_floating_body_that_is_damped_by_1e_12_a_second_differs():
    """Where it moves slowly: a step of the scene above is so short that a rate's last digit is more."""
    slow = FLOATING.replace("[0.5, 0.0, -9.81]", "[5e-9, 0.0, -9.81e-8]")
    for name, by in (("stiffness", 1e-8), ("damping", 1e-4)):
        slow = re.sub(rf"{name} = (\S+)", lambda found, by=by: f"{found[0]}e{round(np.log10(by))}", slow)
    (result,) = compared(slow, Runs).values()
    assert result.outcome == "agrees"
    (result,) = compared(slow, wrong(lambda q, v, before, step: (q, v * (1 - 1e-12 * step)))).values()
    assert result.outcome == "differs"


def test_the_other_sign_of_a_quaternion_is_the_same_rotation():
    (result,) = compared(FLOATING, wrong(lambda q, v, before, step: (turned(q, lambda one, number: -one), v))).values()
    assert result.outcome == "agrees"


def test_quaternions_that_are_moved_like_other_numbers_are_a_textbooks():
    (result,) = compared(FLOATING, Components).values()
    assert result.outcome == "agrees"
    assert result.details["scheme"] == "classical Runge-Kutta, quaternions by components"


def test_means_of_rates_are_of_second_order_whatever_the_scheme():
    (result,) = compared(FLOATING, Means).values()
    assert result.outcome == "differs"
    assert result.reason == (
        "RK4 is said to be of order 4; one step is that of classical Runge-Kutta, rotations by means of rates"
    )


def test_the_spring_of_a_ball_acts_in_a_textbooks_step():
    sprung = FLOATING.replace('kind = "ball"', 'kind = "ball"\nstiffness = 0.5')
    assert {result.outcome for result in compared(sprung).values()} == {"agrees"}


def with_integrators(engine, **fields):
    (usual,) = engine.info.integrators
    return type("Engine", (engine,), {"info": replace(engine.info, integrators=(replace(usual, **fields),))})


def test_an_integrator_may_be_of_another_order_where_bodies_turn():
    (result,) = compared(FLOATING, with_integrators(Means, turning=2)).values()
    assert result.outcome == "agrees"
    assert result.reason == (
        "one step is that of classical Runge-Kutta, rotations by means of rates, of order 2 where bodies tumble"
    )
    (result,) = compared(SMALL, with_integrators(Runs, turning=2)).values()
    assert result.outcome == "agrees"
    assert result.reason == "one step is that of classical Runge-Kutta"


def test_a_rule_of_its_own_for_lone_bodies_is_not_judged():
    engine = with_integrators(Runs, lone_body="it has a rule of its own")
    (result,) = compared(ALONE, engine).values()
    assert (result.outcome, result.reason) == ("skipped", "it has a rule of its own")
    (result,) = compared(FLOATING, engine).values()
    assert result.outcome == "agrees"


@pytest.mark.parametrize("load", [0.0, 0.1])
def test_what_turns_a_free_body_alone_may_be_taken_late(load):
    """MuJoCo's implicitfast does so since 3.11, where nothing hangs on the body; in 3.17 also where it has a load."""
    fixed = f'[[system.links]]\nname = "load"\nparent = "trunk"\nmass = {load}\ncentre = [0.1, 0.0, 0.0]\n'
    found = compared(ALONE + (fixed if load else ""))
    assert {result.outcome for result in found.values()} == {"agrees"}
    schemes = {check: result.details["scheme"] for check, result in found.items()}
    assert schemes["step map Euler"] == "semi-implicit Euler"
    if within(VERSION, ">=3.17" if load else ">=3.11"):
        assert schemes["step map implicitfast"] == (
            "semi-implicit Euler, dampers at the end of the step, and what turns free bodies"
        )


@pytest.mark.slow
@pytest.mark.parametrize("number", [15, 31, 37, 51, 87, 99, 122, 140])
def test_a_right_engine_is_called_right_with_loads_and_springs_of_balls(number):
    """The smallest allowed over measured in 156 such was 10.8."""
    rng = np.random.default_rng(number)
    scene = TreeScene("drawn", tree_of(spatial_trees.tree(rng, int(rng.integers(1, 6)), free=number % 2 == 1)))
    states = tree_states(scene, 4)
    facts = tree_facts(scene, states, motion=False, slopes=False)
    engine = load_tree_engine("mujoco", scene.system)
    for result in step_map.compare(TreeCell(scene, engine_info("mujoco"), engine, states, facts)):
        assert result.outcome == "agrees", result


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2001, 2031, 2))  # with balls and free joints
def test_a_right_engine_is_called_right_on_any_tree_that_turns_in_all_directions(number):
    """The smallest allowed over measured in 356 others was 9.5."""
    for one in cells(number, 4):
        if "trajectory" not in one.info.tree.missing:
            for result in step_map.compare(one):
                assert result.outcome == "agrees", result


@pytest.mark.slow
@pytest.mark.parametrize("number", range(2000, 2030, 2))  # hinges and slides alone; every third far apart in size
def test_engines_that_are_right_are_called_right_on_any_tree(number):
    """``score_trees.mechanism`` draws them; the smallest allowed over measured in 1,137 others was 3.4."""
    results = [
        result
        for one in cells(number, 4)
        if "trajectory" not in one.info.tree.missing
        for result in step_map.compare(one)
    ]
    assert results
    assert {result.outcome for result in results} == {"agrees"}, results
