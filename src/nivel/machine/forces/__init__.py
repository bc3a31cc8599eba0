"""Forces in words, one file for each kind."""

from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import GetCoreSchemaHandler
from pydantic_core import CoreSchema

from nivel.machine.forces.belt_drive import BeltDrive
from nivel.machine.forces.between import Between, BetweenMarkers, End, Ends, GlobalPoint
from nivel.machine.forces.bushing import Bushing
from nivel.machine.forces.characteristic import Characteristic, EffortTable, ForceTable, TorqueTable
from nivel.machine.forces.clutch import Brake, Clutch
from nivel.machine.forces.contact import Contact, Material
from nivel.machine.forces.contacts import Contacts
from nivel.machine.forces.drive_line import DriveLine
from nivel.machine.forces.drives import DcMotor, ServoMotor, TorqueSpeed
from nivel.machine.forces.element import ForceElement
from nivel.machine.forces.freewheel import Freewheel
from nivel.machine.forces.friction import Friction
from nivel.machine.forces.hand import Hand
from nivel.machine.forces.height_field import HeightField
from nivel.machine.forces.joint_spring_damper import JointSpringDamper
from nivel.machine.forces.load import PointForce, Torque
from nivel.machine.forces.motor import Motor
from nivel.machine.forces.pair_force import PairForce
from nivel.machine.forces.rope import Rope
from nivel.machine.forces.servo import Servo
from nivel.machine.forces.shaft import Shaft
from nivel.machine.forces.spring_damper import SpringDamper
from nivel.machine.forces.spring_node import SpringNode
from nivel.machine.forces.spring_series import SpringSeries
from nivel.machine.forces.sticking import holds_by_capacity, is_sticking
from nivel.machine.forces.stop import Stop
from nivel.machine.forces.three_axis_spring import ThreeAxisSpring
from nivel.machine.forces.torsional_spring_damper import TorsionalSpringDamper
from nivel.machine.forces.transmission_loss import TransmissionLoss
from nivel.machine.given import Field

FORCES: list[type[ForceElement]] = [
    PointForce,
    Torque,
    SpringDamper,
    SpringSeries,
    SpringNode,
    TorsionalSpringDamper,
    JointSpringDamper,
    Stop,
    Friction,
    Motor,
    DcMotor,
    ServoMotor,
    Servo,
    PairForce,
    Bushing,
    ThreeAxisSpring,
    Contact,
    Contacts,
    Rope,
    Brake,
    Clutch,
    Freewheel,
    Shaft,
    BeltDrive,
    TransmissionLoss,
    Hand,
]


class _AnyForce:
    """A record of one of FORCES, told apart by its `type`."""

    @classmethod
    def __get_pydantic_core_schema__(cls, _: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return handler.generate_schema(Annotated[reduce(or_, FORCES), Field(discriminator="type")])


if TYPE_CHECKING:
    Force = ForceElement
else:
    Force = _AnyForce


def register(kind: type[ForceElement]) -> None:
    """Add a kind of force. Machines know it from when their record is built anew (`MachineRecord.model_rebuild`)."""
    FORCES.append(kind)


__all__ = [
    "FORCES",
    "BeltDrive",
    "Between",
    "BetweenMarkers",
    "Brake",
    "Bushing",
    "Characteristic",
    "Clutch",
    "Contact",
    "Contacts",
    "DcMotor",
    "DriveLine",
    "EffortTable",
    "End",
    "Ends",
    "Force",
    "ForceElement",
    "ForceTable",
    "Freewheel",
    "Friction",
    "GlobalPoint",
    "Hand",
    "HeightField",
    "JointSpringDamper",
    "Material",
    "Motor",
    "PairForce",
    "PointForce",
    "Rope",
    "Servo",
    "ServoMotor",
    "Shaft",
    "SpringDamper",
    "SpringNode",
    "SpringSeries",
    "Stop",
    "ThreeAxisSpring",
    "Torque",
    "TorqueSpeed",
    "TorqueTable",
    "TorsionalSpringDamper",
    "TransmissionLoss",
    "holds_by_capacity",
    "is_sticking",
    "register",
]
