"""Every kept proof: against quadruple precision, against ``simulate``'s own error estimates, and proved anew."""

import json
from pathlib import Path

import numpy as np
import pytest
from flint import arb

import furiko
from furiko.models import document_scenes, find_scene
from furiko.reference.proved import kept
from furiko.reference.truth import end_points
from furiko.reference.truth.enclosures import precision
from furiko.studies.bench.methods import reference_error
from furiko.studies.bench.scenes import BENCHMARKS

MOVING = [scene.name for scene in document_scenes() if scene.theta is not None and scene.duration]
NAMES = sorted(entry["scene"] for entry in json.loads(kept.PATH.read_text(encoding="utf-8")).values())
UNREACHED = {"n-leg-3-mass-ratio"}  # thousands of steps a second
SWEEP = (pytest.mark.slow, pytest.mark.sweep)
QUICK = {"rods-1", "double-pendulum-no-gravity"}  # proved anew within a second or two each


def of(name):
    scene = find_scene(name)
    return scene, kept.proof(scene.system, scene.theta, scene.omega, scene.duration)


def test_what_is_kept_is_the_catalogues_and_what_is_not_is_said_here():
    assert set(NAMES) <= set(MOVING)
    assert set(MOVING) - set(NAMES) == UNREACHED


@pytest.mark.parametrize("name", NAMES)
def test_quadruple_precision_is_within_the_proof_and_its_own_error(name):
    scene, proof = of(name)
    truth = end_points.lookup(scene.system, scene.theta, scene.omega, scene.duration)
    off, proved = kept.sure(truth, proof)
    assert sum(proved) == len(proof.times)
    for i, radius in enumerate(proof.radius):
        # quadruple's error is an estimate, by the difference of two runs: three times it is always seen to hold
        assert off[i] <= 3 * truth.error[i] + 2 * radius
        assert radius <= 1e-30


def test_a_state_that_is_not_the_motions_is_noticed():
    scene, proof = of("rods-1")
    truth = end_points.lookup(scene.system, scene.theta, scene.omega, scene.duration)
    truth.theta_low[3, 0] += 1e-25  # a state that the test above would refuse
    off, _ = kept.sure(truth, proof)
    assert off[3] > 0.9e-25
    assert kept.sure(truth, None) == (pytest.approx(truth.error), (False,) * 4)


@pytest.mark.parametrize("name", NAMES)
def test_simulates_error_is_about_as_large_as_its_estimate_at_most(name):
    scene, proof = of(name)
    run = furiko.simulate(scene.system, scene.theta, scene.omega, [0.0, *proof.times])
    fastest = np.abs(run.omega).max()
    with precision(kept.READ_BITS):
        for i, estimate in enumerate(run.error[1:]):
            angles = [abs(ball - x).upper() for ball, x in zip(proof.theta[i], run.theta[i + 1].tolist(), strict=True)]
            rates = [abs(ball - x).upper() for ball, x in zip(proof.omega[i], run.omega[i + 1].tolist(), strict=True)]
            # An estimate, not a bound: two runs may agree by chance. The worst of 69 states seen: a tenth too small.
            assert float(max(angles)) <= 1.5 * estimate
            assert float(max(rates)) <= 1.5 * estimate * fastest


@pytest.mark.parametrize(
    "name",
    [name if name in QUICK else pytest.param(name, marks=[pytest.mark.slow, pytest.mark.sweep]) for name in NAMES],
)
def test_a_new_proof_meets_the_kept_one(name):
    scene, proof = of(name)
    # fewer digits, other steps and orders; early balls may be the narrower ones all the same. Both hold the motion, and
    # so they overlap: the one, wider by the other's diameter, holds it.
    found = furiko.enclose(scene.system, scene.theta, scene.omega, [0.0, *proof.times], digits=12)
    assert found.complete
    with precision(kept.READ_BITS):
        for new, old in ((found.theta, proof.theta), (found.omega, proof.omega)):
            for a, b in zip(new[1:].flat, old.flat, strict=True):
                assert (a + arb(0, 2 * b.rad())).contains(b)
                assert a.overlaps(b)


@pytest.mark.parametrize("name", ["bench-rods-2", "bench-rods-5"])
def test_motions_that_are_timed_are_proved_to_their_ends(name):
    """Quadruple precision's end is within the proof."""
    scene = BENCHMARKS[name]
    found = kept.proof(scene.system, scene.theta, scene.omega, scene.duration)
    assert found.times == tuple(scene.duration * part for part in (0.125, 0.25, 0.5, 1.0))
    off, proved = reference_error(scene)
    assert proved
    assert off <= 1e-20  # quadruple precision, whose rounding the motion multiplies by 1e6 and more
    assert not reference_error(BENCHMARKS["bench-rods-100"])[1]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), [("bench-rods-2", 2), ("bench-rods-5", 1)])
def test_a_new_proof_of_the_start_of_a_motion_that_is_timed_meets_the_kept_one(name, count):
    scene = BENCHMARKS[name]
    old = kept.proof(scene.system, scene.theta, scene.omega, scene.duration)
    new = furiko.enclose(scene.system, scene.theta, scene.omega, [0.0, *old.times[:count]], digits=12)
    assert new.complete
    with precision(kept.READ_BITS):
        for found, known in ((new.theta, old.theta), (new.omega, old.omega)):
            for a, b in zip(found[1:].flat, known[:count].flat, strict=True):
                assert a.overlaps(b)
                assert (a + arb(0, 2 * b.rad())).contains(b)


def test_the_table_in_the_documentation_is_that_of_what_is_kept():
    page = Path(__file__).parents[3] / "docs" / "theory" / "proved-trajectories.md"
    assert f"<!-- proved -->\n{kept.table()}\n<!-- /proved -->" in page.read_text(encoding="utf-8")


def test_an_entry_holds_what_was_proved(tmp_path):
    scene = find_scene("rods-1")
    found = furiko.enclose(scene.system, scene.theta, scene.omega, [0.0, 0.1, 0.2], digits=20)
    entry = kept.entry(scene, found)
    with precision(kept.READ_BITS):
        for row, theta, omega in zip(entry["states"], found.theta[1:], found.omega[1:], strict=True):
            assert all(arb(text).contains(ball) for text, ball in zip(row, (*theta, *omega), strict=True))
    assert all(a >= b for a, b in zip(entry["radius"], found.radius[1:], strict=True))
    assert all(a <= 2 * b + 1e-39 for a, b in zip(entry["radius"], found.radius[1:], strict=True))
    assert kept.proof(scene.system, (0.123,), (0.0,), 1.0) is None
