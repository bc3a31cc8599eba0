"""Blocks of a control in words: what `nivel check` says of them."""

from __future__ import annotations

from collections.abc import Sequence

from nivel.analysis.check.elements import function_in_words
from nivel.machine.control.block import Block
from nivel.machine.control.part import PartFunction
from nivel.machine.units.formula import Formula
from nivel.machine.units.linear_function import LinearFunction


def block_in_words(block: Block) -> str:
    """Kind of a block, what it takes, and when."""
    taken = [_in_words(part.function) for part in block.parts if part.key]
    of = f" of {', '.join(dict.fromkeys(taken))}" if taken else ""
    return f"{block.name}: {block.type}{of}{_times(block)}"


def control_in_words(blocks: Sequence[Block]) -> str:
    """How many blocks, continuous states and sampled values there are."""
    roles = [part.role for block in blocks for part in block.parts]
    states, values = roles.count("state"), roles.count("sample") + roles.count("memory")
    periods = sorted({block.period for block in blocks if block.is_sampled})
    often = f" every {', '.join(f'{period:.6g} s' for period in periods)}" if periods else ""
    count = f"{len(blocks)} block{'s' * (len(blocks) != 1)}"
    return (
        f"{count}, {states} continuous state{'s' * (states != 1)}, {values} sampled value{'s' * (values != 1)}{often}"
    )


def _in_words(function: PartFunction) -> str:
    if isinstance(function, LinearFunction):
        return " + ".join(f"{factor:.6g}*{path}" for factor, path in function.terms)
    assert not isinstance(function, Formula)  # made by the block, not given
    return function_in_words(function)


def _times(block: Block) -> str:
    if not block.is_sampled:
        return ", continuous"
    later = f" from {block.offset:.6g} s" if block.offset else ""
    late = f", {block.latency:.6g} s late" if block.latency else ""
    return f", every {block.period:.6g} s{later}{late}"
