import numpy as np
import pytest

from furiko.engines import AnyShape, EngineInfo, Integrator, load_engine
from furiko.models import InvalidInput, RodChain


class Echo:
    """Gives back what it was asked, so that shapes can be seen."""

    def accelerations(self, theta, omega):
        assert theta.ndim == 2
        assert theta.flags.c_contiguous
        return theta + 10 * omega

    def inverse_dynamics(self, theta, omega, alpha, *, gravity=True):
        return alpha + gravity

    def joint_forces(self, theta, omega, alpha):
        return np.stack([theta, omega], axis=-1)

    def energy(self, theta, omega):
        return theta  # three numbers a state, where two are due

    def trajectory(self, theta, omega, integrator, step, steps):
        return theta, omega[:-1]


INFO = EngineInfo(
    "echo", "", "", "", "", "", "absolute", (Integrator("RK4", 4),), missing={"fields": "it has no model"}
)


@pytest.fixture
def echo():
    return AnyShape(Echo(), INFO, 3)


@pytest.mark.parametrize("shape", [(3,), (1, 3), (5, 3), (2, 4, 3), (0, 3), (2, 0, 3)])
def test_any_leading_shape(echo, shape):
    theta = np.arange(np.prod(shape), dtype=float).reshape(shape)
    np.testing.assert_array_equal(echo.accelerations(theta, theta), 11 * theta)
    np.testing.assert_array_equal(echo.inverse_dynamics(theta, theta, theta, gravity=True), theta + 1)
    np.testing.assert_array_equal(echo.inverse_dynamics(theta, theta, theta, gravity=False), theta)
    np.testing.assert_array_equal(echo.joint_forces(theta, 2 * theta, theta), np.stack([theta, 2 * theta], axis=-1))


def test_lists_integers_and_arrays_that_are_not_contiguous(echo):
    assert echo.accelerations([1, 2, 3], [0, 0, 0]).dtype == np.float64
    wide = np.arange(24.0).reshape(4, 6)
    np.testing.assert_array_equal(echo.accelerations(wide[:, ::2], 0 * wide[:, ::2]), wide[:, ::2])


@pytest.mark.parametrize(
    ("theta", "omega", "says"),
    [
        ([1.0, 2.0], [0.0, 0.0], r"theta: .*\(\.\.\., 3\).*\(2,\)"),
        ([1.0, 2.0, 3.0], [0.0, 0.0], "omega"),
        ([[1.0, 2.0, 3.0]], [0.0, 0.0, 0.0], "omega"),
        (1.0, 1.0, "theta"),
        ([[1.0, 2.0, 3.0], [1.0]], [0.0, 0.0, 0.0], "different lengths"),
        (["a", "b", "c"], [0.0, 0.0, 0.0], "theta: real numbers"),
        ([1j, 0, 0], [0.0, 0.0, 0.0], "theta: real numbers"),
        ([True, False, True], [0.0, 0.0, 0.0], "theta: real numbers"),
        ([1.0, 2.0, 3.0], [0.0, np.nan, 0.0], r"omega\[1\]: must be finite, got .*nan"),
        ([[1.0, 2.0, 3.0], [1.0, 2.0, np.inf]], np.zeros((2, 3)), r"theta\[1, 2\]"),
    ],
)
def test_what_is_no_state(echo, theta, omega, says):
    with pytest.raises(InvalidInput, match=says):
        echo.accelerations(theta, omega)


def test_an_answer_of_the_wrong_shape_is_the_engines_fault(echo):
    with pytest.raises(RuntimeError, match=r"echo .*\(4, 3\) where \(4, 2\)"):
        echo.energy(np.zeros((4, 3)), np.zeros((4, 3)))
    with pytest.raises(RuntimeError, match=r"\(2,\) where \(3,\)"):
        echo.trajectory(np.zeros(3), np.zeros(3), "RK4", 0.1, 1)


def test_what_it_cannot_is_said(echo):
    with pytest.raises(InvalidInput, match="echo: no fields: it has no model"):
        echo.fields()
    with pytest.raises(InvalidInput, match="has no integrator of its own"):
        load_engine("pinocchio-aba", RodChain((1.0,))).trajectory([0.0], [0.0], "RK4", 0.1, 1)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        (([0.0] * 3, [0.0] * 3, "RK5", 0.1, 1), "RK4"),
        (([0.0] * 3, [0.0] * 3, "RK4", 0.0, 1), "step"),
        (([0.0] * 3, [0.0] * 3, "RK4", float("nan"), 1), "step"),
        (([0.0] * 3, [0.0] * 3, "RK4", 0.1, 0), "steps"),
        (([0.0] * 2, [0.0] * 3, "RK4", 0.1, 1), "theta"),
        (([[0.0] * 3], [[0.0] * 3], "RK4", 0.1, 1), "theta"),
    ],
)
def test_what_is_no_trajectory(echo, given, says):
    with pytest.raises(InvalidInput, match=says):
        echo.trajectory(*given)


@pytest.mark.parametrize("shape", [(2,), (3, 2), (2, 2, 2), (0, 2)])
def test_every_engine_takes_every_shape(engine, shape):
    states = np.linspace(0.1, 1.0, int(np.prod(shape))).reshape(shape)
    found = load_engine(engine, RodChain((1.0, 0.5))).accelerations(states, 0 * states)
    assert found.shape == shape
    assert found.dtype == np.float64


class Shares(Echo):
    """Writes into its arguments, and returns one buffer again and again."""

    def __init__(self):
        self.buffer = np.zeros((2, 3))

    def accelerations(self, theta, omega):
        self.buffer[:] = theta + 10 * omega
        theta[:] = omega[:] = 0.0
        return self.buffer

    def trajectory(self, theta, omega, integrator, step, steps):
        self.buffer[0], self.buffer[1] = theta + 1, omega + 1
        theta[:] = omega[:] = 0.0
        return self.buffer[0], self.buffer[1]


def test_arguments_are_copies_and_so_are_answers():
    engine = AnyShape(Shares(), INFO, 3)
    theta, omega = np.full((2, 3), 1.0), np.full((2, 3), 2.0)
    first = engine.accelerations(theta, omega)
    second = engine.accelerations(2 * theta, omega)
    assert (theta == 1.0).all()
    assert (omega == 2.0).all()
    assert (first == 21.0).all()
    assert (second == 22.0).all()
    angles, rates = engine.trajectory(theta[0], omega[0], "RK4", 0.1, 1)
    engine.trajectory(2 * theta[0], omega[0], "RK4", 0.1, 1)
    assert (theta[0] == 1.0).all()
    assert (angles == 2.0).all()
    assert (rates == 3.0).all()


@pytest.mark.slow
def test_an_engine_that_changes_its_arguments_hides_nothing(run_cell):
    """One that empties them and gives half as much kinetic energy again agreed, since theory then saw zeros too."""
    assert run_cell("fake_engines:EmptiesItsArguments")["energy"].outcome == "differs"
