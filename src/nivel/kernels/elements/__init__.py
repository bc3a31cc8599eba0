"""Shared parts of forces: friction of joints, the strain of a beam."""
