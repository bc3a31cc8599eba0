"""The numbers of one machine: what every kernel reads and where it leaves its result.

Capital counts in the comments: B bodies, M markers, Q coordinates, K constraint rows of the formulation (those of joints,
couplings and drivers, plus one normalisation row a body for *lagrange*), P parts and N blocks of C_q, E forces, X frictions.
Body B (the last, index nb) is the ground. Vectors are in global axes unless the name ends in `_b` (axes of the body).
Symbols: NOTATION.md.
"""

from __future__ import annotations

from typing import NamedTuple

from nivel.kernels.core.arrays import A1, F1, F2, F3, U1, U2, W1, W2, W3
from nivel.kernels.core.handle import reader
from nivel.kernels.record.beam_record import BeamTangent, PointInertia, SharedMass
from nivel.kernels.record.circuit_record import CircuitTangent
from nivel.kernels.record.flexible_record import Flexible, ModalTree
from nivel.kernels.record.implicit_record import Newton, Residual
from nivel.native.signature import Signature


class Bodies(NamedTuple):
    """Rigid bodies."""

    mass: F1  # (B,) [kg]
    centre_b: F2  # (B, 3) [m] centre of mass from the frame origin
    inertia_b: F3  # (B, 3, 3) [kg m²] about the centre of mass
    inertia_origin_b: F3  # (B, 3, 3) [kg m²] about the frame origin
    whitener_b: F3  # (B, 3, 3) inverse of the lower Cholesky factor of inertia_b
    inverse_root_mass: F1  # (B,) 1/√mass
    gravity: F1  # (3,) [m/s²]
    # work, for the state last evaluated
    R: W2  # (B+1, 3) [m] position of the frame origin
    theta: W2  # (B+1, 4) [-] Euler parameters, scalar first
    A: W3  # (B+1, 3, 3) [-] rotation matrix: columns are the body axes
    Rdot: W2  # (B+1, 3) [m/s]
    omega: W2  # (B+1, 3) [rad/s]
    omega_b: W2  # (B+1, 3) [rad/s]
    c: W2  # (B+1, 3) [m] centre of mass from the frame origin
    wrench: W2  # (B+1, 6) [N, N m] applied force, and torque about the frame origin
    Rddot: W2  # (B+1, 3) [m/s²]
    alpha_b: W2  # (B+1, 3) [rad/s²]


class Rotations(NamedTuple):
    """Three rotation coordinates a body, φ, of A = A(space) A(φ) A(body); all empty where the state has Euler parameters."""

    kind: U1  # (1,) EULER_ANGLES or ROTATION_VECTOR
    space: F2  # (B, 4) Euler parameters, constant: the axes from which φ turns, in global axes
    body: F2  # (B, 4) Euler parameters, constant: the body axes in those that φ turns
    turned_b: F3  # (B, 3, 3) columns are the axes that φ turns, in body axes: A(body)ᵀ
    # work
    theta: W2  # (B, 4) Euler parameters of A(φ)
    G: W3  # (B, 3, 3) Ḡ: ω̄ = Ḡ φ̇
    bias: W2  # (B, 3) [rad/s²] Ḡ̇ φ̇
    regularity: W1  # (B,) distance from the first singular position of the coordinates, zero there


class Markers(NamedTuple):
    """Frames fixed to bodies."""

    body: U1  # (M,)
    position_b: F2  # (M, 3) [m]
    frame_b: F3  # (M, 3, 3) [-]
    # work
    u: W2  # (M, 3) [m] from the frame origin of the body
    r: W2  # (M, 3) [m]
    A: W3  # (M, 3, 3) [-]
    rdot: W2  # (M, 3) [m/s]
    bias: W2  # (M, 3) [m/s²] acceleration of the point when the body's Rddot and alpha are zero


