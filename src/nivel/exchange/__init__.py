"""Models of other programs: read into machine files, and written from machines."""

from nivel.exchange.reader import as_machine, read_model, translated_machine
from nivel.exchange.translation import Translation

__all__ = ["Translation", "as_machine", "read_model", "translated_machine"]
