"""Open mechanisms in a plane: against textbooks' equations, Kane's equations, closed forms, and faults put in."""

import re
from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, arb_poly
from planted_source import plant
from scipy.integrate import solve_ivp

import furiko
from furiko.models import InvalidInput, TreeSystem, find_scene
from furiko.models.trees.system import TreeJoint, TreeLink
from furiko.reference.proved import clouds, defect, form, joints, series, trees, tube
from furiko.reference.proved.form import form_of
from furiko.reference.proved.trees import planar_tree
from furiko.reference.truth.enclosures import precision
from furiko.reference.truth.spatial import spatial_truth

CART_POLE, ACROBOT = find_scene("cart-pole"), find_scene("acrobot")
# As the scene file has them; a double is taken as exact there, and so here.
M, m, l, I, g, C, D = 0.9, 0.14, 0.31, 0.0045, 9.81, 0.12, 0.0008


def cart_pole(spring=0.0, damped=True):
    """The scene's cart-pole with a spring on its track, or without dampers."""

    def changed(link):
        (joint,) = link.joints
        stiffness, springref = (spring, 0.3) if joint.kind == "slide" else (0.0, 0.0)
        damping = joint.damping if damped else 0.0
        return replace(link, joints=(replace(joint, stiffness=stiffness, springref=springref, damping=damping),))

    return TreeSystem(tuple(map(changed, CART_POLE.system.links)), CART_POLE.system.gravity)


def cart_pole_rows(sin, cos, state, alpha, number, spring=0.0):
    """The textbook's two equations, everything on the left: θ from upright, x the cart's place."""
    x, _theta, speed, rate = state
    a, b = alpha
    M_, m_, l_, I_, g_, C_, D_ = map(number, (M, m, l, I, g, C, D))
    ml = m_ * l_
    cart = (M_ + m_) * a + ml * (b * cos - rate * rate * sin) + C_ * speed + number(spring) * (x - number(0.3))
    pole = (I_ + ml * l_) * b + ml * a * cos - ml * g_ * sin + D_ * rate
    return cart, pole


def solved(rows, zero):
    """Both accelerations, from rows that are linear in them."""
    r = rows((zero, zero))
    (p, q), (s, t) = (
        [c - e for c, e in zip(rows(unit), r, strict=True)] for unit in ((1 + zero, zero), (zero, 1 + zero))
    )
    det = p * t - s * q
    return (-r[0] * t + r[1] * s) / det, (r[0] * q - r[1] * p) / det


def cart_pole_accelerations(y):
    sin, cos = mpmath.sin(y[1]), mpmath.cos(y[1])
    return solved(lambda alpha: cart_pole_rows(sin, cos, y, alpha, mpmath.mpf), mpmath.mpf(0))


def acrobot_accelerations(y):
    """The two-link arm of textbooks: angles from straight down, the second relative to the first."""
    m1, m2, l1, c1, c2, i1, i2, a, d, g_ = map(
        mpmath.mpf, (1.1, 0.85, 0.96, 0.47, 0.58, 0.083, 0.103, 0.011, 0.02, 9.81)
    )
    q1, q2, v1, v2 = y
    cos, sin = mpmath.cos(q2), mpmath.sin(q2)
    m11 = m1 * c1**2 + i1 + m2 * (l1**2 + c2**2 + 2 * l1 * c2 * cos) + i2
    m12 = m2 * (c2**2 + l1 * c2 * cos) + i2
    m22 = m2 * c2**2 + i2 + a
    far = m2 * g_ * c2 * mpmath.sin(q1 + q2)
    h = m2 * l1 * c2 * sin
    r1 = h * (2 * v1 * v2 + v2**2) - (m1 * c1 + m2 * l1) * g_ * mpmath.sin(q1) - far
    r2 = -h * v1**2 - far - d * v2
    det = m11 * m22 - m12**2
    return (r1 * m22 - r2 * m12) / det, (r2 * m11 - r1 * m12) / det


def holds(scene, accelerations, end=0.25):
    """Whether the intervals hold mpmath's series of these accelerations, and are as narrow as asked."""
    found = furiko.enclose(scene.system, scene.q, scene.v, [0.0, end], digits=18)
    with mpmath.workdps(22):
        start = [*map(mpmath.mpf, (*scene.q, *scene.v))]
        motion = mpmath.odefun(lambda _t, y: [*y[2:], *accelerations(y)], 0, start)
        values = [mpmath.nstr(x, 21) for x in motion(mpmath.mpf(end))]
    with precision(200):
        # mpmath's own error is a few units of its 22 digits, of numbers below ten
        return (
            found.complete
            and found.radius[1] < 1e-18
            and all(
                (ball + arb(0, "1e-19")).contains(arb(value))
                for ball, value in zip([*found.theta[1], *found.omega[1]], values, strict=True)
            )
        )


