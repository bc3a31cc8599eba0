"""All sentences about a machine: before, during and after its analysis."""
