"""References of elements to each other by name, and what each element uses."""
