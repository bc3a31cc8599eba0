"""Methods of Newmark's family, on the residual."""
