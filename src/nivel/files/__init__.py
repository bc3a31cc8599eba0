"""Readers and writers of machine files."""

from nivel.files.mesh_file import read_mesh
from nivel.files.reader import locate, parse_machine, read_machine, read_text
from nivel.files.schema import schema
from nivel.files.writer import write_machine

__all__ = ["locate", "parse_machine", "read_machine", "read_mesh", "read_text", "schema", "write_machine"]
