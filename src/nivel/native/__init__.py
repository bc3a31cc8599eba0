"""Machine code: functions written in Python, compiled to object files, kept, loaded and called by their addresses.

`function` marks what is compiled, `entry` what has an address; neither imports Numba. An entry without machine code is compiled by a
process of its own (`worker`, where entries meet Numba: `with_numba`), and its object file is kept (`store`) under a name made of
everything it depends on (`sources`). `library` loads object files.
"""
