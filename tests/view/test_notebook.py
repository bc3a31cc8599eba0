"""A notebook that is run: what it shows is a playback, in a browser too."""

from pathlib import Path

import pytest

from browsing import until, watched
from needing import needs
from patience import PATIENCE

needs("ipykernel")
nbformat, nbclient, nbconvert = needs("nbformat"), needs("nbclient"), needs("nbconvert")

EXAMPLE = Path(__file__).parent.parent.parent / "examples" / "mechanisms" / "simple-pendulum.yaml"


@pytest.mark.filterwarnings("ignore")  # of the programs that run notebooks
@pytest.mark.full
def test_a_notebook_shows_a_motion_that_plays(tmp_path, browser):
    cells = [
        f"import nivel\nresult = nivel.load({str(EXAMPLE)!r}).simulate(duration=0.5)",
        "result.animate()",
        "result.view(result, height=300)",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(notebook, timeout=int(PATIENCE), kernel_name="python3").execute(cwd=str(tmp_path))
    shown = [cell.outputs[-1].data for cell in notebook.cells[1:]]
    assert all("<iframe" in each["text/html"] for each in shown)
    assert "result.export_scene" in shown[0]["text/plain"]
    page, _ = nbconvert.HTMLExporter(embed_images=True).from_notebook_node(notebook)
    file = tmp_path / "notebook.html"
    file.write_text(page, encoding="utf-8")
    with watched(browser) as seen:
        seen.page.route("https://**", lambda route: route.abort())  # what the exporter's own page asks for
        seen.page.goto(file.as_uri())
        until(seen.page, lambda: len(seen.page.frames) == 3)
        for frame in seen.page.frames[1:]:
            frame.frame_element().scroll_into_view_if_needed()
            until(frame, "!!window.nivel")
            assert frame.evaluate("nivel.span()") == pytest.approx([0.0, 0.5])
            frame.evaluate("nivel.app.player.toggle(true)")
            until(frame, "nivel.app.player.time > 0")
        # the page around them is the exporter's: what that asks for and says is its own
        seen.left.clear()
        seen.said.clear()
