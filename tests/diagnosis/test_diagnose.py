"""``diagnose`` on a user's own file: models such as engines' galleries have, sound ones that look odd, and faults."""

import json
import math
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from faults.mechanisms import free, random_tree
from faults.model_files import IN_FILES, diagnosed, planted_in_file, sound_model
from faults.writing import Style, written

from furiko import Diagnosis, diagnose
from furiko.diagnosis.measurement import probe_states
from furiko.engines.model_files.adapter import READERS
from furiko.models import InvalidInput, document_catalogue, find_scene, to_mjcf, to_urdf
from furiko.models.readers.model_file import model_from_text

# A swing-up arm as control suites have it: upright at zero, capsules that weigh, a damped hinge.
ACROBOT = """<mujoco model="arm"><default><joint damping=".05"/><geom type="capsule" mass="1"/></default>
<option timestep="0.01" integrator="RK4"/><worldbody><light pos="0 0 6"/>
<geom name="floor" size="3 3 .2" type="plane"/><site name="goal" type="sphere" pos="0 0 4" size=".2"/>
<camera name="fixed" pos="0 -6 2" zaxis="0 -1 0"/>
<body name="upper" pos="0 0 2"><joint name="shoulder" type="hinge" axis="0 1 0"/>
<geom name="upper_hub" type="cylinder" fromto="0 -.06 0 0 .06 0" size=".051" mass="0"/>
<geom name="upper" fromto="0 0 0 0 0 1" size="0.049"/>
<body name="lower" pos="0 0 1"><joint name="elbow" type="hinge" axis="0 1 0"/>
<geom name="lower" fromto="0 0 0 0 0 1" size="0.049"/><site name="tip" pos="0 0 1" size="0.01"/></body></body>
</worldbody><actuator><motor name="elbow" joint="elbow" gear="2"/></actuator></mujoco>"""

# Two point masses on rods as teaching libraries have it: welded to a world that is not declared, no tensors.
BOBS = """<robot name="bobs" xmlns="http://example.org"><material name="red"><color rgba="1 0 0 1"/></material>
<link name="base"><inertial><origin xyz="0 0 0"/><mass value="0.01"/>
<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
<visual><geometry><mesh filename="package://none/base.obj"/></geometry></visual></link>
<joint name="weld" type="fixed"><parent link="world"/><child link="base"/></joint>
{links}<transmission type="SimpleTransmission" name="t"><actuator name="a"/></transmission></robot>"""
BOB = """<link name="{name}"><inertial><origin xyz="0 0 -{l}" rpy="0 0 0"/><mass value="{m}"/>
<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<joint name="{joint}" type="continuous"><parent link="{parent}"/><child link="{name}"/><origin xyz="0 0 {z}"/>
<axis xyz="0 1 0"/></joint>"""
CART = """<mujoco><worldbody><body name="cart"><joint name="slider" type="slide" axis="1 0 0"/><geom size=".1"/>
<body name="pole"><joint name="hinge" axis="0 1 0"/><geom type="capsule" fromto="0 0 0 0 0 1" size=".05"/></body></body>
</worldbody></mujoco>"""


def bobs():
    first = BOB.format(name="upper", joint="first", parent="base", l=1.0, m=1.0, z=0)
    second = BOB.format(name="lower", joint="second", parent="upper", l=2.0, m=0.5, z=-1.0)
    return BOBS.format(links=first + second)


# What engines do with sound files: MuJoCo refuses point masses in URDF, Pinocchio reads one body of the world in MJCF.
OF_ENGINES = {"inertia-rejected", "first-root-only"}


def causes(diagnosis):
    return [finding.cause for finding in diagnosis.findings]