class Coordinates(NamedTuple):
    """Scalars measured between two markers, or more: joint coordinates, lengths of springs, what drivers prescribe.

    Each has a part for each marker: first marker, second marker, and of a slider on a beam all nodes of it.
    """

    what: U2  # (Q, 4) kind, first marker, second marker, axis; see `nivel.kernels.bodies.coordinate`
    active: U1  # those that constraints, forces or laws need
    start: U1  # (Q + 1,) first part of each, and behind the last
    part_marker: U1  # of each part
    station: (
        F1  # of each part: [m] place of a node along its unstressed beam, or radii of a wheel; numbers of a driven turn
    )
    followed: (
        U1  # those that are measured at every accepted state: angles, to count their turns, and places along beams
    )
    reference: F1  # (Q,) [rad or m] value at the last accepted state: they are followed from there
    # work, of the active ones
    value: W1  # (Q,) [m or rad]
    rate: W1  # (Q,)
    bias: W1  # (Q,) second derivative when the accelerations of the bodies are zero
    J: W2  # (parts + 2, 6) rate = Σ J[part] (ṙ, ω of the part's marker); the last two are work


class Constraints(NamedTuple):
    """Basic constraints, one table a kind, and their rows.

    Every row has parts: what multiplies the six velocities (ṙ, ω) of one marker.
    """

    s: U2  # (·, 4) first marker, second marker, first row, first part
    d1: U2  # (·, 6) first marker, its axis, second marker, its axis, row, part
    d2: U2  # (·, 5) first marker, its axis, second marker, row, part
    combination: U2  # (·, 9) row, first term, past the last, f or NONE, first part, past the last, g or NONE, first bend, past the last
    term: U2  # (·, 3) coordinate, place in term_part of the row's part for its first one (the others follow), function ∂g/∂q or NONE
    bend: U2  # (·, 3) coordinates i and j, function ∂²g/∂q_i∂q_j; of two different ones both orders stand here
    term_part: U1
    factor: F1  # (·,) of each term
    offset: F1  # (combinations,) Σ factor coordinate - offset - f(t) - g(coordinates) = 0
    motion: W1  # (combinations,) f'(t), work
    scale: F1  # (K,) what a violation is measured by: the length of the machine [m], or 1 for cosines and angles
    # work
    C: W1  # (K,)
    Cdot: W1  # (K,)
    gamma: W1  # (K + X,) right-hand side of C_q v̇ = γ; the last X are those of the extra rows of friction
    J: W2  # (P, 6) parts of the rows of C_q
    lam: W1  # (K,) multipliers: M v̇ + C_qᵀ λ = Q


class Joints(NamedTuple):
    """Joints as their user sees them: reactions and joint coordinates."""

    first_marker: U1  # (joints,)
    rows: U2  # (joints, 2) first row, one past the last
    part: U1  # (joint rows,) part of the joint's first marker
    coordinate: U1  # indices of Coordinates


class Functions(NamedTuple):
    """Constants, piecewise polynomials, expressions and laws; of time or of other signals."""

    kind: U1  # (·,)
    value: F1  # (·,) the constant
    table: U2  # (·, 2) first knot, one past the last
    knots: F1
    coefficients: F2  # (knots, 4) of powers of the distance from the knot; those of the last knot hold beyond it
    argument: U2  # (·, 4) signal kind, index, component, place in `arguments`
    span: U2  # (functions, 4) first argument, one past the last, first place, place of what its code is given
    arguments: W1  # programs of expressions; values of the arguments, then two places for the derivatives of a motion
    address: A1  # (·,) of its code


class Elements(NamedTuple):
    """Forces, sorted by family. A family is one compiled function, `FAMILY`, called for all its elements.

    Columns of `columns` and `number` are named in the family's file.
    """

    address: A1  # (families,)
    span: U2  # (families, 2) first element, one past the last
    columns: U2  # (E, ·) markers, coordinates, functions, states, first output
    number: W2  # (E, ·)
    memory: F2  # (E, ·) what an element keeps from accepted state to accepted state
    proposal: W2  # (E, ·) the memory that the state last evaluated would leave
    depth: (
        W2  # (E, ·) overlap at each surface of contacts and stops, negative while apart; one to each place of `memory`
    )
    depth_rate: W2  # (E, ·) its rate, where contacts and stops are followed
    state: W1  # (nx,) first-order states, copied from y
    state_rate: W1  # (nx,) zero before the families add to it


