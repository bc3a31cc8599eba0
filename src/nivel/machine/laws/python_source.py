"""The text of a Python function together with what it uses, so that it can be compiled elsewhere."""

import ast
import builtins
import inspect
import sys
import textwrap
from collections.abc import Callable
from numbers import Real
from types import FunctionType, ModuleType
from typing import Any, Final

from nivel.errors import ModelError

# Modules that a law may import by name; functions of all other modules come along as text.
_LIBRARIES: Final = frozenset({"numpy", "scipy", "numba", *sys.stdlib_module_names} - {"__main__"})


def source_of(function: Callable[..., Any]) -> str:
    """The text of a Python file that defines `function`: imports, numbers, the functions it uses, itself.

    Raises ModelError where there is no text, or where the function uses something that cannot be written down.
    """
    head: dict[str, str] = {}
    bodies: dict[str, str] = {}
    _collect(function, head, bodies)
    numbers = [line for line in head.values() if " = " in line]
    imports = ["from __future__ import annotations", *(line for line in head.values() if line not in numbers)]
    return "\n\n".join(["\n".join([*imports, *numbers]), *bodies.values()])


def _collect(function: Callable[..., Any], head: dict[str, str], bodies: dict[str, str]) -> None:
    """Put the text of `function` into `bodies`, after that of what it uses."""
    plain = inspect.unwrap(function)
    name = getattr(plain, "__name__", str(plain))
    if not isinstance(plain, FunctionType) or name == "<lambda>":
        raise ModelError(f"`{name}` is not a function made with `def`; a law in Python must be one")
    if plain.__code__.co_freevars:
        outer = plain.__code__.co_freevars[0]
        raise ModelError(f"the law `{name}` uses `{outer}` of the function around it; hand it over as an argument")
    try:
        text = textwrap.dedent(inspect.getsource(plain)).rstrip() + "\n"
    except (OSError, TypeError):
        message = f"the text of `{name}` cannot be found; keep it in a file, or write `PythonLaw(source=…, function=…)`"
        raise ModelError(message) from None
    bodies[name] = ""  # a function that uses itself is not collected again
    for used in sorted(_global_names(text, plain)):
        _collect_used(used, plain, head, bodies)
    del bodies[name]
    bodies[name] = text


def _global_names(text: str, function: FunctionType) -> set[str]:
    """Names in the text of `function` that it finds outside of itself; those in annotations do not count."""
    loaded, own = set[str](), set[str]()
    for node in ast.walk(_without_annotations(ast.parse(text))):
        match node:
            case ast.Name(name, ast.Load()):
                loaded.add(name)
            case ast.Name(name, _) | ast.arg(name):
                own.add(name)
    return {name for name in loaded - own if name in function.__globals__}


def _without_annotations(tree: ast.Module) -> ast.Module:
    for node in ast.walk(tree):
        match node:
            case ast.arg():
                node.annotation = None
            case ast.FunctionDef():
                node.returns = None
            case ast.AnnAssign():
                node.annotation = ast.Constant(None)
    return tree


def _collect_used(name: str, user: FunctionType, head: dict[str, str], bodies: dict[str, str]) -> None:
    """Put what `name` means to `user` into `head` or `bodies`."""
    value = user.__globals__[name]
    if name in bodies or value is getattr(builtins, name, None):
        return
    plain = inspect.unwrap(value) if callable(value) else value
    module = str(getattr(plain, "__module__", "") or "")
    if isinstance(value, ModuleType) and _is_library(value.__name__):
        line = f"import {value.__name__} as {name}" if name != value.__name__ else f"import {name}"
    elif _is_number(value) or (isinstance(value, tuple) and value and all(map(_is_number, value))):
        line = f"{name} = {_literal(value)}"
    elif isinstance(plain, FunctionType) and not _is_library(module):
        if plain.__name__ != name:
            raise ModelError(f"the law uses the function `{plain.__name__}` as `{name}`; use it by its own name")
        _collect(plain, head, bodies)
        return
    elif callable(value) and _is_library(_home(name, value)):
        line = f"from {_home(name, value)} import {value.__name__}"
        line += f" as {name}" if name != value.__name__ else ""
    else:
        raise ModelError(
            f"the law `{user.__name__}` uses `{name}`, which stands outside of it; hand it over as an argument"
        )
    if head.setdefault(name, line) != line:
        raise ModelError(f"`{name}` means different things to the functions that the law uses; rename one")


def _home(name: str, value: Any) -> str:
    """The module that a function is imported from; numpy's compiled functions do not know theirs."""
    module = str(getattr(value, "__module__", "") or "")
    return "numpy" if not module and type(value).__module__ == "numpy" else module


def _is_library(module: str) -> bool:
    return module.partition(".")[0] in _LIBRARIES


def _is_number(value: object) -> bool:
    return isinstance(value, Real)


def _literal(value: Any) -> str:
    """Python's spelling of a number or of a tuple of numbers, whatever type they have."""
    if isinstance(value, tuple):
        return f"({', '.join(map(_literal, value))},)"
    return repr(value) if isinstance(value, int) else repr(float(value))
