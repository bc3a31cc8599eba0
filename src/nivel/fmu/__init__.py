"""A machine as an FMU: a unit for co-simulation by FMI 3.0 or 2.0, which needs neither Python nor a compiler."""
