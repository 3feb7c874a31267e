"""Engines of open mechanisms against hand-derived equations, against the truth, and against one another."""

import numpy as np
import pytest

from furiko.engines import cannot, engine_info, engine_names, load_tree_engine
from furiko.models import InvalidInput, find_scene
from furiko.models.trees.scene import TreeScene
from furiko.models.trees.states import tree_states
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem
from furiko.reference.truth.spatial import energy, spatial_truth

ENGINES = [name for name in engine_names() if engine_info(name).tree]
# Errors beside the largest number of an array, some thousand roundings: a wrong sign or frame is of order one.
CLOSE = 1e-12


def pairs(scene):
    return [name for name in ENGINES if not cannot(engine_info(name), scene.system)]


def test_who_takes_trees():
    assert {"mujoco", "pinocchio-aba", "pinocchio-aba-mjcf", "pinocchio-crba", "exudyn-tree"} <= set(ENGINES)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_cart_pole_obeys_its_textbook_equations(engine):
    """M = ((mc+mp, mp l cos θ), (mp l cos θ, I + mp l²)), bias = (−mp l sin θ θ̇², −mp g l sin θ), θ from upright.

    About +y a positive angle leans to +x.
    """
    scene = find_scene("cart-pole")
    mc, mp, l, inertia, g, b, d = 0.9, 0.14, 0.31, 0.0045, 9.81, 0.12, 0.0008
    x, theta, v, w = 0.4, 0.7, -0.5, 1.9
    mass = np.array([[mc + mp, mp * l * np.cos(theta)], [mp * l * np.cos(theta), inertia + mp * l**2]])
    bias = np.array([-mp * l * np.sin(theta) * w**2, -mp * g * l * np.sin(theta)])
    passive = np.array([-b * v, -d * w])
    loaded = load_tree_engine(engine, scene.system)
    assert loaded.mass_matrix([x, theta]) == pytest.approx(mass, rel=CLOSE)
    assert loaded.bias([x, theta], [v, w]) == pytest.approx(bias, rel=CLOSE)
    assert loaded.accelerations([x, theta], [v, w]) == pytest.approx(np.linalg.solve(mass, passive - bias), rel=1e-11)
    kinetic = 0.5 * np.array([v, w]) @ mass @ np.array([v, w])
    here, there = loaded.energy([[x, theta], [x, 0.0]], [[v, w], [0.0, 0.0]])
    assert here[0] == pytest.approx(kinetic, rel=CLOSE)
    assert there[1] - here[1] == pytest.approx(mp * g * l * (1 - np.cos(theta)), rel=1e-11)


def compared(system, name="x", states=2):
    """Errors of every engine that takes the system, by engine and quantity, beside the largest true number."""
    scene = TreeScene(name, system)
    looked_at, mechanism = tree_states(scene, states), system.mechanism()
    rows = list(zip(looked_at.q, looked_at.v, strict=True))
    truths = [spatial_truth(mechanism, *row) for row in rows]
    energies = np.array([energy(mechanism, *row).float for row in rows])
    found = {}
    for engine in pairs(scene):
        loaded, info = load_tree_engine(engine, system), engine_info(engine)
        answers = {
            "mass_matrix": loaded.mass_matrix(looked_at.q),
            "bias": loaded.bias(looked_at.q, looked_at.v),
            "accelerations": loaded.accelerations(looked_at.q, looked_at.v),
        }
        if "passive" not in info.tree.missing:
            answers["passive"] = loaded.passive(looked_at.q, looked_at.v)
        for quantity, got in answers.items():
            true = np.array([getattr(truth, quantity).float for truth in truths])
            found[engine, quantity] = float(np.abs(got - true).max() / (np.abs(true).max() or 1.0))
        off = loaded.energy(looked_at.q, looked_at.v) - energies
        off[:, 1] -= off[0, 1]
        found[engine, "energy"] = float((np.abs(off) / np.abs(energies).max(axis=0)).max())
    return found


@pytest.mark.parametrize("seed", range(12))
def test_random_mechanisms_are_held_by_every_engine_as_they_are(seed):
    found = compared(random_tree(np.random.default_rng(seed), hinges_and_slides=seed < 4))
    assert len(found) >= 10
    assert {key: error for key, error in found.items() if not error < CLOSE} == {}


@pytest.mark.parametrize("name", ["acrobot", "hopper", "arm-7", "quadruped", "humanoid"])
def test_the_catalogue_is_held_as_it_is(name):
    found = compared(find_scene(name).system, name, states=1)
    assert {key: error for key, error in found.items() if not error < CLOSE} == {}


def random_tree(random, *, hinges_and_slides):
    """Up to six links with up to two joints each, in any order and any place; all numbers of the size of one."""
    links, count = [], int(random.integers(2, 7))
    for i in range(count):
        parent = int(random.integers(-1, i)) if i else -1
        joints = []
        for k in range(int(random.integers(1, 3))):
            kinds = ["hinge", "slide"] if hinges_and_slides or k else ["hinge", "slide", "ball", "free"]
            kind = str(random.choice(kinds))
            if kind == "free" and parent != -1:
                kind = "ball"
            single = kind in ("hinge", "slide")
            joints.append(
                TreeJoint(
                    f"joint {i} {k}",
                    kind,
                    axis=tuple(random.normal(size=3)),
                    anchor=tuple(random.normal(size=3)),
                    ref=float(random.normal()) if single else 0.0,
                    armature=float(random.random()) if kind != "free" and not hinges_and_slides else 0.0,
                    damping=float(random.random()),
                    stiffness=float(random.random()) if single else 0.0,
                    springref=float(random.normal()) if single else 0.0,
                )
            )
            if kind in ("free", "ball"):  # alone; MuJoCo takes no rotation after a ball
                break
        points = random.normal(size=(3, 3))
        second = points @ points.T
        tensor = np.trace(second) * np.eye(3) - second
        links.append(
            TreeLink(
                f"link {i}",
                parent,
                position=tuple(random.normal(size=3)),
                quaternion=tuple(random.normal(size=4)),
                mass=0.1 + float(random.random()),
                centre=tuple(random.normal(size=3)),
                inertia=tuple(float(tensor[k]) for k in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))),
                joints=tuple(joints),
            )
        )
    return TreeSystem(tuple(links), tuple(5 * random.normal(size=3)))


