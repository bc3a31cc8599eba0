"""What `nivel check` says."""
