"""What every playback does: it opens from a file, plays, and is scrubbed to any moment."""

from io import BytesIO

import numpy as np
import pytest

from browsing import drawn, until, watched
from needing import needs
from nivel.view.page import write_scene


def picture(page):
    """The screen as (height, width, 3)."""
    image = needs("PIL.Image")
    return np.asarray(image.open(BytesIO(page.screenshot())).convert("RGB"))


def assert_drawn(seen, result, frame, page):
    """Every body of the page stands where the result says."""
    position, orientation = result.array("position")[frame], result.array("orientation")[frame]
    size = page.evaluate("nivel.app.stage.size")
    for body, (r, theta) in enumerate(zip(position, orientation, strict=True)):
        pose = np.array(seen.pose(body))
        np.testing.assert_allclose(pose[:3], r, atol=1e-5 * size)
        sign = np.sign(pose[3:] @ theta)
        np.testing.assert_allclose(sign * pose[3:], theta, atol=1e-5)


def assert_plays_and_scrubs(browser, result, file):
    """In a page written to `file`, which complains of nothing and asks nobody."""
    write_scene([result], file)
    with watched(browser) as seen:
        page = seen.open(file.as_uri())
        assert page.evaluate("nivel.span()") == pytest.approx([result.abscissa[0], result.abscissa[-1]])
        assert_drawn(seen, result, 0, page)
        start = picture(page)
        # play
        page.get_by_role("button", name="Play", exact=True).click()
        until(page, "nivel.app.player.time > nivel.span()[0]")
        page.get_by_role("button", name="Pause").click()
        # scrub
        slider = page.locator("input.scrub")
        slider.focus()
        page.keyboard.press("End")
        until(page, "nivel.app.player.time === nivel.span()[1]")
        assert_drawn(seen, result, -1, page)
        shown = f"load factor {result.time[-1]:.1f}"[:14] if result.is_statics else f"{result.time[-1]:.1f}"[:3]
        assert page.locator("output.time").inner_text().startswith(shown.replace("-", "−"))
        assert slider.get_attribute("aria-valuetext") == page.locator("output.time").inner_text()
        # somewhere else than at the start, where many machines come by again at the end
        frame = int(0.37 * len(result.abscissa))
        page.evaluate(f"nivel.app.goTo({float(result.abscissa[frame])!r})")
        drawn(page)
        assert_drawn(seen, result, frame, page)
        later = picture(page)
        slider.focus()
        page.keyboard.press("Home")
        until(page, "nivel.app.player.time === nivel.span()[0]")
        assert_drawn(seen, result, 0, page)
        # something is to be seen, and it moved
        assert len(np.unique(start.reshape(-1, 3), axis=0)) > 100
        moved = np.abs(start.astype(int) - later).max(axis=2) > 25
        assert moved[60:700, 260:940].sum() > 30
