"""Before an analysis: what a machine cannot be, what is unusual in it, and what it is in words."""
