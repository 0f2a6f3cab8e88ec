# SPDX-License-Identifier: MIT
"""``tricue vot-workspace``: what it prints; tests/toolkits has what it writes."""

import re
import shlex
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.cli import main
from tricue.cli.vot_workspace import commands
from tricue.evaluation.toolkits.vot_sequences import _write_lines

pytest.importorskip("trax")


@pytest.fixture
def data(tmp_path: Path) -> Path:
    """A folder of two sequences in color, with true boxes."""
    for name in ("walk", "run"):
        folder = tmp_path / "data" / name / "img"
        folder.mkdir(parents=True)
        for index in range(3):
            cv2.imwrite(str(folder / f"{index}.png"), np.full((40, 60, 3), 50 * index, np.uint8))
        (folder.parent / "groundtruth_rect.txt").write_text("\n".join(["11,11,20,20"] * 3))
    return tmp_path / "data"


def test_it_says_what_it_wrote_and_what_to_run(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that each sequence is told, and that the toolkit's three commands stand there to copy."""
    place = tmp_path / "my vot"
    assert main(["vot-workspace", str(place), "--trackers", "color-particle", "--sequences", str(data)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[:3] == [
        f"wrote {place / 'sequences' / 'run'}",
        f"wrote {place / 'sequences' / 'walk'}",
        f"wrote {place}: color-particle on run, walk",
    ]
    words = [shlex.split(line) for line in printed if line.startswith("  vot ")]
    assert words == [
        [
            "vot",
            "--registry",
            f"{place}/trackers.ini",
            "test",
            "-s",
            f"{place}/sequences/run",
            "color-particle",
        ],
        ["vot", "evaluate", "--workspace", str(place), "color-particle"],
        ["vot", "analysis", "--workspace", str(place), "--format", "json", "color-particle"],
    ]
    assert "exit with 0 even where they fail" in printed[-1]


def test_progress_of_a_search(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that the search of a large folder for sequences isn't silent."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    (tmp_path / "data" / "a").mkdir(parents=True)
    words = ["--trackers", "color-particle", "--sequences", str(tmp_path / "data")]
    assert main(["vot-workspace", str(tmp_path / "vot"), *words]) == 2
    searched = "".join(f"{count}  folders searched for sequences\n" for count in (1, 2))
    assert capsys.readouterr().err.startswith(f"{searched}tricue vot-workspace: ")


def test_trackers_are_named_once(data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a tracker that is named twice is one, and that what is left out is told."""
    names = "color-particle, color-particle"
    command = ["vot-workspace", str(tmp_path / "ws"), "--trackers", names]
    assert main([*command, "--sequences", str(data)]) == 0
    assert (tmp_path / "ws" / "trackers.ini").read_text().count("[color-particle]") == 1
    assert main([*command, "--sequences", str(data)]) == 0
    assert f"left out {data / 'walk'}: the workspace has a sequence walk" in capsys.readouterr().out


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_full_disk_is_told_with_the_file(
    data: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the error of a full disk says which file of the workspace it is about."""
    path = tmp_path / "ws" / "trackers.ini"
    words = ["vot-workspace", str(tmp_path / "ws"), "--trackers", "color-particle", "--sequences", str(data)]
    assert main(words) == 0
    path.unlink()
    path.symlink_to("/dev/full")
    assert main(words) == 2
    assert capsys.readouterr().err == f"tricue vot-workspace: {path}: No space left on device\n"


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_a_full_disk_is_told_with_the_file_of_a_sequence() -> None:
    """It proves the same of the files of a sequence, whose errors become notes."""
    with pytest.raises(OSError, match="No space left on device: '/dev/full'"):
        _write_lines(Path("/dev/full"), ["1,2,3,4"])


def test_all_trackers_are_in_the_commands() -> None:
    """It proves that evaluation and analysis are of all trackers, the test of the first."""
    test, *others = commands(Path("ws"), ["color-particle", "flow-depth"], "walk")
    assert test.endswith("-s ws/sequences/walk color-particle")
    assert all(line.endswith(" color-particle flow-depth") for line in others)


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (["--trackers", "stereo-head"], "tricue vot-workspace: stereo-head: needs the right image"),
        (
            ["--trackers", "depth-particle"],
            "found none; left out .*/run: it has no depth, which depth-particle needs",
        ),
        (["--trackers", "color-particle", "--python", "nowhere/python"], "found none at nowhere/python"),
        (["--trackers", "color-particle", "--sequences", "nowhere"], "nowhere: there is no such folder"),
        (["--trackers", "color-particle", "--sequences", "empty"], "empty: expected folders of sequences"),
        (["--trackers", "fused,nope"], "argument --trackers: expected one of .* got 'nope'"),
        (["--trackers", ","], "argument --trackers: expected names separated by commas"),
        ([], "the following arguments are required: --trackers"),
    ],
)
def test_errors_are_a_line(
    more: list[str],
    message: str,
    data: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It proves that each mistake is one line on stderr, exit code 2, and no folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    try:
        code = main(["vot-workspace", str(tmp_path / "ws"), "--sequences", str(data), *more])
    except SystemExit as stop:  # argparse's own way out
        code = int(str(stop.code))
    error = capsys.readouterr().err
    assert code == 2
    assert error.count("\n") == 1
    assert re.search(message, error), error
    assert not (tmp_path / "ws").exists()


def test_help_shows_examples(capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that the verb has a help text with commands to copy."""
    with pytest.raises(SystemExit) as stop:
        main(["vot-workspace", "--help"])
    assert stop.value.code == 0
    assert "examples:\n  tricue vot-workspace" in capsys.readouterr().out
