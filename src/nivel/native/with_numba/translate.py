"""From an entry to an object file.

Numba would optimise every function by itself, again within each that calls it, and emit machine code for all of them. Here it only
translates: every function once a process, into intermediate code. The functions that an entry reaches are linked, all but the entry made
internal, optimised together once, and emitted.

LLVM's unrolling of loops with a count known at run time only is off: most of ours run three times or less, and eight copies of their
bodies, never entered, push the rest of an evaluation out of the processor's cache of instructions (a tenth of a step).

These settings change the process, which therefore is a worker and nothing else.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numba
from llvmlite import binding, ir
from numba import njit, types
from numba.core import codegen, compiler_lock
from numba.core.registry import cpu_target
from numba.core.runtime.nrt import rtsys

from nivel.native.function import OPTIONS
from nivel.native.signature import BROKEN, IN_C, Signature
from nivel.native.with_numba import front_end, functions, known_parts
from nivel.native.with_numba.arrays import WORD
from nivel.native.with_numba.calls import ALIGNMENT, VECTORS, from_c, function_type
from nivel.native.with_numba.kinds import RESULTS, arguments_of

_njit: Any = njit


# version of Numba whose inside is known here; another one is slower, and left as it is
KNOWN = "0.68."
# instructions from which on a function that several places call is not put into them
LARGE = 1500


class NeedsNumbaError(Exception):
    """Code that calls functions of Numba or of Python when it runs."""


class Part:
    """A function of intermediate code. size : number of its instructions. calls : names of what it calls, once for each place."""

    def __init__(self, function: Any) -> None:
        instructions = [each for block in function.blocks for each in block.instructions]
        self.name, self.size = function.name, len(instructions)
        self.inlined = "alwaysinline" in function.attributes
        self.calls = [each.callee.name for each in instructions if isinstance(each, ir.CallInstr)]


class Translation(codegen.CPUCodeLibrary):
    """The intermediate code of one function, and which others it needs."""

    parts: Sequence[Part] = ()

    def add_ir_module(self, ir_module: Any) -> None:
        """Note how large functions are, and which others they call."""
        self.parts = [*self.parts, *(Part(each) for each in ir_module.functions if each.blocks)]
        super().add_ir_module(ir_module)

    def add_llvm_module(self, ll_module: Any) -> None:
        """Take the code as it is."""
        self._final_module.link_in(ll_module)

    def finalize(self) -> None:
        """Nothing more is added; nothing is done with it yet."""
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        """There is no machine code; nobody here calls a function."""
        return 1

    def closure(self) -> Iterator[Translation]:
        """This function and all that it needs."""
        found, left = {self: None}, [self]
        while left:
            library = left.pop()
            yield library
            for each in library._linking_libraries:
                if each not in found:
                    found[each] = None
                    left.append(each)


class Translator(codegen.JITCPUCodegen):
    """Makes translations."""

    _library_class = Translation

    def set_env(self, env_name: str, env: Any) -> None:
        """Nobody here calls a function."""


def install() -> Any:
    """Let Numba only translate from now on. Returns its context of compilation."""
    context: Any = cpu_target.target_context
    if not isinstance(context._internal_codegen, Translator):
        rtsys.initialize(context)
        binding.set_option("nivel", "-unroll-runtime=false")
        context._internal_codegen = Translator("nivel")
        if numba.__version__.startswith(KNOWN):
            front_end.install()
            known_parts.install()
        functions.MORE |= {"no_cpython_wrapper": True, "no_cfunc_wrapper": True}
    return context


def target_machine(cpu: str, features: str, triple: str = "") -> Any:
    """LLVM's target, for code that may stand anywhere in memory. triple : of another system than this one."""
    codegen.initialize_llvm()
    target = binding.Target.from_triple(triple or binding.get_process_triple())
    return target.create_target_machine(cpu=cpu, features=features, opt=3, reloc="pic", codemodel="default")


def host() -> tuple[str, str]:
    """Name and features of this processor."""
    return binding.get_host_cpu_name(), codegen.get_host_cpu_features()


@compiler_lock.global_compiler_lock
def object_code(function: Any, signature: Signature, symbol: str, machine: Any, **options: Any) -> bytes:
    """The object file with one symbol: `function` compiled for this signature, with `OPTIONS` or these. Raises NeedsNumbaError."""
    return optimised(linked(function, signature, symbol, **options), machine)


