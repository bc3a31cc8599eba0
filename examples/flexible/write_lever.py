"""Writes the files in `lever/` as CalculiX writes them for `*FREQUENCY, SOLVER=MATRIXSTORAGE`: here from a frame of nivel's own beams.

They stand for the matrices of another program: a bell crank of two arms of steel, in millimetres and tonnes, one triangle of each
symmetric matrix, and no supports. Run with a folder as argument to write them elsewhere.
"""

import sys
from pathlib import Path

import numpy as np

from nivel.flexible.model.frame import frame_model
from nivel.flexible.model.model_file import parse_model

FRAME = """
format: 1
name: lever
materials: {steel: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}}
sections: {arm: {type: rectangle, width: 15 mm, height: 10 mm}}
frame:
  nodes: {pivot: [0, 0, 0], long: [0.4, 0, 0], short: [0, 0.2, 0]}
  beams:
    long: {nodes: [pivot, long], section: arm, material: steel, elements: 3}
    short: {nodes: [pivot, short], section: arm, material: steel, elements: 2}
"""


def write(folder: Path) -> None:
    """Nodes and node sets (.inp), the freedom of each row (.dof), stiffness (.sti) and mass (.mas)."""
    model = frame_model(parse_model(FRAME))
    nodes = [f"{k + 1}, {x:.6g}, {y:.6g}, {z:.6g}" for k, (x, y, z) in enumerate(1000.0 * model.position)]
    sets = [f"*NSET, NSET={name.upper()}\n{node + 1}" for name, node in model.names.items()]
    (folder / "lever.inp").write_text("\n".join(["*NODE, NSET=ALL", *nodes, *sets]) + "\n")
    rows = [f"{node}.{axis}" for node in range(1, len(nodes) + 1) for axis in range(1, 7)]
    (folder / "lever.dof").write_text("\n".join(rows) + "\n")
    # N/mm, N and N mm; t, t mm and t mm²: what belongs to turns is 1000 times larger, what belongs to moving 1000 times smaller
    scale = np.tile(np.repeat([1000.0**-0.5, 1000.0**0.5], 3), len(nodes))
    for suffix, matrix in (("sti", model.stiffness), ("mas", model.mass.matrix)):
        full = scale[:, None] * matrix.toarray() * scale
        at = [(i, j) for i in range(len(full)) for j in range(i + 1) if full[i, j] != 0.0]
        lines = [f"{j + 1} {i + 1} {full[i, j]:20.13e}" for i, j in at]
        (folder / f"lever.{suffix}").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    write(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "lever")
