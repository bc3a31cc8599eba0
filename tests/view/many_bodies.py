"""Synthetic scenes: 50 boxes that circle, and a plate of 1000 vertices that vibrates in its modes, coloured by its deflection; a chain of
300 links that waves."""

import numpy as np

from nivel.view.package import Block, layout
from nivel.view.records import Body, Flexible, Joint, Part, Stage, Sweep, Viewpoint

LINKS = 300
BODIES, ALONG, ACROSS, MODES = 50, 40, 25, 12


def stage(block: Block) -> Stage:
    """The stage; the plate is carried by body 0."""
    x, y = np.meshgrid(np.linspace(-1, 1, ALONG), np.linspace(-0.6, 0.6, ACROSS), indexing="ij")
    vertices = np.stack([x, y, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    k = np.arange(ALONG * ACROSS).reshape(ALONG, ACROSS)
    a, b, c, d = k[:-1, :-1].ravel(), k[1:, :-1].ravel(), k[1:, 1:].ravel(), k[:-1, 1:].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    orders = [(m, n) for m in range(1, 5) for n in range(1, 4)]
    shapes = np.stack([np.sin(m * np.pi * (x + 1) / 2) * np.sin(n * np.pi * (y + 0.6) / 1.2) for m, n in orders])
    modes = np.zeros((MODES, len(vertices), 3))
    modes[:, :, 2] = shapes.reshape(MODES, -1)
    plate = Flexible(
        body=0,
        name="plate",
        vertices=block.add(vertices),
        triangles=block.add(triangles, "u4"),
        modes=block.add(modes),
        first=0,
        low=-0.2,
        high=0.2,
        unit="m",
        quantity="deflection",
        field=block.add(shapes.reshape(MODES, -1)),
    )
    colours = ("#5b86b4", "#cf7f4f", "#6fa17a", "#9274b0")
    box = Part("box", (0, 0, 0), [0.12, 0.08, 0.05])
    bodies = [Body("carrier", colours[0], (0, 0, 0))]
    bodies += [Body(f"box_{n}", colours[n % 4], (0, 0, 0), [box]) for n in range(1, BODIES)]
    view = Viewpoint((1, 0, 0), (0, 0.5, 0.866), (0, -0.866, 0.5), False)
    return Stage(
        name="many",
        title="many",
        up=(0, 0, 1),
        viewpoint=view,
        origin=(0, 0, 0),
        low=(-1.5, -1.5, -0.3),
        high=(1.5, 1.5, 0.8),
        size=3.0,
        layout=layout(BODIES, MODES),
        bodies=bodies,
        joints=[],
        forces=[],
        markers=[],
        arrows=[],
        flexible=[plate],
    )


def moment(t: float):
    """Position (B, 3), orientation (B, 4) and modal coordinates (M,) at the time t."""
    n = np.arange(BODIES)
    angle = 2 * np.pi * n / BODIES + t
    position = np.stack([1.3 * np.cos(angle), 1.3 * np.sin(angle), 0.3 + 0.2 * np.sin(3 * angle)], axis=1)
    position[0] = 0.0
    orientation = np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], axis=1)
    orientation[0] = 1.0, 0.0, 0.0, 0.0
    return position, orientation, 0.15 * np.sin((2 + np.arange(MODES)) * t) / (1 + np.arange(MODES))


def chain(block: Block) -> Stage:
    """A chain of links 1 m long between revolute joints, the first of them on the ground."""
    ends = [(-0.5, 0.0, 0.0), (0.5, 0.0, 0.0)]
    bodies = [Body(f"link_{k}", "#5b86b4", (0, 0, 0), links=ends, held=ends) for k in range(LINKS)]
    across = ((0.0, 1.0, 0.0), (0.0, 1.0, 0.0))
    joints = [
        Joint(f"pin_{k}", "revolute", (k - 1, k), (ends[1] if k else (0.0, 0.0, 0.0), ends[0]), across)
        for k in range(LINKS)
    ]
    return Stage(
        name="chain",
        title="chain",
        up=(0, 0, 1),
        viewpoint=Viewpoint((1, 0, 0), (0, 0, 1), (0, -1, 0), True),
        origin=(0, 0, 0),
        low=(0, -1, -60),
        high=(LINKS, 1, 60),
        size=float(LINKS),
        layout=layout(LINKS),
        bodies=bodies,
        joints=joints,
        forces=[],
        markers=[],
        arrows=[],
    )


def wave(t: float):
    """Position (B, 3) and orientation (B, 4) of the chain at the time t."""
    slope = 0.9 * np.sin(2 * np.pi * np.arange(LINKS) / 60 - t)
    steps = np.stack([np.cos(slope), 0 * slope, -np.sin(slope)], axis=1)  # turned about y
    position = np.cumsum(steps, axis=0) - 0.5 * steps
    orientation = np.stack([np.cos(slope / 2), 0 * slope, np.sin(slope / 2), 0 * slope], axis=1)
    return position, orientation


ARC, NODES, RADIUS = 0.5 * np.pi, 5, 2.0


def beam(*, smooth: bool = True) -> Stage:
    """A hollow beam through the frames of five bodies on a quarter of a circle in the xz plane, and a ball beside it."""
    section = [(-0.1, -0.05), (0.1, -0.05), (0.1, 0.05), (-0.1, 0.05)]
    hollow = [(-0.06, -0.03), (0.06, -0.03), (0.06, 0.03), (-0.06, 0.03)]
    nodes = list(range(NODES))
    bodies = [Body(f"boom.{k + 1}", "#cf7f4f", (0, 0, 0), automatic=False) for k in nodes]
    along, across = [(1.0, 0.0, 0.0)] * NODES, [(0.0, 1.0, 0.0)] * NODES
    sweep = Sweep("boom", "#cf7f4f", nodes, [(0.0, 0.0, 0.0)] * NODES, along, across, section, hollow, smooth)
    return Stage(
        name="boom",
        title="boom",
        up=(0, 0, 1),
        viewpoint=Viewpoint((1, 0, 0), (0, 0.4, 0.917), (0, -0.917, 0.4), False),
        origin=(0, 0, 0),
        low=(0, -0.1, 0),
        high=(RADIUS, 0.1, RADIUS),
        size=2.0 * RADIUS,
        layout=layout(NODES + 1),
        bodies=[*bodies, Body("ball", "#5b86b4", (0, 0, 0))],
        joints=[],
        forces=[],
        markers=[],
        arrows=[],
        sweeps=[sweep],
    )


def arc():
    """Position (B, 3) and orientation (B, 4) of the beam's bodies: from the origin along x, bent upwards about (0, 0, RADIUS)."""
    angle = np.append(ARC * np.arange(NODES) / (NODES - 1), 0.0)
    position = RADIUS * np.stack([np.sin(angle), 0 * angle, 1 - np.cos(angle)], axis=1)
    position[-1] = 1.8, 0.0, 0.0
    return position, np.stack([np.cos(angle / 2), 0 * angle, -np.sin(angle / 2), 0 * angle], axis=1)
