"""The tests' own browser: one that is missing is seen."""

import pytest

import browsing
import needing


@pytest.mark.parametrize(("in_ci", "outcome"), [(False, pytest.skip.Exception), (True, pytest.fail.Exception)])
def test_a_missing_browser_is_a_skip_with_a_reason_and_a_failure_in_ci(monkeypatch, in_ci, outcome):
    monkeypatch.setattr(browsing, "CHROMIUM", None)
    monkeypatch.setattr(needing, "MUST_RUN", in_ci)
    with pytest.raises(outcome, match="no chromium on this machine"), browsing.chromium():
        pass
