"""Derivatives of a circuit by hand, component by component: each touches a few pressures and states, so that all together cost less than
one evaluation.

    ẋ = g(x, s, ṡ, t)        e = e(x, s, ṡ)

x are the states of the circuit, s the coordinates on which its pistons and motors act with the efforts e. Restrictions have secants in
place of tangents (see `nivel.kernels.hydraulics.smooth`). Left out are what changes slowly against a step: densities in flows, areas of
telescopes, cushions, commands that depend on the motion.
"""

from __future__ import annotations

from nivel.kernels.hydraulics import load_signal, pipe, piston, restriction, rotary, spool
from nivel.kernels.hydraulics.fluid import DENSITY
from nivel.kernels.hydraulics.volume import GIVE, MASS, RATE
from nivel.kernels.record.hook import call_family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import leaf

# Numbers of families in `CircuitTangent.family`; a component states those of its families in `slopes` of its `ComponentKind`. Families from
# OTHERS on have a family of their own that adds their slopes; the addresses of these are the last ones of the hooks, in the same order.
DISPLACE, GUIDE, PRESS, MOVE, LIFT, SIGNAL, SETTING, TURN, RESTRICT, PIPE = range(10)
OTHERS = 10


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
def find_node_slopes(machine):
    """Slopes of the pressures of volumes with masses and strokes."""
    circuit = record_at(machine).circuit
    tangent = circuit.tangent
    tangent.by_stroke[:, :] = 0.0
    if tangent.family[DISPLACE] != NONE:
        piston.add_slopes_of_rooms(machine, tangent.family[DISPLACE])
    for node in range(circuit.node.shape[0]):
        if circuit.node[node, 1] == NONE:
            continue
        soft = softness(circuit, node)
        tangent.by_mass[node] = slope_by_mass(circuit, node)
        for c in range(tangent.coordinate.shape[0]):
            tangent.by_stroke[node, c] *= -soft


@leaf
def find_slopes(machine, t):
    """Fill `slopes` of the rates of states, and `effort`, in the state last evaluated."""
    tangent = record_at(machine).circuit.tangent
    family = tangent.family
    tangent.slopes[:, :] = 0.0
    tangent.effort[:, :] = 0.0
    find_node_slopes(machine)
    if family[GUIDE] != NONE:
        piston.add_slopes_of_guides(machine, family[GUIDE])
    if family[PRESS] != NONE:
        piston.add_slopes_of_pressing(machine, family[PRESS])
    if family[MOVE] != NONE:
        spool.add_slopes_of_spools(machine, family[MOVE])
    if family[LIFT] != NONE:
        spool.add_slopes_of_poppets(machine, family[LIFT], t)
    if family[SIGNAL] != NONE:
        load_signal.add_slopes(machine, family[SIGNAL])
    if family[SETTING] != NONE:
        rotary.add_slopes_of_settings(machine, family[SETTING])
    if family[TURN] != NONE:
        rotary.add_slopes(machine, family[TURN], t)
    if family[RESTRICT] != NONE:
        restriction.add_slopes(machine, family[RESTRICT], t)
    if family[PIPE] != NONE:
        pipe.add_slopes(machine, family[PIPE])
    address = record_at(machine).hooks.address
    behind = address.shape[0] - family.shape[0]
    for k in range(OTHERS, family.shape[0]):
        call_family(address[behind + k], machine, family[k], t)