class Friction(NamedTuple):
    """Friction in joints: its forces depend on the reactions that depend on them. One extra row of C_q an element."""

    columns: U2  # (X, ·) columns named in `nivel.kernels.elements.friction`
    number: F2  # (X, ·)
    part: U1  # (X,) part for the coordinate's first marker; the others follow
    block: U2  # (X, 2) first block of `saddle.block`, one past the last
    # work
    force: F1  # (X,) effort on the coordinate; where the next iteration starts
    mass: F1  # (X,) [kg or kg m²] what an effort on the coordinate moves: 1/S, at most BOUND times that of its two bodies alone
    S: F2  # (X, X) acceleration of coordinate i for a unit effort on j
    response: F2  # (X, K) multipliers for a unit effort
    change: F3  # (X, B, width) whitened accelerations for a unit effort
    free: F1  # (X,) acceleration of the coordinate without friction
    lam: F1  # (K,) multipliers without friction
    anchor: F1  # (X,) effort of the last evaluation
    jacobian: F2  # (X, X) of the iteration
    work: F2  # (3, X)


class Circuit(NamedTuple):
    """Nodes of hydraulic and pneumatic circuits, N of them: volumes, given pressures, pressures that are signals."""

    node: U2  # (N, 2) fluid, state that is the mass [kg], or NONE: what flows there leaves the circuit
    fluid: F2  # (fluids, ·) constants of each law of density, see `nivel.elements.circuits.density`
    room: F2  # (N, 5) of each volume what pistons do not change, see `nivel.elements.circuits.volumes`
    secant: U1  # (1,) 1: restrictions have secants in place of tangents, for linearly implicit steps
    # steps of `nivel.integrate.rosenbrock.extrapolated_euler` whose extrapolation was not taken, largest difference of pressures in one
    # [Pa]
    guard: F1  # (2,)
    kept: F1  # (N,) [Pa] pressures of another state
    # (N, 8) of each volume the last mass and room, real numbers, with all that follows from them: see `nivel.elements.circuits.volumes`
    known: F2
    # work
    volume: W1  # (N,) [m³] that pistons leave open, without what is constant
    volume_rate: W1  # (N,) [m³/s]
    pressure: W1  # (N,) [Pa] absolute
    density: W1  # (N,) [kg/m³]
    enthalpy: W1  # (N,) [J/kg] above that at atmospheric pressure
    temperature: W1  # (N,) [K] of gas
    inflow: W1  # (N,) [W] enthalpy that flows into gas
    power: W1  # (4,) supplied to the fluid, given to bodies, dissipated [W]; taken from tanks [kg/s]
    stored: W1  # (1,) [J] in the fluid, in elastic walls and in accumulators
    tangent: CircuitTangent


class Outputs(NamedTuple):
    """What forces, drivers and sensors report, one number each, and where all variables stand in a frame."""

    value: W1
    combination: (
        U2  # (combinations, 2) first output of the effort (and power) of a coupling or driver or NONE, has power
    )
    column: U1  # first column of each variable in a frame, by its number in `nivel.kernels.output.observe`


class Sensors(NamedTuple):
    """What is measured for the results; columns named in `nivel.kernels.signals.sensor`."""

    columns: U2  # (sensors, ·)


class Watched(NamedTuple):
    """Values whose zeros are looked for: those of events, then overlaps of contacts and stops, then margins of switches."""

    event: U2  # (events, 3) FUNCTION, DIRECTION, STOP: see ENDS_RUN
    surface: U2  # (surfaces, 2) element, place in its `depth`
    switch: U2  # (switches, 2) places in `functions.arguments`: of the side, 1 or -1, and of the difference that decides about it
    held: F1  # (switches,) the side that a switch keeps, or 0: the difference decides at once
    value: F1  # (events + surfaces + switches,) in the state last evaluated
    rate: F1  # the same, of the surfaces; zero for others
    followed: (
        U1  # (1,) whether contacts and stops keep the side of the accepted state, see `nivel.kernels.forces.impact`
    )


class Sampled(NamedTuple):
    """What is computed at given times or events only, in this order: values of states, and signals that they are made of."""

    state: U1  # (samples,) number of the state, or NONE: a signal
    output: U1  # (samples,) place of a signal in `outputs.value`, or NONE: a state
    at_once: (
        U1  # (samples,) whether those behind it read its new value; others change together, all from the values before
    )
    function: U1  # (samples,) its next value
    event: U1  # (samples,) event that takes a sample, or NONE
    # Sample n is taken at (first + n · ticks)/rate [s], which is rounded once.
    first: F1  # (samples,) [ticks] time of the first sample
    ticks: (
        F1  # (samples,) [ticks] between samples; zero: at the event only, or a signal, which is computed at all of them
    )
    rate: F1  # (samples,) [1/s] ticks in a second
    at_rest: U1  # (1,) 1: in statics, where the rate of such a state is what a sample would change it by
    # work
    came: U1  # (events,) whether the event came in the last step
    due: U1  # (samples,) whether a sample is taken now
    value: F1  # (samples,) values after it


