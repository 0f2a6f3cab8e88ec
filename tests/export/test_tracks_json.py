# SPDX-License-Identifier: MIT
import json

import pytest
from tricue import Box, Status, Track
from tricue.export.table import TableForm, columns
from tricue.export.tracks_json import NamedTarget, TracksJson

TRACKED, LOST = (Track(Box(1, 2, 3, 4), 0.5, status) for status in (Status.TRACKED, Status.LOST))


@pytest.mark.parametrize("several", [False, True])
def test_pieces_are_one_object(several: bool) -> None:
    """It proves that the text can be read, also without any frame, and that ids are there with several."""
    for count in (0, 3):
        text = TracksJson(lambda: 10.0, TableForm(several=several))
        parts = [text.begin({"source": "Ä"}), *(text.add(at, None, {4: LOST}) for at in range(count))]
        content = json.loads("".join([*parts, text.end([NamedTarget(4, "Ännchen", "fused")])]))
        assert list(content) == ["source", "tracks", "targets", "lost", "fps"]
        assert [list(each) for each in content["tracks"]] == [[*columns(TableForm(several=several))]] * count
        assert content["targets"] == [{"id": 4, "name": "Ännchen", "tracker": "fused"}]
        ids = {"id": 4} if several else {}
        found = [{**ids, "first": 0, "last": 2, "start_s": 0.0, "end_s": 0.2}]
        assert content["lost"] == found[: bool(count)]
        assert content["fps"] == 10


def test_a_frame_without_a_track_ends_a_range() -> None:
    """It proves that two ranges stay two if the target wasn't followed between them."""
    text = TracksJson(lambda: 10.0, TableForm(several=True))
    parts = [text.begin({"source": "x"})]
    for at, tracks in enumerate([{1: LOST, 2: LOST}, {2: LOST}, {1: LOST, 2: TRACKED}]):
        parts.append(text.add(at, at / 10, tracks))
    content = json.loads("".join([*parts, text.end([])]))
    assert [(each["id"], each["first"], each["last"]) for each in content["lost"]] == [
        (1, 0, 0),
        (1, 2, 2),
        (2, 0, 1),
    ]
