"""The page of a reduction: its numbers are those of the findings, it is well-formed and needs nothing beside it."""

import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

from needing import needs
from nivel.flexible.reduce import reduce
from nivel.report.reduction_page import MOST_TRIANGLES, mac_drawing, mode_pictures, reduction_html

EXAMPLES = Path(__file__).parents[2] / "examples" / "flexible"


@pytest.fixture(scope="module")
def portal():
    return reduce(EXAMPLES / "portal-frame.yaml")


@pytest.fixture(scope="module")
def boom():
    needs("gmsh")
    return reduce(EXAMPLES / "crane-boom.yaml", overrides={"solid.element_size": "0.2", "reduction": {"modes": 4}})


def test_page_says_what_was_found(portal):
    page = reduction_html(portal.body, portal.findings)
    findings = portal.findings
    assert f"{findings.full[0]:.5g}" in page
    assert f"{findings.mass:.6g} kg" in page
    for each in ("left_foot", "right_foot", "hoist", *findings.statements):
        assert each in page
    assert page.count('class="mode"') == 12
    assert "http-equiv" in page
    assert not re.findall(r'(?:src|href)="http', page)


def test_pictures_are_well_formed_and_differ(portal):
    pictures = mode_pictures(portal.body, 6)
    assert len(set(pictures)) == 6
    for picture in pictures:
        root = ET.fromstring(picture)
        assert len([each for each in root.iter() if each.get("class") == "interface"]) == 3
        numbers = np.array(re.findall(r"-?\d+\.\d", picture), dtype=float)
        assert np.all(np.isfinite(numbers))
        assert numbers.max() <= 700


def test_pictures_of_large_meshes_stay_small(boom):
    """Nodes are merged until there are few faces; only those that look at the eye are drawn."""
    (picture,) = mode_pictures(boom.body, 1)
    faces = [each for each in ET.fromstring(picture).iter() if each.get("d")]
    assert len(boom.body.triangles) > MOST_TRIANGLES
    assert 100 < len(faces) <= MOST_TRIANGLES
    assert len(reduction_html(boom.body, boom.findings)) < 1_500_000


def test_body_without_lines_or_faces_has_no_pictures(portal):
    from dataclasses import replace

    bare = replace(portal.body, lines=np.zeros((0, 2), dtype=np.int64))
    assert mode_pictures(bare, 3) == []
    assert "Modes of the body" not in reduction_html(bare, portal.findings)


def test_mac_drawing_has_a_square_for_each_likeness(portal):
    squares = [each for each in ET.fromstring(mac_drawing(portal.findings)).iter() if each.tag.endswith("rect")]
    assert len(squares) - 1 == int((np.array(portal.findings.mac) > 0.02).sum())


def test_mac_of_a_symmetric_body_mixes_equal_frequencies():
    """A square bar has pairs of equal frequencies, whose modes are any mixture: their likeness is one all the same."""
    findings = reduce(EXAMPLES / "pendulum-bar.yaml").findings
    assert findings.full[0] == pytest.approx(findings.full[1], rel=1e-9)
    assert np.min(np.diag(np.array(findings.mac))[:10]) > 0.999
    assert findings.partners[:10] == list(range(10))
