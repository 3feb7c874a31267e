"""URDF in space: each joint by hand, and the mistakes of engines against MuJoCo, which makes some of them."""

import math
import re
import warnings

import numpy as np
import pytest

from furiko.models import InvalidInput
from furiko.models.readers.model_file import model_from_text, read_model
from furiko.models.readers.rules import AS_DOCUMENTED, with_urdf
from furiko.models.spatial import IDENTITY, Inertial, Pose, from_quaternion

INERTIAL = (
    '<inertial><mass value="{mass}"/><origin xyz=".1 .2 .3" rpy=".1 .2 .3"/>'
    '<inertia ixx="{ixx}" iyy="1.1" izz="{izz}" ixy=".1" ixz="0" iyz="0"/></inertial>'
)


def inertial(mass=2, ixx=1, izz=1.2):
    return INERTIAL.format(mass=mass, ixx=ixx, izz=izz)


ARM = inertial()


def joint(name, kind, parent, child, inside=""):
    return (
        f'<joint name="{name}" type="{kind}"><origin xyz="1 2 3" rpy=".3 .4 .5"/><parent link="{parent}"/>'
        f'<child link="{child}"/>{inside}</joint>'
    )


def robot(kind="revolute", inside='<axis xyz="0 1 1"/>', arm=ARM, more="", top=""):
    return (
        f'<robot name="r" xmlns:drake="d">{top}<link name="base"/><link name="arm">{arm}</link>'
        f"{joint('j', kind, 'base', 'arm', inside)}{more}</robot>"
    )


def tool(inside, kind="fixed"):
    return f'<link name="tool">{inside}</link>{joint("f", kind, "arm", "tool")}'


def spatial(text, rules=AS_DOCUMENTED):
    return model_from_text(text, rules=rules).spatial


# Roll .3, pitch .4, yaw .5 about fixed axes, written out: Rz(.5) Ry(.4) Rx(.3).
def turned(roll, pitch, yaw):
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in (roll, pitch, yaw))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def test_a_joint_stands_where_its_origin_says():
    base, arm = spatial(robot()).bodies
    assert (base.parent, arm.parent, base.joints) == (-1, 0, ())
    np.testing.assert_array_equal(arm.position, [1, 2, 3])
    np.testing.assert_allclose(from_quaternion(arm.quaternion), turned(0.3, 0.4, 0.5), rtol=0, atol=4e-16)


def test_an_inertial_is_turned_by_its_origin():
    (_, arm) = spatial(robot()).bodies
    turn = turned(0.1, 0.2, 0.3)
    np.testing.assert_array_equal(arm.inertial.centre, [0.1, 0.2, 0.3])
    expected = turn @ np.array([[1, 0.1, 0], [0.1, 1.1, 0], [0, 0, 1.2]]) @ turn.T
    np.testing.assert_allclose(arm.inertial.tensor, expected, rtol=0, atol=1e-15)


KINDS = {
    "revolute": ("hinge", 1),
    "continuous": ("hinge", 1),
    "prismatic": ("slide", 1),
    "floating": ("free", 6),
    "spherical": ("ball", 3),
}


@pytest.mark.parametrize("kind", KINDS)
def test_each_type_of_joint(kind):
    inside = '<axis xyz="0 3 4"/><dynamics damping=".5" friction=".25"/><limit lower="-1" upper="2"/>'
    found = spatial(robot(kind, inside)).joints[0].joint
    name, freedoms = KINDS[kind]
    assert (found.name, found.kind, found.freedoms) == ("j", name, freedoms)
    assert (found.damping, found.friction, found.armature, found.stiffness) == (0.5, 0.25, 0, 0)
    assert found.limits == ((-1, 2) if kind in ("revolute", "prismatic") else None)
    if name in ("hinge", "slide"):
        np.testing.assert_allclose(found.axis, [0, 0.6, 0.8], rtol=1e-15)


def test_without_an_axis_it_is_x():
    np.testing.assert_array_equal(spatial(robot(inside="")).joints[0].joint.axis, [1, 0, 0])


