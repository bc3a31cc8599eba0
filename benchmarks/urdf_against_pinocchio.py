"""Mass matrix and inverse dynamics of imported URDF files against Pinocchio, in random states.

    pip install pin example-robot-data
    python benchmarks/urdf_against_pinocchio.py [--free] [FILE …]

With `--free` the first link is free. The two choose the body whose motion is that of the base in another way, so the equations are compared
after the velocities of one have been written by those of the other. Without files all of example-robot-data are read. Both get the
equations of motion without friction and limits. Errors are relative to the largest entry of the matrix, and to the largest effort.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path

import numpy as np

import nivel

STATES = 20
AGREE = 1e-12


def robots() -> list[Path]:
    """All URDF files of example-robot-data."""
    folders = (Path(each) / "cmeel.prefix/share/example-robot-data/robots" for each in sys.path)
    return sorted(file for folder in folders for file in folder.rglob("*.urdf"))


def compared(file: Path) -> tuple[int, float, float]:
    """Degrees of freedom, and the largest errors of mass matrix and inverse dynamics."""
    import pinocchio as pin

    machine = nivel.import_model(file)
    mimics = {each.coordinates[0].split(".")[0]: each for each in machine.record.couplings}
    mechanics = machine.replace(forces=(), couplings=(), simulation=machine.record.simulation).mechanics()
    model = pin.buildModelFromUrdf(str(file))
    model.gravity.linear = np.array([0.0, 0.0, -9.81])
    data = model.createData()
    by_name = {clean(name): model.joints[model.getJointId(name)] for name in model.names[1:]}
    joints = [by_name[name.rpartition(".")[0]] for name in mechanics.names]
    places = [by_name[name.rpartition(".")[0]] for name in mechanics.position_names]
    v = [each.idx_v for each in joints]
    random, worst = np.random.default_rng(1), np.zeros(2)
    for _ in range(STATES):
        x, speed, acceleration = random.uniform(-1.0, 1.0, (3, model.nv))
        q = pin.integrate(model, pin.neutral(model), x)
        M = pin.crba(model, data, q)
        M = np.triu(M) + np.triu(M, 1).T
        tau = pin.rnea(model, data, q, speed, acceleration)
        ours = np.array([x[each.idx_v] for each in places])
        error = np.abs(mechanics.mass_matrix(ours) - M[np.ix_(v, v)]).max() / np.abs(M).max()
        efforts = mechanics.inverse_dynamics(ours, speed[v], acceleration[v])
        worst = np.maximum(worst, [error, np.abs(efforts - tau[v]).max() / np.abs(tau).max()])
    assert len(v) == model.nv, (len(v), model.nv, list(mimics))
    return model.nv, float(worst[0]), float(worst[1])


def compared_free(file: Path) -> tuple[int, float, float]:
    """The same with a free base. v = T v', of Pinocchio v': M' = Tᵀ M T, and efforts Tᵀ τ(v, T a' + Ṫ v')."""
    import pinocchio as pin

    machine = nivel.import_model(file, base="free")
    mechanics = machine.replace(forces=(), couplings=(), simulation=machine.record.simulation).mechanics()
    model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer())
    model.gravity.linear = np.array([0.0, 0.0, -9.81])
    by_name = {clean(name): model.joints[model.getJointId(name)] for name in model.names[1:]}
    base = mechanics.names[0].rpartition(".")[0]
    link = next(each for each in model.frames if each.type == pin.BODY and clean(each.name) == base)
    origin = model.addFrame(pin.Frame("origin", link.parentJoint, 0, pin.SE3.Identity(), pin.OP_FRAME))
    data = model.createData()
    joints = [by_name[name.rpartition(".")[0]] for name in mechanics.names[6:]]
    assert [name.rpartition(".")[0] for name in mechanics.position_names[7:]] == [
        name.rpartition(".")[0] for name in mechanics.names[6:]
    ]
    random, worst = np.random.default_rng(1), np.zeros(2)
    for _ in range(STATES):
        x, v, a = random.uniform(-1.0, 1.0, (3, model.nv))
        q = pin.integrate(model, pin.neutral(model), x)
        M = pin.crba(model, data, q)
        M = np.triu(M) + np.triu(M, 1).T
        tau = pin.rnea(model, data, q, v, a)
        pin.computeJointJacobians(model, data, q)
        pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
        pin.updateFramePlacements(model, data)
        at = data.oMf[origin]
        J = pin.getFrameJacobian(model, data, origin, pin.LOCAL_WORLD_ALIGNED)
        bias = pin.getFrameClassicalAcceleration(model, data, origin, pin.LOCAL_WORLD_ALIGNED).vector
        T, rate = np.zeros((model.nv, model.nv)), np.zeros(model.nv)
        T[:3], T[3:6] = J[:3], at.rotation.T @ J[3:]
        rate[:3], rate[3:6] = bias[:3], at.rotation.T @ bias[3:]
        T[range(6, model.nv), [each.idx_v for each in joints]] = 1.0
        turn = pin.Quaternion(at.rotation)
        angles = [x[each.idx_v] for each in joints]
        ours = np.array([*at.translation, turn.w, turn.x, turn.y, turn.z, *angles])
        error = np.abs(T.T @ mechanics.mass_matrix(ours) @ T - M).max() / np.abs(M).max()
        efforts = T.T @ mechanics.inverse_dynamics(ours, T @ v, T @ a + rate)
        worst = np.maximum(worst, [error, np.abs(efforts - tau).max() / np.abs(tau).max()])
    return model.nv, float(worst[0]), float(worst[1])


def clean(name: str) -> str:
    """The name as `nivel import` writes it."""
    from nivel.exchange.translation import Names

    return Names().name("joint", name)


def main() -> None:
    """A line for each file, and the count of those that agree."""
    free = "--free" in sys.argv
    files = [Path(each) for each in sys.argv[1:] if each != "--free"] or robots()
    agree = 0
    for file in files:
        try:
            count, matrix, efforts = (compared_free if free else compared)(file)
        except nivel.NivelError as refusal:
            print(f"{file.name}: refused: {str(refusal).splitlines()[0]}", flush=True)
            continue
        agree += max(matrix, efforts) <= AGREE
        print(
            f"{file.name}: {count} degrees of freedom, mass matrix {matrix:.1e}, inverse dynamics {efforts:.1e}",
            flush=True,
        )
    print(f"{agree} of {len(files)} agree to {AGREE:g}")


if __name__ == "__main__":
    if find_spec("pinocchio") is None:
        raise SystemExit("this needs Pinocchio: pip install pin example-robot-data")
    main()
