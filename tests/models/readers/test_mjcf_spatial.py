"""MJCF as bodies in space: field by field against MuJoCo's own compiler, one kind of file after another."""

import math
import struct

import mujoco
import numpy as np
import pytest

from furiko.models import InvalidInput
from furiko.models.readers.model_file import read_model
from furiko.models.readers.rules import AS_DOCUMENTED, with_mjcf
from furiko.models.readers.xml_file import write_xml

from .compiled import ROUNDING, assert_alike, assert_same, read

INERTIAL = '<inertial pos="0.1 0 -1" mass="1" diaginertia="0.1 0.2 0.3"/>'


def mjcf(world, head="", tail=""):
    return f'<mujoco model="m">{head}<worldbody>{world}</worldbody>{tail}</mujoco>'


def body(inside="", joints='<joint axis="0 1 0"/>', **attributes):
    given = " ".join(f'{name}="{value}"' for name, value in attributes.items())
    return f"<body {given}>{joints}{INERTIAL}{inside}</body>"


TETRAHEDRON = '<mesh name="t" vertex="0 0 0  1 0 0  0 2 0  0 0 3" {}/>'
# A square pyramid standing in a box: what "legacy" counts twice, "exact" once.
DENT = (
    '<mesh name="t" vertex="0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1 .5 .5 .4" '
    'face="0 2 1 0 3 2 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7 4 5 8 5 6 8 6 7 8 7 4 8" {}/>'
)
MESH = '<body><joint axis="1 0 0"/><geom type="mesh" mesh="t" pos="1 2 3" euler="10 20 30" {}/></body>'


def mesh(attributes="", geom="", shape=TETRAHEDRON, head=""):
    return mjcf(MESH.format(geom), f"{head}<asset>{shape.format(attributes)}</asset>")


