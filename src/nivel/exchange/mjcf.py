"""MJCF: models of MuJoCo, read by its own library, with closed loops made exact.

MuJoCo compiles the model, with its defaults, replications and inertias of geometries; the numbers of the compiled model are those of the
machine. Bodies are placed as in `qpos0`.
"""

import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.exchange import mechanism as parts
from nivel.exchange.mjcf_contacts import CLIP, hardness, kind_of, read_contacts
from nivel.exchange.mjcf_couplings import Tendons, axes_of, read_equalities
from nivel.exchange.urdf import digits
from nivel.extras import needed, require
from nivel.files.apart import apart
from nivel.files.sources import read_bytes
from nivel.files.xml_source import Document, Element

KINDS: Final = {2: "translational", 3: "revolute", 1: "spherical"}  # mjtJoint: free 0, ball 1, slide 2, hinge 3
FREE, BALL = 0, 1
JOINT_TRANSMISSIONS: Final = (0, 1)  # mjtTrn: on a joint, on a joint in the parent
GAINS, BIASES, DYNAMICS = ("fixed", "affine"), ("none", "affine"), ("none", "integrator", "filter", "filterexact")
DEEPEST: Final = 10  # files that include files
SHOWN_GROUPS: Final = 3  # geoms of the groups 0, 1 and 2 are drawn, as by MuJoCo's viewer
OFF: Final = {
    "contacts": "mjDSBL_CONTACT",
    "limits": "mjDSBL_LIMIT",
    "friction": "mjDSBL_FRICTIONLOSS",
    "springs": "mjDSBL_SPRING",
    "dampers": "mjDSBL_DAMPER",
    "equalities": "mjDSBL_EQUALITY",
    "actuators": "mjDSBL_ACTUATION",
}


def read_mjcf(
    path: Path,
    document: Document,
    base: str | None,
    contacts: str = "all",
    keyframe: str | None = None,
    include_paths: Sequence[Path] = (),
) -> parts.Mechanism:
    """The mechanism of an MJCF file. base : `fixed` welds free bodies to the world; default as the file says.
    contacts : `all`, `floor` or `none`. keyframe : name or number of the one at which it starts. include_paths : folders beside that of
    the model from which files are read. Raises ModelError."""
    require("models in MJCF need", "mujoco")
    sources = _Sources((path.parent.resolve(), *(each.resolve() for each in include_paths)), {path.resolve()})
    sources.check(document, path)
    document.raise_faults()
    name = document.root.get("model") or path.stem
    given = (path, document.file, name, base, contacts, keyframe, sources.found)
    return apart(mechanism_here, *given, failed=f"{document.file} cannot be read")


def mechanism_here(
    path: Path, file: str, name: str, base: str | None, contacts: str, keyframe: str | None, found: dict[str, bytes]
) -> parts.Mechanism:
    """The same in this process, which a damaged file may end. found : included files that are not where the file says, by that name."""
    mj = needed("mujoco", "models in MJCF need")
    said: list[warnings.WarningMessage] = []
    try:
        with warnings.catch_warnings(record=True) as said:
            model = mj.MjSpec.from_file(str(path), include=found or None).compile()
    except (ValueError, RuntimeError) as error:
        text = " ".join(str(error).split())
        raise ModelError(Fault(file, 1, 1, "", f"MuJoCo cannot compile the model: {text}")) from None
    off = {what for what, flag in OFF.items() if model.opt.disableflags & int(getattr(mj.mjtDisableBit, flag))}
    weightless = bool(model.opt.disableflags & int(mj.mjtDisableBit.mjDSBL_GRAVITY))
    x, y, z = (0.0, 0.0, 0.0) if weightless else model.opt.gravity.tolist()
    mechanism = parts.Mechanism(name, "MJCF", (x, y, z))
    for each in said:
        mechanism.notes.change(f"MuJoCo: {' '.join(str(each.message).split())}")
    mechanism.step = float(model.opt.timestep)
    for what in sorted(off):
        mechanism.notes.leave(f"{what}, which the model switches off")
    data = mj.MjData(model)
    mj.mj_resetData(model, data)
    data.qpos[:] = model.qpos0
    if keyframe is not None:
        mj.mj_resetDataKeyframe(model, data, _keyframe(model, keyframe, file))
        if np.any(data.qvel):
            mechanism.notes.leave("velocities of the keyframe", keyframe, acts=True)
    mj.mj_kinematics(model, data)
    reader = _Reader(mj, model, data, mechanism, off)
    reader.read(base)
    if "contacts" not in off and contacts != "none":
        read_contacts(mj, data, mechanism, reader.body, reader.solid, contacts)
    if model.nkey and keyframe is None:
        names = ", ".join(model.key(k).name or str(k) for k in range(model.nkey))
        mechanism.notes.leave(f"keyframes ({model.nkey}); `--keyframe NAME` starts at one: {names}")
    _leave(model, mechanism, without=contacts == "none" and "contacts" not in off)
    return mechanism


