"""From an assembled machine in absolute coordinates to the numbers and the state of other coordinates, one kind a file.

A file gives `arrange(machine, absolute, y, rank, settings) -> (System, y)`: `absolute` is the machine in (R, θ; Ṙ, ω̄), six velocities a
body, y its assembled state, rank the number of its independent rows (of joints, couplings and drivers).
"""
