"""Section resultants and shapes of beams."""
