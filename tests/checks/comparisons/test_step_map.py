"""The step map names the scheme of every engine's integrators, and no scheme for one that has none."""

import pytest
from fake_integrators import Damped, Fake, LongStep, OtherRungeKutta

from furiko.checks.comparisons import step_map
from furiko.engines import ENGINES, Integrator
from furiko.models import NLegPendulum, RodChain, Scene, find_scene

SCHEMES = {
    "Euler": "semi-implicit Euler",
    "implicitfast": "semi-implicit Euler",
    "RK4": "classical Runge-Kutta",
    "RK44": "classical Runge-Kutta",
    "RK67": "Butcher's sixth order in seven stages",
    "GeneralizedAlpha": "generalized-α, ρ∞ = 0.9",
    "TrapezoidalIndex2": "trapezoidal rule, velocities held together",
}


@pytest.mark.parametrize("engine", [name for name, info in ENGINES.items() if info.integrators])
@pytest.mark.parametrize("scene", ["double-pendulum", "n-leg-3", "rods-5"])
def test_every_integrator_is_a_textbook_scheme_to_rounding(make_cell, engine, scene):
    results = list(step_map.compare(make_cell(engine, scene)))
    assert len(results) == len(ENGINES[engine].integrators)
    for result in results:
        assert result.outcome == "agrees", result
        assert result.details["scheme"].startswith(SCHEMES[result.details["integrator"]])
        assert (result.details["coordinates"] == "maximal coordinates") == (engine == "exudyn-redundant")
        # The nearest other scheme of the same order misses by far more than rounding, so that the name means something.
        rest = result.details["next best"]
        assert rest is None or rest["error"] > 100 * result.measured


@pytest.mark.parametrize("engine", ["exudyn-tree", "exudyn-redundant"])
@pytest.mark.parametrize(("length", "mass"), [(3e3, 1e-37), (1e-13, 1e-39), (1e20, 1e-15)])
def test_a_mechanism_of_any_size_is_stepped_alike(make_cell, engine, length, mass):
    system = NLegPendulum((length, 2 * length, 0.7 * length), (mass, 3 * mass, 2 * mass))
    for result in step_map.compare(make_cell(engine, Scene("any size", system))):
        assert result.outcome == "agrees", result


def test_links_of_very_unlike_lengths_are_stepped_too(make_cell):
    lengths = (
        0.009396414670638332,
        0.0020709057761925513,
        0.20956026073682615,
        0.1852481948143808,
        0.04967508075444641,
        0.0003014421897485511,
        0.0003482194145946025,
        0.005010387279838114,
        0.0055728251620897635,
        0.011157456129782754,
        0.025845498573458314,
        0.00791488977558035,
    )
    system = RodChain(lengths, 25.765674496303635, 3.970181917992521e-05)
    # The name is what random states follow from: in those of this one, double precision leaves no digits to a change.
    cell = make_cell("exudyn-redundant", Scene("wide-6-2", system), random_states=200)
    for result in step_map.compare(cell):
        assert result.outcome == "agrees", result


def only(results):
    (result,) = results
    return result


def test_another_scheme_of_the_same_order_is_told_by_its_name(make_cell):
    result = only(step_map.compare(make_cell(OtherRungeKutta, "double-pendulum")))
    assert result.outcome == "agrees"
    assert result.details["scheme"] == "Runge-Kutta 3/8 rule"


def test_a_scheme_of_another_order_than_said_differs(make_cell):
    class Exaggerating(Fake):
        integrators = (Integrator("RK5", 5),)

    result = only(step_map.compare(make_cell(Exaggerating, "double-pendulum")))
    assert result.outcome == "differs"
    assert "said to be of order 5; one step is that of classical Runge-Kutta" in result.reason


@pytest.mark.parametrize("fake", [LongStep, Damped])
def test_a_step_that_is_no_schemes_differs_and_the_nearest_is_named(make_cell, fake):
    result = only(step_map.compare(make_cell(fake, "double-pendulum")))
    assert result.outcome == "differs"
    assert "no textbook scheme" in result.reason
    if fake is LongStep:
        assert result.details["scheme"] == "classical Runge-Kutta"


def test_long_chains_are_skipped_with_a_reason(make_cell):
    result = only(step_map.compare(make_cell(Fake, "rods-50")))
    assert result.outcome == "skipped"
    assert "50" in result.reason


UNSOLVED = """
[system]
kind = "rod-chain"
lengths = [0.0008587329371275063, 0.0027509611919129527, 0.0019539463653488577, 7.107224645689783e-06,
  1.3432682987307155e-05, 0.005028348955771567]
gravity = 0.0
density = 2.541934111197794e-08
[state]
theta = [-1.5027098586979496e-11, 3.911241070577278e-11, -5.980065770167798e-11, -7.57236048110938e-12,
  4.2132243662742784e-11, 0.0]
omega = [0.0, -0.0, 0.0, -0.0, -0.0, 0.0]
duration = 1.2615230736585472
"""


def test_a_scheme_that_cannot_be_solved_for_the_step_is_no_error_of_the_engine(make_cell, tmp_path):
    path = tmp_path / "wide-79-30.toml"
    path.write_text(UNSOLVED, encoding="utf-8")
    found = list(step_map.compare(make_cell("exudyn-redundant", find_scene(str(path)), 200)))
    assert {(result.outcome, result.loose) for result in found} <= {("agrees", False), ("skipped", False)}, found


@pytest.mark.parametrize("what", [0, 1])
@pytest.mark.parametrize("link", [0, 1])
@pytest.mark.parametrize("state", [-3, -2, -1])
def test_one_angle_or_rate_after_a_step_from_one_of_the_states_is_enough(make_cell, what, link, state):
    """Of a millionth: the bounds are some 1e-14."""
    cell = make_cell(Fake, "double-pendulum")
    here = cell.states.theta[state]

    class Moved(Fake):
        def trajectory(self, theta, omega, *run):
            ends = super().trajectory(theta, omega, *run)
            ends[what][link] += 1e-6 * (theta == here).all()
            return ends

    result = only(step_map.compare(make_cell(Moved, "double-pendulum")))
    assert result.outcome == "differs"
