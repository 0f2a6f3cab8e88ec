# SPDX-License-Identifier: MIT
"""The files that ``tricue track`` writes: their contents, and that none replaces what is read."""

import json
import subprocess
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from tricue.cli.program import main

from tests.cli.track_commands import read_csv, tricue_command


def test_track_writes_everything(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that track starts on the first true box, follows, scores, and writes all three files."""
    out = {name: tmp_path / f"out.{name}" for name in ("mp4", "csv", "json")}
    files = ["--output", str(out["mp4"]), "--csv", str(out["csv"]), "--json", str(out["json"])]
    assert (
        main(["track", str(sequence), "--tracker", drift_tracker, "--set", "step=2", "--seed", "7", *files])
        == 0
    )
    printed = capsys.readouterr().out
    assert "walk: 10 frames, 8 tracked, 0 occluded, 2 lost" in printed
    assert "AUC 0.952, precision at 20 px 1.000" in printed  # the overlap is 1 above 20 of 21 thresholds
    assert all(f"wrote {path}" in printed for path in out.values())
    rows = read_csv(out["csv"])
    assert [float(row["x"]) for row in rows] == [5 + 2 * index for index in range(10)]
    assert [row["status"] for row in rows] == ["tracked"] * 8 + ["lost"] * 2
    content = json.loads(out["json"].read_text())
    assert content["tricue"] == tricue.__version__
    assert (content["tracker"], content["seed"], content["kernels"]) == (drift_tracker, 7, "native")
    assert content["params"] == {"step": 2.0}
    assert [track["frame"] for track in content["tracks"]] == list(range(10))
    capture = cv2.VideoCapture(str(out["mp4"]))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 10


def test_the_input_is_never_overwritten(
    drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an output that is the input itself is refused and the input stays as it is."""
    path = tmp_path / "v.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(3):
        writer.write(np.full((48, 64, 3), 99, np.uint8))
    writer.release()
    before = path.read_bytes()
    assert (
        main(["track", str(path), "--tracker", drift_tracker, "--box", "1,2,8,9", "--output", str(path)]) == 2
    )
    assert "v.avi: expected a file to write to that isn't read" in capsys.readouterr().err
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("option", "name"),
    [
        ("--csv", "img/0002.png"),
        ("--json", "img/0001.png"),
        ("--mot", "groundtruth_rect.txt"),
        ("--csv", "boxes.csv"),
    ],
)
def test_what_is_read_is_never_overwritten(
    option: str, name: str, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a folder's images and true boxes stay; a track that was written before is replaced."""
    (tmp_path / "img").mkdir()
    for number in range(1, 4):
        cv2.imwrite(str(tmp_path / "img" / f"{number:04d}.png"), np.full((48, 64, 3), 99, np.uint8))
    (tmp_path / ("boxes.csv" if name == "boxes.csv" else "groundtruth_rect.txt")).write_text("1,2,8,9\n" * 3)
    before = (tmp_path / name).read_bytes()
    words = ["track", str(tmp_path), "--tracker", drift_tracker, "--box", "1,2,8,9"]
    assert main([*words, option, str(tmp_path / name)]) == 2
    assert f"{name}: expected a file to write to that isn't read" in capsys.readouterr().err
    assert (tmp_path / name).read_bytes() == before
    for _ in range(2):
        assert main([*words, option, str(tmp_path / "track.csv")]) == 0


def test_labels_beside_a_video_are_never_overwritten(
    drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a table of true boxes stays; one that a tracker wrote is no such table."""
    path, table = tmp_path / "v.avi", tmp_path / "v.csv"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(3):
        writer.write(np.full((48, 64, 3), 99, np.uint8))
    writer.release()
    words = ["track", str(path), "--tracker", drift_tracker, "--box", "1,2,8,9", "--csv", str(table)]
    for _ in range(2):
        assert main(words) == 0
    table.write_text("frame,x,y,width,height\n0,1,2,8,9\n")
    assert main(words) == 2
    assert "v.csv: expected a file to write to that isn't read" in capsys.readouterr().err
    assert table.read_text() == "frame,x,y,width,height\n0,1,2,8,9\n"


def test_a_damaged_image_leaves_whole_files(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an input broken in the middle is a one-line error, and what came before is kept."""
    (sequence / "img" / "0004.png").write_bytes(b"no picture")
    assert main(["track", str(sequence), "--tracker", drift_tracker, "--json", str(tmp_path / "o.json")]) == 2
    assert "0004.png: expected an image" in capsys.readouterr().err
    assert len(json.loads((tmp_path / "o.json").read_text())["tracks"]) == 4


def test_two_outputs_are_not_one_file(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a file given for two outputs is refused before anything is written."""
    files = ["--csv", str(tmp_path / "out"), "--json", str(tmp_path / "." / "out")]
    assert main(["track", str(sequence), "--tracker", drift_tracker, *files]) == 2
    assert "out: expected a file for each output, got this one twice" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("option", ["--csv", "--json"])
def test_a_full_disk_names_the_file(
    option: str, sequence: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an output that can't be written is named, with exit code 2."""
    assert main(["track", str(sequence), "--tracker", drift_tracker, option, "/dev/full"]) == 2
    assert capsys.readouterr().err == "tricue track: /dev/full: No space left on device\n"


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("out.mp4", "File too large"),
        ("out.avi", "only 0 of 10 frames were written; is the disk full?"),
    ],
)
def test_a_video_that_the_disk_has_no_room_for_is_an_error(
    name: str, error: str, sequence: Path, tmp_path: Path
) -> None:
    """It proves that frames that the encoder couldn't write aren't taken for written."""
    command = tricue_command("track", str(sequence), "--output", str(tmp_path / name))
    limited = ["sh", "-c", 'ulimit -f 1; exec "$@"', "sh", *command]  # a block of 512 bytes
    done = subprocess.run(limited, capture_output=True, text=True, check=False)
    assert (done.returncode, "wrote" in done.stdout) == (2, False)
    assert f"{name}: {error}" in done.stderr


@pytest.mark.filterwarnings("default")
def test_a_video_that_is_cut_off_warns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a video of which half is missing is tracked or described as far as it goes, and that
    this is told.
    """
    whole = tmp_path / "whole.avi"
    writer = cv2.VideoWriter(str(whole), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (64, 48))
    noise = np.random.default_rng(0).integers(0, 256, (40, 48, 64, 3), np.uint8)
    for picture in noise:
        writer.write(picture)
    writer.release()
    for share, told in ((1.0, 0), (0.5, 1)):
        (tmp_path / "v.avi").write_bytes(whole.read_bytes()[: int(share * whole.stat().st_size)])
        assert main(["track", str(tmp_path / "v.avi"), "--box", "20,16,16,16"]) == 0
        assert capsys.readouterr().err.count("of its 40 frames can be decoded; is it cut off?") == told
        assert main(["info", str(tmp_path / "v.avi")]) == 0
        assert capsys.readouterr().err.count("of its 40 frames can be decoded; is it cut off?") == told