def test_the_cart_pole_is_the_textbooks():
    assert holds(CART_POLE, cart_pole_accelerations)


def test_the_acrobot_is_the_textbooks_arm():
    assert holds(ACROBOT, acrobot_accelerations)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("module", "name", "old", "new"),
    [
        (series, "motion_series", "form.slide[i][0] * force[i][0] +", "-form.slide[i][0] * force[i][0] +"),
        (
            series,
            "motion_series",
            "alpha[i] * slide[0], alpha[i] * slide[1]",
            "alpha[i] * slide[1], alpha[i] * slide[0]",
        ),
        (series, "mass_matrix", "slide[0] * force[i][0] +", "-slide[0] * force[i][0] +"),
        (form, "_direction", "return along / length, across / length", "return across / length, along / length"),
        (trees, "planar_tree", "(gravity[plane[0]], gravity[plane[1]])", "(gravity[plane[1]], gravity[plane[0]])"),
        (trees, "_link", "sense = -1 if", "sense = 1 if"),  # only joints with springs: not the cart-pole's
        (joints, "in_joints", "q + zero for", "q for"),
    ],
)
def test_a_planted_fault_is_noticed(monkeypatch, module, name, old, new):
    plant(monkeypatch, module, name, old, new)
    monkeypatch.setattr(clouds, "motion_series", series.motion_series)
    monkeypatch.setattr(furiko.reference.proved.enclose, "planar_tree", trees.planar_tree)
    monkeypatch.setattr(furiko.reference.proved.enclose, "in_joints", joints.in_joints)
    try:
        held = holds(CART_POLE, cart_pole_accelerations) and meets_kane()
    except (InvalidInput, ArithmeticError, IndexError):
        held = False
    assert not held


def test_the_energy_without_dampers_contains_what_it_was():
    system = cart_pole(damped=False)
    found = furiko.enclose(system, CART_POLE.q, CART_POLE.v, [0.0, 0.4, 0.8], digits=20)
    with precision(300):
        M_, m_, l_, I_, g_ = map(arb, (M, m, l, I, g))
        energies = []
        for (_x, angle), (speed, rate) in zip(found.theta, found.omega, strict=True):
            cos = angle.cos()
            kinetic = (M_ + m_) * speed**2 / 2 + m_ * l_ * speed * rate * cos + (I_ + m_ * l_**2) * rate**2 / 2
            energies.append(kinetic + m_ * g_ * l_ * cos)
        assert energies[0].rad() < arb(10) ** -60
        assert all(later.contains(energies[0]) for later in energies[1:])
        # narrow enough to say something: the radius times forces and momenta, ten at most
        assert all(later.rad() < arb(10) ** -18 for later in energies[1:])


ARM, LOAD = (0.1, 0.2, 0.15, 0.01, 0.02, 0.03), (0.02, 0.03, 0.04, 0.0, 0.001, 0.0)


def crane():
    """Two slides, one oblique and turned by its body; hinges of both senses, refs, springs; bodies fixed to others.

    Its body frames are turned in the plane and out of it, by quaternions of any length.
    """
    slide = {"kind": "slide", "damping": 0.3, "stiffness": 4.0, "springref": 0.2}
    links = (
        TreeLink("post", -1, (0.1, 0.2, 0.3), (1.0, 1.0, 0.0, 0.0)),  # z to -y: what is y of it is the world's z
        TreeLink("beam", 0, (0.2, 0.0, 0.0), (0.8, 0.0, 0.0, 0.6), 2.0, joints=(
            TreeJoint("rise", axis=(3.0, 4.0, 0.0), ref=0.05, armature=0.1, **slide),
            TreeJoint("run", axis=(-2.0, 0.0, 0.0), ref=-0.1, **slide),
        )),
        TreeLink("arm", 1, (0.3, -0.1, 0.4), (1.0, 0.0, 0.0, 0.5), 1.1, (0.1, 0.4, 0.2), ARM, (
            TreeJoint("swing", axis=(0.0, 0.0, -1.5), anchor=(0.02, -0.03, 0.1), ref=0.3, stiffness=1.5, springref=0.7),
        )),
        TreeLink("load", 2, (0.1, 0.8, 0.0), (0.0, 2.0, 0.0, 0.0), 0.5, (0.05, 0.1, 0.0), LOAD),
        TreeLink("hook", 3, (0.0, -0.3, 0.2), joints=(
            TreeJoint("turn", axis=(0.0, 0.0, -1.0), ref=-0.2, damping=0.1, armature=0.03, stiffness=0.8),
        ), mass=0.7, centre=(0.3, 0.1, 0.0), inertia=LOAD),
    )  # fmt: skip
    return TreeSystem(links, (1.0, -2.0, -9.0))