DEFAULTS = """<default><joint armature="0.1" axis="1 0 0"/><geom density="300"/>
<default class="a"><joint damping="0.2"/><default class="b"><joint stiffness="3" axis="0 0 1"/></default></default>
<default class="c"><geom quat="0 1 0 0" mass="2"/></default></default>"""
READ = {
    "a slide": mjcf(
        body(joints='<joint type="slide" axis="1 0 2" range="-1 2" ref="0.3" springref="0.1" stiffness="4"/>')
    ),
    "a ball": mjcf(body(joints='<joint type="ball" pos="1 2 3" range="0 40" damping="2" frictionloss="1"/>')),
    "free": mjcf(
        body(joints='<joint type="free" pos="7 7 7" armature="0.1" damping="0.2"/>', pos="1 2 3", euler="10 20 30")
    ),
    "freejoint has no defaults": mjcf(body(joints="<freejoint/>"), DEFAULTS),
    "several joints": mjcf(
        body(
            joints='<joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 1"/>'
            '<joint type="ball" pos="0 0 1"/>'
        )
    ),
    "hinges with ref": mjcf(
        body(joints='<joint axis="0 1 0" ref="30"/><joint axis="1 0 0" ref="-20" springref="5" stiffness="1"/>')
    ),
    "radians": mjcf(
        body(joints='<joint axis="0 1 0" ref="0.3" range="-1 1"/>', euler="0.1 0.2 0.3"), '<compiler angle="radian"/>'
    ),
    "fixed euler axes": mjcf(body(euler="10 20 30"), '<compiler eulerseq="XzY"/>'),
    "orientations": mjcf(
        body(body(body(body(quat="2 1 0 3"), zaxis="1 1 0"), xyaxes="1 1 0 0 1 1"), axisangle="1 2 3 40")
    ),
    "opposite z": mjcf(body(zaxis="0 0 -1")),
    "two roots and a fixed one": mjcf(body(pos="1 0 0") + body(pos="2 0 0", joints="") + body(body(joints=""))),
    "frames": mjcf(
        f'<frame pos="1 2 3" euler="0 20 0"><frame quat="1 1 0 0">{body(pos="0 0 1")}</frame></frame>'
        f'<body><frame pos="0 1 0" euler="90 0 0"><joint axis="0 1 0" pos="0 0 1"/><geom size=".1" pos="1 0 0"/>'
        f'<frame pos="0 0 2"><geom type="box" size=".1 .2 .3"/>{body()}</frame></frame></body>'
    ),
    "an inertial in a frame": mjcf(
        f'<body><frame pos="0 0 5" euler="0 90 0"><joint axis="1 0 0"/>{INERTIAL}</frame></body>'
    ),
    "classes": mjcf(
        f'<body childclass="b"><joint/>{INERTIAL}<frame childclass="a"><body><joint/>{INERTIAL}</body></frame>'
        '<body><joint class="a"/><joint class="main" axis="0 1 0"/><geom class="c" type="box" size=".1 .2 .3"/></body>'
        "</body>",
        DEFAULTS,
    ),
    "an own orientation replaces a default's": mjcf(
        '<body><joint/><geom class="c" type="box" size=".1 .2 .3" euler="0 0 30"/></body>', DEFAULTS
    ),
    "sections anywhere, several": mjcf(
        body(euler="0.1 0 0", joints="<joint/>"),
        '<compiler boundmass="0.1"/><default><joint axis="1 0 0"/></default>',
        f'<compiler angle="radian"/><default><joint armature="2"/></default><worldbody>{body(pos="3 0 0")}</worldbody>',
    ),
    "hollow shapes": mjcf(
        '<body><joint/><geom size=".2" shellinertia="true"/>'
        '<geom type="capsule" size=".1 .4" pos="1 0 0" shellinertia="true"/>'
        '<geom type="cylinder" size=".1 .4" pos="0 1 0" shellinertia="true" mass="3"/>'
        '<geom type="box" size=".1 .2 .3" euler="10 20 30" shellinertia="true" density="7"/></body>'
    ),
    "fromto": mjcf(
        "<body><joint/>"
        + "".join(
            f'<geom type="{kind}" fromto="0 .1 {i} .3 .2 {i + 1}" size=".05"/>'
            for i, kind in enumerate(("capsule", "cylinder", "ellipsoid", "box"))
        )
        + "</body>"
    ),
    "groups": mjcf(
        '<body><joint/><geom size=".1" group="1"/><geom size=".2" group="4"/></body>',
        '<compiler inertiagrouprange="0 2"/>',
    ),
    "geoms before inertials": mjcf(body('<geom size=".1" pos="0 1 0"/>'), '<compiler inertiafromgeom="true"/>'),
    "bounds": mjcf(
        body() + '<body><joint/><geom size=".01"/></body>', '<compiler boundmass="0.5" boundinertia="0.25"/>'
    ),
    "a bound on principal moments": mjcf(
        '<body><joint/><inertial pos="0 0 0" mass="1" fullinertia="1 1 1.2 .4 0 0"/></body>',
        '<compiler boundinertia="0.65"/>',
    ),
    "boundmass of nothing": mjcf(
        body(body(pos="0 0 2").replace(INERTIAL, "")), '<compiler boundmass="0.1" boundinertia="0.01"/>'
    ),
    "balance": mjcf(
        '<body><joint/><inertial pos="0 0 0" mass="1" diaginertia="1 1 3" euler="10 20 30"/></body>',
        '<compiler balanceinertia="true"/>',
    ),
    "total mass": mjcf(body(body()), '<compiler settotalmass="7"/>'),
    "copies": mjcf(
        f'<replicate count="12" offset="1 0 0" euler="0 0 30">{body(name="x")}</replicate>'
        f'<body><replicate count="2" offset="0 1 0" euler="90 0 20"><replicate count="2" sep="-" offset="0 0 1">'
        f'{body(name="y")}<geom size=".1"/></replicate></replicate></body>'
    ),
    "a height field": mjcf(
        '<body><joint/><geom type="hfield" hfield="h"/></body>',
        '<asset><hfield name="h" nrow="3" ncol="3" size="1 2 3 4"/></asset>',
    ),
    "gravity": mjcf(body(), '<option gravity="1 2 3"/>'),
    "no gravity": mjcf(body(), '<option><flag gravity="disable"/></option>'),
    "a mocap body": mjcf(f'<body mocap="true" pos="1 0 0"><geom size=".1"/></body>{body()}'),
    "a spring and damper by time constant": mjcf(
        body(
            body(
                body(joints='<joint type="slide" axis="1 1 0" springdamper="0.2 0.7"/>', pos="0 1 1"),
                joints='<joint type="ball" springdamper="0.3 1"/>',
                pos="0 0 1",
            ),
            joints='<joint axis="0 1 0" armature="2" springdamper="0.1 0.5"/>',
        )
    ),
}


