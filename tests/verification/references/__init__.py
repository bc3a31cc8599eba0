"""Reference solutions in plain numpy and scipy. Nothing here imports the package under test."""