Q, V = (0.1, -0.2, 1.0, 0.4), (0.3, 0.5, -1.0, 2.0)


def meets_kane():
    system = crane()
    mechanism = system.mechanism()

    def rates(_t, y):
        return [*y[4:], *spatial_truth(mechanism, y[:4], y[4:]).accelerations.float]

    other = solve_ivp(rates, (0.0, 0.3), [*Q, *V], "DOP853", rtol=1e-11, atol=1e-11).y[:, -1]
    found = furiko.enclose(system, Q, V, [0.0, 0.3])
    # DOP853's error at this tolerance, some 1e-10
    return np.abs([*found.theta_low[1], *found.omega_low[1]] - other).max() < 1e-8 and found.radius[1] <= 1e-15


def test_a_crane_in_turned_frames_is_that_of_kanes_equations():
    assert meets_kane()


def test_starts_and_answers_at_the_start_are_exact():
    found = furiko.enclose(crane(), Q, V, [0.0, 0.0])
    assert found.radius[0] == 0
    assert (found.theta_low[0] == Q).all()
    assert (found.omega_high[0] == V).all()
    p = planar_tree(crane())
    cloud = joints.start(p, [0.0, 0.0, 1e-20, 1e15], V, (0.0, 0.0))
    # by hand: the post takes z to -y, so that the swing's axis -z is +y; under the load, turned over, -z is -y
    swing = Fraction(1e-20) - Fraction(0.3)
    turn = swing - (Fraction(1e15) - Fraction(-0.2))
    for ball, exact in zip(cloud.x[2:], (swing, turn), strict=True):
        mantissa, exponent = ball.mid().man_exp()
        assert Fraction(int(mantissa)) * Fraction(2) ** int(exponent) == exact
        assert ball.rad() == 0


@pytest.mark.parametrize("system", [crane(), CART_POLE.system], ids=["crane", "cart-pole"])
def test_a_start_as_wide_as_asked_holds_the_motions_of_all_its_states(system):
    radius, n = 1e-5, system.n
    q, v = np.array(Q[:n]), np.array(V[:n])
    found = furiko.enclose(system, q, v, [0.0, 0.15, 0.3], radius=radius)
    assert found.complete
    # a box of the joints' coordinates at the start, and not of absolute angles, which would be twice as wide
    assert found.radius[0] <= 1.001 * radius
    random = np.random.default_rng(5)
    for corner in random.choice([-1.0, 1.0], (6, 2 * n)) * radius * (1 - 1e-9):
        one = furiko.enclose(system, q + corner[:n], v + corner[n:], [0.0, 0.15, 0.3])
        assert (found.theta_low <= one.theta_low).all()
        assert (one.theta_high <= found.theta_high).all()
        assert (found.omega_low <= one.omega_low).all()
        assert (one.omega_high <= found.omega_high).all()
    assert found.radius[-1] < 100 * radius


@pytest.mark.parametrize("radius", [0.0, 1e-6])
@pytest.mark.parametrize("end", [0.7, -0.4])
def test_a_mass_on_a_spring_is_a_cosine(radius, end):
    joint = TreeJoint("s", "slide", (0.0, 3.0, -4.0), ref=0.5, armature=0.25, stiffness=2.0, springref=0.75)
    system = TreeSystem((TreeLink("mass", -1, mass=1.5, joints=(joint,)),), (0.0, 0.0, -9.0))
    found = furiko.enclose(system, [1.0], [-2.0], [0.0, end], radius=radius)
    with precision(200):
        rest = arb(0.75) + arb(9) * 4 / 5 * arb(1.5) / 2  # gravity's part along the slide
        frequency = (arb(2) / arb(1.75)).sqrt()
        sin, cos = (frequency * arb(end)).sin_cos()
        assert found.theta[1, 0].contains(rest + (1 - rest) * cos - 2 * sin / frequency)
        assert found.omega[1, 0].contains(-(1 - rest) * frequency * sin - 2 * cos)
    assert found.radius[1] <= max(1e-15, 3 * radius)


def test_the_residual_of_a_slide_is_within_its_bound():
    def fits():
        order = 10
        with precision(200):
            one = form_of(planar_tree(cart_pole(spring=3.0)))
            of = series.motion_series(one, [arb(-0.3), arb(2.0)], [arb(0.1), arb(5.0)], order)
            bound = defect.Defect(one, of).rows(arb(0.05))
            largest = [arb(0), arb(0)]
            for part in np.linspace(0, 1, 11).tolist():
                time = arb(0.05) * part
                x, v = ([arb_poly(c)(time) for c in some] for some in (of.x, of.v))
                alpha = [arb_poly(c).derivative()(time) for c in of.v]
                sin, cos = x[1].sin_cos()
                rows = cart_pole_rows(sin, cos, (*x, *v), alpha, arb, spring=3.0)
                largest = [max(a, abs(row).upper()) for a, row in zip(largest, rows, strict=True)]
            # sums of absolute values instead of a sum: a power of ten or three, not ten
            return all(a <= b <= 1e4 * a for a, b in zip(largest, bound, strict=True))

    assert fits()
    with pytest.MonkeyPatch.context() as patch:  # a slide's bound without the forces that move it
        plant(patch, defect, "_forces_in_absolute_values", "force[parent] = force[parent] + force[i]", "pass")
        assert not fits()


