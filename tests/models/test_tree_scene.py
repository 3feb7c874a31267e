"""Scenes of open mechanisms: the format, one clear line for everything that is wrong with one, and their states."""

import numpy as np
import pytest

from furiko.models import InvalidInput, TreeScene, catalogue, document_catalogue, find_document_scene, find_scene
from furiko.models.scene import scene_from_toml
from furiko.models.trees.states import random_states, tree_states
from furiko.models.trees.system import TreeJoint, TreeLink, TreeSystem, tree_of

LINK = '[system]\nkind = "tree"\n[[system.links]]\nname = "a"\nmass = 2.0\ncentre = [0.0, 0.0, -0.5]\n'
HINGE = LINK + '[[system.links.joints]]\nname = "pin"\naxis = [0.0, 1.0, 0.0]\n'
SECOND = (
    HINGE
    + '[[system.links]]\nname = "b"\nparent = "a"\nmass = 1.0\n[[system.links.joints]]\nname = "knob"\nkind = "ball"\n'
)
FREE = LINK + '[[system.links.joints]]\nname = "float"\nkind = "free"\n'


def test_the_format():
    scene = scene_from_toml(
        SECOND + "[state]\nq = { pin = 0.5, knob = [2.0, 0.0, 0.0, 0.1] }\nv = { knob = [1, 2, 3] }\nduration = 1\n",
        "x",
    )
    assert isinstance(scene, TreeScene)
    assert scene.system.links[1].parent == 0
    assert scene.system.gravity == (0.0, 0.0, -9.81)
    assert (scene.system.n, scene.system.nq) == (4, 5)
    assert scene.q == (0.5, 2.0, 0.0, 0.0, 0.1)
    assert scene.v == (0.0, 1.0, 2.0, 3.0)
    assert scene.system.freedoms == ("pin", "knob[1]", "knob[2]", "knob[3]")


def test_what_a_state_leaves_out_is_as_in_the_reference_configuration():
    scene = scene_from_toml(FREE.replace("mass = 2.0", "mass = 2.0\nposition = [0.0, 1.0, 2.0]") + "[state]\n", "x")
    assert scene.q == (0.0, 1.0, 2.0, 1.0, 0.0, 0.0, 0.0)
    assert scene.v == (0.0,) * 6


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('[system]\nkind = "tree"', "system.links: no joint moves anything"),
        (LINK, "system.links: no joint moves anything"),
        (HINGE.replace("mass = 2.0\n", ""), "'pin' moves nothing that has mass"),
        (HINGE.replace("mass = 2.0", "mass = -1.0"), r"links\[0\].mass: must be zero, or from"),
        (HINGE.replace("mass = 2.0", "mas = 2.0"), r"links\[0\].mas: unknown field.*did you mean 'mass'"),
        (HINGE + "damping = inf", r"joints\[0\].damping: must be zero, or from"),
        (HINGE + "dampin = 1.0", r"links\[0\].joints\[0\].dampin: unknown field.*did you mean 'damping'"),
        (HINGE + 'kind = "hinges"', r"links\[0\].joints\[0\].kind: .*'hinges'"),
        (HINGE.replace("[0.0, 1.0, 0.0]", "[0.0, 0.0, 0.0]"), r"joints\[0\].axis: has no direction"),
        (HINGE.replace("[0.0, 1.0, 0.0]", "[0.0, 1.0]"), r"joints\[0\].axis: 3 numbers are needed, got 2"),
        (HINGE + "ref = nan", r"joints\[0\].ref\[0\]: must be finite"),
        (HINGE + "limits = [1.0, -1.0]", r"joints\[0\].limits: the lower one comes first"),
        (FREE + "limits = [-1.0, 1.0]", r"joints\[0\].limits: a free joint has none"),
        (SECOND.replace('parent = "a"', 'parent = "c"'), r"links\[1\].parent: 'c' is no link before it"),
        (SECOND.replace('name = "b"', 'name = "a"'), r"links\[1\].name: two links are called 'a'"),
        (SECOND.replace('"knob"', '"pin"'), "two joints are called 'pin'"),
        (SECOND.replace('kind = "ball"', 'kind = "free"'), r"links\[1\].joints: a free joint must be alone"),
        (HINGE.replace("mass = 2.0", "mass = 2.0\ninertia = [1.0, 1.0, 2.1]"), r"links\[0\].inertia: no body has"),
        (HINGE.replace("mass = 2.0", "mass = 2.0\ninertia = [1.0, 1.0, 1.0, 2.0, 0.0, 0.0]"), "no body has"),
        (HINGE.replace("mass = 2.0", "inertia = [1.0, 1.0, 1.0]"), r"links\[0\].mass: a link that has inertia"),
        (HINGE.replace('kind = "tree"', 'kind = "tree"\ngravity = -9.81'), "9.81, not -9.81"),
        (HINGE.replace('kind = "tree"', 'kind = "tree"\ngravity = [0.0, 0.0]'), "system.gravity: 3 numbers"),
        (HINGE.replace('kind = "tree"', 'kind = "tree"\nmodel = "x.xml"'), "system.model: links and gravity are"),
        (HINGE + "[state]\nq = { pim = 0.5 }", "state.q.pim: no joint is called 'pim'.*did you mean 'pin'"),
        (HINGE + "[state]\nq = { pin = [0.5, 1.0] }", "state.q.pin: 1 numbers are needed, got 2"),
        (FREE + "[state]\nq = { float = [0, 0, 0, 0, 0, 0, 0] }", "state.q.float: has no direction"),
        (HINGE + "[state]\nduration = -1.0", "state.duration: .*-1.0"),
        (HINGE + "[samples]\nrandom = 0\nnamed = []", "no state is left"),
        (HINGE + '[samples]\nnamed = ["whirlin"]', "samples.named: .*did you mean 'whirling'"),
        (HINGE + "[sampels]\nrandom = 1", "sampels: unknown field.*did you mean 'samples'"),
    ],
)
def test_what_is_wrong_is_said_with_its_field(text, says):
    with pytest.raises(InvalidInput, match=says):
        scene_from_toml(text, "x")


