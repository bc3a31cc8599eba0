"""Where the variables of a frame stand, and whether its writer knows."""

from machines import slider_crank
from nivel.analysis.assembly.equations import equations
from nivel.kernels.output import observe
from nivel.system.layout import OF_MODES, VARIABLES, reported


def test_writer_numbers_variables_as_the_layout_does():
    names = [name for name, *_ in (*VARIABLES, *OF_MODES)]
    assert [getattr(observe, name.upper()) for name in names] == list(range(2, len(names) + 2))
    assert (observe.OUTPUTS, observe.STATES) == (0, 1)


def test_columns_of_the_writer_are_those_of_the_layout():
    system = equations(slider_crank()).system
    columns, outputs = system.record.outputs.column, len(system.record.outputs.value)
    for number, variable in enumerate(system.layout.variables[: len(VARIABLES)], start=2):
        assert columns[number] == variable.columns.start
    reports = reported(system.layout, outputs)
    assert [each.columns.start for each in reports] == list(range(columns[observe.OUTPUTS], system.layout.width))