@pytest.mark.parametrize("feature", READ)
def test_bodies_are_read_as_mujoco_compiles_them(feature):
    assert_same(READ[feature])


MESHES = {
    "as it is": mesh(),
    "scaled and mirrored": mesh('scale="1 -2 .5"'),
    "moved": mesh('refpos="1 2 3" refquat="1 1 0 0"'),
    "with a mass": mesh(geom='mass="3"'),
    "a surface": mesh('inertia="shell"'),
    "exact": mesh('inertia="exact"', shape=DENT),
    "legacy": mesh(shape=DENT),
    "convex": mesh('inertia="convex"', shape=DENT),
    "scaled by default": mesh(head='<default><mesh scale="2 2 2"/></default>'),
    "two on one body": mjcf(
        '<body><joint/><geom type="mesh" mesh="t"/><geom type="mesh" mesh="t" pos="0 3 0" density="10"/></body>',
        f"<asset>{TETRAHEDRON.format('')}</asset>",
    ),
    "fitted primitives": mjcf(
        "<body><joint/>"
        + "".join(
            f'<geom type="{kind}" mesh="t" pos="0 0 1" fitscale="1.5"/>'
            for kind in ("box", "capsule", "cylinder", "sphere", "ellipsoid")
        )
        + "</body>",
        f"<asset>{TETRAHEDRON.format('')}</asset>",
    ),
    "in two sections": mjcf(
        '<body><joint/><geom type="mesh" mesh="t"/><geom type="mesh" mesh="u"/></body>',
        "<asset>"
        + TETRAHEDRON.format("")
        + "</asset><asset>"
        + DENT.format("").replace('name="t"', 'name="u"')
        + "</asset>",
    ),
}


@pytest.mark.parametrize("case", MESHES)
def test_meshes_weigh_what_mujoco_weighs(case):
    # MuJoCo keeps a mesh in single precision, centred and turned: half an ε of 2⁻²³ a coordinate, a few of them.
    assert_same(MESHES[case], tolerance=1e-6)


@pytest.mark.parametrize("case", [*READ, *MESHES])
def test_the_text_that_engines_are_given_has_the_same_bodies(case):
    found = read(READ.get(case) or MESHES[case])
    model = mujoco.MjModel.from_xml_string(write_xml(found.root))
    assert_alike(found, model, ROUNDING if case in READ else 1e-6)
    assert model.nmesh == 0


def stl(*triangles):
    faces = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in t for x in corner), 0) for t in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + faces


CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
SOLID = stl(*([CORNERS[i] for i in face] for face in FACES))


@pytest.mark.parametrize("settings", ['meshdir="parts"', 'assetdir="parts"', 'meshdir="parts" strippath="true"'])
def test_a_mesh_is_found_where_the_compiler_says(tmp_path, settings):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "one.stl").write_bytes(SOLID)
    name = "nowhere/one.stl" if "strip" in settings else "one.stl"
    world = '<body><joint axis="1 0 0"/><geom type="mesh" mesh="one"/></body>'
    text = mjcf(world, f'<compiler {settings}/><asset><mesh file="{name}"/></asset>')
    found = assert_same(text, tmp_path, tolerance=1e-6)
    assert found.bodies[0].inertial.mass == pytest.approx(1000 / 6, rel=1e-6)  # a sixth of a cube of 1 m


def test_a_mesh_outside_is_read_only_from_a_folder_that_the_user_named(tmp_path):
    (tmp_path / "model").mkdir()
    (tmp_path / "meshes").mkdir()
    (tmp_path / "meshes" / "one.stl").write_bytes(SOLID)
    world = '<body><joint/><geom type="mesh" mesh="one"/></body>'
    text = mjcf(world, '<compiler meshdir="../meshes"/><asset><mesh file="one.stl"/></asset>')
    path = tmp_path / "model" / "model.xml"
    with pytest.raises(InvalidInput, match=r"outside the model's own folder.*--meshes"):
        read(text, path=path)
    for other in (text, text.replace('meshdir="../meshes"', 'meshdir="/somewhere/else"')):
        assert read(other, path=path, others=[tmp_path / "meshes"]).bodies[0].inertial.mass > 0


