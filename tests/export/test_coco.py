# SPDX-License-Identifier: MIT
"""COCO's JSON: the categories of targets."""

from tricue import Box, Status, Track
from tricue.export.coco import CocoTracks

TRACK = Track(Box(1, 2, 3, 4), 0.5, Status.TRACKED)


def test_a_target_without_a_name_is_no_other_target() -> None:
    """Those with a name are of its category, the others of one for all of them."""
    tracks = CocoTracks("walk.mp4", {1: "Ann", 3: "Bob", 4: "Ann"})
    tracks.add(0, (64, 48), dict.fromkeys((1, 2, 3, 4, 5), TRACK))
    content = tracks.content(30)
    names = {each["id"]: each["name"] for each in content["categories"]}
    expected = ["Ann", "target", "Bob", "Ann", "target"]
    assert [names[each["category_id"]] for each in content["annotations"]] == expected
    assert [names[each["category_id"]] for each in content["tracks"]] == expected


def test_without_names_there_is_one_category() -> None:
    """Also before anything is tracked."""
    tracks = CocoTracks("walk.mp4")
    assert [each["name"] for each in tracks.content(30)["categories"]] == ["target"]
    tracks.add(0, (64, 48), {7: TRACK})
    assert [each["name"] for each in tracks.content(30)["categories"]] == ["target"]
