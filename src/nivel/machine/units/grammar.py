"""Grammar of expressions: from text to the tree of arithmetic.py. Nothing is handed to Python's `eval`.

    whole   = both { or both }                a condition holds where it is greater than zero
    both    = compared { and compared }
    compared = sum [ (< | <= | > | >=) sum ]
    sum     = term { (+ | -) term }
    term    = sign { (* | /) sign | unit }    a unit may follow a number, `)` or a unit directly: `10 cm`, `(1/2) in`
    sign    = [ + | - ] sign | power
    power   = atom [ (^ | **) sign ]          to the right first, and before the sign: -2^2 = -4, as in Python
    atom    = number | name | signal | function ( whole, … ) | ( whole )
    signal  = name . name [ . name ]          without spaces: `hinge.angle`, or as results write it: `ball.position.x`
    unit    = name [ (^ | **) sign ]

A unit multiplies what stands before it in its term, so `3/8 in` is three eighths of an inch and `pi/2 rad` a quarter
turn. `2 m / 4 s` could then be read in two ways and is refused; `(2 m)/(4 s)` is clear.

A parameter may have the name of a unit. Directly behind a number, a `)` or a unit the name is the unit, and what divides a unit
there is one too: `2 m`, `9.81 m/s^2`. Elsewhere it is the parameter: `2*m`, `F/m`. Behind `*` and a unit it is ambiguous, except
where the whole text is a number with units: `10 N*m`.
"""

import re
from dataclasses import replace
from functools import lru_cache
from typing import Literal, NamedTuple

from nivel.machine.units import tree
from nivel.machine.units.unit import UNITS
from nivel.words.wording import in_expressions

_MOST_TOKENS = 400  # trees are walked by recursion: this and _DEEPEST keep them far from Python's limit
_MOST_LISTED = 20_000  # with numbers and commas, of which points of curves are made
_DEEPEST = 60
_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|"
    r"(?P<name>[^\W\d]\w*(?:\.[^\W\d]\w*)*|°)|(?P<symbol>\*\*|<=|>=|[-+*/^(),<>]))"
)


@lru_cache(maxsize=4096)
def parse(text: str) -> tree.Node:
    """The tree of `text`, names unbound.

    Raises ExpressionError.
    """
    return _Parser(text).whole()