def _included(folder, mesh_of_size, compiler="", name="one.stl"):
    """A model whose mesh is named in parts/assets.xml; ``mesh_of_size``: the solid at each place, by its edge [m]."""
    for place, edge in mesh_of_size.items():
        path = folder / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(stl(*(np.multiply(edge, [CORNERS[i] for i in face]) for face in FACES)))
    (folder / "parts").mkdir(exist_ok=True)
    (folder / "parts" / "assets.xml").write_text(f'<mujoco><asset><mesh name="m" file="{name}"/></asset></mujoco>')
    world = '<body><joint axis="1 0 0"/><geom type="mesh" mesh="m"/></body>'
    path = folder / "model.xml"
    path.write_text(mjcf(world, f'{compiler}<include file="parts/assets.xml"/>'))
    return path


@pytest.mark.parametrize(
    ("sizes", "compiler", "name"),
    [
        ({"parts/one.stl": 1}, "", "one.stl"),
        ({"meshes/one.stl": 1}, "", "../meshes/one.stl"),
        ({"meshes/one.stl": 1}, '<compiler meshdir="elsewhere"/>', "../meshes/one.stl"),
        ({"parts/one.stl": 1, "one.stl": 2}, "", "one.stl"),
        ({"parts/one.stl": 1, "meshes/one.stl": 2}, '<compiler meshdir="meshes"/>', "one.stl"),
        ({"parts/one.stl": 1, "one.stl": 2}, '<compiler meshdir="meshes"/>', "one.stl"),
    ],
)
def test_what_an_included_file_names_may_lie_beside_it(tmp_path, sizes, compiler, name):
    path = _included(tmp_path, sizes, compiler, name)
    theirs = mujoco.MjModel.from_xml_path(str(path)).body_mass[1]
    assert read(path.read_text(), path=path).bodies[0].inertial.mass == pytest.approx(theirs, rel=1e-6)  # float32


def test_an_included_file_includes_what_lies_beside_it(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "arm.xml").write_text(f"<mujoco>{body()}</mujoco>")
    (tmp_path / "parts" / "world.xml").write_text('<mujoco><include file="arm.xml"/></mujoco>')
    path = tmp_path / "model.xml"
    path.write_text(mjcf('<include file="parts/world.xml"/>'))
    assert mujoco.MjModel.from_xml_path(str(path)).nv == 1
    assert len(read(path.read_text(), path=path).bodies) == 1


def test_what_the_model_itself_names_is_in_the_folder_that_it_says(tmp_path):
    (tmp_path / "one.stl").write_bytes(SOLID)
    world = '<body><joint/><geom type="mesh" mesh="one"/></body>'
    path = tmp_path / "model.xml"
    path.write_text(mjcf(world, '<compiler meshdir="meshes"/><asset><mesh file="one.stl"/></asset>'))
    with pytest.raises(ValueError, match="Error opening file"):
        mujoco.MjModel.from_xml_path(str(path))
    with pytest.raises(InvalidInput, match="no such file"):
        read_model(path)


def test_an_included_file_reaches_no_further_than_the_model(tmp_path):
    inside = tmp_path / "inside"
    path = _included(inside, {"parts/one.stl": 1}, name="../../one.stl")
    (tmp_path / "one.stl").write_bytes(SOLID)
    with pytest.raises(InvalidInput, match="outside the model's own folder"):
        read(path.read_text(), path=path)


def test_a_file_outside_is_refused_with_the_folder_to_name(tmp_path):
    (tmp_path / "robots" / "arm").mkdir(parents=True)
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "scene.xml").write_text("<mujoco><option/></mujoco>")
    path = tmp_path / "robots" / "arm" / "model.xml"
    path.write_text(mjcf(body(), '<include file="../../scene/scene.xml"/>'))
    with pytest.raises(InvalidInput) as caught:
        read_model(path)
    named = str(caught.value).partition("--meshes: ")[2].removesuffix(" holds both")
    assert named == str(tmp_path.resolve())[-200:]
    assert read_model(path, meshes=[tmp_path]).spatial.bodies


