"""The mechanisms: what they accept, what they refuse and in which words, and the tree that they reduce to."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from furiko.models import InvalidInput, NLegPendulum, RodChain, document_catalogue, find_scene
from furiko.models.projection import planar_mechanism
from furiko.models.tree import SUPPORT, Link, PlanarTree

BAD_NUMBERS = [0, 0.0, -1.0, math.nan, math.inf, -math.inf, 1e400, 10**400, True, "1", None, 1e-60, 1e60, 1j]


@pytest.mark.parametrize("bad", BAD_NUMBERS)
@pytest.mark.parametrize("place", [0, 1])
def test_a_bad_length_is_refused_by_name(bad, place):
    lengths = [1.0, 1.0]
    lengths[place] = bad
    with pytest.raises(InvalidInput, match=rf"^lengths\[{place}\]: "):
        RodChain(lengths)
    with pytest.raises(InvalidInput, match=rf"^lengths\[{place}\]: "):
        NLegPendulum(lengths, [1.0, 1.0])


@pytest.mark.parametrize("bad", BAD_NUMBERS)
def test_a_bad_mass_or_density_is_refused_by_name(bad):
    with pytest.raises(InvalidInput, match=r"^masses\[1\]: "):
        NLegPendulum([1.0, 1.0], [1.0, bad])
    with pytest.raises(InvalidInput, match=r"^density: "):
        RodChain([1.0], density=bad)


@pytest.mark.parametrize("bad", [-9.81, math.nan, math.inf, 1e400, True, "9.81", None, [9.81]])
def test_a_bad_gravity_is_refused(bad):
    with pytest.raises(InvalidInput, match=r"^gravity: "):
        RodChain([1.0], gravity=bad)


@pytest.mark.parametrize(("lengths", "masses"), [([1, 1], [1]), ([1, 1], [1, 1, 1]), ([1], [1]), ([], [])])
def test_a_wrong_count_is_refused(lengths, masses):
    with pytest.raises(InvalidInput):
        NLegPendulum(lengths, masses)


@pytest.mark.parametrize("bad", ["11", b"11", 5, None])
def test_lengths_must_be_a_list(bad):
    with pytest.raises(InvalidInput, match="list of numbers"):
        RodChain(bad)


def test_no_rods_is_refused():
    with pytest.raises(InvalidInput, match="at least one"):
        RodChain([])


def test_gravity_may_be_zero():
    assert RodChain([1.0], gravity=0).gravity == 0.0


positive = st.floats(1e-6, 1e6)


@given(st.lists(positive, min_size=2, max_size=6), st.data())
def test_an_n_leg_tree_is_a_star_of_point_masses(lengths, data):
    masses = data.draw(st.lists(positive, min_size=len(lengths), max_size=len(lengths)))
    tree = NLegPendulum(lengths, masses).tree()
    assert tree.parents == (SUPPORT,) + (0,) * (len(lengths) - 1)
    for i, link in enumerate(tree.links):
        assert link.hinge == ((lengths[0], 0.0) if i else (0.0, 0.0))  # Shiki (3.1): every leg hangs from bob 1
        assert (link.mass, link.inertia, link.com) == (masses[i], 0.0, (lengths[i], 0.0))


@given(st.lists(positive, min_size=1, max_size=6), positive)
def test_a_rod_chain_tree_has_takenos_masses_and_inertias(lengths, density):
    tree = RodChain(lengths, density).tree()
    assert tree.parents == tuple(range(-1, len(lengths) - 1))
    for i, (l, link) in enumerate(zip(lengths, tree.links, strict=True)):
        assert link.mass == density * l
        assert link.inertia == pytest.approx(density * l**3 / 12, rel=1e-15)  # Takeno (5); four roundings
        assert link.com == (l / 2, 0.0)
        assert link.hinge == ((lengths[i - 1] if i else 0.0), 0.0)


def test_a_parent_must_come_first():
    with pytest.raises(ValueError, match="link 0"):
        PlanarTree((Link(parent=0, hinge=(0, 0), length=1, com=(1, 0), mass=1),), 9.81)


def test_names_sort_as_the_links_stand():
    names = RodChain([1.0] * 11).tree().names("link")
    assert names[0] == "link01"
    assert list(names) == sorted(names)


def test_systems_are_frozen_and_hashable():
    system = RodChain([1, 2])
    with pytest.raises(AttributeError):
        system.density = 2.0
    assert hash(system) == hash(RodChain((1.0, 2.0)))


@pytest.mark.parametrize("name", document_catalogue())
def test_a_document_s_system_is_a_mechanism_in_space(name):
    """Which is projected to the same planar tree, to the last bit, on free hinges."""
    system = find_scene(name).system
    mechanism = system.mechanism()
    assert mechanism.nq == mechanism.nv == system.n
    found, tree = planar_mechanism(mechanism), system.tree()
    for got, asked in zip(found.links, tree.links, strict=True):
        assert (got.parent, got.hinge, got.com) == (asked.parent, asked.hinge, asked.com)
        assert (got.mass, got.inertia) == (asked.mass, asked.inertia)
    assert found.gravity == (tree.gravity, 0.0)
    assert found.link_names == tree.names("link")
    assert tuple(hinge.name for hinge in found.hinges) == tree.names("hinge")
    assert all(hinge.ideal and hinge.sense == 1.0 for hinge in found.hinges)
