"""MJCF of the rigid part of a machine."""

import numpy as np

from nivel.elements.joints.joint import Joint
from nivel.exchange.kinematic_tree import Branch, KinematicTree, kinematic_tree
from nivel.exchange.mechanism import Frame
from nivel.exchange.xml_writer import Lines, geometries, words
from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.record import GROUND
from nivel.machine.machine_record import MachineRecord
from nivel.system.joint_frames import joint_frames

WAY: float = 1e4  # [m or rad] the other end of a way that has one end
APART: float = 0.1  # [m] between the two points that hold the axis of a revolute joint in a loop


def mjcf(machine: MachineRecord, folder: str) -> tuple[str, dict[str, bytes], list[str]]:
    """The document, the meshes that belong to it by file name, and the notes. folder : of meshes. Raises ModelError."""
    tree = kinematic_tree(machine)
    writer = _Writer(tree, folder)
    text = writer.document()
    return text, writer.meshes, tree.notes.lines()


class _Writer:
    def __init__(self, tree: KinematicTree, folder: str) -> None:
        self.tree, self.folder, self.out = tree, folder, Lines()
        self.meshes: dict[str, bytes] = {}
        self.names: dict[str, str] = {}  # of motions, by coordinate

    def document(self) -> str:
        """The whole document."""
        machine, out = self.tree.machine, Lines()
        self.out.start("worldbody")
        self._markers(GROUND)
        for branch in self.tree.children(GROUND):
            self._body(branch)
        self.out.end()
        self._equalities()
        self._actuators()
        out.start("mujoco", model=machine.name)
        out.element("compiler", angle="radian", autolimits="true", inertiafromgeom="false", balanceinertia="false")
        step = machine.simulation.step
        out.element("option", gravity=words(machine.gravity), timestep=float(step) if isinstance(step, float) else None)
        if self.meshes:
            out.start("asset")
            for file in self.meshes:
                out.element("mesh", name=_mesh_name(file), file=file, inertia="shell")
            out.end()
        out.add(self.out)
        out.end()
        out.comment([f"Written by nivel from the machine {machine.name}.", *self.tree.notes.lines()])
        return out.text()

    def _body(self, branch: Branch) -> None:
        out, body = self.out, branch.body
        out.start("body", name=body.name, pos=words(branch.place.origin), quat=_quaternion(branch.place))
        if branch.joint is None and branch.parent == GROUND:
            out.element("freejoint", name=f"{body.name}_free")
        if branch.ball and branch.joint is not None:
            out.element("joint", name=branch.joint.name, type="ball", pos=words(branch.point))
        for motion in branch.motions:
            self._joint(branch, motion.kind, motion.axis, motion.coordinate)
        properties = mass_properties(body)
        i = properties.inertia
        tensor = words([i[0, 0], i[1, 1], i[2, 2], i[0, 1], i[0, 2], i[1, 2]])
        out.element("inertial", pos=words(properties.centre_of_mass), mass=properties.mass, fullinertia=tensor)
        for each in geometries(body, self.folder, self.meshes, self.tree.notes):
            colour = None if each.colour is None else words((*each.colour, 1.0))
            common = {"contype": 0, "conaffinity": 0, "group": 1, "rgba": colour}
            if each.kind == "mesh":
                out.element("geom", type="mesh", mesh=_mesh_name(each.file), **common)
                continue
            halves = [each.sizes[0], 0.5 * each.sizes[1]] if len(each.sizes) == 2 else list(each.sizes)
            size = words([0.5 * size for size in each.sizes] if each.kind == "box" else halves)
            out.element(
                "geom",
                type=each.kind,
                size=size,
                pos=words(each.place.origin) if np.any(each.place.origin) else None,
                quat=_quaternion(each.place),
                **common,
            )
        self._markers(body.name)
        for child in self.tree.children(body.name):
            self._body(child)
        out.end()

    def _joint(self, branch: Branch, kind: str, axis: np.ndarray, coordinate: str) -> None:
        joint, _, which = coordinate.partition(".")
        name = joint if len(branch.motions) == 1 else f"{joint}_{which}"
        self.names[coordinate] = name
        at = self.tree.at[coordinate]
        ends = None
        if at.lower is not None or at.upper is not None:
            ends = words((-WAY if at.lower is None else at.lower, WAY if at.upper is None else at.upper))
        self.out.element(
            "joint",
            name=name,
            type="hinge" if kind == "turn" else "slide",
            pos=words(branch.point) if np.any(branch.point) else None,
            axis=words(axis),
            range=ends,
            damping=at.damping or None,
            stiffness=at.stiffness or None,
            springref=at.free or None,
            frictionloss=at.friction or None,
            armature=at.armature or None,
        )

    def _markers(self, body: str) -> None:
        for name, frame in self.tree.markers_on(body):
            self.out.element("site", name=name, pos=words(frame.origin), quat=_quaternion(frame))

    def _equalities(self) -> None:
        out, notes = self.out, self.tree.notes
        lines = [joint for joint in self.tree.loops if joint.type in ("spherical", "revolute", "fixed")]
        for joint in self.tree.loops:
            if joint not in lines:
                notes.leave(f"joints of type {joint.type} that close a loop", joint.name)
        follows = [each for each in self.tree.follows if each[0] in self.names and each[1] in self.names]
        if not lines and not follows:
            return
        out.start("equality")
        for joint in lines:
            self._loop(joint)
        for first, second, factor, offset in follows:
            out.element(
                "joint", joint1=self.names[first], joint2=self.names[second], polycoef=words((offset, factor, 0, 0, 0))
            )
        out.end()
        notes.change("joints that close loops and couplings are equalities, which are soft in MuJoCo")

    def _loop(self, joint: Joint) -> None:
        """Points that stay together: one, of a revolute joint two on its axis, of a fixed joint a weld."""
        (first, at_first, axes_first), (second, at_second, axes_second) = joint_frames(self.tree.machine, joint)
        names = {"body1": _world(first), "body2": _world(second)}
        if joint.type == "fixed":
            relative = Frame(axes_first, at_first) @ Frame(axes_second, at_second).inverse
            pose = words([*relative.origin, *euler_parameters_from_matrix(relative.axes)])
            self.out.element("weld", name=joint.name, **names, relpose=pose)
            return
        self.out.element("connect", name=joint.name, **names, anchor=words(at_first))
        if joint.type == "revolute":
            self.out.element(
                "connect", name=f"{joint.name}_axis", **names, anchor=words(at_first + APART * axes_first[:, 2])
            )

    def _actuators(self) -> None:
        motors = [each for each in self.tree.motors if each[1] in self.names]
        if not motors:
            return
        self.out.start("actuator")
        for name, coordinate, factor, limit in motors:
            force = None if limit is None else words((-limit / abs(factor), limit / abs(factor)))
            self.out.element(
                "motor", name=name, joint=self.names[coordinate], gear=words((factor, 0, 0, 0, 0, 0)), forcerange=force
            )
        self.out.end()


def _world(body: str) -> str:
    return "world" if body == GROUND else body


def _mesh_name(file: str) -> str:
    return file.rpartition("/")[2].removesuffix(".stl")


def _quaternion(frame: Frame) -> str | None:
    if np.abs(frame.axes - np.eye(3)).max() < 1e-16:
        return None
    return words(euler_parameters_from_matrix(frame.axes))
