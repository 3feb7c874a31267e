"""The time that a result says its engine took: the engine's alone, measured against a sleep of known length."""

import time

from fake_engines import Right, about

import furiko

NAP = 0.05  # [s] in each call


class Sleepy(Right):
    """Sleeps in each call."""

    info = about("Sleepy", missing={"joint_forces": "no", "energy": "no", "trajectory": "no"})

    def accelerations(self, theta, omega):
        time.sleep(NAP)
        return super().accelerations(theta, omega)


def test_a_result_says_how_long_its_engine_took():
    report = furiko.check(["rods-2"], [f"{__file__}:Sleepy"], profile="smoke", use_cache=False)
    (result,) = report.results
    # One call for all states; the formula itself takes far less than the sleep, the comparison is not counted.
    assert NAP <= result.in_engine < NAP + 0.05
    assert result.in_engine <= result.seconds