def test_a_gallery_arm_is_read_and_its_damping_noted():
    found = diagnose(model_from_text(ACROBOT, "arm.xml"))
    assert [link.com[0] for link in found_links(ACROBOT)] == pytest.approx([-0.5, -0.5])  # upright at zero
    assert not [f for f in found.findings if f.says.startswith("the file")]  # nobody said that there is none
    assert "the file gives damping to 'shoulder', 'elbow'" in found.notes
    assert [hinge["damping"] for hinge in found.mechanism["links"]] == [0.05, 0.05]
    assert found.engines["mujoco"]["status"] == found.engines["exudyn-tree"]["status"] == "agrees"


@pytest.mark.parametrize(
    ("without", "says"),
    [
        ((), "a does what the file says"),
        (("mimic (joints that follow another one)",), "a does what the file says (left out: mimic)"),
        (
            ("contacts", "damping in pinocchio-aba, whose forward dynamics leaves it to the caller"),
            "a does what the file says (left out: contacts, damping in pinocchio-aba)",
        ),
        (
            ("contacts", "joint limits", "dry friction", "actuators", "tendons"),
            "a does what the file says (left out: contacts, joint limits, dry friction and 2 more)",
        ),
    ],
)
def test_the_headline_names_what_was_left_out(without, says):
    found = Diagnosis(
        model="m.xml", verdict="agrees", findings=(), engines={"a": {"status": "agrees"}}, without=without
    )
    assert found.headline == says


def test_a_joint_that_is_not_there_is_said_to_be_missing_and_nothing_is_said_twice(tmp_path):
    """What the cause means is printed where the finding's own sentence does not have it."""
    inertial = '<inertial pos="0 0 -1" mass="1" diaginertia="0.1 0.2 0.3"/>'
    body = '<body name="{0}"><joint name="{0}_j" axis="1 0 0"/>' + inertial + "</body>"
    (tmp_path / "two.xml").write_text(f"<mujoco><worldbody>{body.format('a')}{body.format('b')}</worldbody></mujoco>")
    (tmp_path / "one.xml").write_text(f"<mujoco><worldbody>{body.format('a')}</worldbody></mujoco>")
    text = diagnose(tmp_path / "two.xml", engines=["pinocchio-aba"]).text()
    assert text.count("reads only the first <body> of the world") == 1
    assert "of the world: joint 'b_j' (hinge) is missing (" in text
    free = body.format("a").replace('axis="1 0 0"', 'type="free"')
    (tmp_path / "one.xml").write_text(f"<mujoco><worldbody>{free.replace('a_j', 'c')}</worldbody></mujoco>")
    (tmp_path / "two.xml").write_text(f"<mujoco><worldbody>{free}</worldbody></mujoco>")
    text = diagnose(tmp_path / "two.xml", tmp_path / "one.xml", ["mujoco"]).text()
    assert "joint 'c' (free) is missing" in text
    assert "joint 'a_j' (free) is not in one.xml" in text
    assert "joint-added: there is a joint that is not expected" in text


# As a program wrote a leg whose hinges are vertical: a right angle of four digits leaves 4e-6 of gravity in the plane.
FLAT = """<robot name="leg"><link name="base"/><link name="thigh"><inertial><origin xyz="-0.13 0.034 0.009"/>
<mass value="0.28"/><inertia ixx="4.6e-5" ixy="3.6e-7" ixz="3.2e-5" iyy="6.6e-4" iyz="-2.2e-7" izz="6.2e-4"/></inertial>
</link><link name="shank"><inertial><origin xyz="-0.129971495409493 0.025 -0.00810863913628968"/><mass value="0.29"/>
<inertia ixx="6e-5" ixy="-2e-6" ixz="-8e-5" iyy="3.4e-4" iyz="-1e-6" izz="3e-4"/></inertial></link>
<joint name="HFE" type="continuous"><origin xyz="0.1435 0 0.071" rpy="{} 0 0"/><parent link="base"/>
<child link="thigh"/><axis xyz="0 1 0"/></joint><joint name="KFE" type="continuous"><origin xyz="-0.25 0.0097 0"/>
<parent link="thigh"/><child link="shank"/><axis xyz="0 1 0"/></joint></robot>"""


