"""The text of a Python law for complex numbers, whose imaginary parts then carry exact derivatives.

Comparisons look at real parts, and powers and functions with branches become those of `nivel.kernels.algebra.analytic`. Only what is
known to be
right is taken: arithmetic, branches, loops, functions of the text itself and of math and numpy that are listed here. For any other text
there is none.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence

import numpy as np

from nivel.machine.units.functions import FUNCTIONS

# functions of expressions, by their names in math and in numpy
_COMMON = [(kind, (name, kind.array.__name__)) for name, kind in FUNCTIONS.items() if isinstance(kind.array, np.ufunc)]
# functions of math and numpy: the numpy function that is analytic itself
PLAIN = {
    **{each: names[1] for kind, names in _COMMON if not (kind.analytic or kind.jumps) for each in names},
    **{name: name for name in ("sinh", "cosh", "arcsinh", "arccosh", "arctanh")},
    **{f"a{name}": f"arc{name}" for name in ("sinh", "cosh", "tanh")},
}
# those, and what Python knows by itself, that have branches: the function of `nivel.kernels.algebra.analytic`
BRANCHING = {
    **{each: names[1] for kind, names in _COMMON if kind.analytic for each in names},
    **dict.fromkeys(("pow", "power"), "power"),
    "fabs": "absolute",
    "hypot": "hypot",
    "copysign": "copysign",
}
BUILT_IN = ("abs", "min", "max", "pow")
# constant between their steps
STEPS = (*(names[0] for kind, names in _COMMON if kind.jumps), "ceil", "trunc")
COUNTING = ("range", "len")
CONSTANTS = ("pi", "e", "tau", "inf", "nan")
HELPERS = ("absolute", "arctan2", "copysign", "hypot", "maximum", "minimum", "modulo", "power", "real", "tanh")
PREFIX = "_nivel_"
NUMPY = f"{PREFIX}numpy"

KNOWN = (
    *(ast.Return, ast.Assign, ast.AugAssign, ast.If, ast.IfExp, ast.For, ast.While, ast.Break, ast.Continue, ast.Pass, ast.Expr),
    *(ast.Constant, ast.Name, ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.Call, ast.Attribute, ast.Subscript, ast.Tuple),
    *(ast.expr_context, ast.operator, ast.unaryop, ast.boolop, ast.cmpop, ast.arguments, ast.arg),
)  # fmt: skip
UNKNOWN = (ast.In, ast.NotIn, ast.Is, ast.IsNot, ast.Invert, ast.MatMult, ast.FloorDiv)


class NotAnalyticError(Exception):
    """The text has something of which it is not known what it does with complex numbers."""


def analytic_text(source: str, function: str) -> str | None:
    """The text with `function` and all that it calls made analytic, or None."""
    tree = ast.parse(source)
    own = {part.name: part for part in tree.body if isinstance(part, ast.FunctionDef)}
    done: set[str] = set()
    try:
        analytic = _Analytic(tree, set(own))
        while left := (analytic.used | {function}) - done:
            name = min(left)
            analytic.visit(own[name])
            done.add(name)
    except NotAnalyticError:
        return None
    names = ", ".join(f"{name} as {PREFIX}{name}" for name in HELPERS)
    helpers = ast.parse(f"import numpy as {NUMPY}\nfrom nivel.kernels.algebra.analytic import {names}").body
    first = next((k for k, part in enumerate(tree.body) if not _stands_first(part)), len(tree.body))
    tree.body[first:first] = helpers
    return ast.unparse(ast.fix_missing_locations(tree))


def _stands_first(part: ast.stmt) -> bool:
    """Whether nothing may stand before it: the text about the module, imports of the future."""
    return isinstance(part, ast.Expr) or (isinstance(part, ast.ImportFrom) and part.module == "__future__")


class _Analytic(ast.NodeTransformer):
    """Makes functions analytic, in place, and notes which of the text's `own` they use; raises NotAnalyticError where that is not known."""

    def __init__(self, module: ast.Module, own: set[str]) -> None:
        self.used: set[str] = set()
        self._own = own
        self._modules: set[str] = set()
        self._taken: dict[str, str] = {}
        for part in module.body:
            if isinstance(part, ast.Import):
                self._modules |= {each.asname or each.name for each in part.names if each.name in ("math", "numpy")}
            elif isinstance(part, ast.ImportFrom) and part.module in ("math", "numpy"):
                self._taken |= {each.asname or each.name: each.name for each in part.names}
        given = {node.id for node in ast.walk(module) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)}
        given |= {node.arg for node in ast.walk(module) if isinstance(node, ast.arg)} | self._own
        if given & {*BUILT_IN, *COUNTING, "int", "float", *self._modules, *self._taken}:
            raise NotAnalyticError

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        if node.decorator_list:
            raise NotAnalyticError
        node.returns = None
        for argument in (*node.args.posonlyargs, *node.args.args):
            argument.annotation = None
        node.body = [self.visit(part) for part in node.body]
        return node

    def generic_visit(self, node: ast.AST) -> ast.AST:
        if not isinstance(node, KNOWN) or isinstance(node, UNKNOWN):
            raise NotAnalyticError
        return super().generic_visit(node)

    def visit_If(self, node: ast.If | ast.While | ast.IfExp) -> ast.AST:
        test = self._test(node.test)
        node.test = ast.Constant(True)
        self.generic_visit(node)
        node.test = test
        return node

    visit_While = visit_IfExp = visit_If

    def visit_BoolOp(self, node: ast.BoolOp) -> ast.AST:
        raise NotAnalyticError

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        node.left, node.comparators = _call("real", [node.left]), [_call("real", [each]) for each in node.comparators]
        return node

    def visit_UnaryOp(self, node: ast.UnaryOp) -> ast.AST:
        if isinstance(node.op, ast.Not):
            raise NotAnalyticError
        return self.generic_visit(node)

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        return _operation(node.left, node.op, node.right)

    def visit_AugAssign(self, node: ast.AugAssign) -> ast.AST:
        if not isinstance(node.target, ast.Name):
            raise NotAnalyticError
        self.generic_visit(node)
        value = _operation(ast.Name(node.target.id, ast.Load()), node.op, node.value)
        return ast.Assign([node.target], value)

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        if isinstance(node.value, ast.Name) and node.value.id in self._modules and node.attr in CONSTANTS:
            return node
        raise NotAnalyticError

    def visit_Call(self, node: ast.Call) -> ast.AST:
        name, known = self._called(node.func)
        if node.keywords or any(isinstance(each, ast.Starred) for each in node.args):
            raise NotAnalyticError
        arguments = [self.visit(each) for each in node.args]
        if known and name in BRANCHING:
            return _nested(BRANCHING[name], arguments)
        if known and name in PLAIN and len(arguments) == 1:
            return ast.Call(ast.Attribute(ast.Name(NUMPY, ast.Load()), PLAIN[name], ast.Load()), arguments, [])
        if (known and name in STEPS) or name == "int":
            return ast.Call(node.func, [_call("real", [each]) for each in arguments], [])
        if not known and name in self._own:
            self.used.add(name)
        if name in COUNTING or name in self.used:
            return ast.Call(node.func, arguments, [])
        if name == "float" and len(arguments) == 1:
            return arguments[0]
        raise NotAnalyticError

    def _called(self, function: ast.expr) -> tuple[str, bool]:
        """Name of the function called, and whether it is one of math, numpy or Python itself."""
        match function:
            case ast.Attribute(ast.Name(module), name) if module in self._modules:
                return name, True
            case ast.Name(name):
                return self._taken.get(name, name), name in self._taken or name in BUILT_IN
        raise NotAnalyticError

    def _test(self, node: ast.expr) -> ast.expr:
        """A condition: comparisons, and what is made of them by and, or, not."""
        match node:
            case ast.BoolOp(op, values):
                return ast.BoolOp(op, [self._test(each) for each in values])
            case ast.UnaryOp(ast.Not() as op, operand):
                return ast.UnaryOp(op, self._test(operand))
            case ast.Compare() | ast.Constant():
                return self.visit(node)
        raise NotAnalyticError


def _operation(left: ast.expr, op: ast.operator, right: ast.expr) -> ast.expr:
    if isinstance(op, ast.Pow):
        return _call("power", [left, right])
    if isinstance(op, ast.Mod):
        return _call("modulo", [left, right])
    return ast.BinOp(left, op, right)


def _nested(name: str, arguments: Sequence[ast.expr]) -> ast.expr:
    """Minimum and maximum of many are those of two, again and again."""
    if name not in ("minimum", "maximum"):
        return _call(name, arguments)
    if len(arguments) < 2:
        raise NotAnalyticError
    value = arguments[0]
    for each in arguments[1:]:
        value = _call(name, [value, each])
    return value


def _call(name: str, arguments: Sequence[ast.expr]) -> ast.Call:
    return ast.Call(ast.Name(f"{PREFIX}{name}", ast.Load()), [*arguments], [])
