"""Mass matrices and bias forces of random trees, nivel against Pinocchio (PyPI `pin`), which may be in an environment of its own:

python benchmarks/against_pinocchio.py write states.json     where nivel is installed
python benchmarks/against_pinocchio.py check states.json     where pin is installed
python benchmarks/against_pinocchio.py time                  where both are: CPU time a state of a chain of seven, in one process
"""

import json
import sys
import time

import numpy as np

TREES, STATES, BODIES, GRAVITY = 20, 10, 7, (0.3, -0.2, -9.81)
ROWS, REPEATS = 512, 9


def tree(rng):
    """Parents, kinds, points, axes, masses, inertias and centres of a random tree, drawn with all frames parallel."""
    count = int(rng.integers(2, BODIES + 1))
    axis = rng.normal(size=(count, 3))
    return {
        "parent": [int(rng.integers(-1, k)) if k else -1 for k in range(count)],
        "kind": [["revolute", "translational"][int(rng.random() < 0.3)] for _ in range(count)],
        "point": rng.normal(size=(count, 3)).tolist(),
        "axis": (axis / np.linalg.norm(axis, axis=1, keepdims=True)).tolist(),
        "mass": rng.uniform(0.5, 5.0, count).tolist(),
        "inertia": (rng.uniform(1.0, 1.5, (count, 3))).tolist(),
        "centre": rng.normal(size=(count, 3)).tolist(),
    }


def write(path):
    """Random states of random trees, with M and the bias of nivel."""
    rng, out = np.random.default_rng(7), []
    for _ in range(TREES):
        data = tree(rng)
        mechanics = _mechanics(data)
        states = []
        for _ in range(STATES):
            q, v = rng.normal(size=(2, len(data["parent"])))
            # a revolute is zero where its x axes coincide, which is where it is drawn
            M, h = mechanics.mass_matrix(mechanics.start + q), mechanics.bias(mechanics.start + q, v)
            states.append({"q": q.tolist(), "v": v.tolist(), "M": M.tolist(), "bias": h.tolist()})
        out.append({"tree": data, "names": mechanics.names, "states": states})
    with open(path, "w", encoding="utf-8") as file:
        json.dump(out, file)


def _mechanics(data):
    """The tree in nivel."""
    import nivel

    names = [f"b{k}" for k in range(len(data["parent"]))]
    bodies = [
        nivel.Body(name=n, mass=m, inertia=tuple(i), position=tuple(c))
        for n, m, i, c in zip(names, data["mass"], data["inertia"], data["centre"], strict=True)
    ]
    joints = [
        nivel.Joint(
            name=f"j{k}",
            type=data["kind"][k],
            bodies=("ground" if parent < 0 else names[parent], names[k]),
            point=tuple(data["point"][k]),
            axis=tuple(data["axis"][k]),
        )
        for k, parent in enumerate(data["parent"])
    ]
    machine = nivel.Machine("tree", bodies=bodies, joints=joints, gravity=GRAVITY)
    return machine.mechanics(coordinates="relative")


