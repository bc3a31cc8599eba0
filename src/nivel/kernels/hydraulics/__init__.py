"""Components of hydraulic circuits, one family of elements a file.

Every evaluation goes in this order, which is that of the families: what pistons displace, the pressure of every node, forces of pistons,
positions of valves, flows, energies.
"""
