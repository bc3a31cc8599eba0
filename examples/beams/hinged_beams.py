"""Displacement of the tip of the two hinged beams over time: u1, u2, u3 and their size.

    python hinged_beams.py [picture.png]

Shows the plot, or writes it to a file. Needs: pip install 'nivel[plot]'.
"""

import sys
from pathlib import Path

import numpy as np

import nivel


def tip_displacement(elements: int = 20, **simulation: object) -> tuple[np.ndarray, np.ndarray]:
    """Times (n,) [s] and displacement of the tip (n, 3) [m], with so many elements in each beam."""
    overrides = {f"beams.{beam}.elements": elements for beam in ("inner", "outer")}
    result = nivel.load(Path(__file__).with_name("hinged-beams.yaml"), overrides).simulate(verify=False, **simulation)
    return result.time, result.array("outer.end.position") - [10.0, 0.0, 0.0]


def main(picture: str | None = None) -> None:
    """Plot 4 and 20 elements a beam together."""
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(8, 5), layout="constrained")
    for elements, style in ((4, "--"), (20, "-")):
        time, u = tip_displacement(elements)
        for k, curve in enumerate((*u.T, np.linalg.norm(u, axis=1))):
            name = ("u1", "u2", "u3", "|u|")[k]
            axes.plot(time, curve, style, color=f"C{k}", label=f"{name}, {elements} elements a beam")
    axes.set(xlabel="time, s", ylabel="displacement of the tip, m", title="Two hinged beams, Newmark, h = 0.01 s")
    axes.grid(alpha=0.3)
    figure.legend(loc="outside lower center", ncols=4, fontsize="small")
    if picture:
        figure.savefig(picture, dpi=150)
    else:
        plt.show()


if __name__ == "__main__":
    main(*sys.argv[1:2])
