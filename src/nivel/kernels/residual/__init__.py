"""The residual of implicit methods and its derivatives."""