@pytest.mark.parametrize("engine", ["mujoco", "exudyn-tree"])
def test_a_spring_swings_as_a_cosine(engine):
    """m ẍ = −k (x − rest): x − rest = A cos(√(k/m) t). The error of fourth order is (ωh)⁴ times a few radians / 120."""
    slide = TreeJoint("slide", "slide", axis=(1.0, 0.0, 0.0), ref=0.3, stiffness=8.0, springref=0.5)
    body = TreeLink("body", -1, mass=2.0, joints=(slide,))
    loaded = load_tree_engine(engine, TreeSystem((body,), (0.0, 0.0, -9.81)))
    scheme = next(one.name for one in engine_info(engine).integrators if one.order == 4)
    q, v = loaded.trajectory([0.9], [0.0], scheme, 1e-3, 1000)
    assert q == pytest.approx([0.5 + 0.4 * np.cos(2.0)], abs=1e-11)
    assert v == pytest.approx([-0.8 * np.sin(2.0)], abs=1e-11)


@pytest.mark.parametrize(
    ("system", "engine", "says"),
    [
        (find_scene("quadruped").system, "exudyn-tree", "hinges and slides alone"),
        (find_scene("acrobot").system, "exudyn-tree", "no armature"),
        (find_scene("acrobot").system, "exudyn-redundant", "documents' mechanisms alone"),
        (
            TreeSystem((TreeLink("a", -1, mass=1.0, joints=(TreeJoint("a", "ball", stiffness=1.0),)),)),
            "pinocchio-aba",
            "no springs",
        ),
        (
            TreeSystem(
                (
                    TreeLink("a", -1, joints=(TreeJoint("a"),)),
                    TreeLink("b", 0, mass=1.0, joints=(TreeJoint("b", "slide"),)),
                )
            ),
            "mujoco",
            "without mass",
        ),
        (
            TreeSystem((TreeLink("a", -1, mass=1.0, joints=(TreeJoint("a", "ball"), TreeJoint("b"))),)),
            "mujoco",
            "before another rotation",
        ),
    ],
)
def test_what_an_engine_cannot_hold_is_said_before_it_is_asked(system, engine, says):
    assert says in cannot(engine_info(engine), system)
    with pytest.raises(InvalidInput, match=says):
        load_tree_engine(engine, system)


def test_states_of_any_shape_and_what_is_no_state():
    scene = find_scene("hopper")
    loaded = load_tree_engine("mujoco", scene.system)
    one = loaded.accelerations(scene.q, scene.v)
    many = loaded.accelerations(np.tile(scene.q, (2, 3, 1)), np.tile(scene.v, (2, 3, 1)))
    assert one.shape == (6,)
    assert many.shape == (2, 3, 6)
    assert (many == one).all()
    assert loaded.mass_matrix(np.zeros((0, 6))).shape == (0, 6, 6)
    for q, v, says in (
        ([0.0] * 5, [0.0] * 6, "q: 6 numbers a state"),
        ([0.0] * 6, [[0.0] * 6], "as many states"),
        ([np.nan] * 6, [0.0] * 6, "finite"),
        (["a"] * 6, [0.0] * 6, "real numbers"),
    ):
        with pytest.raises(InvalidInput, match=says):
            loaded.accelerations(q, v)
    with pytest.raises(InvalidInput, match="no integrator of its own"):
        load_tree_engine("pinocchio-aba", scene.system).trajectory(scene.q, scene.v, "RK4", 0.1, 1)
    with pytest.raises(InvalidInput, match="none called 'RK5'"):
        loaded.trajectory(scene.q, scene.v, "RK5", 0.1, 1)


def test_a_mass_matrix_that_is_singular_to_rounding_is_refused_in_words():
    """Yaw, pitch and roll on one link, the pitch a part in 1e8 from a right angle: yaw and roll turn about one line.

    What they turn against each other weighs sin² of the angle: 1e-16 of what they turn together, less than rounding.
    """
    hinges = ("yaw", (0.0, 0.0, 1.0)), ("pitch", (0.0, 1.0, 0.0)), ("roll", (1.0, 0.0, 0.0))
    joints = tuple(TreeJoint(name, axis=axis) for name, axis in hinges)
    link = TreeLink("arm", -1, mass=2.0, centre=(0.0, 0.0, -0.2), inertia=(0.02, 0.02, 0.004, 0, 0, 0), joints=joints)
    loaded = load_tree_engine("pinocchio-crba", TreeSystem((link,)))
    sound, locked = [0.3, 0.2, 0.1], [0.3, np.pi / 2, 0.1]
    with pytest.raises(
        InvalidInput, match=r"in state 2 of 2 .* not positive definite: what joint 'roll' moves"
    ) as said:
        loaded.accelerations([sound, locked], np.ones((2, 3)))
    assert "Use pinocchio-aba" in str(said.value)
    assert np.isfinite(loaded.accelerations([sound], np.ones((1, 3)))).all()
