"""The notebook of the site: every cell runs, and the page shows what came out of it."""

import importlib.util
import re
from pathlib import Path

import pytest

from needing import needs

needs("nbclient", "nbconvert", "ipykernel", "matplotlib")

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
