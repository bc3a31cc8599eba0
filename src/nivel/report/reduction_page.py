"""The page of a reduction: what the flexible body is worth, in one HTML file with everything in it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final, NamedTuple

from nivel.files.target import write_text
from nivel.flexible.body.body import ReducedBody
from nivel.flexible.checks.findings import Findings
from nivel.report.drawing import between
from nivel.report.mode_picture import mode_pictures
from nivel.report.page import page

PICTURES: Final = 12
CELL: Final = 15.0  # pixels of a square of the MAC matrix
GOOD, FAIR = 0.01, 0.05  # relative errors of frequencies


class Line(NamedTuple):
    """A row of the table of frequencies."""

    mode: int
    full: str
    reduced: str
    error: str
    tone: str
    mac: str


def write_reduction(
    body: ReducedBody, findings: Findings, path: str | os.PathLike[str], *, force: bool = False
) -> Path:
    """Write the page to `path`; an existing file is replaced with `force` only. The file needs no network and nothing beside it."""
    write_text(reduction_html(body, findings), path, "report", force=force)
    return Path(path)


def reduction_html(body: ReducedBody, findings: Findings) -> str:
    """The page as text."""
    return page(
        "reduction.html.j2",
        ("reduction.css",),
        body=body,
        findings=findings,
        facts=_facts(body, findings),
        lines=_lines(findings),
        beyond=_beyond(findings),
        mac=mac_drawing(findings),
        pictures=list(zip(mode_pictures(body, PICTURES), body.frequencies, strict=False)),
        masses=_masses(findings),
        sums=_sums(findings),
        inertia=_inertia(findings),
        neglect=[(name, f"{100 * value:.2g} %") for name, value in findings.neglect.items()],
    )


def _facts(body: ReducedBody, findings: Findings) -> list[str]:
    conditions = "mean-axis frame" if body.reference == "mean-axis" else f"frame fixed at {', '.join(body.held)}"
    facts = [
        f"{findings.freedoms} degrees of freedom, {findings.nodes} nodes",
        f"{len(body.eigenvalues)} modes",
        f"{len(findings.boundary)} degrees of freedom of interfaces and {len(findings.normal)} normal modes",
        conditions,
        f"{body.mass_kind} mass",
    ]
    return [*facts, "with geometric stiffness"] if body.stiffening else facts


def _lines(findings: Findings) -> list[Line]:
    out = []
    for k, (full, reduced, error) in enumerate(zip(findings.full, findings.reduced, findings.errors, strict=False)):
        tone = "green" if abs(error) <= GOOD else "amber" if abs(error) <= FAIR else "red"
        text = f"{100 * error:.2g} %" if abs(error) > 1e-9 else "0"
        partner = findings.partners[k]
        like = f"{findings.mac[k][partner]:.3f}" + (f" (mode {partner + 1})" if partner != k else "")
        out.append(Line(k + 1, f"{full:.5g}", f"{reduced:.5g}", text, tone, like))
    return out


def _beyond(findings: Findings) -> str:
    rest = findings.reduced[len(findings.full) :]
    return f"{len(rest)} more modes of the reduced body, from {rest[0]:.4g} to {rest[-1]:.4g} Hz" if rest else ""


def mac_drawing(findings: Findings) -> str:
    """SVG of the MAC matrix: a square for each pair, the fuller the more alike."""
    rows = findings.mac
    if not rows:
        return ""
    width, height = 30.0 + CELL * len(rows[0]), 30.0 + CELL * len(rows)
    squares = []
    for i, row in enumerate(rows):
        for j, value in enumerate(row):
            if value > 0.02:
                colour = between("#e8edf4", "#2c6bd1", min(value, 1.0))
                place = f'x="{30.0 + CELL * j:.0f}" y="{30.0 + CELL * i:.0f}" width="{CELL - 1:.0f}" height="{CELL - 1:.0f}"'
                title = f"whole model {i + 1}, reduced {j + 1}: {value:.3f}"
                squares.append(f'<rect {place} rx="2" fill="{colour}"><title>{title}</title></rect>')
    ticks = []
    for k in (0, *range(4, max(len(rows), len(rows[0])), 5)):
        middle = 30.0 + CELL * (k + 0.5)
        if k < len(rows[0]):
            ticks.append(f'<text x="{middle:.0f}" y="22" text-anchor="middle">{k + 1}</text>')
        if k < len(rows):
            ticks.append(f'<text x="24" y="{middle + 4:.0f}" text-anchor="end">{k + 1}</text>')
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="mac" viewBox="0 0 {width:.0f} {height:.0f}" style="max-width:{1.4 * width:.0f}px" '
        f'role="img" aria-label="MAC of whole and reduced modes"><rect class="field" x="29" y="29" width="{width - 29:.0f}" '
        f'height="{height - 29:.0f}"/>{"".join(squares)}{"".join(ticks)}</svg>'
    )


def _masses(findings: Findings) -> list[tuple[str, list[str]]]:
    return [
        (f"{frequency:.5g}", [f"{100 * share:.1f}" for share in shares])
        for frequency, shares in zip(findings.normal, findings.effective_mass, strict=False)
    ]


def _sums(findings: Findings) -> list[str]:
    return [f"{100 * sum(column):.1f}" for column in zip(*findings.effective_mass, strict=True)]


def _inertia(findings: Findings) -> list[tuple[str, str]]:
    vector = lambda values: ", ".join(f"{value:.6g}" for value in values)  # noqa: E731
    rows = [
        ("mass", f"{findings.mass:.6g} kg"),
        ("centre of mass", f"({vector(findings.centre_of_mass)}) m"),
        ("principal inertia about it", f"({vector(findings.principal_inertia)}) kg m²"),
    ]
    if findings.volume is not None:
        rows.append(("volume of the material", f"{findings.volume:.6g} m³"))
    return rows
