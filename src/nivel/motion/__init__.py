"""Equations of motion: coordinates and formulations, one pair a file.

A file gives two compiled functions with the signatures of `nivel.kernels.record`:
`evaluate(machine, t, y, ydot) -> status` and `correct(machine, t, y) -> status`, the direct correction of a state; and the two
facts `POSITIONS` and `VELOCITIES`, coordinates a rigid body.
"""
