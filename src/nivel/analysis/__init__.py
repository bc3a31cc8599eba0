"""Analyses of a machine: assembly, statics, kinematics, motion in time, linearisation, inverse dynamics."""