@pytest.mark.parametrize("angle", ["1.5708", "1.570796", "1.5707963", "1.57", "-1.5708"])
def test_gravity_that_is_nearly_along_the_hinges_is_known_no_better_than_its_rounding(angle):
    """What is left of it in the plane is a difference of large numbers; every engine has it in its own way."""
    file = model_from_text(FLAT.format(angle), "leg.urdf")
    axis = np.cross(file.mechanism.down, file.mechanism.across)
    assert abs(axis @ file.mechanism.down) < 2**-52
    assert file.mechanism.gravity[0] == pytest.approx(
        9.81 * abs(np.cos(float(angle))), rel=1e-15 / abs(np.cos(float(angle)))
    )
    found = diagnose(file)
    assert found.verdict == "agrees", found.text()
    assert any(note.startswith("gravity is nearly along the hinges' axes") for note in found.notes)
    light = model_from_text(FLAT.format(angle).replace('"0.29"', '"0.2900003"'), "light.urdf")
    assert causes(diagnose(light, file)) == ["mass"]


def found_links(text):
    return model_from_text(text).mechanism.links


def test_pinocchio_weighs_geoms_without_the_defaults():
    """A real difference: its reader passes over the default class's mass and takes water's density."""
    found = diagnose(model_from_text(ACROBOT, "arm.xml"))
    theirs = [f for f in found.findings if f.where.startswith("pinocchio")]
    assert theirs[0].cause == "default-geom-mass-dropped"
    assert len(theirs) == 1  # its damping is left to the caller, which is no difference
    assert "damping in pinocchio-aba, whose forward dynamics leaves it to the caller" in found.without


def test_two_point_masses_of_a_teaching_library_are_the_documents_mechanism():
    from furiko import NLegPendulum

    found = diagnose(model_from_text(bobs(), "bobs.urdf"), NLegPendulum((1.0, 2.0), (1.0, 0.5)))
    # Both refuse the file itself: a mesh is not there, a world not declared. The mechanism is what is wanted.
    assert causes(found) == ["file-refused", "file-refused"]
    assert {name: e["status"] for name, e in found.engines.items()} == {
        "mujoco": "refused",
        "pinocchio-aba": "refused",
        "exudyn-tree": "agrees",
    }


def test_a_cart_is_no_planar_tree_of_hinges_and_agrees_all_the_same():
    found = diagnose(model_from_text(CART, "cart.xml"))
    assert (found.verdict, found.to_json()["mechanism"]) == ("agrees", None)
    with pytest.raises(InvalidInput, match=r"'slide'.*not a planar tree"):
        diagnose(model_from_text(CART, "cart.xml"), "rods-2")


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in document_catalogue() if find_scene(name).system.n <= 20])
@pytest.mark.parametrize(("write", "ending"), [(to_mjcf, "xml"), (to_urdf, "urdf")])
def test_every_scenes_own_files_agree_with_it(tmp_path, name, write, ending):
    path = tmp_path / f"model.{ending}"
    path.write_text(write(find_scene(name).system))
    found = diagnose(path, name)
    assert (found.verdict, causes(found)) == ("agrees", [])
    assert found.exit_status == 0


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_what_looks_odd_and_is_sound_raises_no_alarm(seed):
    """Link frames, order, zero pose, plane, inertial frames, fused links, mass moved along with its hinge."""
    text, style, wanted = sound_model(np.random.default_rng(seed))
    found = diagnosed(text, style.language, wanted)
    assert set(causes(found)) <= OF_ENGINES, found.text()
    assert found.engines["exudyn-tree"]["status"] == "agrees"


@pytest.mark.slow
@pytest.mark.parametrize("cause", IN_FILES)
def test_a_fault_planted_in_a_file_is_named_first(cause):
    for seed in range(3):
        plant = planted_in_file(cause, np.random.default_rng(seed))
        found = diagnosed(plant.text, plant.language, plant.wanted)
        assert causes(found)[:1] == [cause], found.text()


