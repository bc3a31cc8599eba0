"""A machine with every component of hydraulic circuits, in motion."""

from nivel import Machine
from simulating import hinge, machine, slide, solid

RATED = {"flow": "40 L/min", "pressure_drop": "7 bar"}
CUSHION = {"length": "20 mm", "flow": "40 L/min", "pressure_drop": "2 bar"}


def machine_with_circuits(command="0.3 + 0.5*rail.displacement + 1e-9*line.pressure"):
    """Two blocks on slides, pushed by a cylinder with cushions and by a telescope, and a wheel turned by an actuator and a motor."""
    axes = {
        "rail": slide("ground", "block", point=[0.6, 0, 0]),
        "post": slide("ground", "top", (0, 0, 1), point=[0, 0, 0.6]),
    }
    return machine(
        {
            "gravity": [0, 0, -9.81],
            "bodies": {
                "block": solid(100.0, 2.0, position=[0.6, 0, 0], velocity=[0.2, 0, 0]),
                "top": solid(80.0, 2.0, position=[0, 0, 0.6]),
                "wheel": solid(20.0, 3.0, angular_velocity=[0, 0, 2]),
            },
            "joints": {**axes, "axle": hinge("ground", "wheel")},
            "hydraulics": {
                "tank": {"type": "tank", "pressure": "2 bar"},
                "supply": {"type": "volume", "volume": "1 L", "wall_modulus": "1 GPa", "start": "120 bar"},
                "line": {"type": "volume", "volume": "0.3 L", "start": "60 bar"},
                "gap": {"type": "volume", "volume": "50 cm^3", "start": "70 bar"},
                "ls": {"type": "load-sensing", "valves": ["valve"]},
                "store": {
                    "type": "accumulator", "ports": {"A": "supply"}, "volume": "1 L", "precharge": "80 bar",
                    "start": "110 bar", **RATED,
                },
                "pump": {
                    "type": "pump", "ports": {"A": "tank", "B": "supply", "LS": "ls"}, "margin": "20 bar",
                    "displacement": "28 cm^3/rev", "speed": "1500 rpm", "pistons": 9, "volumetric_efficiency": 0.95,
                    "mechanical_efficiency": 0.9, "nominal_pressure": "200 bar", "nominal_speed": "1500 rpm",
                },
                "diesel": {
                    "type": "engine", "speed": "1500 rpm", "inertia": 0.2, "drag": 10,
                    "torque_curve": {"speeds": [80, 200], "torques": [100, 90]},
                },
                "second": {
                    "type": "pump", "ports": {"A": "tank", "B": "line", "L": "tank", "X": "supply"}, "engine": "diesel",
                    "displacement": "5 cm^3/rev", "case_leakage": 1e-13, "torque_limit": 2, "frequency": "5 Hz",
                    "efficiency": {
                        "speeds": [50, 200], "pressures": ["20 bar", "200 bar"], "volumetric": [0.8, 0.7, 0.95, 0.9],
                        "mechanical": [0.8, 0.9, 0.85, 0.95],
                    },
                },
                "third": {
                    "type": "pump", "ports": {"A": "tank", "B": "supply", "LS": "ls"}, "speed": "1500 rpm", "margin": "90 bar",
                    "displacement": "5 cm^3/rev", "rate_limit": 9, "frequency": "8 Hz",
                    "cut_off_curve": {"pressures": ["80 bar", "180 bar"], "settings": [1.0, 0.2]},
                },
                "spare": {"type": "flow-source", "ports": {"A": "tank", "B": "supply"}, "flow": "1e-5*(1 + sin(time))"},
                "relief": {
                    "type": "relief-valve", "ports": {"P": "supply", "T": "tank"}, "opens_at": "100 bar",
                    "opening_range": "40 bar", "lag": "5 ms", **RATED,
                },
                "check": {"type": "check-valve", "ports": {"A": "line", "B": "supply", "X": "ram.A"}, "pilot_ratio": 3, **RATED},
                "reducing": {
                    "type": "reducing-valve", "ports": {"P": "supply", "A": "line", "T": "tank"}, "pressure": "58 bar", **RATED,
                },
                "compensator": {"type": "compensator", "ports": {"P": "supply", "A": "gap", "LS": "ls"}, **RATED},
                "valve": {
                    "type": "directional-valve", "ways": "4/3", "centre": "open", "overlap": 0.05, "frequency": "20 Hz",
                    "ports": {"P": "gap", "T": "tank", "A": "ram.A", "B": "ram.B"}, "leakage": 1e-12,
                    "command": command, **RATED,
                },
                "slow": {
                    "type": "directional-valve", "ways": "3/2", "frequency": "5 Hz", "rate_limit": 4,
                    "ports": {"P": "line", "T": "tank", "A": "swing.A"}, "command": 0.8, **RATED,
                },
                "notched": {
                    "type": "spool-valve", "ports": {"P": "supply", "A": "line", "T": "tank"}, "frequency": "30 Hz",
                    "edges": {
                        "PA": {
                            "flows": [
                                {
                                    "of": "position", "points": [0, 0.5, 1], "values": [0, "8 L/min", "20 L/min"],
                                    "interpolation": "monotone",
                                },
                                {"of": "position", "points": [0, 1], "values": [0, "30 L/min"]},
                            ],
                            "pressure_drops": ["5 bar", "60 bar"],
                        },
                        "AT": {"notches": [{"shape": "triangle", "angle": "60 deg", "begins": -0.05}]},
                    },
                    "current": "0.4 + 0.1*sin(40*time)", "stroke": "5 mm", "hysteresis": 0.01, "dead_band": 0.01,
                    "solenoid": {
                        "force": {"of": "current", "points": [0, 0.8], "values": [0, "60 N"]}, "spring": "10 N/mm", "preload": "5 N",
                        "friction": "0.5 N", "transition_speed": 0.5,
                    },
                },
                "ridden": {
                    "type": "spool-valve", "ports": {"P": "supply", "A": "line"}, "coordinate": "rail", "stroke": "0.5 m",
                    "edges": {"PA": {"area": {"of": "position", "points": [-1, 1], "values": ["10 mm^2", "25 mm^2"]}, "jet_angle": 0.6}},
                },
                "section": {
                    "type": "section", "compensation": "post", "command": 0.4, "inner_volume": "20 cm^3", "margin": "2 bar",
                    "ports": {"P": "supply", "T": "tank", "A": "line", "B": "swing.B", "LS": "ls"}, **RATED,
                },
                "float": {
                    "type": "section", "open_centre": "parallel", "command": -0.9, "inner_volume": "20 cm^3", "float_from": 0.85,
                    "ports": {"P": "supply", "N": "supply", "C": "line", "T": "tank", "A": "line", "B": "swing.B"},
                    "regeneration": "B", "holding": "A", "flow": "20 L/min", "pressure_drop": "100 bar",
                },
                "hold": {
                    "type": "counterbalance-valve", "ports": {"L": "mast.A", "V": "line", "X": "supply"},
                    "opens_at": "180 bar", **RATED,
                },
                "leak": {"type": "orifice", "ports": {"A": "swing.B", "B": "tank"}, "diameter": "2 mm", "opening": "0.5 + time"},
                "waves": {"type": "line", "model": "delay", "ports": {"A": "line", "B": "tank"}, "diameter": "8 mm", "length": 30},
                "pipe": {"type": "pipe", "ports": {"A": "line", "B": "tank"}, "diameter": "8 mm", "length": 3},
                "hose": {"type": "pipe", "ports": {"A": "supply", "B": "line"}, "diameter": "8 mm", "length": 5, "inertia": True},
                "ram": {
                    "type": "cylinder", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]], "piston": "50 mm",
                    "rod": "30 mm", "stroke": 0.4, "retracted_length": 0.59, "cushion_A": CUSHION, "cushion_B": CUSHION,
                    "friction": {"sliding": "100 N", "by_pressure": 0.01, "static": 1.3, "viscous": 200},
                    "start_A": "60 bar", "start_B": "40 bar",
                },
                "mast": {
                    "type": "telescopic-cylinder", "bodies": ["ground", "top"], "points": [[0, 0, 0], [0, 0, 0.6]],
                    "stages": [0.06, 0.04], "strokes": [0.099, 0.3], "retracted_length": 0.5,
                },
                "swing": {
                    "type": "rotary-actuator", "coordinate": "axle.angle", "displacement": "50 cm^3/rad", "lower": "-1 rev",
                    "upper": "1 rev", "start_A": "30 bar", "start_B": "20 bar",
                },
                "motor": {
                    "type": "hydraulic-motor", "ports": {"A": "line", "B": "tank"}, "displacement": "10 cm^3/rev",
                    "coordinate": "axle.angle", "setting": 0.7,
                },
            },
            "states": {"filter": {"rate": "ram.force*1e-6 + valve.flow_PA - filter.value"}},
        }
    )  # fmt: skip


