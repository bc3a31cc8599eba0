"""During an analysis: what stopped it, and what to do about it."""
