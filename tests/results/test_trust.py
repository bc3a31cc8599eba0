"""Every number of a trust report is what the histories say, and every threshold decides on the side it should."""

import json
from dataclasses import replace

import numpy as np
import pytest

import synthetic_run as pendulum
from nivel.judge.after.checks.accuracy import MARGIN, Accuracy, Verified, error_from_finer
from nivel.judge.after.checks.flexible import Cost
from nivel.judge.after.checks.joints import Redundancy
from nivel.judge.after.checks.quantities import QuantityError
from nivel.judge.after.report import assess, blindness, thresholds_of
from nivel.judge.after.subject import Scales, Subject
from nivel.results import Memory
from nivel.results.trust import Item, Trust

TIME = np.linspace(0.0, 2.0, 201)


def run(time=TIME, attributes=None, **histories):
    memory = Memory()
    memory.begin(pendulum.header(**(attributes or {})))
    memory.take(pendulum.packed(time, {**pendulum.histories(time), **histories}))
    return memory.result()


THRESHOLDS = thresholds_of(run(), quiet=False)


def estimated(error, body, time, *, until=None, blind=""):
    """What a second run has found of the pendulum."""
    return Accuracy(error, body, time, "steps of 0.6 ms", until, blind, Scales(pendulum.SIZE, "machine's size"))


def item(trust, name):
    return next(each for each in trust.items if each.name == name)


def spike(columns, row, frame, value):
    out = np.zeros((len(TIME), columns))
    out[frame, row] = value
    return out


def test_the_scales_are_those_of_the_machine():
    trust = pendulum.judged(run())
    kinetic = pendulum.histories(TIME)["kinetic_energy"].max()
    assert trust.energy_scale == kinetic
    assert trust.energy_scale_kind == "largest kinetic energy"
    assert trust.size == pytest.approx(pendulum.SIZE, rel=1e-14)
    # the velocity of the centre of mass and, as an upper bound, the joint point 0.5 m from it
    assert trust.speed == pytest.approx(2 * 0.5 * np.abs(pendulum.histories(TIME)["joint_rate"]).max(), rel=1e-12)


def test_a_designer_reads_numbers_scales_and_thresholds():
    trust = pendulum.judged(
        run(kinetic_energy=np.full(len(TIME), 812.0), energy_error=np.full(len(TIME), 3.1e-9 * 812))
    )
    text = "Energy: error 3.1e-9 of the largest kinetic energy 812 J (green below 1e-4, amber below 1e-2)"
    assert item(trust, "energy").text == text
    assert item(trust, "violation").text == (
        "Joints: open by at most 4e-9 m, 8e-9 of the machine's size 0.5 m, row hinge.s.y at t = 2 s "
        "(green below 1e-6, amber below 1e-4)"
    )


@pytest.mark.parametrize(
    ("factor", "verdict"), [("green", "green"), ("amber", "amber"), ("beyond", "red"), ("nan", "red"), ("inf", "red")]
)
@pytest.mark.parametrize("name", list(THRESHOLDS))
def test_thresholds_decide_on_each_side(name, factor, verdict):
    limits = THRESHOLDS[name]
    near = 1e-9
    fraction = {
        "green": limits.green * (1 - near),
        "amber": limits.green * (1 + near),
        "beyond": limits.amber * (1 + near),
        "nan": np.nan,
        "inf": np.inf,
    }[factor]
    reference = pendulum.judged(run())
    histories, accuracy, neglected, quantities = {}, None, None, []
    match name:
        case "energy":
            histories["energy_error"] = spike(1, 0, 77, -fraction * reference.energy_scale)
        case "violation":
            histories["constraint_violation"] = spike(5, 2, 77, -fraction * reference.size)
        case "rate_violation":
            histories["constraint_rate_violation"] = spike(5, 2, 77, -fraction * reference.speed)
        case "accuracy":
            accuracy = estimated(fraction * reference.size, "arm", float(TIME[77]))
        case "neglected":
            neglected = Cost(fraction, "arm", ("I5", "I9"), TIME[77])
        case "quantities":
            quantities = [
                QuantityError("speeds", "velocity of arm", 3.0 * fraction, fraction, 1.0, "m/s", 4.0 * fraction)
            ]
    given = (
        {"accuracy": accuracy} if accuracy else {"neglected": neglected} if neglected else {"quantities": quantities}
    )
    trust = pendulum.judged(run(**histories), **given)
    found = item(trust, name)
    assert found.verdict == verdict
    assert found.time == (None if quantities else TIME[77])
    assert (found.green, found.amber) == (limits.green, limits.amber)
    assert trust.verdict == verdict
    np.testing.assert_allclose(found.fraction, fraction, rtol=1e-12)


