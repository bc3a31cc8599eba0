"""Numba's front end without what it repeats for every function; what it writes is the same.

Numba asks all templates of `+` for the types of every sum, looks through its registries at every call, and computes after every pass which
variables live. A process that only translates needs these once: types are kept, registries are read again only where they have grown, and
lives of variables are computed where references are counted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from numba.core import analysis, base, config, errors, ir, lowering, postproc, transforms
from numba.core.analysis import must_use_alloca
from numba.core.types.functions import BaseFunction
from numba.core.typing.context import BaseContext

_ITEMS = ("functions", "attributes", "globals", "getattrs", "setattrs", "casts", "constants")


def install() -> None:
    """Change Numba, once a process."""
    changed: Any = BaseFunction
    changed.get_call_type = _kept(changed.get_call_type)
    for changed in (BaseContext, base.BaseContext):
        changed.refresh = _where_grown(changed.refresh)
    changed.get_abi_sizeof = cache(changed.get_abi_sizeof)
    changed = ir.Inst
    changed._rec_list_vars = lambda self, value: [*_variables(value)]
    changed = postproc.PostProcessor
    changed.run = _post_process(changed.run)
    changed = lowering.Lower
    changed._find_singly_assigned_variable = _find_values(changed._find_singly_assigned_variable)
    changed = config
    changed.reload_config = lambda: None  # nobody changes the environment of a worker
    if changed := getattr(errors, "HighlightColorScheme", None):
        changed._markup = lambda self, text, *_, **__: text  # errors are built by the thousand, and thrown away


def _kept(get_call_type: Callable[..., Any]) -> Callable[..., Any]:
    """Types of a call of one of Numba's own functions depend on the types of the arguments alone."""
    found: dict[Any, Any] = {}

    def get(self: Any, context: Any, args: Any, kws: Any) -> Any:
        key = self, args, tuple(kws.items())
        signature = found.get(key)
        if signature is None:
            signature = found[key] = get_call_type(self, context, args, kws)
        return signature

    return get


def _where_grown(refresh: Callable[[Any], None]) -> Callable[[Any], None]:
    """Read registries where something was added to them."""

    def read(self: Any) -> None:
        if _size(self) != getattr(self, "size_read", None):
            refresh(self)
            self.size_read = _size(self)

    return read


def _size(context: Any) -> int:
    return sum(len(getattr(registry, items, ())) for registry in context._registries for items in _ITEMS)


def _variables(value: Any) -> Iterator[Any]:
    """Variables within a part of a statement."""
    if isinstance(value, ir.Var):
        yield value
    elif isinstance(value, ir.Inst):
        yield from value.list_vars()
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _variables(each)
    elif isinstance(value, dict):
        for each in value.values():
            if not isinstance(each, str | ir.Loc | int):
                yield from _variables(each)


def _post_process(run: Callable[..., Any]) -> Callable[..., Any]:
    def post_process(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        if emit_dels or self.func_ir.is_generator:
            run(self, emit_dels, extend_lifetimes)
            return
        self.func_ir.blocks = transforms.canonicalize_cfg(self.func_ir.blocks)
        self.func_ir.variable_lifetime = postproc.VariableLifetime(self.func_ir.blocks)
        self.func_ir.generator_info = None

    return post_process


def _find_values(find: Callable[..., Any]) -> Callable[..., Any]:
    """Variables that are assigned once, before all their uses, are values. The others have a place in memory, which Numba gives to all that
    more than one block uses. Where references are counted, a variable is also used where it ends, which may be elsewhere."""

    def find_values(self: Any) -> None:
        if self.func_ir.func_id.is_generator or self.context.enable_nrt:
            find(self)
            return
        defined: dict[str, int] = {}
        places = must_use_alloca(self.blocks)
        for number, block in self.blocks.items():
            for statement in block.find_insts(ir.Assign):
                name = statement.target.name
                if name in defined:
                    places.add(name)
                defined[name] = number
        before = analysis.compute_cfg_from_blocks(self.blocks).dominators()
        # what a block uses without having assigned it
        for number, names in analysis.compute_use_defs(self.blocks).usemap.items():
            places |= {each for each in names if not _is_before(defined.get(each), number, before)}
        self._singly_assigned_vars = {*defined} - places
        self._blk_local_varmap = {}

    return find_values


def _is_before(block: int | None, other: int, before: Any) -> bool:
    """Whether a block is run before another, whenever that is run, and written before it."""
    return block is not None and block < other and block in before[other]
