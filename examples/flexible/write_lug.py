"""The lug of `lug.step`, as a CAD program exports it: a plate, a strap and an eye with a bore, in millimetres. It needs gmsh."""

from pathlib import Path

import gmsh


def write(path):
    """Write the STEP file."""
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        occ = gmsh.model.occ
        # the plate is screwed to a wall at x = 0; the bore is along y, 260 mm from it
        plate = occ.addBox(0, -30, -30, 10, 60, 60)
        strap = occ.addBox(10, -25, -4, 250, 50, 8)
        eye = occ.addCylinder(260, -25, 0, 0, 50, 0, 16)
        whole, _ = occ.fuse([(3, plate)], [(3, strap), (3, eye)])
        bore = occ.addCylinder(260, -26, 0, 0, 52, 0, 10)
        occ.cut(whole, [(3, bore)])
        occ.synchronize()
        gmsh.write(str(path))
    finally:
        gmsh.finalize()


if __name__ == "__main__":
    write(Path(__file__).with_name("lug.step"))
