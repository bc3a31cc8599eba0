"""Looks of a machine, from the scene of its result: solids, automatic links, colours, where to look from. Report and viewer share it."""
