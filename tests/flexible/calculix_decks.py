"""Decks of all elasticities, and the nodal stresses that CalculiX gives for them, stored in `calculix_stress.json`.

All nodes move as `displacement` says, in a step *STATIC. `python tests/flexible/calculix_decks.py` runs CalculiX (2.20 wrote the file) and
writes the stresses anew.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

STRESSES = Path(__file__).with_name("calculix_stress.json")
CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
PARTS = {
    8: [range(8)],
    6: [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
    4: [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
}
MIDDLES = {
    8: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    6: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    4: ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
}
CORNERS = {"C3D4": 4, "C3D8": 8, "C3D8I": 8, "C3D8R": 8, "C3D10": 4, "C3D15": 6, "C3D20R": 8}
NODES = {"C3D4": 4, "C3D8": 8, "C3D8I": 8, "C3D8R": 8, "C3D10": 10, "C3D15": 15, "C3D20R": 20}
ELASTIC = {
    "iso": "*ELASTIC\n210000., .3",
    "iso-t": "*ELASTIC\n210000., .3, 0.\n180000., .33, 500.\n120000., .35, 900.",
    "ortho": "*ELASTIC, TYPE=ORTHO\n140000., 6000., 12000., 5000., 4500., 11000., 5000., 4000.,\n3000.",
    "ortho-t": "*ELASTIC, TYPE=ORTHO\n140000., 6000., 12000., 5000., 4500., 11000., 5000., 4000.,\n3000., 0.\n"
    "100000., 3000., 8000., 2000., 1500., 7000., 2000., 3000.,\n1000., 600.",
    "engineering": "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n135000., 9000., 7000., .3, .25, .4, 5000., 4500.,\n3000.",
    "engineering-t": "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n135000., 9000., 7000., .3, .25, .4, 5000., 4500.,\n3000., 20.\n"
    "95000., 5000., 6000., .32, .2, .3, 3000., 3500.,\n2000., 420.",
    "aniso": "*ELASTIC, TYPE=ANISO\n140000., 6000., 12000., 5000., 4500., 11000., 1500., -800.,\n"
    "400., 5000., 700., 300., -200., 250., 4000., 1100.,\n-600., 350., 150., -120., 3000.",
}
ORIENTATION = {
    "": "",
    "rectangular": "*ORIENTATION, NAME=AXES\n1., .4, .2, -.3, 1., .1",
    "turned": "*ORIENTATION, NAME=AXES, SYSTEM=RECTANGULAR\n1., .4, .2, -.3, 1., .1\n3, 35.",
    "turned-2": "*ORIENTATION, NAME=AXES\n1., .4, .2, -.3, 1., .1\n2, -50.",
    "cylindrical": "*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL\n-5., 20., -3., 40., 25., 2.",
}
# type of the elements, elasticity, orientation, temperatures, elasticity of the second half
CASES = {
    **{f"{kind}": (kind, "iso", "", "", "") for kind in NODES},
    **{
        f"{kind} cylindrical": (kind, "ortho", "cylindrical", "", "")
        for kind in ("C3D4", "C3D8", "C3D8I", "C3D10", "C3D15")
    },
    **{f"{kind} warm": (kind, "iso-t", "", "field", "") for kind in ("C3D8", "C3D10", "C3D20R")},
    **{f"ortho {axes}": ("C3D20R", "ortho", axes, "", "") for axes in ("", "turned")},
    **{f"engineering {axes}": ("C3D20R", "engineering", axes, "", "") for axes in ("", "rectangular")},
    **{f"aniso {axes}": ("C3D20R", "aniso", axes, "", "") for axes in ("", "turned-2", "cylindrical")},
    "engineering warm": ("C3D8I", "engineering-t", "rectangular", "uniform", ""),
    "ortho warm": ("C3D10", "ortho-t", "cylindrical", "field", ""),
    "no temperature": ("C3D8", "iso-t", "", "", ""),
    "two materials": ("C3D20R", "engineering", "turned", "", "iso"),
    "two warm materials": ("C3D8", "aniso", "cylindrical", "uniform", "iso-t"),
}


def block(kind):
    """Places (n, 3) and elements of a warped and graded block of three cells."""
    rng = np.random.default_rng(3)
    x, y, z = np.meshgrid(np.linspace(0.0, 1.0, 4) ** 1.3, (0.0, 1.0), (0.0, 1.0), indexing="ij")
    grid = np.stack([100.0 * x, 12.0 * y, 9.0 * z], axis=-1)
    grid += (0.0 if kind == "C3D8R" else 0.1) * np.array([30.0, 12.0, 9.0]) * rng.uniform(-1.0, 1.0, size=grid.shape)
    numbers, places, elements = {}, [], []
    for i in range(3):
        for part in PARTS[CORNERS[kind]]:
            own = [grid[i + CUBE[k][0], CUBE[k][1], CUBE[k][2]] for k in part]
            if NODES[kind] > len(own):
                own += [(own[a] + own[b]) / 2.0 for a, b in MIDDLES[CORNERS[kind]]]
            for place in own:
                if tuple(np.round(place, 9)) not in numbers:
                    numbers[tuple(np.round(place, 9))] = len(numbers) + 1
                    places.append(np.round(place, 9))
            elements.append([numbers[tuple(np.round(place, 9))] for place in own])
    return np.array(places), elements


def deck(kind, elasticity, orientation, temperature, second):
    """The deck of a case, without a step."""
    places, elements = block(kind)
    lines = ["*NODE, NSET=NALL", *(f"{k}, {x:.9f}, {y:.9f}, {z:.9f}" for k, (x, y, z) in enumerate(places, start=1))]
    half = len(elements) // 2 if second else len(elements)
    for name, first, part in (("E1", 1, elements[:half]), ("E2", half + 1, elements[half:])):
        lines += [f"*ELEMENT, TYPE={kind}, ELSET={name}"] if part else []
        for k, nodes in enumerate(part, start=first):
            row = [str(each) for each in (k, *nodes)]
            lines += [
                ", ".join(row[:16]) + ("," if len(row) > 16 else ""),
                *([", ".join(row[16:])] if len(row) > 16 else []),
            ]
    lines += [ORIENTATION[orientation], "*MATERIAL, NAME=M1", ELASTIC[elasticity]]
    lines += ["*SOLID SECTION, ELSET=E1, MATERIAL=M1" + (", ORIENTATION=AXES" if orientation else "")]
    if second:
        lines += ["*MATERIAL, NAME=M2", ELASTIC[second], "*SOLID SECTION, ELSET=E2, MATERIAL=M2"]
    if temperature:
        lines += ["*INITIAL CONDITIONS, TYPE=TEMPERATURE"]
        lines += (
            ["NALL, 260."]
            if temperature == "uniform"
            else [f"{k}, {8.0 * x + 10.0 * y:.6f}" for k, (x, y, _) in enumerate(places, start=1)]
        )
    return "\n".join(line for line in lines if line) + "\n"


def displacement(places):
    """(n, 3) stretched, sheared, bent and twisted."""
    x, y, z = (places / np.array([100.0, 12.0, 9.0])).T
    return 1e-2 * np.stack([x + 0.5 * y + x * z, 0.3 * y - 0.4 * x * x + 0.2 * x * z, 0.6 * z + 0.3 * x * y], axis=1)


def by_calculix(name):
    """(n, 6) [N/mm²] stress xx, yy, zz, xy, yz, zx at the nodes, by CalculiX."""
    text, moved = deck(*CASES[name]), displacement(block(CASES[name][0])[0])
    held = [
        f"{k}, {axis}, {axis}, {value:.12g}"
        for k, row in enumerate(moved, start=1)
        for axis, value in enumerate(row, start=1)
    ]
    spring = [
        "*NODE",
        "9001, 0, 0, 0",
        "9002, 1, 0, 0",
        "*ELEMENT, TYPE=SPRINGA, ELSET=S",
        "9001, 9001, 9002",
        "*SPRING, ELSET=S",
    ]
    spring += ["", "1.", "*BOUNDARY", "9001, 1, 3", "9002, 2, 3"]  # CalculiX wants a freedom
    step = ["*STEP", "*STATIC", "*BOUNDARY", *held, "*EL FILE", "S", "*END STEP"]
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "case.inp").write_text("\n".join([text, *spring, *step, ""]), encoding="utf-8")
        subprocess.run(["ccx", "case"], cwd=folder, check=True, capture_output=True)
        lines = (Path(folder) / "case.frd").read_text(encoding="utf-8").splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith(" -4  STRESS"))
    stop = next(k for k, line in enumerate(lines) if k > start and line.startswith(" -3"))
    rows = {int(line[3:13]): line[13:] for line in lines[start:stop] if line.startswith(" -1")}
    return np.array([[float(rows[k][12 * j : 12 * j + 12]) for j in range(6)] for k in range(1, len(moved) + 1)])


if __name__ == "__main__":
    found = {name: [[float(f"{x:.6g}") for x in row] for row in by_calculix(name)[::3]] for name in CASES}
    STRESSES.write_text(json.dumps(found, separators=(",", ":")).replace('],"', ']\n,"') + "\n", encoding="utf-8")
    print(len(CASES), "decks")
