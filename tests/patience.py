"""How long tests wait for what must happen. No test asserts a time: a machine in use may be ten times slower than one at rest, or more."""

PATIENCE = 900.0  # seconds, after which something is taken to hang