def machine_whose_commands_wait():
    """The same with a constant command and no state beside those of circuits: their derivatives are found by hand."""
    return Machine.from_record(machine_with_circuits(command=0.4).record.replace(states=()))


def machine_with_warm_oil():
    """A block on a slide, pushed by a cylinder with warm oil out of a reservoir, with a cooler, a hose in segments, and nitrogen."""
    return machine(
        {
            "bodies": {"block": solid(100.0, 2.0, position=[0.6, 0, 0], velocity=[0.2, 0, 0])},
            "joints": {"rail": slide("ground", "block", point=[0.6, 0, 0])},
            "fluids": {"oil": {"grade": "HLP 46", "isothermal": False}},
            "hydraulics": {
                "sump": {"type": "reservoir", "volume": "8 L", "oil": "6 L", "heat_conductance": 10},
                "supply": {"type": "volume", "volume": "0.3 L", "start": "100 bar", "heat_conductance": 5},
                "drain": {"type": "tank", "pressure": "1 bar", "temperature": "330 + 10*time"},
                "back": {"type": "volume", "volume": "0.2 L"},
                "store": {
                    "type": "accumulator", "ports": {"A": "supply"}, "volume": "1 L", "precharge": "80 bar", "start": "98 bar",
                    "gas": "nitrogen", "thermal_time": "1 s", "piston_friction": "0.5 bar", **RATED,
                },
                "pump": {
                    "type": "pump", "ports": {"A": "sump", "B": "supply"}, "displacement": "28 cm^3/rev", "speed": "1500 rpm",
                    "volumetric_efficiency": 0.95, "mechanical_efficiency": 0.9, "nominal_pressure": "200 bar",
                    "nominal_speed": "1500 rpm",
                },
                "relief": {
                    "type": "relief-valve", "ports": {"P": "supply", "T": "back"}, "opens_at": "150 bar", "opening_range": "20 bar",
                    **RATED,
                },
                "line": {
                    "type": "line", "ports": {"A": "supply", "B": "ram.A"}, "diameter": "10 mm", "length": 2, "segments": 2,
                },
                "throttle": {"type": "orifice", "ports": {"A": "supply", "B": "back"}, "leakage": 1e-12, "flow": "20 L/min",
                             "pressure_drop": "90 bar"},
                "cooler": {
                    "type": "cooler", "ports": {"A": "back", "B": "sump"}, "heat_conductance": "50 + 0.1*sump.temperature", **RATED,
                },
                "pipe": {"type": "pipe", "ports": {"A": "ram.B", "B": "drain"}, "diameter": "8 mm", "length": 1},
                "ram": {
                    "type": "cylinder", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]], "piston": "50 mm",
                    "rod": "30 mm", "stroke": 0.4, "retracted_length": 0.4, "start_A": "60 bar", "start_B": "30 bar",
                    "seal_leakage": 1e-13, "heat_conductance": 3,
                },
            },
        }
    )  # fmt: skip


