"""The model files: exact numbers, names in order, nothing that collides, and the committed ones up to date."""

from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from furiko.models import InvalidInput, NLegPendulum, RodChain, to_mjcf, to_urdf
from furiko.models.writers.catalogue_files import FOLDER, model_files

numbers = st.floats(1e-20, 1e20)
systems = st.one_of(
    st.builds(RodChain, st.lists(numbers, min_size=1, max_size=12), numbers, numbers),
    st.lists(st.tuples(numbers, numbers), min_size=2, max_size=12).map(
        lambda pairs: NLegPendulum([p[0] for p in pairs], [p[1] for p in pairs])
    ),
)


def vector(text):
    return [float(word) for word in text.split()]


@given(systems)
def test_mjcf_says_exactly_what_the_tree_says(system):
    root = ElementTree.fromstring(to_mjcf(system))
    tree = system.tree()
    assert vector(root.find("option").get("gravity")) == [0, 0, -system.gravity]
    bodies = list(root.iter("body"))
    assert [body.get("name") for body in bodies] == list(tree.names("link"))
    parent_of = {child: parent for parent in root.iter() for child in parent}
    for body, link in zip(bodies, tree.links, strict=True):
        expected = "worldbody" if link.parent < 0 else bodies[link.parent].get("name")
        parent = parent_of[body]
        assert (parent.get("name") or parent.tag) == expected
        along, across = link.hinge
        assert vector(body.get("pos")) == [across, 0, -along]
        assert body.find("joint").get("axis") == "0 -1 0"
        inertial = body.find("inertial")
        assert vector(inertial.get("pos")) == [0, 0, -link.com[0]]
        assert float(inertial.get("mass")) == link.mass
        assert vector(inertial.get("diaginertia")) == [link.inertia] * 3


@given(systems)
def test_urdf_says_exactly_what_the_tree_says(system):
    root = ElementTree.fromstring(to_urdf(system))
    tree = system.tree()
    links = root.findall("link")[1:]
    joints = root.findall("joint")
    assert [link.get("name") for link in links] == list(tree.names("link"))
    for element, joint, link in zip(links, joints, tree.links, strict=True):
        assert joint.find("child").get("link") == element.get("name")
        assert joint.find("parent").get("link") == ("world" if link.parent < 0 else links[link.parent].get("name"))
        assert vector(joint.find("origin").get("xyz")) == [link.hinge[1], 0, -link.hinge[0]]
        assert vector(joint.find("axis").get("xyz")) == [0, -1, 0]
        inertial = element.find("inertial")
        assert vector(inertial.find("origin").get("xyz")) == [0, 0, -link.com[0]]
        assert float(inertial.find("mass").get("value")) == link.mass
        assert float(inertial.find("inertia").get("iyy")) == link.inertia


@given(systems)
def test_no_geom_collides_or_weighs(system):
    for geom in ElementTree.fromstring(to_mjcf(system)).iter("geom"):
        assert (geom.get("contype"), geom.get("conaffinity"), geom.get("mass")) == ("0", "0", "0")
    assert not list(ElementTree.fromstring(to_urdf(system)).iter("collision"))


def test_a_chain_too_deep_for_mjcf_readers_is_refused_in_words():
    with pytest.raises(InvalidInput, match="nest"):
        to_mjcf(RodChain([1.0] * 500))
    assert to_mjcf(NLegPendulum([1.0] * 500, [1.0] * 500))  # many legs are wide, not deep


def test_the_committed_files_are_what_the_writers_write():
    committed = {path.name: path.read_text() for path in FOLDER.iterdir()}
    assert committed == model_files(), "run: python -m furiko.models.writers.catalogue_files"
