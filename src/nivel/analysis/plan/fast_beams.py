"""Beams that vibrate too fast for the fixed step of an explicit method."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from nivel.analysis.plan.beam_facts import fastest_frequency
from nivel.machine.beams.beam import Beam

# Step times angular frequency: beyond the first no explicit method is accurate, and none of ours is stable beyond the second.
ACCURATE, STABLE = 1.0, 2.8


def too_fast(beams: Sequence[Beam], step: float) -> tuple[str, str] | None:
    """(message, advice) where an element of a beam vibrates too fast for explicit steps [s]; None where none does."""
    if not beams:
        return None
    frequency, beam = max(
        ((fastest_frequency(beam, beam.properties), beam) for beam in beams), key=lambda pair: pair[0]
    )
    rate = 2.0 * np.pi * frequency
    if rate * step <= ACCURATE:
        return None
    limit = STABLE / rate
    message = (
        f"an element of the beam {beam.name} vibrates with up to {frequency:.3g} Hz, which an explicit method follows with steps below "
        f"{limit:.2g} s only; of {step:.3g} s they let it grow"
    )
    advice = (
        f"Take an implicit method, which steps over such vibrations: --integrator generalised-alpha, or radau; or --step "
        f"{0.5 * limit:.1g}. Fewer elements of {beam.name}, or `model: segments`, vibrate less fast."
    )
    return message, advice