def test_the_value_that_explains_it_is_given(tmp_path):
    system = find_scene("rods-3").system
    text = to_mjcf(system).replace('name="hinge2" ', 'name="hinge2" armature="0.01" ')
    (tmp_path / "a.xml").write_text(text)
    (finding,) = (f for f in diagnose(tmp_path / "a.xml", "rods-3").findings)
    assert (finding.cause, finding.where, finding.measured, finding.expected) == ("armature", "joint 2", 0.01, 0.0)
    assert "joint 2: armature: found 0.0100 kg m², expected none" in finding.says


@pytest.mark.parametrize("relative", [1e-9, 1e-10])
@pytest.mark.parametrize("field", ["mass", "diaginertia"])
def test_small_differences_of_a_file_are_found_and_sized(tmp_path, field, relative):
    import re

    text = to_mjcf(find_scene("rods-5").system)
    written = re.findall(rf'{field}="([^"]*)"', text)
    old = next(words for words in written if float(words.split()[0]))  # geoms weigh nothing
    numbers = [float(word) for word in old.split()]
    new = " ".join(repr(x * (1 + relative)) for x in numbers)
    (tmp_path / "a.xml").write_text(text.replace(f'{field}="{old}"', f'{field}="{new}"', 1))
    finding = diagnose(tmp_path / "a.xml", "rods-5").findings[0]
    assert finding.cause == field.removeprefix("diag")
    # One rounding of the written number is 2e-16.
    assert finding.measured / finding.expected - 1 == pytest.approx(relative, abs=1e-15)


def test_json_has_what_the_contract_says():
    found = diagnose(model_from_text(ACROBOT, "arm.xml"))
    assert isinstance(found, Diagnosis)
    again = json.loads(json.dumps(found.to_json()))
    assert again["verdict"] == "differs"
    assert {"cause", "where", "measured", "expected", "says"} == set(again["findings"][0])
    assert set(again["engines"]) == {"mujoco", "pinocchio-aba", "exudyn-tree"}
    assert again["engines"]["mujoco"]["compiled"]["links"][0]["mass"] == 1.0
    assert again["engines"]["mujoco"]["timestep"] == 0.01


def test_text_names_each_engine_and_finding():
    found = diagnose(model_from_text(ACROBOT, "arm.xml"))
    text = found.text()
    for word in ("arm.xml: differs", "mujoco", "pinocchio-aba", "exudyn-tree", "shoulder", "damping"):
        assert word in text


def test_another_file_can_be_what_is_wanted(tmp_path):
    system = find_scene("rods-2").system
    (tmp_path / "a.xml").write_text(to_mjcf(system))
    (tmp_path / "b.urdf").write_text(to_urdf(system))
    assert diagnose(tmp_path / "a.xml", tmp_path / "b.urdf").verdict == "agrees"


@pytest.mark.parametrize("against", ["no-such-scene", 7, "missing.toml"])
def test_bad_words_for_what_is_wanted(against):
    with pytest.raises(InvalidInput):
        diagnose(model_from_text(ACROBOT, "arm.xml"), against)


@pytest.mark.slow
@pytest.mark.parametrize("isolated", [False, True])
@pytest.mark.parametrize("names", [(), ("mujoco",), ("exudyn-tree", "mujoco")])
def test_only_the_given_engines_are_asked(names, isolated):
    file = model_from_text(to_mjcf(find_scene("rods-2").system), "rods.xml")
    found = diagnose(file, "rods-2", {name: READERS[name] for name in names}, isolated=isolated)
    assert tuple(found.engines) == names
    assert all(engine["status"] == "agrees" for engine in found.engines.values())
    assert found.exit_status == (0 if names else 3)


def test_gravity_is_taken_from_what_a_urdf_is_held_against(tmp_path):
    mechanism = free(random_tree(np.random.default_rng(1), n=3))
    weak = replace(mechanism, gravity=(1.62, 0.0), gravity_vector=(0, 0, -1.62))
    text = written(mechanism, Style("urdf"), np.random.default_rng(0))
    found = diagnosed(text, "urdf", weak)
    assert set(causes(found)) <= OF_ENGINES, found.text()
    assert found.engines["exudyn-tree"]["status"] == "agrees"
    assert math.isclose(model_from_text(text).mechanism.gravity[0], 9.81)