def linked(function: Any, signature: Signature, symbol: str, **options: Any) -> Any:
    """The intermediate code of a function and of all that it reaches, one module that is not optimised yet."""
    context = install()
    dispatcher = _njit(**(options or OPTIONS), **functions.MORE)(function)
    arguments = arguments_of(signature)
    dispatcher.compile(RESULTS[signature.result](*arguments))
    compiled = dispatcher.overloads[arguments]
    module = binding.parse_assembly(str(_in_c(context, compiled.fndesc, signature, symbol)))
    libraries = [*compiled.library.closure()]
    for each in libraries:
        module.link_in(each._final_module.clone())
    called = large_parts(
        [part for each in libraries if isinstance(each, Translation) for part in each.parts],
        compiled.fndesc.mangled_name,
    )
    for each in (*module.functions, *module.global_variables):
        if not each.is_declaration and each.name != symbol:
            each.linkage = "internal"
        if each.name in called:
            each.add_function_attribute("noinline")
    module.verify()
    return module


def large_parts(parts: Iterable[Part], first: str) -> set[str]:
    """Names of functions that stay functions: those that are large, with all that is put into them, and called from several places.

    LLVM would put some of them into each of these places, and optimise every copy. first : name of what is called from outside.
    """
    found = {part.name: part for part in parts}
    sizes: dict[str, int] = {}
    places: Counter[str] = Counter()

    def size(part: Part) -> int:
        if part.name not in sizes:
            sizes[part.name] = part.size + sum(
                size(found[name]) for name in part.calls if name in found and found[name].inlined
            )
        return sizes[part.name]

    def count(part: Part) -> None:
        for name in part.calls:
            if name in found:
                places[name] += 1
                if found[name].inlined or places[name] == 1:
                    count(found[name])

    count(found[first])
    return {name for name, part in found.items() if not part.inlined and places[name] > 1 and size(part) > LARGE}


def optimised(module: Any, machine: Any) -> bytes:
    """The object file of a linked module, inlined, optimised and vectorised as at -O3. The module is left as it is."""
    module = module.clone()
    module.data_layout, module.triple = str(machine.target_data), machine.triple
    options = binding.create_pipeline_tuning_options(speed_level=3)
    options.loop_vectorization, options.slp_vectorization = True, False
    builder = binding.create_pass_builder(machine, options)
    builder.getModulePassManager().run(module, builder)
    if foreign := sorted(
        each.name for each in module.functions if each.is_declaration and not _is_everywhere(each.name)
    ):
        raise NeedsNumbaError(", ".join(foreign))
    return bytes(machine.emit_object(module))


def _is_everywhere(name: str) -> bool:
    """Whether a function is LLVM's or of the C library, and not one of Numba or of Python."""
    return not name.startswith(("NRT_", "numba_", "Py", "_Py", ".numba"))


def _in_c(context: Any, description: Any, signature: Signature, symbol: str) -> Any:
    """A module with the C function that calls Numba's; `BROKEN` where that raises."""
    module = ir.Module(symbol)
    module.triple, module.data_layout = binding.get_process_triple(), str(context.target_data)
    function = ir.Function(module, function_type(signature), symbol)
    builder = ir.IRBuilder(function.append_basic_block())
    parts = list(function.args)
    place = parts.pop(0) if signature.result in VECTORS else None
    values = []
    for kind in signature.arguments:
        count = len(IN_C[kind])
        values.append(from_c(context, builder, kind, parts[:count]))
        parts = parts[count:]
    callee = context.declare_function(module, description)
    result = RESULTS[signature.result]
    status, value = context.call_conv.call_function(builder, callee, result, arguments_of(signature), values)
    if signature.result == "nothing":
        builder.ret(builder.select(status.is_ok, ir.Constant(WORD, 0), ir.Constant(WORD, BROKEN)))
    elif place is not None:
        pointer = builder.bitcast(place, context.get_value_type(result).as_pointer())
        builder.store(value, pointer, align=ALIGNMENT)
        builder.ret_void()
    elif result == types.int64:
        builder.ret(builder.select(status.is_ok, value, ir.Constant(value.type, BROKEN)))
    else:
        builder.ret(builder.select(status.is_ok, value, ir.Constant(value.type, float("nan"))))
    return module
