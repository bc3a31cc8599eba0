"""Methods of many steps that choose step and order."""
