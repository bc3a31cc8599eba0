"""Coordinates of patches where surfaces touch: what measures them is the contact, see `nivel.kernels.elements.patch`."""

# kind of the coordinates
PATCH = 20
# Rows of `friction.work`, of the state last evaluated and of the accepted one: the effort of what slides, 0 of what holds; 1 where what
# holds is at rest and stops no longer.
PROPOSED, KEPT, RESTING, RESTS = 5, 6, 7, 8