class Hooks(NamedTuple):
    """Addresses of optional components, or zero: see `FAMILY`."""

    address: (
        A1  # (HOOKS,) measure, friction, sense, complete, watch, residual, friction for given multipliers, tangent of beams,
        # rails, pass, mass of points, residual at an instant, dependent coordinates, nodes of modes, nodes that slide, samples
    )


class Saddle(NamedTuple):
    """The saddle-point system [M C_qᵀ; C_q 0], solved by elimination of the bodies: S = C_q M⁻¹ C_qᵀ.

    W are the blocks of C_q multiplied by the inverse transpose Cholesky factor of the body's mass matrix ("whitened"), so
    S is a sum of dot products. S and its factor L D Lᵀ are in elimination order.
    """

    row: U1  # (K,) row of the constraints that each row here is; they are the same ones unless coordinates carry some joints
    block: U2  # (N, 4) row, part of C_q (or NONE: normalisation), marker, body; those of extra rows last
    blocks: U1  # (1,) number of those of constraint rows
    pair: U2  # (·, 3) block, block, entry of S
    order: U1  # (K,) order[k] is the row eliminated as k-th
    S_start: U1  # (K+1,) column k of the upper triangle
    S_row: U1  # diagonal last in each column
    L_start: U1  # (K+1,) column j of L, below the diagonal
    L_row: U1
    P_start: U1  # (K+1,) pattern of row k of L: its columns ...
    P_column: U1
    P_entry: U1  # ... and where each entry stands in column order
    shift: F1  # (K,) added to the diagonal of S: 1/α of penalty methods, else 0
    least: F1  # (K,) pivot below which a row moves nothing, in elimination order; negative: the row repeats others and is left out
    # work
    W: F2  # (N, width)
    G: F3  # (B, width, width) what the formulation needs of each body's mass matrix
    z: F2  # (B, width) whitened applied and velocity forces
    S: F1
    L: F1
    Dinv: F1  # (K,) 1/D; the scale of the rows where the machine is redundant
    y: F1  # (K,)
    b: F1  # (K,) right-hand side, then solution, in row order
    dense: F2  # (K, K) redundant machines: pivoted factor; (0, 0) otherwise
    null: F2  # (K, redundant) null space of S and its normal equations
    pivot: U1  # (K,)
    target: F1  # (K,) right-hand side, then multipliers, while the augmented Lagrangian iterates
    before: F1  # (K,) its last change


class Frames(NamedTuple):
    """The frames of the bodies as their user placed them; those of `Bodies` themselves unless coordinates use others."""

    R: F2  # (B+1, 3) [m]
    theta: F2  # (B+1, 4)
    Rdot: F2  # (B+1, 3) [m/s]
    Rddot: F2  # (B+1, 3) [m/s²]


