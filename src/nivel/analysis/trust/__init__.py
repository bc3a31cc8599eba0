"""Trust report of an analysis: its checks, and the verdicts on what they find."""
