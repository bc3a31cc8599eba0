"""Hydraulic circuits in numbers: nodes first, then components by family.

A component is its words (`nivel.machine.hydraulics`), kernels (`nivel.kernels.hydraulics`) and a function here that gives its rows.
"""