def test_cosines_are_not_compared_with_metres():
    # hinge.d1.xz (a cosine) is off by 3e-7, hinge.s.x by 2e-7 m of 0.5 m = 4e-7: the smaller number is the larger fault
    violation = spike(5, 3, 10, 3e-7) + spike(5, 0, 20, 2e-7)
    trust = pendulum.judged(run(constraint_violation=violation), degrees=None)
    assert (trust.constraint_violation_row, trust.constraint_violation_max) == ("hinge.s.x", 2e-7)
    trust = pendulum.judged(run(constraint_violation=spike(5, 3, 10, 2e-6)), degrees=None)
    assert (trust.constraint_violation_units, item(trust, "violation").fraction) == ("1", 2e-6)
    assert "as a cosine" in item(trust, "violation").text
    trust = pendulum.judged(run(constraint_rate_violation=spike(5, 3, 10, 1e-3)), degrees=None)
    assert trust.constraint_rate_violation_units == "1/s"
    assert item(trust, "rate_violation").fraction == pytest.approx(1e-3 * trust.size / trust.speed)


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("potential_energy", "largest change of potential energy"),
        ("external_work", "largest work of external forces"),
        ("dissipated_energy", "largest dissipated energy"),
    ],
)
def test_the_energy_scale_is_the_largest_energy_that_moved(name, kind):
    offset = 1e6 if name == "potential_energy" else 0.0  # where the zero of the height lies does not matter
    trust = pendulum.judged(run(**{name: offset + np.linspace(0.0, -50.0, len(TIME))}), degrees=None)
    assert trust.energy_scale == pytest.approx(50.0)
    assert trust.energy_scale_kind == kind
    assert kind in item(trust, "energy").text


def test_a_machine_at_rest_is_green():
    still = {name: np.zeros_like(values) for name, values in pendulum.histories(TIME).items()}
    still |= {"orientation": np.tile([1.0, 0, 0, 0], (len(TIME), 1)), "potential_energy": np.full(len(TIME), 1e6)}
    still |= {"energy_error": spike(1, 0, 3, 1e-10), "constraint_rate_violation": spike(5, 0, 3, 1e-17)}
    trust = pendulum.judged(run(**still))
    assert trust.verdict == "green"
    assert np.isfinite(item(trust, "energy").fraction)


def test_the_first_value_that_is_no_number_is_named():
    error = np.zeros(len(TIME))
    error[50:] = np.nan
    assert (
        "not a number from t = 0.5 s on"
        in item(pendulum.judged(run(energy_error=error), "failed", degrees=None), "energy").text
    )


@pytest.mark.parametrize(
    ("outcome", "verdict"), [("done", "green"), ("interrupted", "amber"), ("running", "amber"), ("failed", "red")]
)
def test_an_unfinished_run_is_not_green(outcome, verdict):
    trust = pendulum.judged(run(), outcome, failure="stopped at t = 2 s")
    assert trust.verdict == verdict
    assert trust.items[0].text.endswith(": stopped at t = 2 s")


def test_redundant_rows_leave_the_motion_unique_but_not_the_reactions():
    trust = pendulum.judged(run(), redundancy=Redundancy(("hinge.d1.xz",), ("hinge", "pin")))
    found = item(trust, "redundancy")
    assert (found.verdict, trust.verdict) == ("amber", "green")
    assert "(hinge.d1.xz)" in found.text
    assert "hinge, pin" in found.text
    assert item(pendulum.judged(run(), redundancy=Redundancy()), "redundancy").verdict == "green"


def test_a_machine_that_cannot_move_is_amber():
    assert item(pendulum.judged(run(), degrees=0), "degrees_of_freedom").verdict == "amber"
    assert item(pendulum.judged(run(), degrees=3), "degrees_of_freedom").text.startswith(
        "Freedom: 3 degrees of freedom"
    )


def test_every_threshold_is_printed_and_has_a_reason():
    neglected = Cost(1e-9, "arm", ("I5",), 1.0)
    quantities = [QuantityError("pressures", "pump.pressure", 2e4, 1e3, 1e7, "Pa", 3e4)]
    trust = pendulum.judged(run(), accuracy=estimated(1e-9, "arm", 1.0), neglected=neglected, quantities=quantities)
    for name, threshold in THRESHOLDS.items():
        assert str(threshold) in item(trust, name).text
        assert len(threshold.reason) > 60
    assert str(THRESHOLDS["energy"]) == "green below 1e-4, amber below 1e-2"