def test_a_planar_joint_slides_across_its_axis_and_turns_about_it():
    joints = [placed.joint for placed in spatial(robot("planar", '<axis xyz="1 1 0"/>')).joints]
    assert [(j.name, j.kind) for j in joints] == [("j_TX", "slide"), ("j_TY", "slide"), ("j_RZ", "hinge")]
    frame = np.stack([j.axis for j in joints], axis=1)
    # The quarter turn about (−1, 1, 0)/√2 takes z to (1, 1, 0)/√2.
    r = math.sqrt(0.5)
    np.testing.assert_allclose(frame, [[0.5, -0.5, r], [-0.5, 0.5, r], [-r, -r, 0]], rtol=0, atol=1e-15)
    ignored = spatial(robot("planar", '<axis xyz="1 1 0"/>'), with_urdf("planar_axis_ignored"))
    np.testing.assert_array_equal([j.joint.axis for j in ignored.joints], np.eye(3))


def test_a_floating_link_is_put_on_the_world():
    fixed = f'<link name="mount"/>{joint("m", "fixed", "base", "mount")}'
    text = robot("floating").replace(
        '<parent link="base"/><child link="arm"/>', '<parent link="mount"/><child link="arm"/>'
    )
    mechanism = spatial(text.replace("</robot>", f"{fixed}</robot>"))
    arm = next(body for body in mechanism.bodies if body.name == "arm")
    assert arm.parent == -1
    turn = turned(0.3, 0.4, 0.5)
    np.testing.assert_allclose(arm.position, turn @ [1, 2, 3] + [1, 2, 3], rtol=1e-15)
    np.testing.assert_allclose(from_quaternion(arm.quaternion), turn @ turn, rtol=0, atol=1e-15)


@pytest.mark.parametrize("kind", ["planar", "floating"])
def test_damping_of_joints_for_which_urdf_does_not_define_it(kind):
    text = robot(kind, '<dynamics damping=".5"/>')
    file = model_from_text(text)
    assert set(file.spatial.per_freedom("damping")) == {0.5}
    assert any("does not define damping" in note for note in file.notes)
    assert not spatial(text, with_urdf("damping_dropped_on_planar_and_floating")).per_freedom("damping").any()


def test_three_dampings_of_a_planar_joint():
    assert list(spatial(robot("planar", '<dynamics damping="1 2 3"/>')).per_freedom("damping")) == [1, 2, 3]


def test_what_acts_and_is_left_out_is_told():
    collision = '<collision><geometry><sphere radius=".1"/></geometry></collision>'
    more = tool(inertial() + collision, "continuous").replace("</joint>", '<mimic joint="j"/></joint>')
    inside = '<limit lower="-1" upper="1"/><dynamics friction="1"/>'
    file = model_from_text(robot(inside=inside, arm=inertial() + collision, more=more))
    assert [what.split(" (")[0] for what in file.without] == ["contacts", "joint limits", "dry friction", "mimic"]
    assert file.spatial.nv == 2
    assert model_from_text(robot("continuous", "")).without == ()


MISPLACED = {
    "an attribute of the joint": (
        robot().replace('name="j"', 'name="j" damping="1"'),
        "attribute 'damping' of <joint>",
    ),
    "an element": (robot(inside='<damping value="1"/>'), "<damping> in <joint>"),
    "inside the axis": (robot(inside='<axis xyz="1 0 0"><dynamics damping="1"/></axis>'), "<dynamics> in <axis>"),
    "as text": (robot(inside="<dynamics><damping>0.4</damping></dynamics>"), "<damping> in <dynamics>"),
    "an old tag": (robot(inside='<joint_properties damping="1" friction="0"/>'), "<joint_properties> in <joint>"),
}


@pytest.mark.parametrize("case", MISPLACED)
def test_a_damping_where_no_engine_reads_it_is_told(case):
    text, says = MISPLACED[case]
    file = model_from_text(text)
    assert not file.spatial.per_freedom("damping").any()
    (note,) = [note for note in file.notes if "read by no engine" in note]
    assert says in note
    assert "line 1" in note