def test_a_thin_rod_and_a_plate_are_bodies():
    for inertia in ("[0.1, 0.1, 0.0]", "[0.1, 0.2, 0.3]", "[0.2, 0.2, 0.2, -0.1, -0.1, -0.1]"):
        assert scene_from_toml(HINGE.replace("mass = 2.0", f"mass = 2.0\ninertia = {inertia}"), "x").system.n == 1


def test_a_model_file_beside_the_scene(tmp_path):
    (tmp_path / "arm.xml").write_text(
        '<mujoco><option gravity="0 0 -3"/><worldbody><body name="a"><joint name="pin" axis="0 1 0" damping="0.5"/>'
        '<inertial pos="0 0 -1" mass="2" diaginertia="1 1 1"/></body></worldbody></mujoco>'
    )
    text = '[system]\nkind = "tree"\nmodel = "arm.xml"\n[state]\nq = { pin = 0.5 }\n'
    scene = scene_from_toml(text, "x", tmp_path)
    assert scene.system.gravity == (0.0, 0.0, -3.0)
    assert scene.system.joints[0].damping == 0.5
    assert scene.system.links[-1].mass == 2.0
    assert scene.q == (0.5,)
    for name, says in (("../arm.xml", "beside the scene file"), ("/arm.xml", "beside"), ("none.xml", "cannot be read")):
        with pytest.raises(InvalidInput, match=f"system.model: .*{says}"):
            scene_from_toml(text.replace("arm.xml", name), "x", tmp_path)


def test_plain_numbers_survive_the_way_to_arrays_and_back():
    for name in set(catalogue()) - set(document_catalogue()):
        system = find_scene(name).system
        again = tree_of(system.mechanism())
        assert again == system
        assert tuple(system.mechanism().reference[: system.nq]) == pytest.approx(system.reference)


def test_the_catalogue_has_open_mechanisms():
    trees = {name: find_scene(name) for name in set(catalogue()) - set(document_catalogue())}
    assert set(trees) >= {"cart-pole", "acrobot", "hopper", "arm-7", "quadruped", "humanoid"}
    assert all(scene.description and scene.starts for scene in trees.values())
    features = set().union(*(scene.system.features for scene in trees.values()))
    assert features >= {"hinge", "slide", "ball", "free", "several joints", "armature", "damping", "spring"}
    assert trees["quadruped"].system.n == 18
    assert trees["arm-7"].system.n == 7


def test_what_takes_documents_alone_refuses_a_tree():
    with pytest.raises(InvalidInput, match="scene 'hopper': the lesson takes the documents' mechanisms, not a tree"):
        find_document_scene("hopper", "the lesson")


def test_random_states_stay_within_limits_and_are_the_same_however_many():
    scene = find_scene("hopper")
    states = tree_states(scene, 50)
    assert states.labels[:4] == ("given", "reference", "small", "whirling")
    joints = list(scene.system.joints)
    hip = [joint.name for joint in joints].index("hip")
    low, high = joints[hip].limits
    assert (states.q[4:, hip] >= low - 1e-9).all()
    assert (states.q[4:, hip] <= high + 1e-9).all()
    first = random_states("hopper", scene.system, 3)
    for one, row in zip(first, range(4, 7), strict=True):
        assert (one[0] == states.q[row]).all()
        assert (one[1] == states.v[row]).all()


def test_random_rotations_are_of_every_direction_and_never_zero():
    system = TreeSystem((TreeLink("a", -1, mass=1.0, joints=(TreeJoint("b", "ball"),)),))
    quaternions = np.array([q for q, _ in random_states("x", system, 400)])
    assert np.linalg.norm(quaternions, axis=1) == pytest.approx(1.0, abs=1e-9)
    # Uniform on the sphere: no component has a mean beyond three standard errors, each a quarter of the square.
    assert np.abs(quaternions.mean(axis=0)).max() < 3 * 0.5 / 20
    assert (quaternions**2).mean(axis=0) == pytest.approx(0.25, abs=3 * 0.21 / 20)


@pytest.mark.parametrize(
    ("joints", "feature"),
    [
        ((TreeJoint("a", "ball"), TreeJoint("b")), "ball before a rotation"),
        ((TreeJoint("a"), TreeJoint("b")), "several joints"),
        ((TreeJoint("a", "ball", stiffness=1.0),), "spring of a ball"),
        ((TreeJoint("a", "free", armature=1.0),), "armature of a free joint"),
    ],
)
def test_features_that_engines_may_lack(joints, feature):
    assert feature in TreeSystem((TreeLink("a", -1, mass=1.0, joints=joints),)).features


def test_a_link_without_mass_whose_children_are_fixed_to_it_weighs():
    moving = TreeLink("a", -1, joints=(TreeJoint("j"),))
    middle, end = TreeLink("b", 0), TreeLink("c", 1, mass=1.0)
    assert "massless link" not in TreeSystem((moving, middle, end)).features
    hinged = TreeLink("c", 1, mass=1.0, joints=(TreeJoint("k"),))
    assert "massless link" in TreeSystem((moving, middle, hinged)).features