@pytest.mark.parametrize("value", [1e-9, np.nan, np.inf])
def test_json_out_and_in_changes_nothing(value):
    given = {"redundancy": Redundancy(("a.s.x",), ("a",)), "accuracy": estimated(1e-5, "arm", 0.5)}
    trust = pendulum.judged(run(energy_error=spike(1, 0, 4, value)), **given)
    text = trust.to_json()
    json.loads(text, parse_constant=lambda name: pytest.fail(f"{name} is not JSON"))
    assert str(Trust.from_json(text)) == str(trust)
    assert repr(Trust.from_json(text)) == repr(trust)


def test_the_headline_tells_the_worst_number_beside_positions():
    pressures = QuantityError("pressures", "pump.pressure", 2e4, 1e3, 1e7, "Pa", 3e4)
    speeds = QuantityError("speeds", "velocity of arm", 1e-6, 1e-7, 1.0, "m/s", 1e-6)
    near = estimated(3.1e-6, "arm", 7.2)
    trust = pendulum.judged(run(), accuracy=near, quantities=[speeds, pressures])
    motion = "within 3.1e-6 m of the exact motion of this model; largest at arm, t = 7.2 s"
    assert trust.headline == f"{motion}; pressures within 0.3 bar (pump.pressure most)"
    # what is round-off of its range is not told
    trust = pendulum.judged(run(), accuracy=near, quantities=[replace(speeds, error=1e-10, largest=1e-10)])
    assert trust.headline == motion


def test_a_headline_does_not_contradict_a_red_line():
    wrong = QuantityError("user states", "state.b", 1.2, 0.7, 1.9, "1", 1.2)
    exact = estimated(0.0, "arm", 0.0)
    assert pendulum.judged(run(), accuracy=exact).headline == "exact for this model, except for round-off"
    off = pendulum.judged(run(), accuracy=exact, quantities=[wrong])
    assert off.headline == "user states off by up to 1.2 (state.b most); bodies exact, except for round-off"
    assert off.verdict == "red"
    energy = spike(1, 0, 7, 1e3)
    trust = pendulum.judged(run(energy_error=energy), accuracy=estimated(1e-9, "arm", 1.0))
    assert trust.headline == "of unknown error: two runs agree within 1e-9 m, but the line Energy is red"


def test_json_of_a_later_version_is_read():
    data = json.loads(pendulum.judged(run()).to_json())
    data["something_new"] = 1
    data["items"][0]["something_new"] = 2
    assert Trust.from_json(json.dumps(data)) == pendulum.judged(run())


def test_json_has_the_agreed_keys():
    data = json.loads(pendulum.judged(run()).to_json())
    agreed = "energy_error_max energy_scale constraint_violation_max constraint_violation_row constraint_violation_time"
    agreed += " constraint_rate_violation_max degrees_of_freedom redundant_rows non_unique_joints accuracy_estimate"
    assert set(agreed.split()) <= set(data)


def test_an_analysis_without_frames_has_a_report_too():
    trust = assess(Subject(outcome="failed", failure="nothing to look at"))
    assert (trust.verdict, str(trust)) == ("red", "  red  Outcome: failed: nothing to look at")
    assert Trust.from_json(trust.to_json()) == trust


# keys of version 0.2.0, and of those before
EARLIER = [
    "verdict",
    "outcome",
    "energy_error_max",
    "energy_error_time",
    "energy_scale",
    "energy_scale_kind",
    "size",
    "speed",
    "constraint_violation_max",
    "constraint_violation_row",
    "constraint_violation_time",
    "constraint_violation_units",
    "constraint_rate_violation_max",
    "constraint_rate_violation_row",
    "constraint_rate_violation_time",
    "constraint_rate_violation_units",
    "degrees_of_freedom",
    "position_freedoms",
    "drivers",
    "redundant_rows",
    "non_unique_joints",
    "accuracy_estimate",
    "accuracy_body",
    "accuracy_time",
    "accuracy_refinement",
    "verified_until",
    "verification_ended",
    "size_kind",
    "at_rest",
    "modes",
    "neglected_share",
    "neglected_body",
    "neglected_names",
    "neglected_time",
    "undetermined_efforts",
    "unresolved_force",
    "unresolved_work",
    "unresolved_time",
    "items",
]


