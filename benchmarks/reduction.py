"""How long it takes to make a flexible body of a meshed boom of about 70 000 freedoms, stage by stage, and to read it back.

And its memory, against that of a process that only factorises the same stiffness once and computes twenty modes with it.

    OMP_NUM_THREADS=1 python benchmarks/reduction.py [ELEMENT_SIZE]

Twelve interface freedoms and twenty normal modes, with geometric stiffness. One thread of the linear algebra is faster than two.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import scipy.sparse as sp

from nivel.flexible.body.body_file import read_body, write_body
from nivel.flexible.model.model_file import read_model
from nivel.flexible.reduce import reduce, source_model
from nivel.flexible.reduction.free_body import FreeBody

BOOM = Path(__file__).parent.parent / "examples" / "flexible" / "crane-boom.yaml"
SOLVER = """
import sys
import scipy.sparse as sp
import scipy.sparse.linalg as spl

K, M = (sp.csc_matrix(sp.load_npz(f"{sys.argv[1]}/{name}.npz")) for name in "KM")
lu = spl.splu(K, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
spl.eigsh(K, k=20, M=M, sigma=0.0, OPinv=spl.LinearOperator(K.shape, matvec=lu.solve, dtype=float))
print(next(line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")))
"""  # a process begins with the ru_maxrss of the one that starts it


class Watch:
    """Prints the processor time that each stage took."""

    def __init__(self) -> None:
        self.stage, self.begin = "", time.process_time()

    def __call__(self, stage: str, _share: float) -> None:
        now = time.process_time()
        if self.stage:
            print(f"{now - self.begin:7.2f} s  {self.stage}")
        self.stage, self.begin = stage, now


def solver_memory(size: str) -> float:
    """[MB] of the solver itself."""
    located = read_model(BOOM, overrides={"solid.element_size": size})
    body = FreeBody.of(source_model(located, lambda *_: None)[0])
    free = body.all_but(body.pins)
    with tempfile.TemporaryDirectory() as folder:
        for name, matrix in (("K", body.K), ("M", body.M)):
            sp.save_npz(f"{folder}/{name}.npz", sp.csc_matrix(matrix[free][:, free]))
        told = subprocess.run([sys.executable, "-c", SOLVER, folder], capture_output=True, text=True, check=True)
    return float(told.stdout) / 1e3


def main() -> None:
    size = sys.argv[1] if len(sys.argv) > 1 else "48 mm"
    start = time.process_time()
    reduction = reduce(BOOM, overrides={"solid.element_size": size}, stage=Watch())
    total = time.process_time() - start
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
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
    alone = solver_memory(size)
    print(f"{memory:7.0f} MB at most; the solver itself {alone:.0f} MB: {memory / alone:.2f} times")


if __name__ == "__main__":
    main()
