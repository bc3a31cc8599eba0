"""Contacts: what keeps bodies apart. A pair of shapes makes points, and one law acts at them."""
