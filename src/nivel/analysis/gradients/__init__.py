"""Gradients of runs: derivatives of what a run computes with respect to numbers of the machine, by the same code on dual numbers."""
