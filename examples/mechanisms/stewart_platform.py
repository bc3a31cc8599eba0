"""A Stewart platform: a plate on six legs whose lengths are driven; which forces do they need?

python examples/mechanisms/stewart_platform.py

Each leg is a cylinder on a universal joint and a rod in it on a ball joint: the plate has six freedoms, and nothing is
redundant.
"""

import numpy as np

import nivel

BASE, TOP, HEIGHT = 1.0, 0.6, 1.2  # [m] radii of the joints' circles, height of the plate
SPREAD = np.radians([15.0, 20.0])  # half angle between the two joints of a pair, on the ground and on the plate
PLATE, CYLINDER, ROD = 50.0, 4.0, 3.0  # [kg]


def corners() -> tuple[np.ndarray, np.ndarray]:
    """(6, 3) joints on the ground and on the plate."""
    pairs = np.radians([0.0, 120.0, 240.0])
    low = np.array([[angle - SPREAD[0], angle + SPREAD[0]] for angle in pairs]).ravel()
    turned = pairs + np.radians(60.0)
    high = np.array([[angle - SPREAD[1], angle + SPREAD[1]] for angle in turned]).ravel()
    high = np.roll(high, 1)  # each pair on the plate belongs to legs of two pairs on the ground
    base = np.column_stack([BASE * np.cos(low), BASE * np.sin(low), np.zeros(6)])
    top = np.column_stack([TOP * np.cos(high), TOP * np.sin(high), np.full(6, HEIGHT)])
    return base, top


def machine(amplitude: float = 0.05, frequency: float = 1.0) -> nivel.Machine:
    """The platform; the lengths of its legs vary by `amplitude` [m], smoothly from rest, one after the other."""
    base, top = corners()
    bodies = [nivel.Body(name="plate", mass=PLATE, inertia=(4.0, 4.0, 8.0), position=(0, 0, HEIGHT))]
    joints, drivers = [], []
    for k, (a, b) in enumerate(zip(base, top, strict=True), 1):
        along = (b - a) / np.linalg.norm(b - a)
        across = np.cross(along, [0.0, 0.0, 1.0])
        across /= np.linalg.norm(across)
        rows = np.column_stack([along, across, np.cross(along, across)])
        turn = {"matrix": tuple(tuple(row) for row in rows.tolist())}
        for name, share, mass in (("cylinder", 0.25, CYLINDER), ("rod", 0.75, ROD)):
            place = tuple((a + share * (b - a)).tolist())
            body = nivel.Body(
                name=f"{name}_{k}", mass=mass, inertia=(0.01, 0.15, 0.15), position=place, orientation=turn
            )
            bodies.append(body)
        middle = tuple((0.5 * (a + b)).tolist())
        cross = np.cross(along, across)
        joints += [
            nivel.Joint(
                name=f"foot_{k}",
                type="universal",
                bodies=("ground", f"cylinder_{k}"),
                point=tuple(a.tolist()),
                axes=(tuple(across.tolist()), tuple(cross.tolist())),
            ),
            nivel.Joint(
                name=f"leg_{k}",
                type="translational",
                bodies=(f"cylinder_{k}", f"rod_{k}"),
                point=middle,
                axis=tuple(along.tolist()),
            ),
            nivel.Joint(name=f"ball_{k}", type="spherical", bodies=(f"rod_{k}", "plate"), point=tuple(b.tolist())),
        ]
        value = f"{amplitude}*(1 - exp(-4*time^2))*sin({2.0 * np.pi * frequency}*time + {k})"
        drivers.append(nivel.Driver(name=f"drive_{k}", coordinate=f"leg_{k}.displacement", value=value))
    return nivel.Machine("stewart-platform", bodies=bodies, joints=joints, drivers=drivers, gravity=(0, 0, -9.81))


if __name__ == "__main__":
    print(machine().inverse(positions=201))
