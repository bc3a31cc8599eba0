"""Integrators, one family a file, and the loop that drives them.

An integrator is one compiled function `step(evaluate, machine, history) -> status` that advances the state by one step, plus its line in
`nivel.integrate.catalogue`.
"""
