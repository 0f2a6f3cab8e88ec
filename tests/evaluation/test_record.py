# SPDX-License-Identifier: MIT
import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from tricue.evaluation.one_pass import Run
from tricue.evaluation.record import Record
from tricue.track.base.track import Status

numbers = st.floats(allow_infinity=False, allow_nan=True, width=64)


@st.composite
def records(draw):
    """Records with any numbers in them."""
    count = draw(st.integers(1, 5))
    positions = draw(arrays(np.float64, (count, 3), elements=numbers))
    return Record(
        Run(
            draw(arrays(np.float64, (count, 4), elements=numbers)),
            draw(arrays(np.float64, count, elements=st.floats(0, 1))),
            tuple(draw(st.lists(st.sampled_from(Status), min_size=count, max_size=count))),
            positions,
            draw(arrays(np.float64, (count, 3, 3), elements=numbers)),
            draw(arrays(np.float64, draw(st.integers(0, 5)), elements=st.floats(0, 1))),
        ),
        tuple(draw(st.lists(st.integers(0, 9), min_size=1, max_size=3))),
        draw(st.text()),
    )


@given(records())
def test_a_record_is_the_same_again_bit_for_bit(record):
    """Every number, NaN and text comes back as it was written."""
    again = Record.from_json(record.to_json({"tracker": "drift"}))
    for name in ("boxes", "scores", "positions", "covariances", "seconds"):
        before, after = getattr(record.run, name), getattr(again.run, name)
        assert before.shape == after.shape
        np.testing.assert_array_equal(before, after)
    assert (again.run.statuses, again.starts, again.error) == (
        record.run.statuses,
        record.starts,
        record.error,
    )


def test_the_file_explains_itself_and_is_plain_json():
    """What was run stands in it; NaN, which JSON hasn't, is null."""
    nothing = np.full((2, 4), np.nan)
    run = Run(
        nothing, np.zeros(2), (Status.LOST,) * 2, nothing[:, :3], np.full((2, 3, 3), np.nan), np.ones(1)
    )
    values = json.loads(Record(run).to_json({"tracker": "drift"}), parse_constant=pytest.fail)
    assert values["tracker"] == "drift"
    assert values["boxes"] == [None, None]
    assert values["statuses"] == ["lost", "lost"]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "{}", '{"boxes": 3}', '{"boxes": [[1]], "statuses": ["new"]}']
)
def test_other_files_are_refused(text):
    """What isn't a record raises ValueError and nothing else."""
    with pytest.raises(ValueError, match=r".+"):
        Record.from_json(text)