@pytest.mark.slow
def test_ten_links_against_three_engines_in_a_fresh_process(tmp_path):
    """Measured: 0.7 s; with a fault to explain 1 s. No time is asserted: a busy machine is not a fault."""
    text = to_mjcf(find_scene("rods-10").system)
    (tmp_path / "a.xml").write_text(text.replace('name="hinge04" ', 'name="hinge04" armature="0.01" '))
    code = f"import furiko; assert furiko.diagnose({str(tmp_path / 'a.xml')!r}, 'rods-10').findings"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_where_nothing_weighs_only_coupling_tells():
    """Turning the inner link's centre about its hinge changes no inertia and no coupling: nothing but its weight."""
    from furiko.diagnosis.model_files.matching import same_motion
    from furiko.models import Link, PlanarTree

    def mechanism(angle):
        com = (0.5 * math.cos(angle), 0.5 * math.sin(angle))
        return free(PlanarTree((Link(-1, (0, 0), 1, com, 1.0, 1.1), Link(0, (1, 0), 1, (0.4, 0), 2.0, 0.2)), 0.0))

    still = mechanism(0.0)
    assert same_motion(mechanism(0.0), still)
    from furiko.diagnosis.explain import explain
    from furiko.reference import planar_tree as planar

    class Other:
        p = planar.parameters(mechanism(1.0))

        def accelerations(self, theta, omega):
            return planar.forward_dynamics((-1, 0), self.p, theta, omega)

    assert explain(Other(), still) == []
    assert same_motion(mechanism(1.0), still)
    longer = mechanism(0.0)
    links = (longer.links[0], replace(longer.links[1], hinge=(1.1, 0)))
    # An inner inertia that makes up for the longer arm leaves the coupling alone to tell.
    links = (replace(links[0], inertia=links[0].inertia - 2.0 * (1.1**2 - 1)), links[1])
    assert not same_motion(replace(longer, links=links), still)


NO_RESET = '<option integrator="{}"><flag autoreset="disable"/></option>'


@pytest.mark.parametrize(
    ("option", "expected"),
    [
        (NO_RESET.format("RK4"), []),
        (NO_RESET.format("Euler"), ["implicit-damping"]),  # as MuJoCo's documentation of its integrators says
        ('<option integrator="Euler"/>', ["implicit-damping"]),  # its reset after far too long steps is no matter here
        ('<option integrator="Euler"><flag eulerdamp="disable" autoreset="disable"/></option>', []),
    ],
)
def test_the_time_steps_of_the_files_integrator_are_explained(option, expected):
    text = ACROBOT.replace('<option timestep="0.01" integrator="RK4"/>', option)
    against = model_from_text(ACROBOT, "arm.xml").mechanism
    found = diagnose(model_from_text(text, "arm.xml"), against, {"mujoco": READERS["mujoco"]})
    assert (found.verdict, found.findings) == ("agrees", ())  # the same equations of motion, in other steps
    assert [cause["cause"] for cause in found.engines["mujoco"]["motion"]] == expected
    assert [line for line in found.text().splitlines() if "in its time steps" in line] == [
        f"  in its time steps: {cause} at mujoco, {found.engines['mujoco']['integrator']}" for cause in expected
    ]


def test_a_limit_that_a_step_runs_into_is_no_fault_of_the_time_steps():
    """One degree either way: a step of the probe turns the hinge by up to three."""
    text = ACROBOT.replace('name="elbow" type="hinge"', 'name="elbow" type="hinge" limited="true" range="-1 1"')
    text = text.replace('integrator="RK4"/>', 'integrator="RK4"><flag autoreset="disable"/></option>')
    text = text.replace('<geom name="floor" size="3 3 .2" type="plane"/>', "")
    mujoco = diagnose(model_from_text(text, "arm.xml"), engines={"mujoco": READERS["mujoco"]}).engines["mujoco"]
    assert (mujoco["status"], mujoco["motion"]) == ("agrees", [])


