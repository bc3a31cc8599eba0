"""A machine in motion whose states depend on bodies and on each other, and its forces on them."""

from simulating import hinge, machine, slide, solid

BRISTLES = {"type": "friction", "coordinate": "turn.angle", "model": "lugre", "coefficient": 0.2, "radius": 0.02}


def machine_with_states(*, bristles):
    """Two arms on a hinge and a slide, a free body; a chain of states through all of them, one sampled; and friction with bristles."""
    own = {"grip": {**BRISTLES, "bristle_stiffness": 500, "bristle_damping": 0.5}} if bristles else {}
    leak = "sin(pressure.value) - leak.value*abs(leak.value)" + (" + grip.bristle*100" if bristles else "")
    push = "3*pressure.value^2 + held.value*shift.displacement"
    return machine(
        {
            "gravity": [0, 0, -9.81],
            "bodies": {
                "a": solid(1.3, (0.05, 0.08, 0.06), position=[0.2, 0.1, 0.5]),
                "b": solid(0.9, (0.03, 0.04, 0.02), position=[0.6, 0.2, 0.7]),
                "c": solid(0.7, (0.02, 0.02, 0.03), position=[-0.5, 0.9, 0.4]),
            },
            "joints": {"turn": hinge("ground", "a"), "shift": slide("a", "b", (1, 0, 0), point=[0.6, 0.2, 0.7])},
            "states": {
                "pressure": {"start": 2.0, "rate": "-pressure.value*shift.displacement_rate + leak.value - c.vx"},
                "leak": {"start": 0.3, "rate": leak},
                "held": {"start": 0.7, "update": "turn.angle + leak.value", "every": 0.01},
            },
            "forces": {
                "push": {"type": "motor", "coordinate": "shift.displacement", "effort": push},
                "wind": {"type": "force", "body": "c", "vector": ["leak.value*c.vy", "pressure.value", "held.value"]},
                **own,
            },
        }
    )
