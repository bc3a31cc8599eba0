"""Model files that several tests reduce."""

from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduce import reduce_model

STEEL = "steel: {youngs_modulus: 210 GPa, poisson_ratio: 0.3, density: 7850 kg/m^3}"


def reduced(text, folder="."):
    """The body and the findings of a model file."""
    result = reduce_model(parse_model(text, f"{folder}/model.yaml"))
    return result.body, result.findings


def bar(
    *,
    length=2.0,
    width=0.02,
    height=0.03,
    elements=16,
    theory="euler-bernoulli",
    interfaces="root: {node: root}, tip: {node: tip}",
    reduction="modes: 8",
    tip=None,
    more="",
):
    """A straight bar from the origin along x, or to `tip`, whose height is along z."""
    x, y, z = tip or (length, 0.0, 0.0)
    return f"""
format: 1
name: bar
materials: {{{STEEL}}}
sections: {{bar: {{type: rectangle, width: {width}, height: {height}}}}}
frame:
  theory: {theory}
  nodes: {{root: [0, 0, 0], tip: [{x}, {y}, {z}]}}
  beams: {{bar: {{nodes: [root, tip], section: bar, material: steel, elements: {elements}}}}}
interfaces: {{{interfaces}}}
reduction: {{{reduction}}}
{more}
"""


def block(*, length=1.0, side=0.1, size=0.06, interfaces="", reduction="modes: 6", more=""):
    """A square bar of solid elements from the origin along x."""
    return f"""
format: 1
name: block
materials: {{{STEEL}}}
solid:
  parts: [{{type: box, from: [0, {-side / 2}, {-side / 2}], to: [{length}, {side / 2}, {side / 2}]}}]
  material: steel
  element_size: {size}
interfaces: {{{interfaces}}}
reduction: {{{reduction}}}
{more}
"""