class _Parser:
    """Recursive descent over the grammar at the top of this file."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = placed_tokens(text)
        self.at = 0
        self.depth = 0

    def whole(self) -> tree.Node:
        node = self.condition()
        if self.at < len(self.tokens):
            raise self.unexpected()
        return _units(node, "unit") if _is_plain_quantity(node) else node

    def condition(self) -> tree.Node:
        self.deeper()
        node = self.both()
        while self.word() == "or":
            node = tree.Operation(self.take(), node, self.both())
        self.depth -= 1
        return node

    def both(self) -> tree.Node:
        node = self.compared()
        while self.word() == "and":
            node = tree.Operation(self.take(), node, self.compared())
        return node

    def compared(self) -> tree.Node:
        node = self.sum()
        if self.symbol() not in tree.COMPARISONS:
            return node
        node = tree.Operation(self.take(), node, self.sum())
        if self.symbol() in tree.COMPARISONS:
            raise tree.ExpressionError("one comparison at a time: for `a < x < b` write `a < x and x < b`")
        return node

    def word(self) -> str:
        """`and` or `or`, which stand between conditions; else nothing."""
        text = self.tokens[self.at].text if self.at < len(self.tokens) else ""
        return text if text in tree.LOGICAL else ""

    def sum(self) -> tree.Node:
        self.deeper()
        node = self.term()
        while self.symbol() in ("+", "-"):
            node = tree.Operation(self.take(), node, self.term())
        self.depth -= 1
        return node

    def term(self) -> tree.Node:
        node = self.sign()
        has_unit = divided = False
        joined = ""  # the signs after which a name still belongs to the units behind a number
        while True:
            if self.symbol() in ("*", "/"):
                sign = self.take()
                divided = sign == "/"
                operand = self.sign()
                if sign in joined and _is_of_units(operand, product=not divided):
                    operand = _units(operand, "unit" if divided else "product")
                    joined = "/" if divided else joined
                else:
                    joined = ""
                node = tree.Operation(sign, node, operand)
            elif self.kind() == "name" and not self.word() and self.follows_number():
                if divided and has_unit:
                    raise tree.ExpressionError("which part the last unit belongs to is unclear; write `(2 m)/(4 s)`")
                node = tree.Operation("*", node, self.unit())
                has_unit = True
                joined = joined or "*/"
            else:
                return node

    def follows_number(self) -> bool:
        """A unit may stand directly after a number, a closing parenthesis or another unit."""
        kind, text, *_ = self.tokens[self.at - 1]
        return kind == "number" or text == ")" or (kind == "name" and text in {*UNITS, *tree.CONSTANTS, "A"})

    def sign(self) -> tree.Node:
        sign = self.symbol()
        if sign not in ("+", "-"):
            return self.power()
        self.take()
        self.deeper()
        operand = self.sign()
        self.depth -= 1
        return tree.Negative(operand) if sign == "-" else operand

    def power(self) -> tree.Node:
        return self.raised(self.atom())

    def raised(self, base: tree.Node) -> tree.Node:
        if self.symbol() not in ("^", "**"):
            return base
        self.take()
        self.deeper()
        exponent = self.sign()
        self.depth -= 1
        return tree.Operation("**", base, exponent)

    def unit(self) -> tree.Node:
        name = self.take()
        if self.symbol() == "(" or "." in name:
            raise tree.ExpressionError(f"`*` is missing before `{name}`")
        return self.raised(replace(named, place="unit") if isinstance(named := _named(name), tree.Name) else named)

    def atom(self) -> tree.Node:
        kind = self.kind()
        if kind == "number":
            return tree.Number(tree.finite(float(self.take())))
        if kind == "name":
            name = self.take()
            if self.symbol() == "(":
                return self.call(name)
            return _named(name)
        if self.symbol() == "(":
            self.take()
            node = self.condition()
            self.expect(")")
            return node
        raise self.unexpected()

    def call(self, name: str) -> tree.Node:
        self.take()
        arguments = [self.condition()]
        while self.symbol() == ",":
            self.take()
            arguments.append(self.condition())
        self.expect(")")
        return tree.Call(name, tuple(arguments))

    def deeper(self) -> None:
        self.depth += 1
        if self.depth > _DEEPEST:
            raise tree.ExpressionError("the expression is nested too deeply")

    def kind(self) -> str:
        return self.tokens[self.at].kind if self.at < len(self.tokens) else "end"

    def symbol(self) -> str:
        return self.tokens[self.at].text if self.kind() == "symbol" else ""

    def take(self) -> str:
        self.at += 1
        return self.tokens[self.at - 1].text

    def expect(self, symbol: str) -> None:
        if self.symbol() != symbol:
            raise self.unexpected(f"; `{symbol}` was expected")
        self.take()

    def unexpected(self, hint: str = "") -> tree.ExpressionError:
        if self.at >= len(self.tokens):
            return tree.ExpressionError(f"the expression ends too early{hint}")
        if [each.text for each in self.tokens[self.at : self.at + 3]] == ["1", "/", "min"]:
            hint = "; turns in a minute are `rpm`"
        return tree.ExpressionError(f"`{self.tokens[self.at].text}` was not expected here{hint}")


def _is_of_units(node: tree.Node, *, product: bool = False) -> bool:
    """Whether `node` is made of names of units only: ``m``, ``s^2``, and unless it stands in a `product` ``(m*s)``."""
    match node:
        case tree.Name(text):
            return text in UNITS
        case tree.Operation("**", base, exponent):
            return _is_of_units(base, product=product) and not any(
                isinstance(each, tree.Name) for each in tree.leaves(exponent)
            )
        case tree.Operation("*" | "/", left, right):
            return not product and _is_of_units(left) and _is_of_units(right)
    return False


def _units(node: tree.Node, place: Literal["unit", "product"]) -> tree.Node:
    """`node` with its names in another place."""
    match node:
        case tree.Name(text):
            return tree.Name(text, place)
        case tree.Negative(operand):
            return tree.Negative(_units(operand, place))
        case tree.Operation(symbol, left, right):
            return tree.Operation(symbol, _units(left, place), _units(right, place))
    return node


def _is_plain_quantity(node: tree.Node) -> bool:
    """Whether `node` is a number and units: ``-10 N*m``, ``3/8 in``."""
    match node:
        case tree.Negative(operand):
            return _is_plain_quantity(operand)
        case tree.Operation("*" | "/", left, right):
            if all(isinstance(leaf, tree.Number) for leaf in tree.leaves(right)):
                return _is_plain_quantity(left)
            in_place = all(leaf.place != "free" for leaf in tree.leaves(right) if isinstance(leaf, tree.Name))
            return in_place and _is_of_units(right) and _is_plain_quantity(left)
    return isinstance(node, tree.Number)


def _named(name: str) -> tree.Node:
    if "." not in name:
        return tree.Time() if name == tree.TIME else tree.Name(name)
    name = in_expressions(name)
    if name.count(".") > 1:
        raise tree.ExpressionError(
            f"`{name}` has more than one dot; `ELEMENT.QUANTITY` was expected, such as `hinge.angle`"
        )
    return tree.Signal(name)


class Token(NamedTuple):
    """A number, name or symbol of a text, and where it stands in it."""

    kind: str
    text: str
    start: int
    end: int


def placed_tokens(text: str) -> list[Token]:
    """The tokens of `text`. Raises ExpressionError."""
    tokens: list[Token] = []
    at, parts, end = 0, 0, len(text.rstrip())
    while at < end:
        found = _TOKEN.match(text, at)
        if found is None:
            sign = text[at:].lstrip()[0]
            hint = "; numbers that vary are hardly ever equal: write `<` or `>`" if sign in "=!" else ""
            if sign == "%" and tokens and tokens[-1].kind == "number":
                hint = f"; a share is a number: write `{float(tokens[-1].text) / 100.0:g}`"
            raise tree.ExpressionError(f"`{sign}` is not understood{hint}")
        kind = str(found.lastgroup)
        tokens.append(Token(kind, found.group(kind), *found.span(kind)))
        at = found.end()
        parts += kind != "number" and tokens[-1].text != ","
        if parts > _MOST_TOKENS or len(tokens) > _MOST_LISTED:
            raise tree.ExpressionError("the expression is too long; split it with `parameters:`")
    if not tokens:
        raise tree.ExpressionError("a number was expected, got nothing")
    return tokens
