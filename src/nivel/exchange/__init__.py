"""Models of other programs: read into machine files, and written from machines."""

from nivel.exchange.reader import read_model, translated_machine
from nivel.exchange.translation import Translation

__all__ = ["Translation", "read_model", "translated_machine"]
