"""Entries are compiled here for processors of another family: the object is theirs, and where they can be imitated it gives the same."""

import shutil
import struct
import subprocess

import numpy as np
import pytest
import toy_entries as toys

from nivel.native import library, store, workers
from nivel.native.processor import LEVELS

X = np.array([3.0, 4.5, -5.25])
# `e_machine` of an ELF file
ELF_MACHINE = {"x86_64": 62, "aarch64": 183}
PROGRAM = """
#include <stdint.h>
#include <stdio.h>
double toy_entries_squares(double *, int64_t, int64_t);
int main(void) { double x[] = {3.0, 4.5, -5.25}; printf("%a", toy_entries_squares(x, 3, 0)); return 0; }
"""


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    """The object file of an entry for every level."""
    folder = tmp_path_factory.mktemp("levels")
    paths = {name: folder / f"{name}.o" for name in LEVELS}
    targets = [(str(path), LEVELS[name].target) for name, path in paths.items()]
    workers.compile_all([library.job_of(toys.squares, targets)])
    for path in paths.values():
        path.write_bytes(store.read(path))
    return paths


@pytest.mark.parametrize("name", LEVELS)
def test_the_object_is_of_the_family(objects, name):
    assert struct.unpack_from("<H", objects[name].read_bytes(), 18)[0] == ELF_MACHINE[LEVELS[name].machine]


@pytest.mark.skipif(
    not (shutil.which("aarch64-linux-gnu-gcc") and shutil.which("qemu-aarch64-static")), reason="no imitation"
)
def test_the_number_is_the_same_to_the_last_bit(objects, tmp_path):
    (tmp_path / "main.c").write_text(PROGRAM)
    built = [tmp_path / "main", tmp_path / "main.c", objects["armv8-a"], "-lm"]
    subprocess.run(["aarch64-linux-gnu-gcc", "-static", "-o", *built], check=True)
    done = subprocess.run(["qemu-aarch64-static", built[0]], check=True, capture_output=True, text=True)
    assert float.fromhex(done.stdout) == toys.squares(X, 0)
