# SPDX-License-Identifier: MIT
"""The self test, and what it finds wrong."""

import pytest
from tricue.doctor import encoders
from tricue.doctor.finding import Verdict
from tricue.doctor.probe import ProbeAnswer
from tricue.doctor.self_test import find_self_test, judge

GOOD = {"speed": 5000.0, "same": True, "difference": 1e-13, "off": 1.0}


def test_this_installation_passes():
    """The tracker follows, in the same way twice, and its speed is told."""
    (found,) = find_self_test()
    assert found.verdict is Verdict.OK, found.text
    assert "updates/s" in found.text
    assert "the same bit for bit" in found.text


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"same": False}, "two runs from one seed differ"),
        ({"difference": 0.01}, "native and reference kernels differ by 0.01 px"),
        ({"difference": float("nan")}, "native and reference kernels differ"),
        ({"off": 20.0}, "the target is missed by 20.0 px"),
        ({"off": float("nan")}, "the target is missed"),
    ],
)
def test_what_is_wrong_is_a_failure(wrong, said):
    """Each of the numbers by itself."""
    found = judge(ProbeAnswer({**GOOD, **wrong}))
    assert found.verdict is Verdict.FAILED
    assert said in found.text


def test_a_crash_is_a_failure():
    """As of kernels for another processor."""
    found = judge(ProbeAnswer({}, "ends the process with SIGILL"))
    assert (found.verdict, found.text) == (Verdict.FAILED, "ends the process with SIGILL")


@pytest.mark.parametrize(
    ("answer", "verdict", "text"),
    [
        (ProbeAnswer({"count": 10}), Verdict.OK, "by PyAV"),
        (ProbeAnswer({"count": 7}), Verdict.BROKEN, "by PyAV: of 10 frames written 7 can be read"),
        (ProbeAnswer({}, "ModuleNotFoundError: No module named 'av'"), Verdict.ABSENT, "needs PyAV"),
        (ProbeAnswer({}, "OSError: unknown codec"), Verdict.BROKEN, "by PyAV: OSError: unknown codec"),
    ],
)
def test_an_encoder_is_judged_by_what_can_be_read(answer, verdict, text):
    """A file that was written and can't be read is broken."""
    found = encoders._judge("H.264 in .mp4", answer)
    assert (found.verdict, found.text) == (verdict, text)
    assert bool(found.fix) == (verdict is Verdict.ABSENT)
