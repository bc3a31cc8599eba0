"""Flexible bodies: from a finite-element model to a body of a few modes that moves in a machine.

    model file  →  finite-element model  →  interfaces tied  →  basis  →  modes  →  body file
    model_file     frame, solid, foreign    ties                bases    orthonormal  body, body_file

`reduce.py` goes this way. `invariants.py` has the inertia of the modes, `stiffening.py` their geometric stiffness, `reference.py` what
a moving body answers, `recovery.py` stresses after a run.
"""
