"""What every kernel meets: kinds of arrays, codes of status, addresses of records."""
