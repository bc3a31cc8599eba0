# Written by `python packaging/write_settings.py` from the records. Do not edit.
# fmt: off
# ruff: noqa
# pyright: reportOptionalMemberAccess=false
"""Forces: what loads bodies by their state, by time or by signals, without taking a freedom away."""

from typing import TYPE_CHECKING, Annotated, Any, Final

from nivel.elements.kind import Kind, Kinds, OneOf
from nivel.machine.core.element import ForceElement

FORCES: Final = Kinds[Kind](__name__, "nivel.elements.contacts", noun="force")

if TYPE_CHECKING:
    Force = ForceElement
else:
    Force = Annotated[ForceElement, OneOf(FORCES)]

from nivel.elements.contacts.contact import Contact as Contact
from nivel.elements.contacts.contact import Contacts as Contacts
from nivel.elements.forces.actuators import Motor as Motor
from nivel.elements.forces.actuators import Servo as Servo
from nivel.elements.forces.actuators import Stop as Stop
from nivel.elements.forces.bushing import Bushing as Bushing
from nivel.elements.forces.drive_lines import Brake as Brake
from nivel.elements.forces.drive_lines import Clutch as Clutch
from nivel.elements.forces.drive_lines import Freewheel as Freewheel
from nivel.elements.forces.drive_lines import TransmissionLoss as TransmissionLoss
from nivel.elements.forces.drives import DcMotor as DcMotor
from nivel.elements.forces.drives import ServoMotor as ServoMotor
from nivel.elements.forces.friction import Friction as Friction
from nivel.elements.forces.hand import Hand as Hand
from nivel.elements.forces.loads import PairForce as PairForce
from nivel.elements.forces.loads import PointForce as PointForce
from nivel.elements.forces.loads import Torque as Torque
from nivel.elements.forces.ropes import Rope as Rope
from nivel.elements.forces.shafts import BeltDrive as BeltDrive
from nivel.elements.forces.shafts import Shaft as Shaft
from nivel.elements.forces.spring_node import SpringNode as SpringNode
from nivel.elements.forces.spring_series import SpringSeries as SpringSeries
from nivel.elements.forces.springs import JointSpringDamper as JointSpringDamper
from nivel.elements.forces.springs import SpringDamper as SpringDamper
from nivel.elements.forces.springs import ThreeAxisSpring as ThreeAxisSpring
from nivel.elements.forces.springs import TorsionalSpringDamper as TorsionalSpringDamper
from nivel.elements.forces.terramechanics import Blade as Blade
from nivel.elements.forces.terramechanics import SoilWheel as SoilWheel
from nivel.elements.forces.terramechanics import Track as Track
from nivel.elements.forces.three_phase_motors import InductionMotor as InductionMotor
from nivel.elements.forces.three_phase_motors import SynchronousMotor as SynchronousMotor
from nivel.elements.forces.tyre import Tyre as Tyre
