"""FMUs made by tests: the unit of `unit.c`, and archives of any content."""

import subprocess
import zipfile
from pathlib import Path

SOURCE = Path(__file__).with_name("unit.c")
VARIABLES = {
    "x": (1, "input"),
    "v": (2, "input"),
    "u": (3, "output"),
    "plant.i[1]": (4, "output"),
    "t": (5, "output"),
    "kp": (6, "parameter"),
    "kd": (7, "parameter"),
    "fault": (8, "parameter"),
    "fault_at": (9, "parameter"),
    "instances": (10, "output"),
}


def description(fmi=3, variables=VARIABLES, states=True, once=False, more=""):
    """modelDescription.xml of the unit. more : further variables."""
    word = {3: "FMUState", 2: "FMUstate"}[fmi]
    able = f'canGetAndSet{word}="true" canSerialize{word}="true"' if states else ""
    single = 'canBeInstantiatedOnlyOncePerProcess="true"' if once else ""
    form = {
        3: '<Float64 name="{}" valueReference="{}" causality="{}"/>',
        2: '<ScalarVariable name="{}" valueReference="{}" causality="{}"><Real/></ScalarVariable>',
    }[fmi]
    listed = "".join(form.format(name, *facts) for name, facts in variables.items())
    token = {3: "instantiationToken", 2: "guid"}[fmi]
    return (
        f'<fmiModelDescription fmiVersion="{fmi}.0" modelName="unit" {token}="unit">'
        f'<CoSimulation modelIdentifier="unit" {able} {single}/>'
        f"<ModelVariables>{listed}{more}</ModelVariables><ModelStructure/></fmiModelDescription>"
    )


def compiled(folder, fmi=3):
    """The library of the unit."""
    target = folder / f"unit{fmi}.so"
    subprocess.run(["cc", "-O1", "-fPIC", "-shared", f"-DFMI={fmi}", "-o", target, SOURCE], check=True)
    return target.read_bytes()


def archive(path, text, library=b"", fmi=3, system=None):
    """An FMU of a description and a library."""
    system = system or {3: "x86_64-linux", 2: "linux64"}[fmi]
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed:
        packed.writestr("modelDescription.xml", text)
        packed.writestr(f"binaries/{system}/unit.so", library)
    return path