GAS_RATED = {"sonic_conductance": "2 dm^3/(s*bar)"}


def machine_with_gas():
    """A block on a slide, pushed by a cylinder with cushions between warm and isothermal chambers of valves, tanks and a line."""
    cushion = {"length": "60 mm", **GAS_RATED}
    return machine(
        {
            "bodies": {"block": solid(20.0, 2.0, position=[0.6, 0, 0], velocity=[0.2, 0, 0])},
            "joints": {"rail": slide("ground", "block", point=[0.6, 0, 0])},
            "fluids": {"air": {"type": "ideal-gas"}, "calm": {"type": "ideal-gas", "isothermal": True, "temperature": 310}},
            "hydraulics": {
                "supply": {"type": "tank", "pressure": "7 bar", "fluid": "air"},
                "room": {"type": "tank", "fluid": "air"},
                "line": {"type": "volume", "volume": "0.2 L", "start": "5 bar", "heat_conductance": 0.5, "fluid": "air"},
                "valve": {
                    "type": "directional-valve", "ways": "5/3", "centre": "float", "frequency": "20 Hz", "leakage": 1e-12,
                    "ports": {"P": "line", "A": "ram.A", "B": "ram.B", "R": "room", "S": "room"},
                    "command": "0.3 + 0.5*rail.displacement + 1e-7*line.pressure", **GAS_RATED,
                },
                "regulator": {"type": "reducing-valve", "ports": {"P": "supply", "A": "line"}, "pressure": "6 bar", **GAS_RATED},
                "safety": {
                    "type": "relief-valve", "ports": {"P": "ram.A", "T": "room"}, "opens_at": "1 bar", "opening_range": "2 bar",
                    "lag": "5 ms", **GAS_RATED,
                },
                "leak": {"type": "orifice", "ports": {"A": "ram.B", "B": "room"}, "diameter": "1 mm", "opening": "0.5 + time"},
                "ram": {
                    "type": "cylinder", "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]], "piston": "50 mm",
                    "rod": "20 mm", "stroke": 0.4, "retracted_length": 0.57, "cushion_A": cushion, "cushion_B": cushion,
                    "heat_conductance": 1, "start_A": "4 bar", "start_B": "3 bar", "fluid": "air",
                },
                "box": {"type": "volume", "volume": "0.3 L", "start": "2 bar", "fluid": "calm"},
                "outside": {"type": "tank", "fluid": "calm"},
                "hose": {
                    "type": "tube", "ports": {"A": "line", "B": "cup"}, "diameter": "4 mm", "length": 2, "segments": 2,
                    "bends": 1.5, "heat_transfer": 40, "start": "3 bar", "fluid": "air",
                },
                "cup": {
                    "type": "volume", "volume": "0.1 L", "start": "0.9 bar", "heat_transfer": 50, "surface": 0.02, "fluid": "air",
                },
                "jet": {
                    "type": "ejector", "ports": {"P": "supply", "A": "cup", "R": "room"}, "sonic_conductance": 2e-9,
                    "vacuums": [0, 4e4, 8e4], "suction_flows": [1e-3, 6e-4, 0],
                },
                "check": {"type": "check-valve", "ports": {"A": "box", "B": "outside"}, **GAS_RATED},
            },
        }
    )  # fmt: skip
