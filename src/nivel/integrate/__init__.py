"""Integrators, one family a file, and the loop that drives them.

An integrator is one compiled function `step(evaluate, machine, history) -> status` that advances the state by one step, and beside it its
`FACTS` (`nivel.integrate.facts`). `nivel.integrate.catalogue` finds them; its word stands in `nivel.methods`.
"""
