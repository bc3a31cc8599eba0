"""The page of a comparison: everything is in it, it needs nothing else, and a browser shows it."""

import re
from html.parser import HTMLParser

import pytest

from browsing import titled, watched
from nivel.report.compare_page import COLUMNS, WIDE, comparison_html, curves, diagram
from nivel.report.plots import LogAxis, power_of_ten
from nivel.results.comparison import Comparison, Reference, Row, Spread

VOID = {"meta", "link", "br", "hr", "img", "input"}
REFERENCE = Reference("dop853 at tolerance 1e-12", "dop853", 1e-12, "its distance from a run at tolerance 1e-11")


def row(stabilisation, step, *, error, seconds, integrator="rk4", **more):
    return Row(
        *(integrator, "newton-euler", "absolute", "euler-parameters", stabilisation),
        **{"step": step, "loop_seconds": seconds, "seconds_per_step": 1e-6, "steps": round(1 / step), "rejected": 3}
        | {
            "evaluations": 4 * round(1 / step),
            "iterations": 0,
            "constraint_error": 1e-13,
            "constraint_rate_error": 2e-13,
        }
        | {"constraint_error_mean": 1e-14, "constraint_rate_error_mean": 1e-14, "energy_error": 1e-9}
        | {"energy_error_relative": 1e-10, "motion_error": error, "motion_error_body": "crank <1>"}
        | {"motion_error_time": 0.5, "reference": REFERENCE.name}
        | more,
    )


def comparison(rows=None, **more):
    rows = rows or (
        row("none", 1e-2, error=1e-5, seconds=1e-3),
        row("none", 1e-3, error=1e-9, seconds=1e-2, order=4.0),
        row("direct", 1e-2, error=5e-6, seconds=2e-3),
        row("direct", 1e-3, error=1e-12, seconds=2e-2),
        Row("rk4", "penalty", "absolute", "euler-parameters", "baumgarte", 1e-2, None, "refused", "no <meaning>"),
        Row(
            "rk4", "newton-euler", "absolute", "euler-parameters", "none", 1e-1, None, "failed", "stopped at t = 0.2 s"
        ),
    )
    facts = {"machine": "slider & crank", "duration": 1.0, "output_interval": 0.1, "repeat": 3, "size": 1.0}
    facts |= {"references": (REFERENCE,), "spread": Spread(1e-9, "none", "direct", 2), "kinetic_energy": 10.0}
    return Comparison(**facts | {"rows": tuple(rows)} | more)


