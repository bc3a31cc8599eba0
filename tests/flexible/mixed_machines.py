"""Machines in which flexible bodies, beams of consistent mass and bodies that slide along these hang on each other."""

import beams
import simulating

SECTION = beams.general(1e5, 1e5, 500.0, 500.0, 2.0, (0.01, 0.01, 0.01))


def flexible(folder, file, **more):
    """A flexible body of `tree_machines.write_beams` with three modes."""
    return {"flexible": {"file": str(folder / f"{file}.nc"), "modes": 3, "damping_ratio": 0.01}, **more}


def mixed(folder, kind="translational-on-beam", *, mass="consistent", root="arm", closed=False, **simulation):
    """A flexible body on a hinge carries a beam by its tip; a flexible body slides along this and carries a rigid one by its own tip.

    root : what the beam is welded to. closed : its end is held on a line, by a joint that closes a loop.
    """
    sections = {
        "name": "mixed",
        "gravity": [0.3, -9.81, 0.5],
        "bodies": {
            "arm": flexible(folder, "beam"),
            "runner": flexible(folder, "soft", position=[1.55, 0, 0]),
            "block": simulating.solid(0.7, 0.02, position=[2.55, 0, 0], centre_of_mass=[0.02, -0.01, 0.03]),
        },
        "beams": {"rod": {"from": [1, 0, 0], "to": [2, 0, 0], "section": SECTION, "elements": 3, "mass": mass}},
        "joints": {
            "root": {"type": "revolute", "bodies": ["ground", "arm"], "point": [0, 0, 0], "axis": [0, 0.6, 0.8]},
            "weld": {"type": "fixed", "bodies": [root, "rod.start"], "point": [1, 0, 0]},
            "pad": {"type": kind, "bodies": ["runner", "rod"], "point": [1.55, 0, 0]},
            "grip": {"type": "cylindrical", "bodies": ["runner", "block"], "point": [2.55, 0, 0], "axis": [1, 0, 0]},
        },
        "forces": {
            "push": {"type": "force", "body": "block", "vector": [3, -5, 2]},
            "rope": {
                "type": "spring-damper",
                "bodies": ["arm", "block"],
                "points": [[0.5, 0, 0], [2.55, 0, 0]],
                "stiffness": 300,
                "free_length": 1.7,
                "damping": 2,
            },
        },
        "markers": {"halfway": {"body": "arm", "interface": "middle"}},
        "sensors": {"felt": {"marker": "halfway", "quantity": "acceleration"}},
        "simulation": {"integrator": "generalised-alpha", "stabilisation": "direct", **simulation},
    }
    if closed:
        line = {"type": "point-on-line", "bodies": ["ground", "rod.end"], "point": [2, 0, 0], "axis": [1, 0, 0]}
        sections["joints"]["line"] = line
    return sections


def sprung(sections):
    """The same with a spring on every joint coordinate, so that it can rest."""
    springs = {"root.angle": 500, "pad.displacement": 5e3, "grip.angle": 50, "grip.displacement": 5e3}
    own = {
        f"coil{k}": {
            "type": "joint-spring-damper",
            "coordinate": coordinate,
            "stiffness": stiffness,
            "damping": 0,
            "free_value": 0.5 if coordinate == "pad.displacement" else 0.0,
        }
        for k, (coordinate, stiffness) in enumerate(springs.items())
    }
    return {**sections, "forces": {**sections["forces"], **own}}
