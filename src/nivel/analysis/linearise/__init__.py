"""Small motions about a state: the equations of motion made linear, their eigenvalues, inputs and outputs."""