def test_the_tubes_derivatives_are_those_of_difference_quotients():
    step = arb(2) ** -100
    with precision(400):
        state = [arb(x) for x in (-0.3, 2.0, 0.1, 5.0)]

        def accelerations(y):
            sin, cos = y[1].sin_cos()
            return solved(lambda alpha: cart_pole_rows(sin, cos, y, alpha, arb, spring=3.0), arb(0))

        at = accelerations(state)
        slopes = np.zeros((2, 4))
        for k in range(4):
            moved = accelerations([y + step if j == k else y for j, y in enumerate(state)])
            slopes[:, k] = [float((a - b) / step) for a, b in zip(moved, at, strict=True)]
        one = form_of(planar_tree(cart_pole(spring=3.0)))
        by_x, by_v, _ = tube._piece(one, (state[:2], state[2:]), [arb(0), arb(0)])
    # difference quotients with a step of 1e-30
    assert float(by_x) == pytest.approx(np.abs(slopes[:, :2]).sum(axis=1).max(), rel=1e-13)
    assert float(by_v) == pytest.approx(np.abs(slopes[:, 2:]).sum(axis=1).max(), rel=1e-13)


def link(name, parent, *its, **more):
    return TreeLink(name, parent, mass=1.0, inertia=(1.0, 1.0, 1.0, 0.0, 0.0, 0.0), joints=its, **more)


Y = (0.0, 1.0, 0.0)
TURN = TreeJoint("turn", axis=Y)


@pytest.mark.parametrize(
    ("links", "words"),
    [
        ((link("a", -1, TreeJoint("b", "ball")),), "joint 'b': a ball joint leaves the plane"),
        ((link("a", -1, TreeJoint("f", "free")),), "joint 'f': a free joint leaves the plane"),
        ((link("a", -1, TURN), link("b", 0, TreeJoint("z"))), "joint 'z': its axis is not exactly parallel to y"),
        ((link("a", -1, TURN), link("b", 0, TreeJoint("s", "slide"))), "joint 's': it slides along what 'turn' turns"),
        ((link("a", -1, TreeJoint("s", "slide", Y), TURN),), "joint 's': it does not slide exactly across y"),
        ((link("a", -1, TreeJoint("t", axis=(0.0, 1.0, 1.0))),), "joint 't': its axis is not exactly along x, y or z"),
        ((link("a", -1, TURN), link("b", 0, TreeJoint("t", axis=Y), quaternion=(1.0, 1e-16, 0.0, 0.0))),
         "joint 't': its axis is not exactly parallel to y"),
        ((link("a", -1),), "no joint"),
        (tuple(link(f"a{i}", i - 1, TreeJoint(f"t{i}", axis=Y)) for i in range(201)), "201 bodies"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_with_its_joint(links, words):
    system = TreeSystem(links)
    with pytest.raises(InvalidInput, match=f"^{re.escape(words)}"):
        planar_tree(system)


def test_a_pendulum_about_the_vertical_turns_as_without_gravity():
    system = TreeSystem((link("a", -1, TreeJoint("t"), centre=(0.5, 0.0, 0.3)),))  # gravity is along the hinge
    found = furiko.enclose(system, [0.25], [1.5], [0.0, 2.0])
    assert found.theta_low[1, 0] <= 0.25 + 1.5 * 2.0 <= found.theta_high[1, 0]
    assert found.omega_low[1, 0] <= 1.5 <= found.omega_high[1, 0]


def test_catalogue_and_friction():
    with pytest.raises(InvalidInput, match=r"^joint 'leg': it slides along what 'knee' turns"):
        planar_tree(find_scene("hopper").system)
    with pytest.raises(InvalidInput, match=r"^joint 'j2'"):
        planar_tree(find_scene("arm-7").system)
    mechanism = cart_pole().mechanism()
    (cart, pole) = mechanism.bodies
    rubbing = replace(cart, joints=(replace(cart.joints[0], friction=0.2),))
    with pytest.raises(InvalidInput, match=r"^joint 'track': friction 0\.2 N jumps"):
        furiko.enclose(replace(mechanism, bodies=(rubbing, pole)), CART_POLE.q, CART_POLE.v, [0.0, 1.0])
