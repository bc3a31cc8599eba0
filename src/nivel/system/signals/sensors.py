"""Sensors in numbers, and their outputs."""

from nivel.errors import Fault, ModelError, located
from nivel.kernels.bodies.coordinate import DISTANCE, LAST_ANGLE, ROTATION
from nivel.kernels.record.record import NONE
from nivel.kernels.signals import sensor as kernel
from nivel.known import Sensor
from nivel.machine.uses.coordinate_reference import resolve
from nivel.system.builder import SystemBuilder

VECTOR_UNITS = {
    "position": "m",
    "velocity": "m/s",
    "acceleration": "m/s^2",
    "angular_velocity": "rad/s",
    "angular_acceleration": "rad/s^2",
}
TURNS = ("first", "second", "third")
# suffixes of the units of a coordinate's value, rate, acceleration
PER_SECOND = {"value": "", "rate": "/s", "acceleration": "/s^2"}


def sensor_columns(builder: SystemBuilder) -> list[list[int]]:
    """Columns of `nivel.kernels.signals.sensor` for all sensors; their outputs are added."""
    columns: list[list[int]] = []
    if builder.machine.sensors:
        quantities = ("position", "velocity", "acceleration", "angular_velocity", "angular_acceleration")
        vectors = {name: getattr(kernel, name.upper()) for name in quantities}
        scalars = {"value": kernel.VALUE, "rate": kernel.RATE, "acceleration": kernel.SECOND}
        for sensor in builder.machine.sensors:
            with builder.within(f"sensors.{sensor.name}"), located(f"sensors.{sensor.name}"):
                match sensor.form:
                    case "marker":
                        columns.append(_of_marker(builder, sensor, vectors))
                    case "coordinate":
                        assert sensor.coordinate is not None  # the record was checked
                        assert sensor.quantity is not None
                        joint, name = resolve(sensor.coordinate, builder.machine.joints)
                        coordinate = builder.joint_coordinates[f"{joint}.{name}"]
                        columns.append(_scalar(builder, sensor.name, sensor.quantity, scalars, coordinate))
                    case "distance" | "angle" as form:
                        ends = sensor.distance or sensor.angle
                        assert ends is not None  # the record was checked
                        kind = DISTANCE if form == "distance" else ROTATION
                        coordinate = builder.coordinates.add(kind, *builder.ends(ends))
                        columns.append(_scalar(builder, f"{sensor.name}.{form}", "value", scalars, coordinate))
                        columns.append(_scalar(builder, f"{sensor.name}.rate", "rate", scalars, coordinate))
                    case "force":
                        read = f"force.{sensor.force}.{sensor.quantity}"
                        index = _output(builder, sensor, read)
                        output = builder.outputs.add((f"sensor.{sensor.name}", builder.outputs.entries[index][1], read))
                        columns.append([output, kernel.COPY, index, NONE])
                    case _:
                        assert sensor.value is not None  # the record was checked
                        output = builder.outputs.add((f"sensor.{sensor.name}", sensor.units, f"sensor {sensor.name}"))
                        with located(f"sensors.{sensor.name}.value"):
                            function = builder.function(sensor.value, switching=False)
                        columns.append([output, kernel.FUNCTION, function, NONE])
    return columns


def _output(builder: SystemBuilder, sensor: Sensor, name: str) -> int:
    """Index of the output `name`. Raises ModelError where the force has none, as one of another model than lugre has no bristles."""
    try:
        return builder.outputs.index(name)
    except ValueError:
        message = f"this force has no `{sensor.quantity}`"
        raise ModelError(Fault.at(f"sensors.{sensor.name}.quantity", message)) from None


def _of_marker(builder: SystemBuilder, sensor: Sensor, vectors: dict[str, int]) -> list[int]:
    assert sensor.marker is not None  # the record was checked
    assert sensor.quantity is not None
    if sensor.quantity == "euler_angles":
        return _of_turns(builder, sensor, sensor.marker)
    words = f"{sensor.quantity.replace('_', ' ')} of {sensor.marker}"
    words += f" seen from {sensor.relative_to}" if sensor.relative_to is not None else ""
    units = VECTOR_UNITS[sensor.quantity]
    output = builder.outputs.add(*((f"sensor.{sensor.name}.{axis}", units, f"{axis} of the {words}") for axis in "xyz"))
    frame = NONE if sensor.relative_to is None else builder.marker_or_ground(sensor.relative_to)
    return [output, vectors[sensor.quantity], builder.marker(sensor.marker), frame]


def _of_turns(builder: SystemBuilder, sensor: Sensor, marker: str) -> list[int]:
    """Euler angles of a marker, named first, second and third in the results."""
    assert sensor.sequence is not None  # the record was checked
    words = [f"{turn} Euler angle ({sensor.sequence}) of {marker}" for turn in TURNS]
    output = builder.outputs.add(
        *((f"sensor.{sensor.name}.{turn}", "rad", text) for turn, text in zip(TURNS, words, strict=True))
    )
    i, j, k = ("xyz".index(axis) for axis in sensor.sequence)
    frame = NONE if sensor.relative_to is None else builder.marker_or_ground(sensor.relative_to)
    return [output, kernel.EULER_ANGLES + 9 * i + 3 * j + k, builder.marker(marker), frame]


def _scalar(builder: SystemBuilder, name: str, quantity: str, scalars: dict[str, int], coordinate: int) -> list[int]:
    units = "rad" if builder.coordinates.what[coordinate][0] <= LAST_ANGLE else "m"
    output = builder.outputs.add((f"sensor.{name}", f"{units}{PER_SECOND[quantity]}", f"{quantity} of sensor {name}"))
    return [output, scalars[quantity], coordinate, NONE]
