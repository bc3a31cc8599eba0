"""nivel: machines and mechanisms, simulated with numbers one can trust.

    import nivel

    machine = nivel.load("slider-crank.yaml")
    result = machine.simulate(duration=8.0, step=1e-3)
    result["hinge.angle"]

Names are loaded when they are used: importing `nivel` costs nothing.
"""

import sys
from importlib import import_module
from typing import Any

from nivel.lazy import homes, provide

__version__ = "0.2.0"

# names of the package, which stand in its stub
_HOMES = homes(__file__)

__all__ = sorted(_HOMES)  # noqa: PLE0605


# functions that results call and that stand in rooms above them
provide(
    {
        "comparison": "nivel.report.compare_page:comparison_html",
        "efforts": "nivel.report.analysis_pages:efforts_html",
        "linear model": "nivel.report.analysis_pages:linear_html",
        "linear sweep": "nivel.report.analysis_pages:sweep_html",
        "mechanism": "nivel.report.analysis_pages:mechanism_html",
        "notebook": "nivel.view.page:Inline",
        "report": "nivel.report.write:write_report",
        "result file": "nivel.results.store:save",
        "scene": "nivel.view.page:write_scene",
        "trust of remains": "nivel.judge.after.report:assess_remains",
    }
)


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        hint = _hint(name) if name[:1].isupper() else ""
        raise AttributeError(f"module 'nivel' has no attribute '{name}'{hint}", name=name, obj=sys.modules[__name__])
    module, inside = _HOMES[name]
    owner = import_module(module)
    return getattr(owner, inside) if hasattr(owner, inside) else import_module(f"{module}.{inside}")


def _hint(name: str) -> str:
    """Where a record stands that `nivel` itself does not have; the records of all forces for `Force`, and so on."""
    for room, kind in (("forces", "Force"), ("hydraulics", "Component"), ("control", "Block")):
        records = dir(__getattr__(room))
        if name in records:
            return f"; write `nivel.{room}.{name}`"
        if name == kind:
            return f"; there are, in `nivel.{room}`, {', '.join(records)}"
    return ""


def __dir__() -> list[str]:
    return __all__
