"""A beam as rigid segments on springs: the third way to bend, beside modes and geometrically exact beams.

The beam is cut into `count` rigid bars of equal length l. Between two of them, and between the first and the ground, stands a bushing
with the stiffness of the piece of beam between their middles: E A/l along it, G A/l across it, G J/l and E I/l about it; the first
piece is half as long. Turns may be large. Frequencies are right to the order of l², so it takes many more segments than modes; what it
is good for is a beam between rigid bodies where forces act everywhere along it. Here it is made by hand, to be changed: a beam of a machine
file with `model: segments` is such a row of bars without any program.
"""

from nivel import Body, Bushing, MachineRecord, Marker, Sensor, SimulationSettings

SPAN, WIDTH, HEIGHT = 2.0, 0.02, 0.03  # [m] along x, y, z
YOUNGS_MODULUS, SHEAR_MODULUS, DENSITY = 210e9, 80.8e9, 7850.0  # [Pa, Pa, kg/m³]


def segments(count: int) -> tuple[tuple[Body, ...], tuple[Bushing, ...]]:
    """The rigid bars of a cantilever along x, and the bushings that hold them."""
    length = SPAN / count
    area = WIDTH * HEIGHT
    iy, iz = WIDTH * HEIGHT**3 / 12, HEIGHT * WIDTH**3 / 12
    torsion = 0.196 * HEIGHT * WIDTH**3  # of a rectangle of 3 by 2 (Timoshenko and Goodier, art. 109)
    mass = DENSITY * area * length
    inertia = (DENSITY * (iy + iz) * length, *(mass * length**2 / 12 + DENSITY * i * length for i in (iy, iz)))
    bodies = tuple(
        Body(name=f"segment_{k + 1}", mass=mass, inertia=inertia, position=((k + 0.5) * length, 0.0, 0.0))
        for k in range(count)
    )
    forces = []
    for k, before in enumerate(("ground", *(body.name for body in bodies[:-1]))):
        piece = 0.5 * length if k == 0 else length
        moving = [E * area / piece for E in (YOUNGS_MODULUS, SHEAR_MODULUS, SHEAR_MODULUS)]
        turning = [SHEAR_MODULUS * torsion / piece, YOUNGS_MODULUS * iy / piece, YOUNGS_MODULUS * iz / piece]
        place = (k * length, 0.0, 0.0)
        forces.append(
            Bushing(
                name=f"piece_{k + 1}",
                bodies=(before, bodies[k].name),
                points=(place, place),
                stiffness=(*moving, *turning),
            )
        )
    return bodies, tuple(forces)


def cantilever(count: int) -> MachineRecord:
    """A cantilever of so many segments that swings under a little weight."""
    bodies, forces = segments(count)
    tip = Marker(name="tip", body=bodies[-1].name, position=(0.5 * SPAN / count, 0.0, 0.0))
    return MachineRecord(
        name="segments",
        gravity=(0.0, 0.0, -0.1),
        bodies=bodies,
        forces=forces,
        markers=(tip,),
        sensors=(Sensor(name="tip", marker="tip", quantity="position"),),
        simulation=SimulationSettings(
            integrator="generalised-alpha",
            coordinates="absolute",
            duration=1.0,
            step=5e-4,
            output_interval=5e-3,
        ),
    )


if __name__ == "__main__":
    from nivel import Machine

    print(
        Machine.from_record(cantilever(8)).simulate(
            verify=False,
        )
    )