@pytest.mark.parametrize("blind", ["", "their steps miss push.vector.x"])
@pytest.mark.parametrize("worst", [1e-9, np.nan, np.inf])
def test_the_report_of_an_earlier_version_is_read(worst, blind):
    given = {"accuracy": estimated(1e-5, "arm", 0.5, blind=blind), "redundancy": Redundancy(("a.s.x",), ("a",))}
    trust = pendulum.judged(run(energy_error=spike(1, 0, 4, worst)), **given)
    data = json.loads(trust.to_json())
    earlier = Trust.from_json(json.dumps({key: data[key] for key in EARLIER}))
    assert str(earlier) == str(trust)
    assert earlier.headline == trust.headline
    assert blind in earlier.headline
    kept = [key for key in EARLIER if key not in ("items", "verdict", "outcome")]
    assert repr([getattr(earlier, key) for key in kept]) == repr([getattr(trust, key) for key in kept])


def test_a_finer_run_finds_the_worst_body_and_time():
    moved = pendulum.histories(TIME)["position"].copy()
    moved[77, 0, 1] += 15e-6
    peak = error_from_finer(run(position=moved), run(), 1 / 16)
    assert peak.value == pytest.approx(MARGIN * 16e-6)  # 15/16 of the error of the coarser run is seen
    assert (peak.row, peak.time) == ("arm", TIME[77])


def test_what_was_not_verified_says_so_and_what_was_says_how_exact():
    assert pendulum.judged(run()).headline == "not verified"
    found = pendulum.judged(run(), accuracy=estimated(3.1e-6, "rod", 7.2))
    assert found.headline == "within 3.1e-6 m of the exact motion of this model; largest at rod, t = 7.2 s"
    assert "by a second run with steps of 0.6 ms; largest at rod, t = 7.2 s" in item(found, "accuracy").text


def test_what_two_runs_miss_alike_is_no_exactness():
    """A load between the steps of both: the headline claims nothing, and neither does the item."""
    missed = Item("loads", "red", "Loads: …", 1.0, row="push.vector.x")
    trust = pendulum.judged(run(), accuracy=estimated(1e-9, "rod", 0.5, blind=blindness((missed,))))
    assert trust.headline == "of unknown error: two runs agree within 1e-9 m, but their steps miss push.vector.x"
    assert "within 1e-9 m, but both may have the same error" in item(trust, "accuracy").text
    assert "exact motion" not in str(trust)


def test_verification_that_ends_early_is_amber_and_says_up_to_when():
    accuracy, verified = estimated(1e-9, "rod", 0.5, until=0.7), Verified(0.7, "its time was spent")
    trust = pendulum.judged(run(), accuracy=accuracy, verified=verified)
    assert trust.verdict == "amber"
    assert "up to t = 0.7 s, not verified beyond" in trust.headline
    assert "its time was spent" in item(trust, "verified").text
    assert Trust.from_json(trust.to_json()) == trust


def test_a_finer_run_sees_a_rotor_whose_origin_rests():
    turned = -pendulum.histories(TIME)["orientation"]  # θ and -θ are the same orientation
    angle = 1e-5
    half = np.array([np.cos(angle / 2), 0.0, 0.0, np.sin(angle / 2)])
    c, s = turned[10, 0, 0], turned[10, 0, 3]
    turned[10, 0] = [c * half[0] - s * half[3], 0.0, 0.0, c * half[3] + s * half[0]]
    peak = error_from_finer(run(orientation=turned), run(), 1 / 2)
    assert peak.value == pytest.approx(MARGIN * 2.0 * angle * pendulum.SIZE, rel=1e-6)
    assert peak.time == TIME[10]


def test_a_finer_run_is_compared_at_equal_times():
    finer = np.linspace(0.0, 2.0, 401)
    assert error_from_finer(run(), run(finer), 1 / 16).value < 4e-15
    assert error_from_finer(run(), run(finer[:200]), 1 / 16).value < 4e-15  # a finer run that stopped early


def assessed(length, mass, duration, error):
    """The pendulum in other units of length, mass and time, with an energy error of the fraction `error`."""
    histories = pendulum.histories(TIME)
    energy = mass * length**2 / duration**2
    rows = np.array([length if units == "m" else 1.0 for units in pendulum.ROWS.values()])
    factors = {"position": length, "velocity": length / duration, "angular_velocity": 1.0 / duration}
    factors |= {"kinetic_energy": energy, "potential_energy": energy, "joint_force": energy / length}
    factors |= {"constraint_violation": rows, "constraint_rate_violation": rows / duration}
    scene = pendulum.scene()
    scene["bodies"][0]["points"] = [[-length * pendulum.LENGTH, 0, 0]]
    other = {name: values * factors.get(name, 1.0) for name, values in histories.items()}
    other["energy_error"] = np.full(len(TIME), error * energy * histories["kinetic_energy"].max())
    return pendulum.judged(run(TIME * duration, {"scene": json.dumps(scene)}, **other))


