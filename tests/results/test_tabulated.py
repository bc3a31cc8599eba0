"""Results of every kind by name, as files and as tables of pandas."""

import numpy as np
import pytest

import nivel
from example_files import EXAMPLES
from nivel.results.frames.tabulated import Tabulated

CRANK = str(EXAMPLES / "mechanisms" / "slider-crank.yaml")
PENDULUM = str(EXAMPLES / "mechanisms" / "simple-pendulum.yaml")


@pytest.fixture(scope="module")
def run():
    return nivel.load(PENDULUM).simulate(duration=0.2)


@pytest.fixture(scope="module")
def crank():
    return nivel.load(CRANK)


@pytest.fixture(scope="module")
def turn(crank):
    return crank.kinematics(drive="hinge", duration=1, positions=11)


@pytest.fixture(scope="module")
def kinds(run, crank, turn):
    """A result of every kind, and a column of its table: its name, numbers and unit."""
    efforts = crank.inverse(actuators="hinge", motion=turn)
    pendulum = nivel.load(PENDULUM)
    linear = pendulum.linearise(about="equilibrium")
    rest = pendulum.statics()
    return {
        "run": (run, "bob.position.x", run.array("bob.position")[:, 0], "m"),
        "statics": (rest, "bob.position.z", rest.array("bob.position")[:, 2], "m"),
        "kinematics": (turn, "hinge.angle", turn.array("hinge.angle"), "rad"),
        "inverse": (efforts, f"{efforts.actuators[0]}.effort", efforts.effort[:, 0], efforts.units[0]),
        "linear": (linear, "natural_frequency", [each.natural_frequency for each in linear.modes], "Hz"),
    }


KINDS = ["run", "statics", "kinematics", "inverse", "linear"]


@pytest.mark.parametrize("kind", KINDS)
def test_every_result_has_names_that_it_takes_and_completes(kinds, kind):
    result = kinds[kind][0]
    assert isinstance(result, Tabulated)
    assert len(result.keys()) > 1
    assert result._ipython_key_completions_() == list(result.keys())
    for name in result.keys()[:5]:
        assert np.array_equal(result[name].to_numpy(), result[name].values, equal_nan=True)
    with pytest.raises(nivel.ModelError, match="no_such"):
        result["no_such"]


@pytest.mark.parametrize("kind", KINDS)
def test_tables_have_the_numbers_and_their_units(kinds, kind):
    result, name, numbers, unit = kinds[kind]
    table = result.to_dataframe()
    np.testing.assert_array_equal(table[name].to_numpy(), np.asarray(numbers))
    assert table.attrs["units"][name] == unit
    assert set(table.attrs["units"]) == {table.index.name, *table.columns}
    alone = result.to_dataframe(select=[name])
    assert list(alone.columns) == [name]
    assert len(table.columns) > 1
    with pytest.raises(nivel.ModelError, match="no_such"):
        result.to_dataframe(select=["no_such"])


def test_a_table_takes_elements_and_patterns(run):
    positions = run.to_dataframe(select=["bob.position"])
    assert list(positions.columns) == [f"bob.position.{axis}" for axis in "xyz"]
    assert list(run.to_dataframe(select="bob.position.*").columns) == list(positions.columns)
    np.testing.assert_array_equal(positions.index.to_numpy(), run.time)
    assert positions.index.name == "time"


def test_a_saved_result_reads_back_equal_and_is_not_replaced_unasked(run, tmp_path):
    saved = run.save(tmp_path / "run.nc")
    read = nivel.open_result(saved)
    assert read.names == run.names
    for name in ("time", "bob.position", "joint_coordinate", "kinetic_energy"):
        np.testing.assert_array_equal(read.array(name), run.array(name))
    assert read.outcome == run.outcome == "done"
    assert read.trust.headline == run.trust.headline
    with pytest.raises(nivel.ModelError, match="exists"):
        run.save(saved)
    copied = read.save(tmp_path / "copy.nc")
    np.testing.assert_array_equal(nivel.open_result(copied).array("bob.position"), run.array("bob.position"))
    with pytest.raises(nivel.ModelError):
        read.save(saved)
    run.save(copied, force=True)


def test_without_pandas_one_is_told_what_to_install(run, monkeypatch):
    import sys

    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(nivel.ModelError, match="pip install pandas"):
        run.to_dataframe()


def test_results_that_move_are_animated_in_notebooks(kinds):
    for kind in ("run", "kinematics", "statics"):
        assert "<iframe" in kinds[kind][0].animate(height=200)._repr_html_()
    assert "<iframe" in kinds["linear"][0].animate(1)._repr_html_()


def test_a_table_without_numbers_cannot_be_made():
    class Nothing(Tabulated):
        pass

    with pytest.raises(TypeError, match="to_xarray"):
        Nothing()
