# SPDX-License-Identifier: MIT
"""What ``tricue track`` does to files: to those of an earlier run, to what it reads, and by which names."""

import csv
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.cli.program import main
from tricue.cli.starts import in_options
from tricue.draw.video import OverlayWriter, count_frames

BOX = "20,16,16,16"


@pytest.fixture
def video(tmp_path: Path) -> Path:
    """A bright square over noise, 64x48, six frames."""
    picture = np.random.default_rng(0).integers(0, 90, (48, 64, 3), np.uint8)
    picture[16:32, 20:36] = (60, 120, 220)
    with OverlayWriter(tmp_path / "in" / "v.avi", 10.0) as writer:
        for _ in range(6):
            writer.write(picture)
    return writer.path


def images(folder: Path) -> Path:
    """Three images, from 9.png to 11.png."""
    folder.mkdir(parents=True)
    for number in (9, 10, 11):
        cv2.imwrite(str(folder / f"{number}.png"), np.full((48, 64, 3), 99, np.uint8))
    return folder


def error_of(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """The error's line of a run that ends with exit code 2."""
    assert main(["track", *words]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    return error.removeprefix("tricue track: ").strip()


def out(folder: Path) -> list[str]:
    """Options for all outputs but the plot."""
    names = {"--csv": "o.csv", "--json": "o.json", "--mot": "o.txt", "--coco": "o.coco", "--output": "o.avi"}
    return [word for option, name in names.items() for word in (option, str(folder / name))]


NEVER_STARTED = [
    (["--box", "5000,16,16,16"], "box: expected a part inside the image"),
    (["--box", BOX, "--start", "100"], "frame 100: expected a frame to start in"),
    (["--box", f"100:{BOX}"], "frame 100: expected a frame to start in; v ends before it"),
    (["--tracker", "stereo-head", "--box", BOX], "frame: expected the channel right"),
    (["--box", BOX, "--plot", "{}/in/v.avi/p.png"], "Not a directory"),
]


def test_progress_in_a_video(
    video: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that a video's progress is told by the number of frames that its container states."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    for words, total in (([], 6), (["--start", "2"], 4), (["--end", "2"], 3)):
        assert main(["track", str(video), "--box", BOX, *words]) == 0
        lines = capsys.readouterr().err.splitlines()
        assert [line.split()[0] for line in lines] == [f"{done}/{total}" for done in range(1, total + 1)]


@pytest.mark.parametrize(("words", "message"), NEVER_STARTED)
def test_a_run_that_never_starts_touches_nothing(
    video: Path, tmp_path: Path, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a mistyped option costs no results of an earlier run, and leaves no empty files."""
    before = tmp_path / "before"
    assert main(["track", str(video), "--box", BOX, *out(before)]) == 0
    capsys.readouterr()
    content = {path: path.read_bytes() for path in before.iterdir()}
    assert len(content) == 5
    words = [word.format(tmp_path) for word in words]
    for folder in (before, tmp_path / "new"):
        assert re.search(message, error_of(capsys, str(video), *words, *out(folder)))
    assert {path: path.read_bytes() for path in before.iterdir()} == content
    assert not (tmp_path / "new").exists()


def test_a_target_that_is_never_found_touches_nothing(
    recording: Path, nearest_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves it also of a tracker that looks for its target in all frames."""
    words = [str(recording), "--depth-scale", "0.001", "--tracker", nearest_tracker, "--end", "1"]
    (tmp_path / "o.csv").write_text("before")
    assert "started in none of 2 frames" in error_of(capsys, *words, *out(tmp_path))
    assert (tmp_path / "o.csv").read_text() == "before"
    assert not list(tmp_path.glob("o.[!c]*"))


def test_a_wide_low_image_has_a_video(tmp_path: Path, drift_tracker: str) -> None:
    """It proves that the overlay isn't enlarged beyond what its encoder takes."""
    pytest.importorskip("av")
    (tmp_path / "in").mkdir()
    for number in range(3):
        cv2.imwrite(str(tmp_path / "in" / f"{number}.png"), np.full((20, 2000, 3), 99, np.uint8))
    words = ["--tracker", drift_tracker, "--box", "20,2,16,16", "--output", str(tmp_path / "o.mp4")]
    assert main(["track", str(tmp_path / "in"), *words]) == 0
    assert count_frames(tmp_path / "o.mp4") == 3


def test_times_of_a_variable_rate(tmp_path: Path, drift_tracker: str) -> None:
    """It proves that the table and the overlay have the times of the video's frames."""
    av = pytest.importorskip("av")
    times = [0, 0.04, 1.04, 1.08, 3.0]
    with OverlayWriter(tmp_path / "v.mp4", 25.0) as writer:
        for time in times:
            writer.write(np.full((48, 64, 3), 99, np.uint8), time)
    files = ["--csv", str(tmp_path / "o.csv"), "--output", str(tmp_path / "o.mp4")]
    assert main(["track", str(tmp_path / "v.mp4"), "--tracker", drift_tracker, "--box", BOX, *files]) == 0
    with (tmp_path / "o.csv").open() as file:
        assert [float(row["time_s"]) for row in csv.DictReader(file)] == pytest.approx(times, abs=0.001)
    with av.open(str(tmp_path / "o.mp4")) as file:
        assert [frame.time for frame in file.decode(video=0)] == pytest.approx(times, abs=0.001)


@pytest.mark.parametrize("suffix", [".mp4", ".mkv"])
def test_a_variable_rate_is_the_mean(
    tmp_path: Path, drift_tracker: str, suffix: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that JSON, COCO and tricue info have one rate, by which the last frame has its time."""
    pytest.importorskip("av")
    video = tmp_path / f"v{suffix}"
    with OverlayWriter(video, 25.0) as writer:
        for time in (0, 0.04, 1.04, 1.08, 3.0):
            writer.write(np.full((48, 64, 3), 99, np.uint8), time)
    files = ["--json", str(tmp_path / "o.json"), "--coco", str(tmp_path / "c.json")]
    assert main(["track", str(video), "--tracker", drift_tracker, "--box", BOX, *files]) == 0
    capsys.readouterr()
    assert main(["info", str(video), "--json"]) == 0
    rate = json.loads(capsys.readouterr().out)["fps"]
    assert rate == pytest.approx(4 / 3.0)
    assert json.loads((tmp_path / "o.json").read_text())["fps"] == pytest.approx(rate)
    assert json.loads((tmp_path / "c.json").read_text())["videos"][0]["fps"] == pytest.approx(rate)


@pytest.mark.parametrize("name", ["v.avi", "hard.avi", "soft.avi"])
def test_no_name_of_the_input_is_written(
    video: Path, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the input is known by any name, also that of a hard link."""
    (video.parent / "hard.avi").hardlink_to(video)
    (video.parent / "soft.avi").symlink_to(video)
    before = video.read_bytes()
    path = video.parent / name
    error = error_of(capsys, str(video), "--box", BOX, "--csv", str(path))
    assert error == f"{path}: expected a file to write to that isn't read"
    assert video.read_bytes() == before


def test_two_names_of_one_output(video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that two outputs into hard links of one file are refused."""
    (tmp_path / "o.csv").touch()
    (tmp_path / "o.json").hardlink_to(tmp_path / "o.csv")
    assert "got this one twice" in error_of(capsys, str(video), "--box", BOX, *out(tmp_path))


def test_a_layouts_list_is_never_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that the file that lists a sequence's images counts as read."""
    folder = images(tmp_path / "walk" / "color").parent
    (folder / "sequence").write_text("channels.color=color/%d.png\n")
    error = error_of(capsys, str(folder), "--box", BOX, "--csv", str(folder / "sequence"))
    assert error.endswith("sequence: expected a file to write to that isn't read")
    assert (folder / "sequence").read_text() == "channels.color=color/%d.png\n"


def test_coco_names_a_folders_images(tmp_path: Path, drift_tracker: str) -> None:
    """It proves that file_name is that of the image, by which other tools find it."""
    words = ["--tracker", drift_tracker, "--box", BOX, "--coco", str(tmp_path / "o.json"), "--start", "1"]
    assert main(["track", str(images(tmp_path / "images")), *words]) == 0
    found = json.loads((tmp_path / "o.json").read_text())["images"]
    assert [each["file_name"] for each in found] == ["10.png", "11.png"]


UNSURE = """
import tricue

class Unsure:
    def init(self, image, box):
        self.count = 0

    def update(self, image):
        self.count += 1
        if self.count % 2:
            return tricue.Track(tricue.Box(float("nan"), 0, 1, 1), 0.0, tricue.Status.LOST)
        return tricue.Track(tricue.Box(1, 2, 8, 9), 0.5, tricue.Status.TRACKED)
"""


def test_a_box_that_a_third_party_does_not_know(video: Path, tmp_path: Path) -> None:
    """A lost target without a box has its last one, of which all files can tell."""
    (tmp_path / "theirs.py").write_text(UNSURE)
    words = ["--tracker", f"{tmp_path}/theirs.py:Unsure", "--box", BOX, *out(tmp_path), "--trail"]
    assert main(["track", str(video), *words]) == 0
    rows = json.loads((tmp_path / "o.json").read_text())["tracks"]
    assert [row["x"] for row in rows] == [20, 20, 1, 1, 1, 1]
    assert [row["status"] == "lost" for row in rows] == [False, True, False, True, False, True]
    assert count_frames(tmp_path / "o.avi") == 6


def test_a_third_party_that_names_no_channel(
    video: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its own words are told, without advice about a channel that it doesn't name."""
    (tmp_path / "theirs.py").write_text(
        "from tricue.errors import MissingChannelError\n"
        "class Picky:\n"
        "    def init(self, image, box): raise MissingChannelError('no thermal image')\n"
        "    def update(self, image): pass\n"
    )
    error = error_of(capsys, str(video), "--box", BOX, "--tracker", f"{tmp_path}/theirs.py:Picky")
    assert error.endswith("no thermal image")


@pytest.mark.parametrize("option", ["--csv", "--mot", "--coco", "--output"])
def test_json_alone_goes_to_standard_output(
    video: Path,
    tmp_path: Path,
    option: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It proves that - for another output is refused, and no file of that name."""
    monkeypatch.chdir(tmp_path)
    error = error_of(capsys, str(video), "--box", BOX, option, "-")
    assert error.startswith(f"{option} -: expected a file")
    assert not Path("-").exists()


def test_names_that_are_not_utf_8(video: Path, tmp_path: Path) -> None:
    """It proves that an overlay's is refused in a line, before anything is written; a table may have any."""
    names = [os.fsencode(tmp_path) + b"/o\xff" + suffix for suffix in (b".csv", b".avi")]
    command = [sys.executable, "-m", "tricue", "track", str(video), "--box", BOX]
    files: list[str | bytes] = ["--csv", names[0], "--output", names[1]]
    done = subprocess.run([*command, *files], capture_output=True, check=False)
    assert (done.returncode, done.stderr.count(b"\n")) == (2, 1)
    assert b"expected a video's path in UTF-8" in done.stderr
    assert not any(map(os.path.exists, names))
    done = subprocess.run([*command, *files[:2]], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")


def test_parameters_are_called_as_on_the_command_line(
    video: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an error of a tracker is told without Python."""
    error = error_of(capsys, str(video), "--box", BOX, "--tracker", "flow-depth")
    assert "; --set cues=flow needs neither; give the right camera's images with --right" in error
    assert in_options("cues=('flow', 'disparity') (5, 6) b=(1,)") == "--set cues=flow,disparity (5, 6) b=(1,)"
