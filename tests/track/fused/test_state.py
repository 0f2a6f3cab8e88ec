# SPDX-License-Identifier: MIT
"""The fused tracker's state, a value that is replaced."""

import pytest
from tricue.track.fused.memory import Memory
from tricue.track.fused.outline import Sides
from tricue.track.fused.state import FusedState
from tricue.track.fused.target import Target

HERE = Target(100.0, 80.0, 40.0, 40.0)


def test_a_replaced_state_is_another_one():
    """The state stays what it was; the other has the new attributes and all the others."""
    state = FusedState(
        (240, 320), {}, Memory({}, {}), HERE, 40.0, 40.0, 0.5, Sides.cut_by_border(HERE, (240, 320))
    )
    changed = state.replace(score=0.25, frames=7)
    assert (state.frames, changed.frames, changed.score) == (0, 7, 0.25)
    assert changed.replace(score=state.score, frames=0) == state


def test_a_misspelt_attribute_is_refused():
    """It would be lost without a word."""
    state = FusedState(
        (240, 320), {}, Memory({}, {}), HERE, 40.0, 40.0, 0.5, Sides.cut_by_border(HERE, (240, 320))
    )
    with pytest.raises(AssertionError, match="expected fields of a FusedState, got frame"):
        state.replace(frame=7)
