"""The spanning tree: what carries, what is cut, and that no tree leaves fewer constraint rows."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components, minimum_spanning_tree

from nivel import MachineRecord
from nivel.elements.joints import JOINTS
from nivel.system.elimination.topology import FREE, Edge, carries, spanning_tree
from nivel.system.states.relative import tree_of

# what carries nothing whatever the tree: links, couplings of two freedoms, points on lines
NEVER = ("distance", "point-on-line", "revolute-cylindrical")
CARRIERS = {type_: len(kind.composition.rows) for type_, kind in JOINTS.items() if carries(type_)}
TYPES = (*CARRIERS, *NEVER)


@st.composite
def graphs(draw, bodies=9, joints=14):
    """(bodies, edges, names of joints that stay constraints): any multigraph, the ground last; joints of a body with itself too."""
    count = draw(st.integers(1, bodies))
    ends = st.integers(0, count)
    drawn = draw(st.lists(st.tuples(st.sampled_from(TYPES), ends, ends), max_size=joints))
    edges = [Edge(f"j{k}", *each) for k, each in enumerate(drawn)]
    kept = draw(st.sets(st.sampled_from([edge.name for edge in edges]), max_size=4)) if edges else set()
    return count, edges, kept


def carrying(edges, kept=()):
    return [k for k, edge in enumerate(edges) if edge.type in CARRIERS and edge.name not in kept]


def rows_carried(edges, tree):
    return sum(CARRIERS[edges[branch.joint].type] for branch in tree.branches if branch.joint != FREE)


@given(graphs())
def test_every_body_hangs_once_on_a_parent_before_it(graph):
    bodies, edges, kept = graph
    tree = spanning_tree(bodies, edges, kept)
    assert sorted(branch.child for branch in tree.branches) == list(range(bodies))
    reached = {bodies}
    for branch in tree.branches:
        assert branch.parent in reached
        reached.add(branch.child)


@given(graphs())
def test_branches_are_joints_between_their_bodies_the_way_they_are_turned(graph):
    bodies, edges, kept = graph
    for branch in spanning_tree(bodies, edges, kept).branches:
        if branch.joint == FREE:
            assert branch.parent == bodies
            assert not branch.turned
        else:
            edge = edges[branch.joint]
            assert (edge.first, edge.second)[:: -1 if branch.turned else 1] == (branch.parent, branch.child)


@given(graphs())
def test_every_joint_carries_one_body_or_is_cut(graph):
    bodies, edges, kept = graph
    tree = spanning_tree(bodies, edges, kept)
    carriers = [branch.joint for branch in tree.branches if branch.joint != FREE]
    assert sorted([*carriers, *tree.cut]) == list(range(len(edges)))
    assert set(carriers) <= set(carrying(edges, kept))


@given(graphs())
def test_as_many_roots_as_there_are_parts_without_the_ground(graph):
    bodies, edges, kept = graph
    chosen = carrying(edges, kept)
    ends = np.array([(edges[k].first, edges[k].second) for k in chosen], dtype=int).reshape(-1, 2)
    matrix = csr_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(bodies + 1, bodies + 1))
    parts, _ = connected_components(matrix, directed=False)
    tree = spanning_tree(bodies, edges, kept)
    assert sum(branch.joint == FREE for branch in tree.branches) == parts - 1


@given(graphs())
def test_rows_carried_are_those_of_a_maximum_spanning_tree(graph):
    """Against scipy (Kruskal): a minimum spanning tree of the negative rows; of parallel joints the one with the most rows."""
    bodies, edges, kept = graph
    heaviest = np.zeros((bodies + 1, bodies + 1))
    for k in carrying(edges, kept):
        a, b = sorted((edges[k].first, edges[k].second))
        if a != b:
            heaviest[a, b] = max(heaviest[a, b], CARRIERS[edges[k].type])
    expected = -minimum_spanning_tree(csr_array(-heaviest)).sum()
    assert rows_carried(edges, spanning_tree(bodies, edges, kept)) == expected


@given(graphs(bodies=4, joints=6))
def test_no_choice_of_joints_carries_more_rows(graph):
    """Every set of joints without a loop, tried one after another."""
    bodies, edges, kept = graph
    best = 0
    chosen = carrying(edges, kept)
    for size in range(min(bodies, len(chosen)) + 1):
        for some in combinations(chosen, size):
            part = list(range(bodies + 1))
            for k in some:
                a, b = part[edges[k].first], part[edges[k].second]
                if a == b:
                    break
                part = [a if p == b else p for p in part]
            else:
                best = max(best, sum(CARRIERS[edges[k].type] for k in some))
    assert rows_carried(edges, spanning_tree(bodies, edges, kept)) == best


def test_of_two_joints_between_the_same_bodies_the_one_with_more_rows_carries():
    edges = [Edge("ball", "spherical", 0, 1), Edge("hinge", "revolute", 1, 0)]
    tree = spanning_tree(1, edges)
    assert [(branch.joint, branch.turned) for branch in tree.branches] == [(1, False)]
    assert tree.cut == (0,)


@pytest.mark.parametrize("type_", CARRIERS)
def test_a_joint_of_a_body_with_itself_or_of_the_ground_with_itself_carries_nothing(type_):
    tree = spanning_tree(2, [Edge("self", type_, 0, 0), Edge("base", type_, 2, 2)])
    assert [branch.joint for branch in tree.branches] == [FREE, FREE]
    assert tree.cut == (0, 1)


def test_named_joints_are_cut():
    """A chain with its first joint cut is free in space; naming a joint that carries nothing anyway changes nothing."""
    edges = [Edge("hinge", "revolute", 2, 0), Edge("knee", "revolute", 0, 1), Edge("rod", "distance", 2, 1)]
    tree = spanning_tree(2, edges, {"hinge"})
    assert [(branch.child, branch.joint) for branch in tree.branches] == [(0, FREE), (1, 1)]
    assert tree.cut == (0, 2)
    assert spanning_tree(2, edges, {"rod", "nobody"}) == spanning_tree(2, edges)


def test_what_hangs_on_nothing_gets_its_root_at_the_heaviest_body():
    edges = [Edge("a", "revolute", 0, 1), Edge("b", "revolute", 1, 2), Edge("c", "spherical", 3, 4)]
    tree = spanning_tree(5, edges, weight=[1.0, 2.0, 7.0, 1.0, 3.0])
    assert [branch.child for branch in tree.branches if branch.joint == FREE] == [2, 4]


def test_a_closed_chain_on_the_ground_is_cut_in_its_middle():
    """Of equal joints the one nearest to the ground carries: both halves of a ring of n bodies have n/2 of them."""
    n = 10
    edges = [Edge("j0", "revolute", n, 0), *(Edge(f"j{k}", "revolute", k - 1, k) for k in range(1, n))]
    tree = spanning_tree(n, [*edges, Edge("last", "revolute", n - 1, n)])
    depth = {n: 0}
    for branch in tree.branches:
        depth[branch.child] = depth[branch.parent] + 1
    assert max(depth.values()) == n // 2


def test_a_body_weighs_what_its_shape_and_density_say():
    cube = {"type": "box", "size": [1, 1, 1]}
    pair = MachineRecord(
        name="pair",
        bodies=({"name": "light", "mass": 2.0, "shape": cube}, {"name": "heavy", "density": 3.0, "shape": cube}),
        joints=(
            {"name": "hinge", "type": "revolute", "bodies": ("light", "heavy"), "point": (0, 0, 0), "axis": (0, 0, 1)},
        ),
    )
    root, _ = tree_of(pair, pair.simulation).branches
    assert (root.child, root.joint) == (1, FREE)
