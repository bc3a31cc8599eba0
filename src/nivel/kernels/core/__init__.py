"""Basic definitions of all kernels: kinds of arrays, codes of status, addresses of records."""
