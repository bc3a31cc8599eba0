"""Parts of blocks of the control, their order, and what is wrong between them."""
