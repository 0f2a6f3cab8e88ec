# SPDX-License-Identifier: MIT
"""``tricue info`` of several targets and of folders of several recordings."""

from pathlib import Path

import pytest
from tricue.cli import main
from tricue.data.datasets import find_sequences

from tests.cli.info_recordings import color, depth, facts, kitti, lines, vot


def test_targets(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a folder's targets are listed, and that one can be looked at."""
    root = kitti(tmp_path / "kitti")
    printed = lines(capsys, root)
    assert "  truth        none" in printed
    assert "  targets      2, by --target: Car 0, Van 3" in printed
    found = facts(capsys, root, "--target", "Van 3")
    assert (found["name"], found["frames"], found["truth"]["boxes"]) == ("kitti Van 3", 2, 2)
    assert found["truth"]["positions"]["known"] == 2


def test_a_folder_of_sequences(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that of a folder without images each sequence below has a line, in JSON an object."""
    kitti(tmp_path / "b" / "kitti")
    vot(tmp_path / "a" / "walk")
    assert lines(capsys, tmp_path) == [
        "a/walk: VOT RGB-D, 4 frames, color and depth, 2 boxes",
        "b/kitti: KITTI tracking, 3 frames, color and right, 2 targets",
    ]
    found = facts(capsys, tmp_path)["sequences"]
    assert [each["place"] for each in found] == ["a/walk", "b/kitti"]
    assert found[0]["boxes"] == 2


def test_progress_of_a_search(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that the search of a large folder, and the reading of what it finds, aren't silent."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    vot(tmp_path / "a" / "walk")
    assert main(["info", str(tmp_path)]) == 0
    captured = capsys.readouterr()
    searched = "".join(f"{count}  folders searched for sequences\n" for count in (1, 2, 3))
    assert captured.err == f"{searched}1/1  sequences read\n"
    assert captured.out.startswith("a/walk: ")


@pytest.mark.parametrize(
    "option", [("--fps", "15"), ("--target", "Car 0"), ("--calibration", "c.yml"), ("--unit", "1")]
)
def test_a_folder_of_sequences_refuses_options_of_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], option: tuple[str, str]
) -> None:
    """It proves that an option about one recording is an error of one line instead of being ignored."""
    vot(tmp_path / "a")
    assert main(["info", str(tmp_path), *option]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith(f"tricue info: {option[0]}: expected with one recording, {tmp_path} is a ")


def test_the_unit_of_a_folder_of_sequences(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --depth-scale is for the sequences that need it, and leaves the others alone."""
    (color(tmp_path / "a", 2) / "boxes.csv").write_text("1,2,3,4\n")
    (depth(tmp_path / "b", 2) / "boxes.csv").write_text("1,2,3,4\n")
    both = tmp_path / "c"
    for channel, make in (("color", color), ("depth", depth)):
        make(both / channel, 2)
    (both / "boxes.csv").write_text("1,2,3,4\n")
    assert main(["info", str(tmp_path / "b")]) == 2
    found = facts(capsys, tmp_path, "--depth-scale", 0.001)["sequences"]
    assert found.pop()["channels"] == ["color", "depth"]
    assert [each["channels"] for each in found] == [["color"], ["depth"]]


def test_a_malformed_sequence_among_others(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that the others have their lines all the same, and the exit code is that of an error."""
    (vot(tmp_path / "a") / "groundtruth.txt").write_text("1,2,3\n")
    vot(tmp_path / "b")
    assert main(["info", str(tmp_path)]) == 2
    captured = capsys.readouterr()
    first, second = captured.out.splitlines()
    assert first.startswith("a: can't be opened: ")
    assert "groundtruth.txt, line 1: expected four numbers" in first
    assert second.startswith("b: VOT RGB-D")
    assert captured.err == f"tricue info: {tmp_path}: 1 of 2 sequences can't be opened\n"


def test_real_data(data: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that every real sequence is told of in one line, and by itself: of those in color alone,
    which are many and alike, a few.
    """
    listed = facts(capsys, data)["sequences"]
    assert len(listed) == len(list(find_sequences(data))) >= 11
    in_color = [each for each in listed if each["channels"] == ["color"]]
    for each in [each for each in listed if each not in in_color[2:]]:
        found = facts(capsys, data / each["place"])
        assert found["format"] == each["format"]
        assert found["truth"] is not None or len(found["targets"]) == 4
        if found["depth"]:
            assert 0 < found["depth"]["invalid"] < 0.9
            assert 0.1 < found["depth"]["near_m"] < found["depth"]["far_m"] < 10


def test_a_target_is_tracked_by_its_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that ``tricue track`` starts on the target that ``tricue info`` lists."""
    words = ["track", str(kitti(tmp_path / "kitti")), "--assume-fov", "60,45"]
    assert main(words) == 2
    assert "give --box" in capsys.readouterr().err
    assert main([*words, "--target", "Van 3"]) == 0
    assert capsys.readouterr().out.startswith("kitti Van 3: 2 frames")
