"""Forces in words, one file for each kind."""

from typing import Annotated

from pydantic import Field

from nivel.machine.forces.between import Between, BetweenMarkers, End, GlobalPoint
from nivel.machine.forces.bushing import Bushing
from nivel.machine.forces.characteristic import Characteristic, EffortTable, ForceTable, TorqueTable
from nivel.machine.forces.contact import Contact, Material
from nivel.machine.forces.element import ForceElement
from nivel.machine.forces.friction import Friction
from nivel.machine.forces.joint_spring_damper import JointSpringDamper
from nivel.machine.forces.load import PointForce, Torque
from nivel.machine.forces.motor import Motor
from nivel.machine.forces.pair_force import PairForce
from nivel.machine.forces.spring_damper import SpringDamper
from nivel.machine.forces.stop import Stop
from nivel.machine.forces.torsional_spring_damper import TorsionalSpringDamper

Force = Annotated[
    PointForce
    | Torque
    | SpringDamper
    | TorsionalSpringDamper
    | JointSpringDamper
    | Stop
    | Friction
    | Motor
    | PairForce
    | Bushing
    | Contact,
    Field(discriminator="type"),
]
FORCES: tuple[type[ForceElement], ...] = (
    PointForce,
    Torque,
    SpringDamper,
    TorsionalSpringDamper,
    JointSpringDamper,
    Stop,
    Friction,
    Motor,
    PairForce,
    Bushing,
    Contact,
)

__all__ = [
    "FORCES",
    "Between",
    "BetweenMarkers",
    "Bushing",
    "Characteristic",
    "Contact",
    "EffortTable",
    "End",
    "Force",
    "ForceElement",
    "ForceTable",
    "Friction",
    "GlobalPoint",
    "JointSpringDamper",
    "Material",
    "Motor",
    "PairForce",
    "PointForce",
    "SpringDamper",
    "Stop",
    "Torque",
    "TorqueTable",
    "TorsionalSpringDamper",
]
