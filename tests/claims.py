"""Several named claims about one prepared state: all are checked, and a failure names those that do not hold, with their numbers."""

import traceback


def check(claims, *given):
    """Check claims, {name: function of what is given that asserts}.

    Raises AssertionError with the name of each claim that fails, the file and line of its assertion and what that says; the claims after
    it are checked as well. Errors of other kinds are told in the same way.
    """
    failed = [told(name, error) for name, claim in claims.items() if (error := error_of(claim, given)) is not None]
    if failed:
        raise AssertionError(f"{len(failed)} of {len(claims)} claims do not hold\n" + "\n".join(failed))


def error_of(claim, given):
    """What a claim raises, or None."""
    try:
        claim(*given)
    except Exception as error:
        return error
    return None


def told(name, error):
    """Name of a claim, the place in it and the error."""
    place = traceback.extract_tb(error.__traceback__)[1]
    text = "".join(traceback.format_exception_only(error)).strip()
    return f"- {name} ({place.filename.rpartition('/')[2]}:{place.lineno})\n  {text}"
