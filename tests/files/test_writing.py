"""Machines written to files and read back."""

import pytest
from base_machine import BASE
from hypothesis import given
from hypothesis import strategies as st

from example_files import RIGID
from nivel import Body, Expression, Joint, MachineRecord, Marker, PointForce, Table
from nivel.files import parse_machine, read_machine, write_machine
from nivel.machine.bodies.shape import Sphere, Tube
from nivel.machine.core.orientation import Orientation


def test_a_machine_comes_back_equal_and_its_text_too():
    machine = parse_machine(BASE)
    text = write_machine(machine)
    assert parse_machine(text) == machine
    assert write_machine(parse_machine(text)) == text


@pytest.mark.parametrize("example", RIGID, ids=lambda path: path.stem)
def test_examples_come_back(example):
    machine = read_machine(example, allow_code=True)
    assert machine.name == example.stem
    assert parse_machine(write_machine(machine), allow_code=True) == machine


def test_what_is_written_reads_like_a_machine_file():
    text = write_machine(parse_machine(BASE))
    assert "hinge: {type: revolute, bodies: [ground, crank], point: [0, 0, 0], axis: [1, 0, 0]}" in text
    assert "inertia: [0.022, 0.513, 0.526]" in text
    assert "velocity: [0, 0, 0]" not in text  # a default


finite = st.floats(-1e9, 1e9).map(lambda x: x + 0.0)
positive = st.floats(1e-9, 1e9)
vectors = st.tuples(finite, finite, finite)
names = st.from_regex(r"[a-zA-Zäö][a-zA-Z0-9_-]{0,8}", fullmatch=True) | st.sampled_from(
    ["no", "null", "true", "e3", "y", "NaN"]
)
orientations = st.one_of(
    st.builds(Orientation, euler=vectors, sequence=st.sampled_from(["zxz", "xyz", "123"])),
    st.builds(Orientation, axis=st.just((0, 1, 0)), angle=finite),
)
shapes = st.one_of(
    st.builds(Sphere, radius=positive, centre=st.none() | vectors),
    st.builds(
        Tube,
        outer_radius=st.floats(2, 3),
        inner_radius=st.floats(0.5, 1),
        from_=st.just((0, 0, 0)),
        to=st.just((1, 2, 3)),
    ),
)
components = st.one_of(
    finite,
    st.lists(st.integers(0, 10_000), min_size=1, max_size=4, unique=True).map(
        lambda times: Table(tuple(t / 7 for t in sorted(times)), tuple(float(t) for t in times))
    ),
    st.tuples(finite, finite).map(lambda ab: Expression(f"{ab[0]!r} + {ab[1]!r}*sin(2*pi*time)")),
)


@st.composite
def machines(draw):
    body_names = draw(st.lists(names.filter(lambda name: name != "ground"), min_size=2, max_size=4, unique=True))
    between = draw(st.booleans())
    bodies = [Body(name=body_names[0], density=draw(st.floats(1e-2, 1e5)), shape=draw(shapes))]
    bodies += [
        Body(
            name=name,
            mass=draw(positive),
            inertia=(1, 1, 1),
            position=draw(st.none() | vectors),
            orientation=draw(orientations),
        )
        for name in body_names[1:]
    ]
    first, second = (Marker(body=body_names[0], position=draw(vectors)), Marker(body=body_names[1]))
    joint = Joint(name=draw(names), type="fixed", markers=(first, second)) if between else None
    force = PointForce(
        name=draw(names), body=body_names[1], vector=(draw(components), draw(components), draw(components))
    )
    text = draw(st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Cs", "Cn", "Co"]), max_size=30))
    return MachineRecord(name="m", description=text, bodies=bodies, joints=[joint] if joint else [], forces=[force])


@given(machines())
def test_any_machine_comes_back(machine):
    assert parse_machine(write_machine(machine)) == machine