def _keyframe(model: Any, wanted: str, file: str) -> int:
    """Number of the keyframe of this name or number. Raises ModelError."""
    names = [model.key(k).name or str(k) for k in range(model.nkey)]
    for k, name in enumerate(names):
        if wanted in (name, str(k)):
            return k
    known = f"there are {', '.join(names)}" if names else "it has none"
    raise ModelError(Fault(file, 1, 1, "", f"the model has no keyframe `{wanted}`; {known}"))


def _check_finite(document: Document) -> None:
    """Note attributes of numbers of which one is not finite. A word that the file gives to an element as its name is none."""
    names, given = {""}, []
    for element in document.root.every():
        names |= {element.get("name"), element.get("class")}
        given += [(element, key, each.split()) for key, each in element.attributes.items()]
    for element, key, words in given:
        numbers = [] if " ".join(words) in names else [_number(word) for word in words]
        if None not in numbers and not np.all(np.isfinite(np.array(numbers, dtype=float))):
            document.fault(element, f'{key}="{" ".join(words)}" is not finite')


def _number(word: str) -> float | None:
    try:
        return float(word)
    except ValueError:
        return None


class _Sources:
    """The files of a model. folders : in which they may be, that of the model first. found : contents of included files from the others."""

    def __init__(self, folders: tuple[Path, ...], seen: set[Path]) -> None:
        self.folders, self.seen = folders, seen
        self.found: dict[str, bytes] = {}

    def check(self, document: Document, path: Path, depth: int = 0) -> None:
        """Refuse numbers that are not finite, what would make a model larger than its file, and files outside of the folders."""
        _check_finite(document)
        if document.faults:
            return
        for element, count in _repeated(document.root, 1):
            if count > parts.MOST_LINKS:
                document.fault(element, f"{count} repetitions; up to {parts.MOST_LINKS} are read")
        pending = [document.root]
        while pending:
            element = pending.pop()
            pending += element.children
            for key in ("file", "meshdir", "texturedir", "assetdir"):
                given = element.get(key)
                if given and not any((path.parent / given).resolve().is_relative_to(each) for each in self.folders):
                    left = f'{key}="{given}" leaves the folder of the model, and is not read'
                    document.fault(
                        element, f"{left}; `--include-path FOLDER` names another folder from which files are read"
                    )
            if element.tag == "include" and not document.faults:
                self._include(document, element, path.parent, depth)

    def _include(self, document: Document, element: Element, folder: Path, depth: int) -> None:
        given = element.get("file")
        inner = next((at for each in (folder, *self.folders[1:]) if (at := (each / given).resolve()).is_file()), None)
        if inner is None:
            document.fault(
                element, f"there is no file `{given}`; `--include-path FOLDER` names a folder in which it is"
            )
        elif inner in self.seen or depth > DEEPEST:
            document.fault(element, f"`{given}` is included twice, or leads back to itself")
        else:
            self.seen.add(inner)
            content = read_bytes(inner)
            if not (folder / given).is_file():
                self.found[given] = content
            included = Document(content, str(inner))
            self.check(included, inner, depth + 1)
            document.faults += included.faults