def test_a_mesh_that_does_not_weigh_is_not_asked_for():
    world = body('<geom type="mesh" mesh="one"/>') + '<body><geom type="mesh" mesh="one" mass="0"/></body>'
    found = read(mjcf(world, '<asset><mesh name="one" file="missing.stl"/></asset>'))
    assert [b.inertial.mass for b in found.bodies] == [1, 0]


def test_actuators_add_armature_and_damping_to_their_joint():
    # MuJoCo keeps them apart from the joint's own; its mass matrix and passive forces have both, by the gear squared.
    tail = (
        '<actuator><motor joint="j" gear="3" armature="0.5" damping="2"/><motor joint="j" armature="0.25"/></actuator>'
    )
    text = mjcf('<body><joint name="j" armature="0.1" damping="1"/><geom size=".1"/></body>', "", tail)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qvel[:] = 1.0
    mujoco.mj_forward(model, data)
    found = read(text)
    (joint,) = found.bodies[0].joints
    inertia = found.bodies[0].inertial.tensor[2, 2]
    unit = np.zeros(1)
    mujoco.mj_mulM(model, data, unit, np.ones(1))
    assert joint.armature + inertia == pytest.approx(float(unit[0]), rel=1e-13)
    assert -joint.damping == pytest.approx(float(data.qfrc_passive[0]), rel=1e-13)
    assert "armature or damping of its actuators" in " ".join(found.notes)


def forces_without_control(tail, head=""):
    text = mjcf(f'<body><joint name="j" axis="0 1 0"/>{INERTIAL}</body>', head, tail)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = 0.3, 0.7
    mujoco.mj_forward(model, data)
    return read(text), bool(data.qfrc_actuator.any())


ACTUATORS = {
    "motor": ('<motor joint="j"/>', ""),
    "position": ('<position joint="j" kp="12"/>', ""),
    "only damping": ('<position joint="j" kp="0" kv="0.6"/>', ""),
    "velocity": ('<velocity joint="j" kv="2"/>', ""),
    "velocity that does nothing": ('<velocity joint="j" kv="0"/>', ""),
    "integrated velocity": ('<intvelocity joint="j" kp="3"/>', ""),
    "damper": ('<damper joint="j" kv="3" ctrlrange="0 1"/>', ""),
    "general": ('<general joint="j" gainprm="3"/>', ""),
    "general with a bias": ('<general joint="j" biastype="affine" biasprm="0 -3 -1"/>', ""),
    "a bias that is said to be none": ('<general joint="j" biastype="none" biasprm="0 -3 -1"/>', ""),
    "a bias that is none": ('<general joint="j" biasprm="0 -3 -1"/>', ""),
    "a bias by default": ('<general joint="j"/>', '<default><general biastype="affine" biasprm="0 -3"/></default>'),
    "a servo by default": ('<general joint="j"/>', '<default><position kp="3"/></default>'),
    "a motor behind a servo": ('<motor joint="j"/>', '<default><position kp="3"/></default>'),
    "a gain by default": (
        '<position joint="j" class="s"/>',
        '<default><default class="s"><position kp="0" kv="1"/></default></default>',
    ),
    "disabled": ('<position joint="j" kp="12"/>', '<option><flag actuation="disable"/></option>'),
}


@pytest.mark.parametrize("case", ACTUATORS)
def test_a_servo_is_named_where_it_pulls_without_control(case):
    actuator, head = ACTUATORS[case]
    named = actuator.replace(" joint", ' name="servo" joint')
    found, pulls = forces_without_control(f"<actuator>{named}</actuator>", head)
    assert found.servos == ([("servo", "j")] if pulls else [])
    assert ("actuators" in found.without) == (case != "disabled")


