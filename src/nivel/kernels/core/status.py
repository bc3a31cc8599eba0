"""Status codes that kernels return; `nivel.judge.during.failure` turns them into sentences."""

OK = 0
SINGULAR = 1  # a constraint row depends on the others: control.failure names it
NOT_FINITE = 2  # the state is no longer a number
BUFFER_FULL = 3  # the output buffer must be taken
BUDGET_SPENT = 4  # the chunk of steps is done
DONE = 5  # the end of the run is reached
BRISTLE_TOO_FAST = 7  # LuGre friction relaxes faster than the step can follow: control.failure is its number
CONTRADICTION = 8  # a redundant row no longer follows from the others: control.failure names it
FRICTION_DIVERGES = 6  # no friction is consistent with the reactions it causes: control.failure is its number
ROTATION_SINGULAR = 9  # rotation coordinates come to a singular position: control.failure is the body
MULTIPLIERS_NOT_FOUND = 13  # the augmented Lagrangian does not converge
EVENT_NOT_FINITE = 12  # the value of an event is no longer a number: control.failure is its number
NOT_CONVERGED = 10  # an implicit step has no solution that its iteration finds
STEP_TOO_SMALL = 11  # the error of even the smallest step is above the tolerance
NOT_ON_RAIL = 15  # a slider has no place on its beam, or is beyond its end: control.failure is its coordinate
NOT_CLOSED = 16  # positions cannot be put back onto the constraints: control.failure is the row farthest open
OPEN = 17  # positions of an accepted state are farther open than run.clock[OPEN_LIMIT]: nothing yet says whether that is drift
NO_MASS_LEFT = 14  # the modes of a flexible body take up all the mass of its frame: control.failure is its number
NO_VOLUME = 18  # a volume of a circuit has no fluid, or no room, left: control.failure is its node