class Nesting(HTMLParser):
    """Notes what is not closed, and every address."""

    def __init__(self):
        super().__init__()
        self.open, self.addresses, self.faults = [], [], []

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for name, value in attributes if name in ("src", "href")]
        if tag not in VOID and tag not in ("path", "rect", "circle"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag in ("path", "rect", "circle"):
            return
        if not self.open or self.open.pop() != tag:
            self.faults.append(tag)


def words(html):
    visible = re.sub(r"<(style|script)\b.*?</\1>", " ", html, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", visible))


def test_the_page_is_well_formed_and_asks_for_nothing():
    html = comparison_html(comparison())
    page = Nesting()
    page.feed(html)
    assert page.open == []
    assert page.faults == []
    assert page.addresses == ["data:,"]
    assert "http" not in re.sub(r"http-equiv", "", html)
    assert "default-src 'none'" in html


def test_every_row_and_every_number_is_there():
    text = words(comparison_html(comparison()))
    for part in ("slider &amp; crank", "1.0e-5", "5.0e-6", "crank &lt;1&gt;, 500 ms", "refused : no &lt;meaning&gt;"):
        assert part in text
    assert "failed : stopped at t = 0.2 s" in text
    assert "≲ 1.0e-12" in text  # not to be told from the error of the reference
    assert "error ≤ 1e-6 newton-euler · none, 1 ms: 10 ms" in text  # no-break spaces are spaces to `words`
    assert "Furthest apart of 2 methods, each at its finest: none and direct." in text


def test_runs_that_an_event_ended_are_told():
    ended = row("none", 1e-3, error=1e-9, seconds=1e-2, stopped_by="far <1>", end_time=0.71234567)
    other = row("direct", 1e-3, error=1e-9, seconds=1e-2, end_time=1.0)
    text = words(comparison_html(comparison((ended, other))))
    assert (
        "Methods compared in 2 runs. 1 of them ran to the end. 1 of 2 runs was ended by the event far &lt;1&gt;,"
        in text
    )
    assert "at 0.712346 s." in text
    assert "up to 1 s simulated" in text
    assert "ended at 0.712346 s" in text
    assert "None of them ran to the end. The run was ended by" in words(comparison_html(comparison((ended,))))
    assert "All of them ran to the end." in words(comparison_html(comparison((other,))))


def test_a_curve_for_every_method_from_coarse_to_fine():
    drawn = curves(comparison())
    assert [curve.label for curve in drawn] == ["newton-euler · none", "newton-euler · direct"]
    assert [row.step for row in drawn[0].rows] == [1e-2, 1e-3]
    svg = diagram(comparison(), WIDE, "wide")
    assert svg.count('class="line"') == 2
    assert svg.count("<title>") == 4
    assert svg.count("hollow") == 1
    ((x1, y1), (x2, y2)) = (
        map(float, place) for place in re.findall(r'class="hit" transform="translate\((\S+) (\S+)\)', svg)[:2]
    )
    assert x1 < x2  # slower
    assert y1 < y2  # and more exact, which is down


@pytest.mark.parametrize(
    "rows",
    [
        (row("none", 1e-2, error=0.0, seconds=1e-3),),
        (row("none", 1e-2, error=float("inf"), seconds=1e-3), row("none", 1e-3, error=1e300, seconds=1e-2)),
        (Row("rk4", "penalty", "absolute", "euler-parameters", "none", 1e-2, None, "refused", "why"),),
        tuple(
            row("none", 10.0**-k, error=10.0**-k, seconds=1e-3, integrator=f"m{n}") for n in range(40) for k in (1, 2)
        ),
    ],
    ids=["zero", "infinite", "refused", "many"],
)
def test_strange_numbers_are_drawn_or_left_out(rows):
    html = comparison_html(comparison(rows))
    assert "nan" not in html
    assert ("<svg" in html) == (rows[0].outcome == "done")


def test_without_reference_there_is_no_diagram_but_a_table():
    rows = (row("none", 1e-2, error=None, seconds=1e-3, reference=""),)
    html = comparison_html(comparison(rows, references=(), spread=None, note="no reference: none came to the end"))
    assert "no reference" in html
    assert "1 ms" in html
    assert 'class="precision' not in html


def test_a_logarithmic_axis():
    axis = LogAxis.around([1e-6, 1e-2], 0.0, 100.0, room=0.0)
    assert axis.at(1e-4) == pytest.approx(50.0)
    assert [tick.value for tick in axis.ticks(power_of_ten)] == pytest.approx([1e-6, 1e-5, 1e-4, 1e-3, 1e-2])
    assert [power_of_ten(value) for value in (1.0, 1e-12, 2e-3, 5.0)] == ["1", "10⁻¹²", "2·10⁻³", "5"]


SCRIPT = """
const column = (k) => [...document.querySelectorAll(".cells tbody tr")].map((row) => (row.cells[k] || {}).textContent);
const button = document.querySelectorAll(".cells thead button")[8];
button.click(); const rising = column(8); button.click(); const falling = column(8);
const entry = document.querySelectorAll(".legend button")[1];
entry.dispatchEvent(new Event("focus")); const chosen = document.querySelectorAll(".precision.one .chosen").length;
entry.dispatchEvent(new Event("blur"));
const shown = [...document.querySelectorAll(".precision")].map((svg) => svg.getBoundingClientRect().width > 0);
document.title = JSON.stringify({ rising, falling, chosen, shown, left: document.querySelectorAll(".precision.one").length,
  wide: document.documentElement.scrollWidth - document.documentElement.clientWidth });
"""


@pytest.mark.parametrize("width", [1200, 400])
def test_the_page_works_in_a_browser(tmp_path, browser, width):
    page = tmp_path / "page.html"
    page.write_text(
        comparison_html(comparison()).replace("</body>", f"<script>{SCRIPT}</script></body>"), encoding="utf-8"
    )
    with watched(browser, width=width, height=1200) as looking:
        seen = titled(looking.page, page)
    motions = [text for text in seen["rising"] if text]
    assert COLUMNS[8].title == "motion"
    assert [text[:6] for text in motions] == ["≲ 1.0e", "1.0e-9", "5.0e-6", "1.0e-5"]
    assert [text for text in seen["falling"] if text] == motions[::-1]
    assert seen["rising"][:4] == motions  # rows without numbers stay last
    assert seen["chosen"] == 2  # in the wide drawing and in the narrow one
    assert seen["left"] == 0
    assert seen["wide"] == 0
    assert sum(seen["shown"]) == 1