@pytest.mark.parametrize(("error", "verdict"), [(1e-9, "green"), (1e-3, "amber"), (1.0, "red")])
@pytest.mark.parametrize("units", [(1e-6, 1e-15, 1e-3), (1e-9, 1e-20, 1e-9), (1e3, 1e9, 1e6)])
def test_a_machine_of_any_size_mass_and_pace_has_the_same_verdicts(units, error, verdict):
    plain, other = assessed(1.0, 1.0, 1.0, error), assessed(*units, error)
    assert other.verdict == plain.verdict == verdict
    fractions = [[each.fraction for each in trust.items if each.fraction is not None] for trust in (plain, other)]
    np.testing.assert_allclose(*fractions, rtol=1e-9)


def still(**histories):
    """Histories of a machine in which nothing is, moves or happens."""
    nothing = {name: np.zeros_like(values) for name, values in pendulum.histories(TIME).items()}
    return nothing | {"orientation": np.tile([1.0, 0, 0, 0], (len(TIME), 1))} | histories


def test_where_there_is_no_energy_only_no_error_is_none():
    found = item(pendulum.judged(run(**still())), "energy")
    assert (found.verdict, found.fraction) == ("green", 0.0)
    assert "no energy anywhere, and no error" in found.text
    found = item(pendulum.judged(run(**still(energy_error=spike(1, 0, 3, 1e-30)))), "energy")
    assert found.verdict == "red"
    assert "error 1e-30 J where there is no energy" in found.text


def test_round_off_of_a_loaded_machine_at_rest_is_green_at_any_height():
    load = np.tile([0.0, 20.0, 0.0], (len(TIME), 1))
    trust = pendulum.judged(run(**still(joint_force=load, energy_error=spike(1, 0, 3, 1e-15))))
    assert item(trust, "energy").verdict == "green"
    assert trust.energy_scale == pytest.approx(1e-9 * 20.0 * pendulum.SIZE)


def test_a_machine_at_rest_is_said_to_be():
    trust = pendulum.judged(run(**still(constraint_rate_violation=spike(5, 0, 3, 1e-17))))
    assert trust.at_rest
    assert "the machine is at rest" in item(trust, "rate_violation").text
    assert "largest speed" not in item(trust, "rate_violation").text
    assert not pendulum.judged(run()).at_rest
    assert "of the largest speed" in item(pendulum.judged(run()), "rate_violation").text


def test_a_single_point_is_compared_with_its_path_or_with_a_metre():
    scene = {"scene": json.dumps({"bodies": [{"name": "arm"}]})}
    off = spike(5, 0, 3, 1e-9)
    path = np.zeros((len(TIME), 1, 3))
    path[:, 0, 0] = 0.1 + 3e-6 * TIME
    trust = pendulum.judged(run(attributes=scene, position=path, constraint_violation=off))
    assert trust.size == pytest.approx(6e-6)
    assert "of the extent of its path 6e-6 m" in item(trust, "violation").text
    path[:, 0, 0] = 0.1 + 1e-17 * TIME  # round-off is no path
    trust = pendulum.judged(run(attributes=scene, position=path, constraint_violation=off))
    assert trust.size == 1.0
    assert "of the length taken for a single point at rest 1 m" in item(trust, "violation").text


def test_a_run_beyond_all_bounds_is_red_without_warnings():
    huge = pendulum.histories(TIME)["velocity"] * 1e300
    huge[7] = np.inf
    trust = pendulum.judged(
        run(velocity=huge, kinetic_energy=np.full(len(TIME), np.inf), energy_error=np.full(len(TIME), np.inf)),
        "failed",
        degrees=None,
    )
    assert trust.verdict == "red"
    position = pendulum.histories(TIME)["position"] * 1e300
    assert error_from_finer(run(position=position), run(), 1 / 16).value > 1e200


def test_angles_that_are_held_are_said_in_radians():
    """Rows of gears and of driven angles."""
    rows = {"constraint_units": json.dumps({**pendulum.ROWS, "hinge.d1.xz": "rad"})}
    trust = pendulum.judged(run(attributes=rows, constraint_violation=spike(5, 3, 10, 2e-6)), degrees=None)
    assert trust.constraint_violation_units == "rad"
    assert "open by at most 2e-6 rad, row hinge.d1.xz" in item(trust, "violation").text


@pytest.mark.parametrize(
    ("value", "text"),
    [(1.02e-4, "1.020e-4"), (0.00996, "0.00996"), (0.0100004, "1.000e-2"), (1e-4, "1e-4"), (3.21e-5, "3.2e-5")],
)
def test_an_amber_number_does_not_look_like_the_threshold_that_it_passes(value, text):
    assert THRESHOLDS["energy"].shown(value) == text
