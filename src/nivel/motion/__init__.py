"""Equations of motion: coordinates and formulations, one pair a file.

A file gives two compiled functions with the signatures of `nivel.kernels.record.record`: `evaluate(machine, t, y, ydot) -> status` and
`normalise_state(machine, t, y) -> status`, what is done to a state after a step without correction. A second file beside it gives
`correct(machine, t, y) -> status`, the direct correction; it is compiled by runs that use it. In independent coordinates `correct` is
`normalise_state`, and a third file gives `depend`, which implicit methods call by its address for what follows from the independent ones.
"""
