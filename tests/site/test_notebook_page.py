"""The notebooks of the site: every cell runs, and the pages show what came out of them."""

import importlib.util
import re
from pathlib import Path

import pytest

from needing import needs

nbformat = needs("nbclient", "nbconvert", "ipykernel", "matplotlib", "nbformat")

DOCS = Path(__file__).parents[2] / "docs"


def notebook_page(path):
    spec = importlib.util.spec_from_file_location("notebooks", DOCS / "site" / "notebooks.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.notebook_page(path)


@pytest.mark.filterwarnings("ignore")  # of the programs that run notebooks
def test_first_steps_run_and_their_page_shows_a_plot_a_table_and_the_errors():
    text, pictures = notebook_page(DOCS / "notebooks" / "first-steps.ipynb")
    assert any(content.startswith(b"\x89PNG") and f"({name})" in text for name, content in pictures.items())
    assert "not verified" not in text
    assert re.search(r"<th>bob\.position\.z</th>", text)
    assert "'kinetic_energy': 'J'" in text
    # the energy of a pendulum let go at the height of its pivot is zero; 3 s with rk4 keep it to a millionth of its swing
    (energy,) = re.findall(r"kinetic.*?^    ([\d.e-]+)$", text[text.index("energy.abs()") - 100 :], re.S | re.M)
    assert 0.0 <= float(energy) < 1e-5


@pytest.mark.parametrize("path", sorted((DOCS / "notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_are_valid_and_have_no_outputs_of_their_own(path):
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in cells)
    for cell in cells:
        compile(cell.source, path.name, "exec")


@pytest.mark.full
@pytest.mark.filterwarnings("ignore")
def test_studies_run_and_their_page_shows_what_is_known(monkeypatch):
    """Friction and damping within four standard deviations of those that the block was measured with."""
    monkeypatch.setenv("PYTHONPATH", str(DOCS.parent / "src"))
    text, pictures = notebook_page(DOCS / "notebooks" / "studies.ipynb")
    assert "48 done" in text
    assert len(pictures) == 3
    for value, deviation, truth in re.findall(r"([\d.]+) ± ([\d.]+), measured with ([\d.]+)", text):
        assert abs(float(value) - float(truth)) < 4.0 * float(deviation)


@pytest.mark.full
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("name", "plots"), [("robotics", 3), ("mechatronics", 2), ("vehicles", 3)])
def test_other_notebooks_run_and_their_pages_show_plots(name, plots, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", str(DOCS.parent / "src"))
    text, pictures = notebook_page(DOCS / "notebooks" / f"{name}.ipynb")
    assert len(pictures) == plots
    asymmetry = re.search(r"asymmetry ([\d.e-]+)", text)
    assert (asymmetry is not None) == (name == "robotics")
    assert asymmetry is None or float(asymmetry[1]) < 1e-12
