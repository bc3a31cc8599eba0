"""Whether the steps of a run see what its loads do: functions of time, place and speed that vary faster than the steps."""
