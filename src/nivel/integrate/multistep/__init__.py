"""Methods of Adams and Gear with a constant step."""
