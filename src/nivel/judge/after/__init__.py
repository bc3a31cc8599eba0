"""After an analysis: the trust report, its checks, and the verdicts on what they find."""