class Tree(NamedTuple):
    """The spanning tree of relative coordinates; empty in others. D nodes, one a body; U columns, one a joint velocity.

    Node n carries the body `child` on the body `parent`; a slider on a beam, written as a child of the ground, on the nodes beside it. The
    frame of a body is that of the marker by which it is carried, and all that is fixed to the body (markers, centre of mass, inertia) is
    given in it. Vectors are in global axes; wrenches are (moment about the frame's origin, force), motions (angular, of the origin).
    """

    node: U2  # (D, 6) child, parent, kind, joint or NONE, columns from, to
    place: U2  # (D, 2) where the joint's positions start in y, and its velocities
    # (D, 7) lead of a screw [m/rad], its displacement at angle zero, cosine and sine of a constant turn about z, the parent's marker
    number: F2
    first: W3  # (D, 3, 3) axes of the parent's marker, in the parent
    marker: U1  # markers that every evaluation needs
    turning: U1  # 1 for those of them whose axes it needs too
    rows: Constraints  # of the joints that carry bodies: they hold by themselves, and are filled for frames only
    carried: U2  # (D, 2) in `reaction`, from, to
    reaction: U2  # (·, 3) row of the joint that carries the body, part of its marker on the child, that marker
    part: U2  # (·, 4) row of the saddle (then of friction), part, marker, body: of the constraints that are left
    part_start: U1  # (K + X + 1,)
    path: U2  # (·, 2) nodes between the bodies of a row and the ground, outermost first; first block of the node
    path_start: U1  # (K + X + 1,)
    row_blocks: U1  # (K + X,) blocks of each row
    bundle: (
        U1  # rows with one and the same path follow each other: first row of each such bundle, then the number of rows
    )
    counted: U2  # (·, 2) angle among the coordinates that the state counts, its position in y
    turn: F2  # (·, 2) the angle is turn[0] y + turn[1]
    slider: U2  # (S, 2) nodes that slide along beams, place along the beam among the coordinates; see `nivel.kernels.tree.slider`
    slider_of: U1  # (D,) number of each node among these, or NONE
    theta: F2  # (D, 4) turn from the parent's frame to its marker, as Euler parameters
    own: F2  # (B, 3) [m] the origin of the body's own frame
    own_theta: F2  # (B, 4) its axes, as Euler parameters
    size: F1  # (1,) [m] length of the machine
    positions: U1  # (1,) their number
    # work
    axes: W2  # (3, 3) of a marker
    arm: W2  # (B+1, 3) from the parent's origin to the body's
    alpha0: W2  # (B+1, 3) angular acceleration while no joint velocity changes
    Rddot0: W2  # (B+1, 3) acceleration of the origin while no joint velocity changes
    column: W2  # (U, 6) motion of a joint velocity
    element: U2  # (S, 2) node before the element on which each slider is held, or NONE: where it is; where it was before it passed a node
    frame: W2  # (S, 28) of the beam at each slider
    jump: W2  # (S, 6) added to the acceleration of each slider, see `nivel.kernels.residual.element_crossing`
    before: F2  # (S, 12) its motion before it passed a node, its acceleration behind it
    inertia: F2  # (B+1, 27) articulated inertia: I (6), H (9), M (6); I of the body alone (6)
    U: F2  # (U, 6) inertia times column
    Dinv: F1  # (U,) 1/(columnᵀ U)
    root: F1  # (U,) its root
    wrench: F2  # (B+1, 6)
    load: F3  # (rows of the largest bundle, B+1, 6) zero between uses
    delta: F2  # (B+1, 6) acceleration less that while no joint velocity changes
    state: F1  # (positions,) those last evaluated
    change: F1  # (U,) of joint coordinates in a correction
    moved: F1  # (positions,) the same of positions
    small: F2  # (6, 7) equations for the reactions of one joint


class Partition(NamedTuple):
    """Velocities in two groups, dependent and independent; n = 6 B of them, r independent rows, f = n - r. Empty for other coordinates.

    Indices before r in `column` and `row` belong to C_d, the square part of C_q that gives the dependent velocities.
    """

    unit: F1  # (n,) what each velocity is measured in: the length of the machine [m], or 1 for angles
    column: U1  # (n,) the dependent velocities, then the independent ones
    row: U1  # (K,) rows that determine the dependent velocities, then those that follow from them
    choices: U1  # (1,) partitions chosen so far
    quality: F1  # (3,) least growth of B since the last choice; smallest pivot of C_d; growth at which another choice is made
    # work
    column_place: U1  # (n,) where each velocity stands in `column`
    row_place: U1  # (K,)
    scale: F1  # (K,) what makes the rows of C_q unit length
    weight: F1  # (K,) √(C_q M⁻¹ C_qᵀ)_kk of the scaled rows
    E: F2  # (K, n) scaled C_q, then L, U and L⁻¹ C_i of C_d = L U, in the order of `row` and `column`
    null: F2  # (K - r, K) combinations of rows that vanish, in the order of `row`
    B: F2  # (f, n) columns of B: v̇ = B u̇ + D
    MB: F2  # (f, n) columns of M B
    H: F2  # (f, f) Bᵀ M B, then its Cholesky factor
    u: F1  # (f,) accelerations of the independent velocities
    D: F1  # (n,) dependent accelerations for u̇ = 0; changes of the dependent velocities in a correction
    Q: F1  # (n,) forces, then what the multipliers have to balance
    v: F1  # (n,) accelerations
    p: F1  # (n,) M times a vector
    b: F1  # (K,) right-hand sides, multipliers of the scaled rows


