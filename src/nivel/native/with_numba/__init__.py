"""Numba's side: types, instructions that Numba cannot say, and the way from functions to object files. Nothing else imports Numba."""
