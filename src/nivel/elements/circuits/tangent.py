"""Derivatives of a circuit by hand, family by family: each touches a few pressures and states, so that all together cost less than one
evaluation.

    ẋ = g(x, s, ṡ, t)        e = e(x, s, ṡ)

x are the states of the circuit, s the coordinates on which its pistons and motors act with the efforts e. Restrictions have secants in
place of tangents (see `nivel.elements.circuits.smooth`). Left out are what changes slowly against a step: densities in flows, areas of
telescopes, cushions, commands that depend on the motion. What adds the slopes of a family stands beside it
(`nivel.elements.circuits.kind.slopes_of`).
"""

from nivel.elements.circuits.density import DENSITY
from nivel.elements.circuits.volumes import GIVE, MASS, RATE
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf


@leaf
def softness(circuit, node):
    """-∂p/∂V [Pa/m³] of a volume, for its mass and room last evaluated."""
    known, density = circuit.known[node], circuit.fluid[circuit.node[node, 0], DENSITY]
    return 1.0 / (known[GIVE] - known[MASS] * known[RATE] / density)


@leaf
def slope_by_mass(circuit, node):
    """∂p/∂m [Pa/kg] of a volume, for its mass and room last evaluated."""
    return softness(circuit, node) / circuit.density[node]


@leaf
def add_by_pressure(circuit, row, node, slope):
    """Add to a row of slopes `slope` times that of the pressure of a node: it follows from a mass and from pistons, or is a state."""
    tangent, state = circuit.tangent, circuit.node[node, 1]
    if state != NONE:
        row[tangent.unknown[state]] += slope * tangent.by_mass[node]
        first = tangent.state.shape[0]
        for c in range(tangent.coordinate.shape[0]):
            row[first + c] += slope * tangent.by_stroke[node, c]
    elif tangent.signal[node] != NONE:
        row[tangent.signal[node]] += slope


@leaf
def add_flow_by_pressure(circuit, a, b, node, slope):
    """The mass flow from node a to node b grows by `slope` [kg/s/Pa] with the pressure of a node."""
    tangent = circuit.tangent
    if circuit.node[a, 1] != NONE:
        add_by_pressure(circuit, tangent.slopes[tangent.unknown[circuit.node[a, 1]]], node, -slope)
    if circuit.node[b, 1] != NONE:
        add_by_pressure(circuit, tangent.slopes[tangent.unknown[circuit.node[b, 1]]], node, slope)


@leaf
def add_flow_by_column(circuit, a, b, column, slope):
    """The mass flow from node a to node b grows by `slope` with what a column of slopes stands for."""
    tangent = circuit.tangent
    if circuit.node[a, 1] != NONE:
        tangent.slopes[tangent.unknown[circuit.node[a, 1]], column] -= slope
    if circuit.node[b, 1] != NONE:
        tangent.slopes[tangent.unknown[circuit.node[b, 1]], column] += slope


@leaf
def find_slopes(machine, t):
    """Fill `slopes` of the rates of states, and `effort`, in the state last evaluated.

    Addresses of what adds them are the last ones of the hooks. Chambers are the first family, and give `by_stroke`.
    """
    record = record_at(machine)
    circuit, address = record.circuit, record.hooks.address
    tangent = circuit.tangent
    tangent.slopes[:, :] = 0.0
    tangent.effort[:, :] = 0.0
    tangent.by_stroke[:, :] = 0.0
    for node in range(circuit.node.shape[0]):
        if circuit.node[node, 1] != NONE:
            tangent.by_mass[node] = slope_by_mass(circuit, node)
    behind = address.shape[0] - tangent.family.shape[0]
    for k in range(tangent.family.shape[0]):
        call_family(address[behind + k], machine, tangent.family[k], t)
