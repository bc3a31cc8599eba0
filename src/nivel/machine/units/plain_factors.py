"""Plain numbers that lack a unit in an expression with units, and the text that would be right.

    k*(length - 20 cm)          is a length where a force was expected: `k` lacks N/m
    sin(pi*(x - 5 m)/L)         takes the sine of a length: `L` lacks m

Which numbers, and which units, is unit inference (Kennedy 1996): each plain factor that may lack a unit has unknown exponents of
kg, m, s, …; a sum, a comparison, an argument of a function and the kind of the field are linear equations between them. The fewest
factors that satisfy all equations are the answer, and it is offered only if the changed text is accepted.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from copy import deepcopy
from itertools import combinations, islice, product
from typing import Final

import numpy as np

from nivel.lazy import Struct, dataclass, field
from nivel.machine.units import tree
from nivel.machine.units.arithmetic import bind, evaluate
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.grammar import parse, placed_tokens
from nivel.machine.units.measure import Reading, readings
from nivel.machine.units.unit import BASES, KINDS, NONE, UNITS, Dimension, powered, without_angle

MOST: Final = 3  # factors that are completed at once
LARGEST_EXPONENT: Final = 1e3
_MOST_READINGS: Final = 24
_MOST_STEPS: Final = 25_000  # of sets of factors and readings, of each size, times the leaves of the expression
_MOST_CANDIDATES: Final = 10
_RAD: Final = BASES.index("rad")
_PURE: Final = (0.5, 0.25, 0.75, 1.5, *map(float, range(1, 11)))  # numbers that are hardly ever quantities

# a literal: whose text it stands in ("" for the expression itself) and which leaf it is there; a parameter: its name
Leaf = tuple[str, int] | str
Accepts = Callable[[str, tree.Parameters], None]


class Completed(Struct):
    """What is right: `text` of the expression and `bodies` of functions that it calls, only those that change.

    lacking : for the expression (under "") and each of these functions the factors as they are written, with the units that they lack
    reading : what the variables were taken for
    """

    text: str
    bodies: Mapping[str, str]
    lacking: Mapping[str, tuple[tuple[str, str], ...]]
    reading: Reading


def completed(
    text: str,
    parameters: tree.Parameters,
    local: tuple[str, ...],
    wanted: tuple[Dimension, ...],
    accepts: Accepts,
    *,
    constant: bool = False,
) -> Completed | None:
    """The text with the fewest units added that is accepted; None where plain numbers are not what is wrong.

    wanted : dimensions of which the expression must have one; none where it may have any
    accepts : raises ExpressionError for a text, with the parameters and functions that it uses, that is still wrong
    constant : small numbers such as 2 are not taken for quantities, and no unusual unit is proposed
    """
    try:
        problem = _Problem(text, parameters, local, constant)
        bound = bind(problem.trees[""], parameters, local)
    except (tree.ExpressionError, tree.FaultyParameterError):
        return None
    found = sorted(_solutions(problem, bound, wanted), key=lambda each: each.cost)
    for solution in found[:20]:
        for units in (solution.units | problem.beside(solution), solution.units):
            result = problem.rewritten(units, solution)
            if _accepted(result, parameters, accepts):
                return result
    return None


def _accepted(result: Completed, parameters: tree.Parameters, accepts: Accepts) -> bool:
    try:
        accepts(result.text, with_bodies(parameters, result.bodies))
    except (tree.ExpressionError, tree.FaultyParameterError):
        return False
    return True


def with_bodies(parameters: tree.Parameters, bodies: Mapping[str, str]) -> tree.Parameters:
    """`parameters` with other texts of some functions. Raises ExpressionError."""
    if not bodies:
        return parameters
    written = {name: each for name, each in parameters.items() if isinstance(each, tree.Function) and each.text}
    done: dict[str, tree.Number | tree.Signal | tree.Function | None] = {
        name: each for name, each in parameters.items() if name not in written
    }

    def fill(name: str) -> None:
        function = written[name]
        text = bodies.get(name, function.text)
        root = parse(text)
        for used in sorted(set(tree.calls(root)) & written.keys() - done.keys()):
            fill(used)
        known = {each: value for each, value in done.items() if each not in function.arguments}
        done[name] = tree.Function(function.arguments, bind(root, known, function.arguments), function.head, text)

    for name in written:
        if name not in done:
            fill(name)
    return done


class _Affine(Struct):
    """Exponents of the bases: those that are known, and multiples of those of factors."""

    known: Dimension
    factors: Mapping[Leaf, float] = field(default_factory=dict)

    def plus(self, other: "_Affine", times: float) -> "_Affine":
        known = tuple(a + times * b for a, b in zip(self.known, other.known, strict=True))
        names = self.factors.keys() | other.factors.keys()
        return _Affine(
            known, {name: self.factors.get(name, 0.0) + times * other.factors.get(name, 0.0) for name in names}
        )


Measured = _Affine | None  # None: a plain number, which fits everywhere
_PURE_NUMBER: Final = _Affine(NONE)
_Part = tuple[tree.Node, Measured]


@dataclass
class _Solution:
    """Units of some factors in one reading."""

    units: dict[Leaf, Dimension]
    reading: Reading
    cost: tuple[float, ...]


class _Problem:
    """An expression with all that it calls, in which some factors may lack units."""

    def __init__(self, text: str, parameters: tree.Parameters, local: tuple[str, ...], constant: bool) -> None:
        self.parameters, self.local, self.constant = parameters, local, constant
        self.texts = {"": text}
        self.trees = {"": deepcopy(parse(text))}  # leaves are known by their identity, and texts may be alike
        pending = [""]
        while pending:
            for name in tree.calls(self.trees[pending.pop()]):
                function = parameters.get(name)
                if isinstance(function, tree.Function) and function.text and name not in self.trees:
                    self.texts[name], self.trees[name] = function.text, deepcopy(parse(function.text))
                    pending.append(name)
        self.leaf_of: dict[int, Leaf] = {}
        self.candidates: dict[Leaf, float] = {}  # the smaller the number, the more likely a unit is missing there
        self.literals: set[Leaf] = set()  # without unit, other than zero
        for owner, root in self.trees.items():
            self._look_at(owner, root)
        self.wildcards: list[tuple[tree.Node, str, Measured]] = []  # plain parts beside quantities, and whose they are

    def _look_at(self, owner: str, root: tree.Node) -> None:
        """Number the leaves of a tree, and find those that may lack a unit."""
        function = self.parameters.get(owner) if owner else None
        arguments = function.arguments if isinstance(function, tree.Function) else self.local
        with_unit = {id(leaf) for leaf in _with_units(root)}
        for at, leaf in enumerate(tree.leaves(root)):
            match leaf:
                case tree.Number(value):
                    self.leaf_of[id(leaf)] = (owner, at)
                    small = value in _PURE
                    if value != 0.0 and id(leaf) not in with_unit:
                        self.literals.add((owner, at))
                        if not (small and self.constant):
                            self.candidates[owner, at] = 3.0 if small else 1.0
                case tree.Name(text) if text not in arguments and id(leaf) not in with_unit:
                    meant = self.parameters.get(text)
                    if isinstance(meant, tree.Number) and meant.dimension is None:
                        self.leaf_of[id(leaf)] = text
                        self.candidates[text] = 0.0

    def equations(
        self, chosen: Mapping[Leaf, _Affine], reading: Reading, wanted: Dimension | None
    ) -> list[_Affine] | None:
        """What has to be without dimension if the factors `chosen` have units; None where that can never be."""
        self.wildcards = []
        found: list[_Affine] = []
        walk = _Walk(self, chosen, reading, found)
        try:
            result = walk.of(self.trees[""], "", None)
        except tree.ExpressionError:
            return None
        if result is not None and wanted is not None:
            found.append(result.plus(_Affine(wanted), -1.0))
        return found

    def beside(self, solution: _Solution) -> dict[Leaf, Dimension]:
        """Units of the plain numbers that are added to, or compared with, quantities in the texts that change anyway."""
        chosen = {leaf: _Affine(without_angle(its)) for leaf, its in solution.units.items()}
        self.equations(chosen, solution.reading, None)
        owners = {leaf[0] for leaf in solution.units if isinstance(leaf, tuple)}
        owners |= {owner for owner, root in self.trees.items() for leaf in solution.units if self._names(root, leaf)}
        units: dict[Leaf, Dimension] = {}
        for node, owner, its in self.wildcards:
            leaf = self.leaf_of.get(id(node))
            known = its is not None and not any(its.factors.values()) and without_angle(its.known) != NONE
            if known and owner in owners and leaf in self.literals:
                assert its is not None
                units.setdefault(leaf, its.known)
        return {leaf: its for leaf, its in units.items() if leaf not in solution.units}

    def _names(self, root: tree.Node, leaf: Leaf) -> bool:
        return isinstance(leaf, str) and any(self.leaf_of.get(id(each)) == leaf for each in tree.leaves(root))

    def rewritten(self, units: Mapping[Leaf, Dimension], solution: _Solution) -> Completed:
        """The texts with these units in them."""
        texts: dict[str, str] = {}
        lacking: dict[str, tuple[tuple[str, str], ...]] = {}
        for owner, root in self.trees.items():
            found = [self.leaf_of.get(id(each)) for each in tree.leaves(root)]
            here = {at: units[leaf] for at, leaf in enumerate(found) if leaf is not None and leaf in units}
            if not here:
                continue
            texts[owner] = _with_units_written(self.texts[owner], here)
            said = [
                (written, unit_text(solution.units[leaf]))
                for leaf, written in zip(found, _written(self.texts[owner]), strict=True)
                if leaf is not None and leaf in solution.units
            ]
            lacking[owner] = tuple(dict.fromkeys(said))
        own = texts.pop("", self.texts[""])
        return Completed(own, texts, lacking, solution.reading)


class _Walk:
    """One pass over an expression and the functions that it calls; what has to fit goes to `equations`."""

    def __init__(
        self, problem: _Problem, chosen: Mapping[Leaf, _Affine], reading: Reading, equations: list[_Affine]
    ) -> None:
        self.problem, self.chosen, self.reading, self.equations = problem, chosen, reading, equations

    def of(self, node: tree.Node, owner: str, arguments: Mapping[str, Measured] | None) -> Measured:
        """What `node` of the text of `owner` measures. arguments : of the function, None in the expression itself."""
        match node:
            case tree.Number():
                return self.chosen.get(self.problem.leaf_of[id(node)])
            case tree.Time():
                return _known(self.reading.get(tree.TIME))
            case tree.Signal(path):
                return _known(self.reading.get(path))
            case tree.Name():
                return self.of_name(node, arguments)
            case tree.Negative(operand):
                return self.of(operand, owner, arguments)
            case tree.Operation("**", base, exponent):
                return self.of_power(base, exponent, owner, arguments)
            case tree.Operation(symbol, left, right):
                first, second = self.of(left, owner, arguments), self.of(right, owner, arguments)
                return self.of_operation(symbol, (left, first), (right, second), owner)
            case tree.Call(function, given) if function == tree.LOOKUP:
                self.of(given[0], owner, arguments)
                return None
            case tree.Call(function, given):
                return self.of_call(function, [(each, self.of(each, owner, arguments)) for each in given], owner)
        return None

    def of_name(self, name: tree.Name, arguments: Mapping[str, Measured] | None) -> Measured:
        text, problem = name.text, self.problem
        if name.place == "unit" and text in UNITS:
            return _known(UNITS[text].dimension)
        if arguments is not None and text in arguments:
            return arguments[text]
        if arguments is None and text in problem.local:
            return _known(self.reading.get(text))
        meant = bind(name, problem.parameters)
        if isinstance(meant, tree.Signal):
            return _known(self.reading.get(meant.path))
        its = meant.dimension if isinstance(meant, tree.Number) else None
        if its is not None:
            return _known(its)
        leaf = problem.leaf_of.get(id(name))
        return None if leaf is None else self.chosen.get(leaf)

    def of_power(
        self, base: tree.Node, exponent: tree.Node, owner: str, arguments: Mapping[str, Measured] | None
    ) -> Measured:
        its, power = self.of(base, owner, arguments), self.of(exponent, owner, arguments)
        self.pure(power)
        if its is None:
            return None
        if arguments is not None and any(
            each.text in arguments for each in tree.leaves(exponent) if isinstance(each, tree.Name)
        ):
            raise tree.ExpressionError("an exponent that is an argument")
        number = bind(exponent, self.problem.parameters, self.problem.local)
        if tree.varies(number):
            raise tree.ExpressionError("an exponent that varies")
        return _PURE_NUMBER.plus(its, evaluate(number))

    def of_operation(self, symbol: str, left: _Part, right: _Part, owner: str) -> Measured:
        first, second = left[1], right[1]
        if symbol in tree.LOGICAL:
            return None
        if symbol in ("*", "/"):
            if second is None:
                return first
            return (first or _PURE_NUMBER).plus(second, 1.0 if symbol == "*" else -1.0)
        result = self.same(owner, left, right)
        return None if symbol in tree.COMPARISONS else result

    def of_call(self, function: str, terms: list[_Part], owner: str) -> Measured:
        meant = self.problem.parameters.get(function)
        if isinstance(meant, tree.Function) and function not in FUNCTIONS:
            if function not in self.problem.trees:  # a curve, which is of plain numbers
                return None
            arguments = dict(zip(meant.arguments, (its for _, its in terms), strict=True))
            return self.of(self.problem.trees[function], function, arguments)
        units = FUNCTIONS[function].units
        result = _PURE_NUMBER if units.is_angle else None
        if units.taken:
            for _, its in terms:
                self.pure(its)
        for group in units.alike:
            its = self.same(owner, *group.of(terms))
            if its is not None and group.exponent:
                result = (result or _PURE_NUMBER).plus(its, group.exponent)
        return result

    def same(self, owner: str, *terms: _Part) -> Measured:
        """What all `terms` measure, of which plain ones fit any."""
        its = next((each for _, each in terms if each is not None), None)
        for node, each in terms:
            if each is None:
                self.problem.wildcards += [(leaf, owner, its) for leaf in _terms(node)]
            elif each is not its and its is not None:
                self.equations.append(each.plus(its, -1.0))
        return its

    def pure(self, its: Measured) -> None:
        if its is not None:
            self.equations.append(its)


def _known(its: Dimension | None) -> Measured:
    return None if its is None else _Affine(its)


def _terms(node: tree.Node) -> Iterator[tree.Node]:
    """The numbers that are added and subtracted in `node`, where it is a sum of numbers."""
    match node:
        case tree.Negative(operand):
            yield from _terms(operand)
        case tree.Operation("+" | "-", left, right):
            yield from _terms(left)
            yield from _terms(right)
        case tree.Number():
            yield node


def _with_units(node: tree.Node) -> Iterator[tree.Node]:
    """What has a unit already: the 3 of `3 m`, all of `3/8 in`, the parameter of `L*1 m`."""
    match node:
        case tree.Operation("*", left, right) if _is_unit(right):
            factors = list(tree.leaves(left))
            if all(isinstance(each, tree.Number) for each in factors):
                yield from factors
            elif isinstance(factors[-1], tree.Number):
                yield factors[-1]
            match left:
                case tree.Operation("*", tree.Name() as parameter, tree.Number(1.0)):
                    yield parameter
            yield from _with_units(left)
        case tree.Operation("**", base, exponent):
            yield from (each for each in tree.leaves(exponent) if isinstance(each, tree.Number))
            yield from _with_units(base)
        case _:
            if isinstance(node, tree.Call) and node.function == tree.LOOKUP:
                yield from (
                    leaf for each in node.arguments[1:] for leaf in tree.leaves(each) if isinstance(leaf, tree.Number)
                )
            for part in tree.parts(node):
                yield from _with_units(part)


def _is_unit(node: tree.Node) -> bool:
    """Whether `node` is a unit that stands after a number, possibly to a power."""
    match node:
        case tree.Name(_, place):
            return place != "free"
        case tree.Operation("**", base, _):
            return _is_unit(base)
        case tree.Operation("*" | "/", left, right):
            return _is_unit(left) and _is_unit(right)
    return False


def _solutions(problem: _Problem, bound: tree.Node, wanted: tuple[Dimension, ...]) -> Iterator[_Solution]:
    """Sets of factors, as few as possible, with the units that make the expression right in some reading."""
    candidates = sorted(problem.candidates, key=lambda leaf: problem.candidates[leaf])[:_MOST_CANDIDATES]
    ways = list(islice(readings(bound), _MOST_READINGS)) if candidates else []
    tries_of_a_size = min(1000, _MOST_STEPS // sum(1 for _ in tree.leaves(bound)))
    for count in range(1, MOST + 1):
        tries = product(combinations(candidates, count), ways, wanted or (None,))
        found = False
        for chosen, reading, target in islice(tries, tries_of_a_size):
            units = _solved(problem, chosen, reading, target)
            if units is not None and not (problem.constant and any(map(_is_unusual, units.values()))):
                found = True
                plain = sum(its is None for its in reading.values()) if reading else _variables(bound)
                kinds = sum(problem.candidates[leaf] + _strangeness(its) for leaf, its in units.items())
                yield _Solution(units, reading, (count, plain, kinds))
        if found:
            return


def _variables(bound: tree.Node) -> int:
    return len({each for each in tree.leaves(bound) if isinstance(each, tree.Time | tree.Signal)})


def _solved(
    problem: _Problem, chosen: tuple[Leaf, ...], reading: Reading, wanted: Dimension | None
) -> dict[Leaf, Dimension] | None:
    """The one set of units of these factors that fits, each other than a pure number; None where there is none."""
    equations = problem.equations({leaf: _Affine(NONE, {leaf: 1.0}) for leaf in chosen}, reading, wanted)
    if not equations:
        return None
    matrix = np.array([[each.factors.get(leaf, 0.0) for leaf in chosen] for each in equations])
    known = -np.array([each.known for each in equations])
    if max(np.abs(matrix).max(), np.abs(known).max()) > LARGEST_EXPONENT:
        return None
    if np.linalg.matrix_rank(matrix) < len(chosen):
        return None
    exponents = np.round(2.0 * np.linalg.lstsq(matrix, known, rcond=None)[0]) / 2.0
    fits = np.abs(matrix @ exponents - known) < 1e-9
    angles = [k for k, base in enumerate(BASES) if base in ("rad", "cycle")]
    if not np.all(np.delete(fits, angles, axis=1)):
        return None
    exponents[:, [k for k in angles if not np.all(fits[:, k]) or k != _RAD]] = 0.0
    units = {leaf: tuple(float(each) + 0.0 for each in row) for leaf, row in zip(chosen, exponents, strict=True)}
    return units if all(without_angle(its) != NONE for its in units.values()) else None


def _strangeness(its: Dimension) -> float:
    """How unusual a unit is: of two answers the one with the more usual unit is meant."""
    only_below = all(each <= 0.0 for each in without_angle(its))
    return (2.0 if _is_unusual(its) else 0.0) + (1.5 if only_below else 0.0) + 0.01 * sum(map(abs, its))


def _is_unusual(its: Dimension) -> bool:
    """Whether no field of a machine measures this."""
    return all(without_angle(each) != without_angle(its) for _, _, each in KINDS.values())


def unit_text(its: Dimension) -> str:
    """A unit as it is written after a number: ``N/m``, ``kg m^2``, ``m^-1``."""
    for _, written, each in KINDS.values():
        if each == its and not written.startswith("1"):
            return written.replace("*", " ")
    above = _joined((base, each) for base, each in zip(BASES, its, strict=True) if each > 0)
    below = [(base, -each) for base, each in zip(BASES, its, strict=True) if each < 0]
    if not above:
        return _joined((base, -each) for base, each in below)
    under = _joined(below)
    return above + (f"/({under})" if len(below) > 1 else f"/{under}" if below else "")


def _joined(factors: Iterable[tuple[str, float]]) -> str:
    """A product of units; a unit may follow a common one, or an exponent, without a sign."""
    text = ""
    for base, exponent in factors:
        after = text.rpartition(" ")[2].rpartition("*")[2]
        text += ("" if not text else " " if after in UNITS or "^" in after else "*") + powered(base, exponent)
    return text


def _leaf_tokens(text: str) -> list[int]:
    """The places among the tokens of `text` of the leaves of its tree."""
    tokens = placed_tokens(text)
    is_call = {at for at in range(len(tokens) - 1) if tokens[at + 1].text == "(" and tokens[at].kind == "name"}
    return [
        at
        for at, token in enumerate(tokens)
        if token.kind == "number" or (token.kind == "name" and at not in is_call and token.text not in tree.LOGICAL)
    ]


def _written(text: str) -> list[str]:
    """The leaves of the tree of `text` as they are written."""
    tokens = placed_tokens(text)
    return [tokens[at].text for at in _leaf_tokens(text)]


def _with_units_written(text: str, units: Mapping[int, Dimension]) -> str:
    """`text` with units after some of its leaves, by their place among the leaves."""
    tokens, at_leaves = placed_tokens(text), _leaf_tokens(text)
    for leaf in sorted(units, reverse=True):
        at = at_leaves[leaf]
        token = tokens[at]
        before = tokens[at - 1].text if at else ""
        behind = [each.text for each in tokens[at + 1 : at + 3]] + ["", ""]
        unit = unit_text(units[leaf])
        if token.kind == "name":
            new = f"({token.text}*1 {unit})"
        else:
            may_join = behind[0] in ("/", "^", "**") or (behind[0] == "*" and behind[1] in UNITS)
            bare = f"{token.text} {unit}"
            new = f"({bare})" if may_join or before in ("/", "^", "**") else bare
        text = text[: token.start] + new + text[token.end :]
    return text