def _repeated(element: Element, times: int) -> Iterator[tuple[Element, int]]:
    """Elements that repeat what stands in them or make many bodies, with the number of all repetitions."""
    stack = [(element, times)]
    while stack:
        each, count = stack.pop()
        if each.tag in ("replicate", "composite", "flexcomp"):
            for word in each.get("count", "1").split():
                number = _number(word)
                count *= 1 if number is None or not np.isfinite(number) else abs(int(number))
            yield each, count
        stack += [(child, count) for child in each.children]


class _Reader:
    """The parts of a compiled model; `d` holds the kinematics of qpos0."""

    def __init__(self, mj: Any, m: Any, d: Any, mechanism: parts.Mechanism, off: set[str]) -> None:
        self.mj, self.m, self.d, self.mechanism, self.off = mj, m, d, mechanism, off
        self.joints: dict[int, parts.Connection] = {}
        self.tendons = Tendons(m, d, mechanism, self.joints, self.body)

    def read(self, base: str | None) -> None:
        """Fill the mechanism."""
        for b in range(1, self.m.nbody):
            self._body(b)
        for b in range(1, self.m.nbody):
            self._joints(b, base)
        for s in range(self.m.nsite):
            self._site(s)
        pulls = (self.m.actuator_trntype == int(self.mj.mjtTrn.mjTRN_TENDON)) & ("actuators" not in self.off)
        self.tendons.read(self.off, {int(each) for each in self.m.actuator_trnid[pulls, 0]})
        if "equalities" not in self.off:
            read_equalities(self.mj, self.m, self.mechanism, self.joints, self.body, self.tendons.terms)
        if "actuators" not in self.off:
            for a in range(self.m.nu):
                self._actuator(a)

    def body(self, b: int) -> str:
        """The name of the link of a body."""
        return parts.WORLD if b == 0 else self.m.body(b).name or f"body_{b}"

    def _frame(self, at: Any, axes: Any) -> parts.Frame:
        return parts.Frame(np.array(axes, dtype=float).reshape(3, 3), np.array(at, dtype=float))

    def _body(self, b: int) -> None:
        m, d = self.m, self.d
        place = self._frame(d.xpos[b], d.xmat[b])
        inertial = None
        if m.body_mass[b] > 0.0:
            own = axes_of(self.mj, m.body_iquat[b])
            inertial = parts.Inertial(
                float(m.body_mass[b]), m.body_ipos[b].copy(), own @ np.diag(m.body_inertia[b]) @ own.T
            )
        name = self.body(b)
        looks = [
            look
            for g in range(m.body_geomadr[b], m.body_geomadr[b] + m.body_geomnum[b])
            if (look := self._look(g, name))
        ]
        self.mechanism.links[name] = parts.Link(name, place, inertial, looks)
        if m.body_gravcomp[b] and inertial is not None and any(self.mechanism.gravity):
            lift = -float(m.body_gravcomp[b]) * inertial.mass * np.array(self.mechanism.gravity)
            self.mechanism.lifts.append((name, inertial.centre, lift))
            self.mechanism.notes.change("gravcomp is a force at the centre of mass", name)

    def _joints(self, b: int, base: str | None) -> None:
        m, name = self.m, self.body(b)
        before, first = self.body(int(m.body_parentid[b])), int(m.body_jntadr[b])
        joints = range(first, first + int(m.body_jntnum[b]))
        if not joints:
            self.mechanism.connections.append(parts.Connection(f"{name}_weld", "fixed", (before, name), np.zeros(3)))
        for j in joints:
            if m.jnt_type[j] == FREE:
                if base == "fixed":
                    self.mechanism.connections.append(
                        parts.Connection(f"{name}_base", "fixed", (parts.WORLD, name), np.zeros(3))
                    )
                continue
            after = name
            if j != joints[-1]:
                after = f"{name}_{self._joint_name(j)}"
                self.mechanism.links[after] = parts.Link(after, self._frame(self.d.xanchor[j], self.d.xmat[b]))
            self.joints[j] = self._joint(j, before, after)
            self.mechanism.connections.append(self.joints[j])
            before = after

    def _joint_name(self, j: int) -> str:
        return self.m.joint(j).name or f"joint_{j}"

    def _joint(self, j: int, before: str, after: str) -> parts.Connection:
        m, notes = self.m, self.mechanism.notes
        name, v, q = self._joint_name(j), int(m.jnt_dofadr[j]), int(m.jnt_qposadr[j])
        joint = parts.Connection(name, KINDS[int(m.jnt_type[j])], (before, after), self.d.xanchor[j].copy())
        if m.jnt_type[j] == BALL:
            given = (m.dof_armature[v], m.dof_damping[v], m.jnt_stiffness[j], m.dof_frictionloss[v], m.jnt_limited[j])
            for value, what in zip(given, ("armature", "damping", "stiffness", "friction", "limits"), strict=True):
                if value:
                    notes.leave(f"{what} of ball joints", name, acts=True)
            return joint
        joint.axes = (self.d.xaxis[j].copy(),)
        joint.placed, joint.reference = float(self.d.qpos[q]), float(m.qpos0[q])
        joint.armature = float(m.dof_armature[v])
        if "dampers" not in self.off:
            joint.damping = float(m.dof_damping[v])
        if "springs" not in self.off:
            joint.stiffness, joint.free = float(m.jnt_stiffness[j]), float(m.qpos_spring[q])
        if "friction" not in self.off:
            joint.friction = float(m.dof_frictionloss[v])
            joint.creep = joint.friction * self._compliance(v)
        if "limits" not in self.off and m.jnt_limited[j]:
            joint.lower, joint.upper = map(float, m.jnt_range[j])
            joint.hardness = hardness(
                m.jnt_solref[j], m.jnt_solimp[j], float(m.dof_invweight0[v]), float(m.opt.timestep)
            )
        curved = [getattr(m, key, None) for key in ("jnt_stiffnesspoly", "dof_dampingpoly")]
        for poly, k in zip(curved, (j, v), strict=True):
            if poly is not None and np.any(poly[k]):
                notes.leave("parts of springs and dampers that are not linear", name, acts=True)
        return joint

    def _compliance(self, v: int) -> float:
        """Rate by effort of friction, R/b: with f = -(b/R) v, R = (1 - d)/d of the inverse weight, MuJoCo holds what does not move."""
        m = self.m
        least, most = (min(max(float(each), CLIP), 1.0 - CLIP) for each in m.dof_solimp[v][:2])
        given = float(m.dof_solref[v][0])
        b = 2.0 / (most * max(given, 2.0 * float(m.opt.timestep))) if given > 0.0 else -float(m.dof_solref[v][1]) / most
        return (1.0 - least) / least * float(m.dof_invweight0[v]) / b if b > 0.0 else 0.0

    def _look(self, g: int, name: str) -> parts.Look | None:
        if self.m.geom_group[g] >= SHOWN_GROUPS:
            return None
        look = self.solid(g)
        if look is None or look.kind == "plane":
            self.mechanism.notes.leave(f"looks: geoms of type {kind_of(self.mj, self.m, g)}", name)
            return None
        return look

    def solid(self, g: int) -> parts.Look | None:
        """The solid of a geom in its body; None of types that have none."""
        m = self.m
        size, material = m.geom_size[g], int(m.geom_matid[g])
        colour = (
            m.mat_rgba[material] if material >= 0 and np.all(m.geom_rgba[g] == (0.5, 0.5, 0.5, 1.0)) else m.geom_rgba[g]
        )
        place = self._frame(m.geom_pos[g], axes_of(self.mj, m.geom_quat[g]))
        common: dict[str, Any] = {"place": place, "colour": digits(colour)}
        match kind_of(self.mj, m, g):
            case "sphere" | "capsule" | "cylinder" | "box" | "ellipsoid" | "plane" as kind:
                factors = {"sphere": (1.0,), "box": (2.0, 2.0, 2.0), "ellipsoid": (1.0, 1.0, 1.0), "plane": ()}
                sizes = zip(factors.get(kind, (1.0, 2.0)), size.tolist(), strict=False)
                return parts.Look(kind, sizes=tuple(factor * each for factor, each in sizes), **common)
            case "mesh":
                k = int(m.geom_dataid[g])
                vertices = m.mesh_vert[m.mesh_vertadr[k] : m.mesh_vertadr[k] + m.mesh_vertnum[k]].astype(float)
                faces = m.mesh_face[m.mesh_faceadr[k] : m.mesh_faceadr[k] + m.mesh_facenum[k]]
                return parts.Look("surface", surface=(vertices, faces.astype(np.uint32)), **common)
        return None

    def _site(self, s: int) -> None:
        m = self.m
        name = m.site(s).name
        if name:
            at = self._frame(m.site_pos[s], axes_of(self.mj, m.site_quat[s]))
            self.mechanism.sites.append((name, self.body(int(m.site_bodyid[s])), at))

    def _actuator(self, a: int) -> None:
        m, notes, mj = self.m, self.mechanism.notes, self.mj
        name, gear, constant = m.actuator(a).name or f"actuator_{a}", float(m.actuator_gear[a, 0]), 0.0
        where, at = int(m.actuator_trntype[a]), int(m.actuator_trnid[a, 0])
        terms: parts.Terms | None = None
        if where in JOINT_TRANSMISSIONS:
            joint = self.joints.get(at)
            terms = ((joint.name, gear),) if joint is not None and joint.coordinate else None
        elif where == int(mj.mjtTrn.mjTRN_TENDON) and at in self.tendons.terms:
            lengths, constant = self.tendons.terms[at]
            terms = tuple((joint, gear * factor) for joint, factor in lengths)
        if terms is None:
            notes.leave("actuators on other elements than hinges, slides and tendons that are lengths", name, acts=True)
            return
        # force = gain · activation + b0 + b1 · length + b2 · speed, with the length gear · coordinate
        kinds = [mj.mjtGain, mj.mjtBias, mj.mjtDyn]
        types = (m.actuator_gaintype[a], m.actuator_biastype[a], m.actuator_dyntype[a])
        gain, bias, dynamics = (
            kind(int(each)).name.partition("_")[2].lower() for kind, each in zip(kinds, types, strict=True)
        )
        if gain not in GAINS or bias not in BIASES or dynamics not in DYNAMICS:
            notes.leave("muscles, and actuators with laws of a plugin or a user", name, acts=True)
            return
        numbers = m.actuator_gainprm[a][:3] * ([1.0, 0.0, 0.0] if gain == "fixed" else 1.0)
        laws = m.actuator_biasprm[a][:3] if bias == "affine" else np.zeros(3)
        fixed = gear * constant
        gains, biases = ((float(e[0] + e[1] * fixed), float(e[1]), float(e[2])) for e in (numbers, laws))
        made = parts.Actuator(name, terms, gains, biases)
        if dynamics != "none":
            made.time = 0.0 if dynamics == "integrator" else float(m.actuator_dynprm[a, 0])
        for given, of, key in (("ctrl", "ctrl", "control"), ("force", "force", "limit"), ("act", "act", "activation")):
            if getattr(m, f"actuator_{given}limited")[a]:
                setattr(made, key, tuple(map(float, getattr(m, f"actuator_{of}range")[a])))
        made.rest = float(self.d.ctrl[a])
        if made.control is not None:
            made.rest = min(max(made.rest, made.control[0]), made.control[1])
        self.mechanism.actuators.append(made)


def _leave(m: Any, mechanism: parts.Mechanism, *, without: bool) -> None:
    """Note what no part of the reader has asked for."""
    notes = mechanism.notes
    for count, what in ((m.nflex, "flexible elements"), (m.nsensor, "sensors"), (m.nplugin, "plugins")):
        if count:
            notes.leave(f"{what} ({count})", acts=what != "sensors")
    if without and np.any((m.geom_contype > 0) | (m.geom_conaffinity > 0)):
        notes.leave("contacts of geoms; a contact is a force of type `contact`", acts=True)
    if m.opt.density or m.opt.viscosity:
        notes.leave("forces of the fluid around the bodies (density, viscosity)", acts=True)
    if np.any(m.body_mocapid >= 0):
        notes.change("mocap bodies stand on the ground")
