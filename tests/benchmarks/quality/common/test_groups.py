# SPDX-License-Identifier: MIT
from benchmarks.quality.common.depth_recordings import find_targets
from benchmarks.quality.common.groups import COLOR, GROUPS, LISTED, RECORDINGS, members, recording


def test_each_sequence_has_one_subject():
    """People, faces, cars, animals and objects share the thirty color sequences out; so do tuned and others.
    Those with depth are registered or of walkers.
    """
    subjects = [GROUPS[name] for name in ("people", "faces", "cars", "animals", "objects")]
    assert sum(map(len, subjects)) == len(frozenset().union(*subjects)) == len(COLOR) == 30
    assert len(GROUPS["tuned"]) == 6
    assert len(GROUPS["others"]) == 24
    assert not GROUPS["tuned"] & GROUPS["others"]
    assert len(GROUPS["OTB"]) == 15
    assert frozenset(LISTED) - frozenset(COLOR) == GROUPS["registered"] | GROUPS["walkers"]
    assert not GROUPS["registered"] & GROUPS["walkers"]
    assert all(group <= frozenset(LISTED) for group in GROUPS.values())


def test_the_recorded_sequences_are_listed(data):
    """Each is in a group."""
    found = {path.name for path in (data / "color").iterdir() if path.is_dir()}
    assert "Couple" in found
    assert found <= set(COLOR)
    targets = {each.name for each in find_targets(data / "rgbd")}
    assert "kitchen-mug chair" in targets
    assert targets <= set(LISTED) - set(COLOR)


def test_members():
    """By name, whatever the folder; empty groups are left out, and what is in none is of its own group."""
    names = ["color/Couple", "Panda", "unheard-of"]
    assert members(names) == {
        "all": names,
        "tuned": ["color/Couple"],
        "others": ["Panda"],
        "OTB": ["color/Couple"],
        "people": ["color/Couple"],
        "animals": ["Panda"],
        "other": ["unheard-of"],
    }
    assert members([]) == {}


def test_recordings():
    """Two sequences of one recording share its name, within their folder; any other has its own."""
    assert recording("color/StreetWalker") == recording("color/Couple") == "color/Couple"
    assert recording("StreetWalker") != recording("color/StreetWalker")
    assert recording("Panda") == "Panda"
    assert {*RECORDINGS, *RECORDINGS.values()} <= set(LISTED)