ACTS = {
    "contacts": mjcf(body('<geom size=".1"/>') + '<geom size=".1"/>'),
    "joint limits": mjcf(body(joints='<joint range="-1 1"/>')),
    "dry friction": mjcf(body(joints='<joint frictionloss="1"/>')),
    "equality constraints": mjcf(body(name="a"), "", '<equality><weld body1="a"/></equality>'),
    "tendons": mjcf(
        body(joints='<joint name="j"/>'),
        "",
        '<tendon><fixed stiffness="2"><joint joint="j" coef="1"/></fixed></tendon>',
    ),
    "fluid": mjcf(body(), '<option viscosity="1"/>'),
    "gravcomp": mjcf(body(gravcomp="1")),
    "mocap": mjcf('<body mocap="true"/>' + body()),
    "flex": mjcf(
        body(name="a"), "", '<deformable><flex body="a" vertex="0 0 0 1 0 0" element="0 1" dim="1"/></deformable>'
    ),
}


@pytest.mark.parametrize("what", ACTS)
def test_what_acts_and_is_left_out_is_said(what):
    assert any(what in said for said in read(ACTS[what]).without)
    assert read(mjcf(body())).without == []


NOTHING_ACTS = {
    "geoms that touch nothing": mjcf(body('<geom size=".1" contype="0" conaffinity="0"/>') + '<geom size=".1"/>'),
    "one geom": mjcf(body('<geom size=".1"/>')),
    "inactive": mjcf(body(name="a"), "", '<equality><weld body1="a" active="false"/></equality>'),
    "inactive by default": mjcf(
        body(name="a"), '<default><equality active="false"/></default>', '<equality><weld body1="a"/></equality>'
    ),
    "a tendon that measures": mjcf(
        body(joints='<joint name="j"/>'), "", '<tendon><fixed><joint joint="j" coef="1"/></fixed></tendon>'
    ),
    "constraints disabled": mjcf(
        body('<geom size=".1"/>', name="a", joints='<joint range="-1 1" frictionloss="1"/>') + '<geom size=".1"/>',
        '<option><flag constraint="disable"/></option>',
        '<equality><weld body1="a"/></equality>',
    ),
    "a sensor, a camera, a keyframe": mjcf(
        body('<camera/><site name="s"/><light/>'),
        "",
        '<sensor><gyro site="s"/></sensor><keyframe><key qpos="1"/></keyframe>',
    ),
}


@pytest.mark.parametrize("what", NOTHING_ACTS)
def test_what_does_not_act_is_not_said_to(what):
    found = read(NOTHING_ACTS[what])
    assert found.without == []
    assert found.notes == []


STRANGE = {
    "an element in a joint": (mjcf(body(joints='<joint><dynamics damping="1"/></joint>')), "<dynamics>"),
    "an attribute of a joint": (mjcf(body(joints='<joint dampening="1"/>')), "'dampening'"),
    "an attribute of an inertial": (mjcf(body().replace("mass=", 'com="1" mass=')), "'com'"),
    "an element in a body": (mjcf(body("<inertia/>")), "<inertia>"),
    "an attribute of a body": (mjcf(body(mass="1")), "'mass'"),
    "a section": (mjcf(body(), "<physics/>"), "<physics>"),
    "no body's inertia": (mjcf(body().replace("0.1 0.2 0.3", "0.1 0.1 0.3")), "exceeds the sum"),
}


@pytest.mark.parametrize("case", STRANGE)
def test_what_is_not_known_is_told_and_not_dropped_in_silence(case):
    text, says = STRANGE[case]
    found = read(text)
    assert any(says in note for note in found.notes), found.notes
    assert len(found.bodies) == 1