STRANGE = {
    "in a link": (robot(arm=inertial() + "<contact/>"), "<contact> in <link> is not known"),
    "in an inertial": (robot(arm=inertial().replace("<mass", "<density/><mass")), "<density> in <inertial>"),
    "of an inertia": (robot(arm=inertial().replace("ixy", 'unit="g" ixy')), "'unit' of <inertia>"),
    "of a limit": (robot(inside='<limit lower="0" upper="1" drake:acceleration="1"/>'), "vendor"),
    "at the top": (robot(top="<foo/>"), "<foo> is not known in URDF"),
    "without effect": (robot(top='<gazebo/><transmission name="t"/><drake:x/>'), "drake:x, gazebo, transmission"),
    "twice": (robot(inside='<axis xyz="1 0 0"/><axis xyz="0 1 0"/>'), "a second <axis> in <joint>"),
    "no limit": (robot("revolute", ""), "without <limit>"),
    "turned limits": (robot(inside='<limit lower="1" upper="0"/>'), "wrong way round"),
    "A + B < C": (robot(arm=inertial(izz=9)), r"A \+ B < C"),
    "a negative moment": (robot(arm=inertial(ixx=-1)), "negative principal moment"),
    "a negative mass": (robot(arm=inertial(mass=-1)), "negative mass"),
    "no mass": (robot(arm=inertial(mass=0)), "without a mass"),
    "an extension": (robot(top='<mujoco><compiler settotalmass="3"/></mujoco>'), 'settotalmass="3".* MuJoCo alone'),
    "a gravity": (robot(top='<mujoco><option gravity="0 0 -1"/></mujoco>'), 'gravity="0 0 -1".* MuJoCo alone'),
}


@pytest.mark.parametrize("case", STRANGE)
def test_what_is_passed_over_or_impossible_is_told_and_read(case):
    text, says = STRANGE[case]
    file = model_from_text(text)
    assert len([note for note in file.notes if re.search(says, note)]) == 1
    assert file.spatial.nv == 1


def test_a_negative_mass_is_read_as_it_stands():
    """``boundmass``, which no document asks for here, does not raise it to nothing."""
    assert spatial(robot(arm=inertial(mass=-1))).bodies[1].inertial.mass == -1


def test_nothing_is_told_of_a_plain_file():
    text = robot(inside='<axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/>')
    assert [note[:30] for note in model_from_text(text).notes] == ["URDF says nothing of gravity: "]


def test_the_same_in_many_places_is_told_once():
    more = tool(inertial() + "<contact/>")
    notes = model_from_text(robot(arm=inertial() + "<contact/>", more=more)).notes
    assert [note[-31:] for note in notes if "contact" in note] == ["passed over (and in 1 more places)"[-31:]]