class Control(NamedTuple):
    """Numbers that steer an evaluation."""

    rank: U1  # (3,) independent rows; rows that are left out; whether the last factor is pivoted
    # (3,) most iterations of the augmented Lagrangian (1: none), those of all evaluations so far, evaluations since it last converged
    iterations: U1
    stabilise: F1  # (4,) Baumgarte 2α and β²; tolerances of |C|/scale and |Ċ|/scale for the direct correction
    feedback: F2  # (K, 2) 2α and β² of each row, as multiples of those in `stabilise`
    # (2,) the augmented Lagrangian ends where what its last change does, squared, is below this share of what all forces do; of a
    # redundant machine the largest that the smallest pivot of S has been since its rows were chosen, as a share of its diagonal
    settled: F1
    energy: F1  # (3,) kinetic and potential energy of the last observation, their sum at the start
    power: W1  # (2,) work of external forces and dissipation per second
    stored: W1  # (1,) [J] elastic energy of the forces
    # (2,) [s] time within which stiction stops a joint; two steps, which bristles have to be slower than, or 0 where steps are chosen
    stick: F1
    failure: U1  # (1,) row that could not be eliminated, friction that did not converge, body of singular rotations


class Record(NamedTuple):
    """One machine in numbers."""

    bodies: Bodies
    rotations: Rotations
    markers: Markers
    coordinates: Coordinates
    constraints: Constraints
    joints: Joints
    functions: Functions
    elements: Elements
    friction: Friction
    circuit: Circuit
    saddle: Saddle
    tree: Tree
    frames: Frames
    flexible: Flexible
    modal: ModalTree
    shared: SharedMass
    points: PointInertia
    beams: BeamTangent
    partition: Partition
    residual: Residual
    newton: Newton
    sensors: Sensors
    watched: Watched
    sampled: Sampled
    outputs: Outputs
    hooks: Hooks
    control: Control


record_at = reader(Record)
# kinds of nodes
REVOLUTE, TRANSLATIONAL, CYLINDRICAL, SCREW, UNIVERSAL, SPHERICAL, PLANAR, FIXED, FREE = 0, 1, 2, 3, 4, 5, 6, 7, 8
# and of what lies between the frames of a flexible body, see `nivel.kernels.tree.flexible_tree`
MODAL, OUTWARD = 9, 10
# and of a body that slides along a beam, carried by the two nodes beside it, see `nivel.kernels.tree.slider`
POINT_ON_BEAM, KEYED_ON_BEAM, CYLINDRICAL_ON_BEAM, TRANSLATIONAL_ON_BEAM = 11, 12, 13, 14
# (machine, t, y, ẏ), (machine, t, y, frame) and (machine, t, y)
EVALUATE = Signature("status", ("machine", "number", "vector", "vector"))
OBSERVE = Signature("nothing", ("machine", "number", "vector", "vector"))
CORRECT = Signature("status", ("machine", "number", "vector"))
# address of the record, number of the family (0 for a hook), time → status
FAMILY = Signature("status", ("machine", "count", "number"))

NONE = 0xFFFFFFFF  # an index that points nowhere
EULER_ANGLES, ROTATION_VECTOR = 0, 1  # kinds of Rotations
(
    MEASURE,
    FRICTION,
    SENSE,
    COMPLETE,
    WATCH,
    RESIDUAL,
    GIVEN_FRICTION,
    TANGENT,
    RAIL,
    PASS,
    POINTS,
    MOMENTARY,
    DEPENDENT,
    MODES,
    SLIDERS,
    SAMPLE,
) = range(16)  # entries of Hooks.address
FACTORS = 16  # of flexible bodies in coordinates of single bodies; other jobs of theirs are of MODES
HOOKS = 17
LOCK, DEPART, RESUME = 0, 1, 2  # jobs of the hook PASS
# what the hooks MODES and SLIDERS do for a node, and MODES for all flexible bodies, see `nivel.kernels.tree.tree_nodes`
MOVE, ACCELERATE, HAND, LOAD, NEED = 0, 1, 2, 3, 4
FUNCTION, DIRECTION, STOP = 0, 1, 2  # columns of Watched.event
BOTH, RISING, FALLING = 0, 1, 2  # directions
# values of STOP: the event is noted; it ends the run; it ends the step where steps are chosen, for a sample
NOTED, ENDS_RUN, ENDS_STEP = 0, 1, 2
