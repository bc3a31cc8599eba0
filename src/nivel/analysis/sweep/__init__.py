"""Many runs of one machine with other values: on all processors, into one xarray dataset."""
