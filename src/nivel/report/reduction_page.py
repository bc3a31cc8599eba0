"""The page of a reduction: what the flexible body is worth, in one HTML file, with still pictures of its modes."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nivel.flexible.body.body import ReducedBody
from nivel.flexible.checks.findings import Findings
from nivel.looks.viewpoint import View, choose_view
from nivel.machine.core.vectors import Array
from nivel.report.drawing import HEIGHTS, LIGHT, WIDTH, Frame, between, fit
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
        sums=[f"{100 * sum(column):.1f}" for column in zip(*findings.effective_mass, strict=True)],
        inertia=_inertia(findings),
        neglect=[(name, f"{100 * value:.2g} %") for name, value in findings.neglect.items()],
    )


def _facts(body: ReducedBody, findings: Findings) -> list[str]:
    return [
        f"{findings.freedoms} degrees of freedom, {findings.nodes} nodes",
        f"{len(body.eigenvalues)} modes",
        f"{len(findings.boundary)} degrees of freedom of interfaces and {len(findings.normal)} normal modes",
        "mean-axis frame" if body.reference == "mean-axis" else f"frame fixed at {', '.join(body.held)}",
        f"{body.mass_kind} mass",
        *["with geometric stiffness"] * bool(body.stiffening),
    ]


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


AMPLITUDE: Final = 0.12  # of the size of the body: the largest displacement in a picture
MOST_TRIANGLES: Final = 1400
CALM, STRONG = "#4a74a8", "#e0a33a"  # no and the largest displacement
PROBED: Final = 400  # nodes from which the view is chosen


def mode_pictures(body: ReducedBody, count: int) -> list[str]:
    """SVG texts of the first `count` modes, all seen from the same place. Empty where there is nothing to draw."""
    if not len(body.triangles) and not len(body.lines):
        return []
    every = max(1, len(body.position) // PROBED)
    none = np.zeros((0, 3))
    view = choose_view(body.position[::every], none, none)
    triangles = _thinned(body) if len(body.triangles) else body.triangles
    return [_picture(body, k, view, triangles) for k in range(min(count, body.modes.shape[2]))]


def _thinned(body: ReducedBody) -> NDArray[np.int64]:
    """The triangles on fewer nodes: nodes in one cell of a grid become one, until there are few enough."""
    triangles = body.triangles
    x = body.position - body.position.min(axis=0)
    cells = 60.0
    while len(triangles) > MOST_TRIANGLES and cells > 6.0:
        size = np.ptp(body.position, axis=0).max() / cells
        _, first, cell = np.unique(np.floor(x / size).astype(int), axis=0, return_index=True, return_inverse=True)
        merged = first[cell.ravel()][body.triangles]
        whole = (merged[:, 0] != merged[:, 1]) & (merged[:, 1] != merged[:, 2]) & (merged[:, 2] != merged[:, 0])
        triangles = np.unique(merged[whole], axis=0)
        cells *= 0.82
    return triangles


def _picture(body: ReducedBody, mode: int, view: View, triangles: NDArray[np.int64]) -> str:
    moved = np.nan_to_num(body.modes[:, :3, mode])
    turned = np.nan_to_num(body.modes[:, 3:, mode])
    size = float(np.linalg.norm(np.ptp(body.position, axis=0)))
    far = np.linalg.norm(moved, axis=1)
    largest = far.max()
    if largest * size < 1e-6 * np.abs(turned).max() * size**2:  # a beam that twists: shown by colour alone
        far, largest = np.linalg.norm(turned, axis=1), np.linalg.norm(turned, axis=1).max()
        moved = np.zeros_like(moved)
    place = body.position + AMPLITUDE * size / (largest or 1.0) * moved
    share = far / (largest or 1.0)
    frame = fit(view, np.concatenate([place, body.position]), body.position[:: max(1, len(body.position) // PROBED)])
    parts = _drawn_lines(frame, body.position, body.lines, None)
    if len(triangles):
        parts += _faces(frame, place, triangles, share)
    parts += _drawn_lines(frame, place, body.lines, share)
    parts += [_mark(frame, place[each.node]) for each in body.interfaces]
    label = f"mode {mode + 1}, {body.frequencies[mode]:.4g} Hz"
    height = max(frame.height, HEIGHTS[0])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="mode" viewBox="0 0 {WIDTH:.0f} {height:.0f}" role="img" '
        f'aria-label="{label}">{"".join(parts)}</svg>'
    )


def _faces(frame: Frame, place: Array, triangles: NDArray[np.int64], share: Array) -> list[str]:
    """Faces that look at the eye, far ones first; colour by displacement, shade by light."""
    corners = place[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    normal = normal / np.maximum(length, 1e-300)[:, None]
    view = frame.view
    seen = np.flatnonzero((normal @ view.towards > 0.0) & (length > 0.0))
    order = seen[np.argsort(view.depth(corners[seen].mean(axis=1)))]
    facing = np.stack([normal @ view.right, normal @ view.up, normal @ view.towards], axis=1) @ LIGHT
    flat = frame.pixels(corners)
    out = []
    for t in order:
        colour = between(CALM, STRONG, float(share[triangles[t]].mean()))
        colour = between("#18212c", colour, float(np.clip(0.62 + 0.5 * facing[t], 0.5, 1.0)))
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in flat[t])
        out.append(f'<path color="{colour}" d="M{path}z"/>')
    return [f'<g class="faces">{"".join(out)}</g>']


def _drawn_lines(frame: Frame, place: Array, lines: NDArray[np.int64], share: Array | None) -> list[str]:
    """Beams; with `share` coloured by displacement, else as they lie undeformed."""
    flat = frame.pixels(place)
    out = []
    for i, j in lines:
        colour = "" if share is None else f' color="{between(CALM, STRONG, float(share[[i, j]].mean()))}"'
        out.append(f'<path{colour} d="M{flat[i, 0]:.1f} {flat[i, 1]:.1f}L{flat[j, 0]:.1f} {flat[j, 1]:.1f}"/>')
    kind = "rest" if share is None else "beams"
    return [f'<g class="{kind}">{"".join(out)}</g>'] if out else []


def _mark(frame: Frame, at: Array) -> str:
    x, y = frame.pixels(at[None])[0]
    return f'<circle class="interface" cx="{x:.1f}" cy="{y:.1f}" r="4"/>'
