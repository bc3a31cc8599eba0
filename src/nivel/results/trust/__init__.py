"""What the trust report looks at, and its words."""
