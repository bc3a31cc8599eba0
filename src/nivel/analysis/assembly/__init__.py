"""Equations of a machine assembled: joints closed, freedoms counted, redundant rows found."""
