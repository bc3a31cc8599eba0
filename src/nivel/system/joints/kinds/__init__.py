"""Kinds of joints: every module of this folder says in KINDS which it has."""