REFUSED = {
    "composite": (mjcf(body("<composite/>")), "<composite>.*write them out"),
    "flexcomp": (mjcf("<flexcomp/>"), "bends"),
    "attach": (mjcf(body('<attach model="m" prefix="p"/>')), "<attach>"),
    "a joint in the world": (mjcf("<joint/>"), "does not move"),
    "free on another body": (mjcf(body(body(joints="<freejoint/>"))), "free joint on a body"),
    "a spring that yields": (mjcf(body(joints='<joint stiffness="1" springyield="0.1"/>')), "yields"),
    "a spring of higher powers": (mjcf(body(joints='<joint stiffness="1 0.5"/>')), "a spring that is not linear"),
    "a damper of higher powers": (mjcf(body(joints='<joint damping="1 0 0.5"/>')), "write damping='1'"),
    "global": (mjcf(body(), '<compiler coordinate="global"/>'), "coordinate"),
    "a class twice": (mjcf(body(), '<default><default class="a"/><default class="a"/></default>'), "second <default>"),
    "a hollow ellipsoid": (mjcf('<body><geom type="ellipsoid" size="1 2 3" shellinertia="true"/></body>'), "ellipsoid"),
    "a distance field": (mjcf('<body><geom type="sdf" mesh="m"/></body>'), "distance field"),
    "no such mesh": (mjcf('<body><geom type="mesh" mesh="m"/></body>'), "no <mesh> of that name"),
    "a mesh of nothing": (mesh().replace("0 0 3", "0 0 0"), "volume|hull|surface"),
    "a mocap body with a joint": (mjcf(body(mocap="true")), "mocap"),
    "a joint in copies": (
        mjcf(f'<body><replicate count="2"><joint/></replicate>{INERTIAL}</body>'),
        "directly in <replicate>",
    ),
    "copies turned in a way left open": (
        mjcf(f'<replicate count="3" euler="10 20 0">{body()}</replicate>'),
        "leaves open",
    ),
    "copies of copies": (
        mjcf(f'<replicate count="300"><replicate count="300">{body()}</replicate></replicate>'),
        "elements",
    ),
    "an unknown actuator": (mjcf(body(), "", "<actuator><spring/></actuator>"), "no kind of actuator"),
    "a time constant of nothing": (mjcf('<body><joint springdamper="1 1"/></body>'), "singular"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_read_is_refused_with_its_reason(case):
    text, says = REFUSED[case]
    with pytest.raises(InvalidInput, match=says):
        read(text)


def test_names_are_given_in_the_documents_order():
    found = read(mjcf(body(body(), name="a") + body()))
    assert [b.name for b in found.bodies] == ["a", "furiko_body_2", "furiko_body_3"]
    assert [j.name for b in found.bodies for j in b.joints] == [f"furiko_joint_{k}" for k in (1, 2, 3)]


def test_a_long_list_of_positions_does_not_refuse_a_file():
    keys = f'<keyframe><key qpos="{"0.125 " * 5000}"/></keyframe>'
    assert len(read(mjcf(body(), "", keys)).bodies) == 1


def test_a_tetrahedron_has_the_moments_of_its_closed_form():
    # ∫x² over the corner tetrahedron of sides a, b, c is abc·a²/60, its centre at a quarter: by hand.
    found = read(mesh(geom='density="1"').replace('pos="1 2 3" euler="10 20 30"', ""))
    inertial = found.bodies[0].inertial
    sides = np.array([1.0, 2.0, 3.0])
    volume = float(sides.prod()) / 6
    squares = volume * sides**2 * (1 / 10 - 1 / 16)
    assert inertial.mass == pytest.approx(volume, rel=1e-14)
    np.testing.assert_allclose(inertial.centre, sides / 4, rtol=1e-14)
    np.testing.assert_allclose(np.diag(inertial.tensor), squares.sum() - squares, rtol=1e-13)
    assert math.isclose(inertial.tensor[0, 1], volume * 1 * 2 * (1 / 16 - 1 / 20), rel_tol=1e-12)


def test_a_model_file_has_its_spatial_mechanism_and_says_what_is_left_out(tmp_path):
    path = tmp_path / "cart.xml"
    tail = '<actuator><position name="servo" joint="x" kp="5"/></actuator>'
    path.write_text(mjcf(body(joints='<joint name="x" type="slide" axis="1 0 0" range="-1 1"/>'), "", tail))
    file = read_model(path)
    assert file.spatial.joint_names == ("x",)
    assert file.planar is None
    assert "slide" in file.not_planar
    assert file.servos == (("servo", "x"),)
    assert set(file.without) == {"joint limits", "actuators"}
    assert file.rules is AS_DOCUMENTED
    mistaken = read_model(path, with_mjcf("first_root_only"))
    assert mistaken.rules.mjcf.first_root_only
