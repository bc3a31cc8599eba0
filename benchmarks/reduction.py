"""How long it takes to make a flexible body of a meshed boom of about 70 000 freedoms, stage by stage, and to read it back.

    OMP_NUM_THREADS=1 python benchmarks/reduction.py [ELEMENT_SIZE]

Twelve interface freedoms and twenty normal modes, with geometric stiffness. One thread of the linear algebra is faster than two.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

from nivel.flexible.body.body_file import read_body, write_body
from nivel.flexible.reduce import reduce

BOOM = Path(__file__).parent.parent / "examples" / "flexible" / "crane-boom.yaml"


class Watch:
    """Prints the processor time that each stage took."""

    def __init__(self) -> None:
        self.stage, self.begin = "", time.process_time()

    def __call__(self, stage: str, _share: float) -> None:
        now = time.process_time()
        if self.stage:
            print(f"{now - self.begin:7.2f} s  {self.stage}")
        self.stage, self.begin = stage, now


def main() -> None:
    size = sys.argv[1] if len(sys.argv) > 1 else "48 mm"
    start = time.process_time()
    reduction = reduce(BOOM, overrides={"solid.element_size": size}, stage=Watch())
    total = time.process_time() - start
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "boom.nc"
        write_body(reduction.body, path)
        start = time.process_time()
        read_body(path)
        reading = time.process_time() - start
        megabytes = path.stat().st_size / 1e6
    modes = len(reduction.body.eigenvalues)
    print(
        f"{total:7.2f} s  {reduction.findings.freedoms} freedoms → {modes} modes; read back in {reading:.3f} s ({megabytes:.0f} MB)"
    )


if __name__ == "__main__":
    main()