def compare_times():
    """Least CPU time a state of both, in turn; Pinocchio is called once a state, as its interface of Python has it."""
    import pinocchio as pin

    rng = np.random.default_rng(7)
    data = next(each for each in iter(lambda: tree(rng), None) if len(each["parent"]) == BODIES)
    data |= {"parent": [*range(-1, BODIES - 1)], "kind": ["revolute"] * BODIES}
    mechanics, (model, _) = _mechanics(data), _model(pin, data)
    there, last = model.createData(), model.njoints - 1
    q, v, x = rng.normal(size=(3, ROWS, BODIES))
    Q = mechanics.start + q

    def jacobian(each):
        pin.computeJointJacobians(model, there, each)
        pin.getJointJacobian(model, there, last, pin.LOCAL_WORLD_ALIGNED)

    asked = {
        "mass_matrix": (lambda: mechanics.mass_matrix(Q), lambda: [pin.crba(model, there, each) for each in q]),
        "bias": (
            lambda: mechanics.bias(Q, v),
            lambda: [pin.nonLinearEffects(model, there, *each) for each in zip(q, v, strict=True)],
        ),
        "inverse_dynamics": (
            lambda: mechanics.inverse_dynamics(Q, v, x),
            lambda: [pin.rnea(model, there, *each) for each in zip(q, v, x, strict=True)],
        ),
        "forward_dynamics": (
            lambda: mechanics.forward_dynamics(Q, v, x),
            lambda: [pin.aba(model, there, *each) for each in zip(q, v, x, strict=True)],
        ),
        "derivatives": (
            lambda: mechanics.inverse_dynamics_derivatives(Q, v, x),
            lambda: [pin.computeRNEADerivatives(model, there, *each) for each in zip(q, v, x, strict=True)],
        ),
        "jacobian": (lambda: mechanics.jacobian(f"b{BODIES - 1}", Q), lambda: [jacobian(each) for each in q]),
    }
    for name, calls in asked.items():
        least = [np.inf, np.inf]
        for _ in range(REPEATS):
            for k, call in enumerate(calls):
                start = time.process_time()
                call()
                least[k] = min(least[k], (time.process_time() - start) / ROWS)
        ours, theirs = 1e6 * np.array(least)
        print(f"{name:17} {ours:6.2f} us, Pinocchio {theirs:6.2f} us, ratio {ours / theirs:.2f}")


def check(path):
    """The largest relative differences from Pinocchio's rnea and nonLinearEffects."""
    import pinocchio as pin

    with open(path, encoding="utf-8") as file:
        cases = json.load(file)
    worst = np.zeros(2)
    for case in cases:
        model, order = _model(pin, case["tree"])
        data = model.createData()
        place = [order[int(name.split(".")[0][1:])] for name in case["names"]]
        for state in case["states"]:
            q, v = np.zeros(model.nq), np.zeros(model.nv)
            q[place], v[place] = state["q"], state["v"]
            # crba fills the rows of joints that were added depth first only, so columns of rnea make M
            still = np.zeros(model.nv)
            weight = pin.rnea(model, data, q, still, still)
            M = np.array([pin.rnea(model, data, q, still, unit) - weight for unit in np.eye(model.nv)])
            h = pin.nonLinearEffects(model, data, q, v)
            for k, (ours, theirs) in enumerate(((state["M"], M[np.ix_(place, place)]), (state["bias"], h[place]))):
                worst[k] = max(worst[k], np.abs(np.array(ours) - theirs).max() / np.abs(theirs).max())
    print(
        f"{sum(len(case['states']) for case in cases)} states of {len(cases)} trees: M {worst[0]:.1e}, bias {worst[1]:.1e}"
    )


def _model(pin, data):
    """The tree in Pinocchio, and the velocity of each joint."""
    model, joints = pin.Model(), []
    model.gravity = pin.Motion(np.array(GRAVITY), np.zeros(3))
    for k, parent in enumerate(data["parent"]):
        kind = pin.JointModelRevoluteUnaligned if data["kind"][k] == "revolute" else pin.JointModelPrismaticUnaligned
        point = np.array(data["point"][k])
        before = np.zeros(3) if parent < 0 else np.array(data["point"][parent])
        placement = pin.SE3(np.eye(3), point - before)
        joint = model.addJoint(0 if parent < 0 else joints[parent], kind(np.array(data["axis"][k])), placement, f"j{k}")
        inertia = pin.Inertia(data["mass"][k], np.array(data["centre"][k]) - point, np.diag(data["inertia"][k]))
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
        joints.append(joint)
    return model, [model.idx_vs[joint] for joint in joints]


if __name__ == "__main__":
    {"write": write, "check": check, "time": compare_times}[sys.argv[1]](*sys.argv[2:])