# Degrees in a file whose angles are radians; a range that is a hundred turns away, on either side.
@pytest.mark.parametrize("limits", ["-130 -60", "60 130", "600 600.5", "-0.2 100", "-1e6 -5e5"])
def test_a_range_beyond_half_a_turn_is_looked_at_where_it_is(limits):
    text = ACROBOT.replace('name="elbow" type="hinge"', f'name="elbow" type="hinge" limited="true" range="{limits}"')
    text = text.replace("<default>", '<compiler angle="radian"/><default>', 1)
    found = diagnose(model_from_text(text, "arm.xml"), engines=["mujoco", "exudyn-tree"])
    assert {engine["status"] for engine in found.engines.values()} == {"agrees"}, found.text()


@pytest.mark.parametrize("sense", [1, -1])
def test_a_revolute_joint_without_ends_of_its_range_is_looked_at_all_round(sense):
    """URDF has zero for both, which the other sense makes −0."""
    link = '<link name="{}"><inertial><origin xyz="0.3 0 0"/><mass value="1"/><inertia {}/></inertial></link>'
    moments = " ".join(f'i{axes}="{0.01 * (axes[0] == axes[1])}"' for axes in ("xx", "yy", "zz", "xy", "xz", "yz"))
    joint = """<joint name="{0}" type="revolute"><parent link="{0}"/><child link="{1}"/><origin xyz="0.5 0 0"/>
        <axis xyz="0 {2} 0"/><limit effort="1" velocity="1"/></joint>"""
    links = "".join(link.format(name, moments) for name in "ab")
    joints = joint.format("world", "a", 1) + joint.format("a", "b", sense)
    file = model_from_text(f'<robot name="r"><link name="world"/>{links}{joints}</robot>', "arm.urdf")
    assert [hinge.limits for hinge in file.mechanism.hinges] == [(0, 0), (0, 0)]
    assert diagnose(file).verdict == "agrees"
    theta, _ = probe_states(file.mechanism)
    assert theta.std(axis=0).min() > 1


PAIR = """<mujoco><worldbody><body name="cart"><joint name="slider" type="slide" axis="1 0 0"/>
<geom size=".1" mass="{}" contype="0" conaffinity="0"/>
<body name="pole"><joint name="hinge" axis="0 1 0" range="-90 90"/>
<geom type="capsule" fromto="0 0 0 0 0 1" size=".05" mass="2" contype="0" conaffinity="0"/></body></body>
</worldbody></mujoco>"""


def test_what_it_should_be_is_called_by_its_own_name(tmp_path):
    """The file says 3 kg, the other one 1 kg: that "the file says 1 kg" would be false."""
    for name, mass in (("one.xml", 1), ("three.xml", 3)):
        (tmp_path / name).write_text(PAIR.format(mass))
    found = diagnose(tmp_path / "three.xml", tmp_path / "one.xml", ["mujoco"])
    assert "link 'cart': mass 3 kg, one.xml says 1 kg" in found.findings[0].says
    assert "(left out: joint limits)" in found.headline
    assert "without: joint limits" in found.brief().splitlines()[-1]


@pytest.mark.parametrize(
    ("statuses", "says"),
    [
        ({"a": "failed", "b": "failed"}, "a and b fail with the file"),
        ({"a": "failed"}, "a fails with the file"),
        ({"a": "refused", "b": "refused"}, "a and b refuse the file"),
        ({"a": "agrees", "b": "missing"}, "a does what the file says; b was not asked, for it cannot be imported"),
    ],
)
def test_the_headline_is_a_sentence(statuses, says):
    found = Diagnosis(
        model="m.xml", verdict="incomplete", findings=(), notes=(), against="", mechanism=None, spatial={},
        engines={name: {"status": status} for name, status in statuses.items()},
    )  # fmt: skip
    assert found.headline == says
