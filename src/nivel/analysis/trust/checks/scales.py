"""Scales of the other checks: size and speed of the machine. They have no line."""

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Recorded

CHECKS = (Check("scales", Recorded, lambda subject: subject.scales, lambda _: None, 0),)
