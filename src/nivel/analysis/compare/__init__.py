"""Methods compared with each other on one machine."""
