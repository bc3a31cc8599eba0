"""Laws of blocks, compiled like those of users: plain functions of numbers.

Numbers that differ from block to block are arguments, so that each function is compiled once for all machines. What is not a number
stays none: `min` and `max` would hide it.
"""


def limited(value: float, lower: float, upper: float) -> float:
    """`value`, at least `lower` and at most `upper`."""
    if value > upper:
        return upper
    if value < lower:
        return lower
    return value


def beyond(value: float, lower: float, upper: float) -> float:
    """How far `value` is outside of a band; zero inside."""
    if value > upper:
        return value - upper
    if value < lower:
        return value - lower
    return 0.0 * value


def chosen(condition: float, yes: float, no: float) -> float:
    """`yes` where the condition is positive, else `no`."""
    if condition > 0.0:
        return yes
    return no


def followed(before: float, target: float, fall: float, rise: float) -> float:
    """The value after `before` on the way to `target`: it changes by `fall` (negative) to `rise`."""
    return before + limited(target - before, fall, rise)


def approach(value: float, target: float, time_constant: float, fall: float, rise: float) -> float:
    """Rate of a value that follows `target` with a time constant, between `fall` (negative) and `rise`."""
    return limited((target - value) / time_constant, fall, rise)


def bounded_rate(rate: float, value: float, lower: float, upper: float) -> float:
    """The rate, or zero where it would lead a value at a limit beyond it."""
    if value >= upper and rate > 0.0:
        return 0.0 * rate
    if value <= lower and rate < 0.0:
        return 0.0 * rate
    return rate


def switched(on: float, value: float, above: float, below: float) -> float:
    """1 from where `value` is greater than `above` until it is less than `below`, else 0; `on` is the output before."""
    if value > above:
        return 1.0
    if value < below:
        return 0.0
    return on


def entered(time: float, before: float, state: float, state_before: float) -> float:
    """The time at which the present state of a state machine began."""
    if state != state_before:
        return time
    return before


def trapezoid(time: float, start: float, first: float, way: float, speed: float, acceleration: float) -> float:
    """Place on a `way` from `first`: constant acceleration up to a speed, that speed, constant deceleration, from `start` on."""
    length = abs(way)
    if length == 0.0 or time <= start:
        return first + 0.0 * time
    top = min(speed, (length * acceleration) ** 0.5)
    rise = top / acceleration
    duration = length / top + rise
    since = time - start
    left = duration - since
    if left <= 0.0:
        gone = length + 0.0 * time
    elif since < rise:
        gone = 0.5 * acceleration * since * since
    elif left < rise:
        gone = length - 0.5 * acceleration * left * left
    else:
        gone = top * (since - 0.5 * rise)
    if way < 0.0:
        return first - gone
    return first + gone
