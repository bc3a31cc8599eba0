"""Integrators by name: the facts beside the steps, found in the folders of the families. A folder is imported when it is first asked."""

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Final

from nivel.integrate.facts import IntegratorFacts, Machines
from nivel.methods import known_words

# in the order in which they are looked through
FAMILIES: Final = ("explicit", "radau", "newmark", "rosenbrock", "variable_order", "multistep")


@cache
def facts_of(family: str) -> tuple[IntegratorFacts, ...]:
    """Facts of all steps in a folder."""
    package = import_module(f"nivel.integrate.{family}")
    modules = [import_module(f"{package.__name__}.{module.name}") for module in iter_modules(package.__path__)]
    return tuple(facts for module in modules for facts in getattr(module, "FACTS", ()))


def all_facts() -> list[IntegratorFacts]:
    """Facts of all steps, also of those for special machines."""
    return [facts for family in FAMILIES for facts in facts_of(family)]


def step_for(name: str, machines: Machines) -> IntegratorFacts | None:
    """The integrator of this name for such machines; None where it has no step of their own."""
    for family in FAMILIES:
        if own := [facts for facts in facts_of(family) if facts.name == name]:
            return next((facts for facts in own if facts.machines == machines), None)
    return None


class _Integrators(Mapping[str, IntegratorFacts]):
    """Facts of the steps for all machines, by the words of the setting `integrator`."""

    def __getitem__(self, name: str) -> IntegratorFacts:
        facts = step_for(name, "all") if name in known_words("integrator") else None
        if facts is None:
            raise KeyError(name)
        return facts

    def __iter__(self) -> Iterator[str]:
        return iter(known_words("integrator"))

    def __len__(self) -> int:
        return len(known_words("integrator"))


INTEGRATORS: Final = _Integrators()
