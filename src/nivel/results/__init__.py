"""What happened: sinks that keep the frames of a run, the result made of them, and how far to trust it."""
