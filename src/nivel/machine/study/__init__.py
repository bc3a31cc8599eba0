"""A study in words: a machine, what varies, how variants are drawn, which analysis each is, and what is kept of it."""