REFUSED = {
    "two roots": (robot(more='<link name="other"/>'), "2 links have no parent"),
    "mass missing": (robot(arm=inertial().replace('<mass value="2"/>', "")), "<mass value=> is needed"),
    "inertia missing": (robot(arm=inertial().replace('ixz="0"', "")), "ixz missing"),
    "floating on what moves": (robot(more=tool(inertial(), "floating")), "floating joint on a link that moves"),
    "no such type": (robot("screw"), "'screw' is not known"),
    "no direction": (robot(inside='<axis xyz="0 0 0"/>'), "direction"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_judged_is_refused(case):
    text, says = REFUSED[case]
    with pytest.raises(InvalidInput, match=says):
        model_from_text(text)


def moving_inertials(mechanism):
    """The inertials of the bodies that move, with those fixed to them, by the name of their last joint."""
    found, frames = {}, []
    for body in mechanism.bodies:
        name, frame = frames[body.parent] if body.parent >= 0 else ("", IDENTITY)
        frame = frame @ Pose(from_quaternion(body.quaternion), body.position)
        if body.joints:
            name, frame = body.joints[-1].name, IDENTITY
        frames.append((name, frame))
        part = body.inertial.transformed(frame)
        found[name] = found[name] + part if name in found else part
    found.pop("", None)
    return found


def of_mujoco(text, folder=None):
    import mujoco

    spec = mujoco.MjSpec.from_string(text)
    if folder is not None:
        spec.modelfiledir = str(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # settotalmass is deprecated
        model = spec.compile()
    found = {}
    for j in range(model.njnt):
        body = model.jnt_bodyid[j]
        turn = from_quaternion(model.body_iquat[body])
        tensor = turn @ np.diag(model.body_inertia[body]) @ turn.T
        found[model.joint(j).name] = Inertial(model.body_mass[body], model.body_ipos[body], tensor)
    return found, model


def assert_same(ours, theirs, tolerance=1e-12):
    # MuJoCo goes through principal axes: some tens of roundings of the largest moment.
    assert ours.keys() == theirs.keys()
    for name, a in ours.items():
        b = theirs[name]
        np.testing.assert_allclose(a.mass, b.mass, rtol=1e-13)
        np.testing.assert_allclose(a.centre, b.centre, rtol=0, atol=1e-12)
        np.testing.assert_allclose(a.tensor, b.tensor, rtol=0, atol=tolerance * max(1.0, np.abs(b.tensor).max()))


SHAPES = (
    '<collision><origin xyz=".1 0 0" rpy=".2 .3 .4"/><geometry><box size=".1 .2 .3"/></geometry></collision>'
    '<collision><geometry><cylinder radius=".1" length=".4"/></geometry></collision>'
    '<collision><geometry><sphere radius=".2"/></geometry></collision>'
    '<collision><origin rpy="1 0 0"/><geometry><capsule radius=".1" length=".4"/></geometry></collision>'
    '<visual><geometry><sphere radius="9"/></geometry></visual>'
)


def extension(**attributes):
    given = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    return f"<mujoco><compiler {given}/></mujoco>"


AS_MUJOCO = {
    "collision geometry": robot(arm=SHAPES),
    "collision geometry on a fixed link": robot(more=tool(SHAPES)),
    "collision geometry beside an inertial": robot(arm=inertial() + SHAPES),
    "massless fixed": robot(more=tool(inertial(mass=0))),
    "fixed to a massless one": robot(arm=inertial(mass=0), more=tool(inertial())),
    "massless fixed, not fused": robot(arm=inertial(mass=3), top=extension(fusestatic="false")),
    "inertia from geoms": robot(arm=inertial() + SHAPES, top=extension(inertiafromgeom="true")),
    "inertia from geoms, of which there are none": robot(top=extension(inertiafromgeom="true")),
    "geoms of other groups": robot(
        arm=inertial() + SHAPES, top=extension(inertiafromgeom="true", inertiagrouprange="1 2")
    ),
    "total mass": robot(more=tool(inertial()), top=extension(settotalmass="10")),
    "total mass with a heavy base": robot(top=extension(settotalmass="10")).replace(
        '<link name="base"/>', f'<link name="base">{ARM}</link>'
    ),
    "total mass, not fused": robot(top=extension(settotalmass="10", fusestatic="false")),
    "balanced": robot(arm=inertial(izz=9), top=extension(balanceinertia="true")),
    "bounds": robot(more=tool(inertial(mass=0)), top=extension(boundmass="3", boundinertia="1.1")),
}


@pytest.mark.parametrize("case", AS_MUJOCO)
def test_with_its_mistakes_we_read_what_mujoco_reads(case):
    text = AS_MUJOCO[case]
    rules = with_urdf("collision_weighs", "fixed_massless_inertia_dropped", "extension_honoured")
    theirs, _ = of_mujoco(text)
    assert_same(moving_inertials(spatial(text, rules)), theirs)


def test_gravity_and_time_step_of_the_extension():
    text = robot(top='<mujoco><option gravity="1 2 3" timestep=".01"/></mujoco>')
    _, model = of_mujoco(text)
    file = model_from_text(text, rules=with_urdf("extension_honoured"))
    np.testing.assert_array_equal(file.spatial.gravity, model.opt.gravity)
    assert file.timestep == model.opt.timestep
    np.testing.assert_array_equal(spatial(text).gravity, [0, 0, -9.81])


def test_by_the_format_itself_nothing_but_inertials_weighs():
    for text, mass in (
        (robot(arm=SHAPES), 0),
        (robot(arm=inertial() + SHAPES, top=extension(inertiafromgeom="true", settotalmass="9", boundmass="5")), 2),
    ):
        assert spatial(text).bodies[1].inertial.mass == mass
    # The case that people fall over: a massless link, fixed to another, has an inertia.
    both = moving_inertials(spatial(robot(more=tool(inertial(mass=0)))))["j"]
    one = moving_inertials(spatial(robot()))["j"]
    turn = turned(0.3, 0.4, 0.5)
    added = turn @ (one.tensor) @ turn.T
    np.testing.assert_allclose(both.tensor, one.tensor + added, rtol=0, atol=1e-15)


def test_a_sphere_of_water_for_an_impossible_inertial():
    rules = with_urdf("impossible_inertia_becomes_sphere")
    (_, arm) = spatial(robot(arm=inertial(izz=9)), rules).bodies
    radius = (2 / 1000 / (4 / 3 * math.pi)) ** (1 / 3)
    np.testing.assert_allclose(arm.inertial.tensor, np.eye(3) * 0.4 * 2 * radius**2, rtol=1e-14)
    (_, arm) = spatial(robot(arm=inertial(mass=0)), rules).bodies
    assert arm.inertial.mass == 1
    (_, arm) = spatial(robot(), rules).bodies
    assert arm.inertial.tensor.trace() == pytest.approx(3.3)


def test_drakes_rotors():
    rotor = '<actuator><drake:rotor_inertia value="0.5"/><drake:gear_ratio value="10"/></actuator>'
    text = robot(more=f'<transmission name="t"><joint name="j"/>{rotor}</transmission>')
    assert list(spatial(text, with_urdf("drake_rotor_counted")).per_freedom("armature")) == [50]
    assert list(spatial(text).per_freedom("armature")) == [0]


CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 2) for z in (0, 3)).encode() + (
    b"f 1 2 4\nf 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n"
)


def meshed(name, scale="1 1 1"):
    return robot(arm=f'<collision><geometry><mesh filename="{name}" scale="{scale}"/></geometry></collision>')


@pytest.mark.parametrize("scale", ["1 1 1", ".5 2 1"])
def test_a_collision_mesh_weighs(tmp_path, scale):
    text = meshed("cube.obj", scale)
    (tmp_path / "cube.obj").write_bytes(CUBE)
    (tmp_path / "robot.urdf").write_text(text)
    theirs, _ = of_mujoco(text, tmp_path)
    file = read_model(tmp_path / "robot.urdf", with_urdf("collision_weighs"))
    assert_same(moving_inertials(file.spatial), theirs, 1e-6)  # MuJoCo's principal axes of a mesh: single precision


def test_where_meshes_are_looked_for(tmp_path):
    package, elsewhere = tmp_path / "arm_description", tmp_path / "elsewhere"
    for folder in (package / "urdf", package / "meshes", elsewhere / "other" / "meshes", tmp_path / "meshes"):
        folder.mkdir(parents=True)
        (folder / "cube.obj").write_bytes(CUBE)
    rules = with_urdf("collision_weighs")
    path = package / "urdf" / "robot.urdf"

    def found(name, *meshes):
        path.write_text(meshed(name))
        try:
            file = read_model(path, rules, meshes)
        except InvalidInput as error:
            return "no such mesh" not in str(error)
        return file.spatial.bodies[1].inertial.mass == pytest.approx(6000)

    assert found("cube.obj")
    assert found("package://arm_description/meshes/cube.obj")
    assert not found("package://other/meshes/cube.obj")
    assert found("package://other/meshes/cube.obj", elsewhere)
    assert found("package://other/meshes/cube.obj", elsewhere / "other")
    nothing = tmp_path / "nothing"
    nothing.mkdir()
    for name in (
        "../meshes/cube.obj",
        "package://arm_description/../meshes/cube.obj",
        "package://../meshes/cube.obj",
        str(tmp_path / "meshes/cube.obj"),
    ):
        assert not found(name)
        assert not found(name, nothing)
        assert found(name, elsewhere)  # below it, by the end of its path
    (package / "urdf" / "link.obj").symlink_to(tmp_path / "meshes" / "cube.obj")
    assert not found("link.obj")
