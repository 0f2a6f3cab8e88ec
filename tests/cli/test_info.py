# SPDX-License-Identifier: MIT
"""``tricue info``: what is said of recordings whose contents are known."""

import json
import time
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tricue.cli import main
from tricue.data.summary import MAX_SAMPLED_FRAMES
from tricue.draw.video import OverlayWriter

from tests.cli.info_recordings import color, depth, facts, lines, vot

TOML = "[{channel}]\nfx = 50.0\nfy = 60.0\ncx = 31.5\ncy = 23.5\n"


def test_a_sequence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that format, frames, channels, unit, range, invalid pixels, truth and camera are what they
    were made to be.
    """
    folder = vot(tmp_path / "walk")
    (folder / "intrinsics.toml").write_text(TOML.format(channel="depth"))
    (folder / "position_z_mm.txt").write_text("1500\n0\n2500\n")
    assert lines(capsys, folder) == [
        "walk: VOT RGB-D",
        "  frames       4, 5 a second, 0.60 s",
        "  color        64x48, uint8",
        "  depth        100x40, uint16",
        "               0.001 m per unit, by VOT's format",
        "               1.004 m to 1.094 m, 5th to 95th percentile; 25.0 % invalid pixels; of all frames",
        "  truth        2 boxes, 1 absent, 1 unknown",
        "               10 to 12.5 px wide, 20 to 24 px high",
        "               0 positions, 2 depths, 1.50 m to 2.50 m",
        f"  calibration  {folder / 'intrinsics.toml'}",
        "               fx 50.00, fy 60.00, cx 31.50, cy 23.50 px",
        "               field of view 90.0 x 36.9 degrees",
    ]


def test_json_says_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --json holds the figures under their names."""
    found = facts(capsys, vot(tmp_path / "walk"))
    assert (found["name"], found["format"], found["frames"]) == ("walk", "VOT RGB-D", 4)
    assert (found["fps"], found["fps_known"], found["seconds"]) == (5.0, True, pytest.approx(0.6))
    assert found["channels"]["depth"] == {"width": 100, "height": 40, "type": "uint16", "frames": 4}
    assert found["depth"]["near_m"] == pytest.approx(1.004)
    assert found["depth"]["far_m"] == pytest.approx(1.094)
    assert (found["depth"]["invalid"], found["depth"]["frames_looked_at"]) == (0.25, 4)
    counted = {name: found["truth"][name] for name in ("boxes", "absent", "unknown", "behind_the_end")}
    assert counted == {"boxes": 2, "absent": 1, "unknown": 1, "behind_the_end": 0}
    assert found["truth"]["positions"] is found["calibration"] is None
    assert found["targets"] == found["notes"] == []


def test_where_the_unit_comes_from(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that the unit is the format's or the option's, Princeton's also of its folder alone, and that
    its bits are turned back.
    """
    plain = depth(tmp_path / "plain", 2)
    turned = depth(tmp_path / "turned", 2, rotated=True)
    for arguments, unit, near in (
        ((plain, "--depth-scale", 0.0005), "--depth-scale", 0.502),
        ((turned,), "Princeton's format", 1.004),
        ((vot(tmp_path / "vot"), "--depth-scale", 0.01), "--depth-scale", 10.04),
    ):
        found = facts(capsys, *arguments)["depth"]
        assert (found["unit_from"], found["near_m"]) == (unit, pytest.approx(near))


def test_many_depth_images_are_sampled(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that of a long recording at most a hundred images of depth are looked at, and that it says
    so.
    """
    folder = depth(tmp_path / "long", MAX_SAMPLED_FRAMES + 20)
    line = lines(capsys, folder, "--depth-scale", 0.001)[4]
    assert line.endswith("25.0 % invalid pixels; of 100 frames, evenly spaced")


def test_depth_of_far_scenes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that depths beyond 65.5 m, in units larger than a millimeter, are reported as they are."""
    depth(tmp_path / "depth", 1)
    assert main(["info", str(tmp_path / "depth"), "--depth-scale", "0.1", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["depth"]
    assert (found["near_m"], found["far_m"]) == (pytest.approx(100.4), pytest.approx(109.4))


def test_depth_of_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that depth without a single measurement has no range."""
    cv2.imwrite(str(tmp_path / "1.png"), np.zeros((4, 4), np.uint16))
    found = facts(capsys, tmp_path, "--depth-scale", 0.001)["depth"]
    assert (found["near_m"], found["far_m"], found["invalid"]) == (None, None, 1.0)
    assert lines(capsys, tmp_path, "--depth-scale", 0.001)[4].endswith("no valid pixel in all frames")


def test_a_video_is_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a video's frames are counted by reading, and that its table's rows behind its end are
    told.
    """
    path = tmp_path / "clip.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(5):
        writer.write(np.zeros((48, 64, 3), np.uint8))
    writer.release()
    assert lines(capsys, path)[1:4] == [
        "  frames       5, 10 a second, 0.40 s",
        "  color        64x48, uint8",
        "  truth        none",
    ]
    (tmp_path / "clip.csv").write_text("3,1,2,3,4\n6,1,2,3,4\n")
    found = lines(capsys, path)
    assert found[3] == "  truth        1 box, 0 absent, 4 unknown"
    assert found[5] == "               2 rows more than there are frames"
    assert found[-1] == f"  note         true boxes found: {tmp_path / 'clip.csv'}"


def test_progress_while_a_video_is_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that a video's progress is told on standard error, once, and with --json as well."""
    monkeypatch.setattr("tricue.cli.progress._PLAIN_EVERY", 0.0)
    with OverlayWriter(tmp_path / "v.avi", 10.0) as writer:
        for _ in range(3):
            writer.write(np.full((48, 64, 3), 99, np.uint8))
    for words in ([], ["--json"]):
        assert main(["info", str(writer.path), *words]) == 0
        assert capsys.readouterr().err == "".join(f"{done}/3  reading color\n" for done in (1, 2, 3))


def test_a_pair_lasts_as_long_as_its_shorter_video(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a left video with more frames than the right one changes neither duration nor rate."""
    left, right = tmp_path / "left.avi", tmp_path / "right.avi"
    for path, count in ((left, 5), (right, 4)):
        writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
        for _ in range(count):
            writer.write(np.zeros((48, 64, 3), np.uint8))
        writer.release()
    assert lines(capsys, left, "--right", right)[1] == "  frames       4, 10 a second, 0.30 s"


def test_assumed_times(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a frame rate that nobody told is said to be assumed."""
    folder = color(tmp_path / "i", 3)
    assert (
        lines(capsys, folder)[1] == "  frames       3, 30 a second (assumed, nothing tells the times), 0.07 s"
    )
    assert lines(capsys, folder, "--fps", 4)[1] == "  frames       3, 4 a second, 0.50 s"


@pytest.mark.parametrize(("shift", "warned"), [(500, False), (0.01, True), (50_000, True)])
@pytest.mark.filterwarnings("ignore:baseline")
def test_pairs(tmp_path: Path, capsys: pytest.CaptureFixture[str], shift: float, warned: bool) -> None:
    """It proves that a pair's baseline is told, and one that can't be in meters is warned of."""
    left, right = color(tmp_path / "a", 2), color(tmp_path / "b", 2)
    file = tmp_path / "calib.txt"
    file.write_text(f"P2: 500 0 32 0 0 500 24 0 0 0 1 0\nP3: 500 0 32 {-shift} 0 500 24 0 0 0 1 0\n")
    found = facts(capsys, left, "--right", right, "--calibration", file)
    assert (found["format"], list(found["channels"])) == ("stereo pair", ["color", "right"])
    assert found["calibration"]["baseline_m"] == pytest.approx(shift / 500)
    assert ("warning" in found["calibration"]) == warned
    printed = lines(capsys, left, "--right", right, "--calibration", file)
    assert f"               baseline {shift / 500:.4f} m" in printed
    assert any(line.startswith("  warning") for line in printed) == warned


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("baseline", [5, 12])
def test_a_wide_baseline_is_told_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], baseline: float
) -> None:
    """It proves that the report alone has the warning, from the width on from which others warn."""
    left, right, file = color(tmp_path / "a", 2), color(tmp_path / "b", 2), tmp_path / "calib.txt"
    shift = 500 * baseline
    file.write_text(f"P2: 500 0 32 0 0 500 24 0 0 0 1 0\nP3: 500 0 32 {-shift} 0 500 24 0 0 0 1 0\n")
    assert main(["info", str(left), "--right", str(right), "--calibration", str(file)]) == 0
    captured = capsys.readouterr()
    assert f"  warning      a baseline of {baseline} m is implausible" in captured.out
    assert captured.err == ""


def test_the_boards_unit(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --unit brings an OpenCV calibration in millimeters to meters, as in tricue track, and is
    refused where it has no effect.
    """
    left, right, file = color(tmp_path / "a", 2), color(tmp_path / "b", 2), tmp_path / "c.yml"
    written = cv2.FileStorage(str(file), cv2.FILE_STORAGE_WRITE)
    for name, shift in (("P1", 0.0), ("P2", -60000.0)):
        written.write(name, np.array([[500.0, 0, 32, shift], [0, 500, 24, 0], [0, 0, 1, 0]]))
    written.release()
    pair = [str(left), "--right", str(right)]
    found = facts(capsys, *pair, "--calibration", file, "--unit", "0.001")["calibration"]
    assert found["baseline_m"] == pytest.approx(0.12)
    assert "warning" not in found
    for arguments, message in (
        (pair, "--unit: expected with --calibration FILE, by OpenCV"),
        ([str(left), "--calibration", str(file)], "--unit: expected with a stereo pair"),
    ):
        assert main(["info", *arguments, "--unit", "0.001"]) == 2
        assert message in capsys.readouterr().err


def test_times_that_go_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a clock that was set back is told, and doesn't make the duration negative."""
    folder = depth(tmp_path / "d", 6, rotated=True)  # Princeton's names: microseconds, then the number
    for number in (3, 4, 5, 6):
        (folder / f"d-{number}000-{number}.png").rename(folder / f"d-{number % 5}00-{number}.png")
    found = facts(capsys, folder)
    (note,) = found["notes"]
    assert note.startswith("the time goes back in 2 frames, the first of them frame 2, as if the clock")
    assert found["seconds"] == pytest.approx(5 / found["fps"])


@pytest.mark.parametrize("suffix", ["png", "jpg"])
def test_images_of_another_size(tmp_path: Path, suffix: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The first of them is named, where tricue track would stop."""
    for number, height in enumerate((48, 48, 50, 48, 36), 1):
        cv2.imwrite(str(tmp_path / f"{number}.{suffix}"), np.full((height, 64, 3), 90, np.uint8))
    other = tmp_path / f"3.{suffix}"
    note = f"2 of 5 images are of another size than the first, 64x48; tracking stops at {other}, 64x50 px"
    assert facts(capsys, tmp_path)["notes"] == [note]


def test_images_of_another_size_in_their_files_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing is said of a photo that is turned by its EXIF data to the size of the others, of a damaged
    file, or of formats whose headers aren't looked at.
    """
    image = pytest.importorskip("PIL.Image")
    exif = image.Exif()
    exif[0x0112] = 6  # turned by 90 degrees
    image.new("RGB", (48, 64)).save(tmp_path / "1.jpg")
    image.new("RGB", (64, 48)).save(tmp_path / "2.jpg", exif=exif)
    (tmp_path / "3.jpg").write_bytes(b"\xff\xd8\xff\xe0")
    image.new("RGB", (64, 48)).save(tmp_path / "4.bmp")
    assert facts(capsys, tmp_path)["notes"] == []


def test_a_calibration_of_no_use(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that what is wrong with a file that was found is told, and is an error if it was given."""
    folder = color(tmp_path / "walk", 1)
    (folder / "intrinsics.toml").write_text("fx = 1\n")
    assert "of no use" in lines(capsys, folder)[-1]
    assert main(["info", str(folder), "--calibration", str(folder / "intrinsics.toml")]) == 2
    assert "intrinsics.toml: expected the key" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda folder: folder / "nowhere", "there is no such file or folder"),
        (lambda folder: folder, "expected a folder of images or a sequence, found neither"),
        (lambda folder: depth(folder / "d", 1), "expected --depth-scale"),
        (lambda folder: color(folder / "c", 1) / "00000001.png", "one picture; give its folder"),
    ],
)
def test_errors_are_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], make: Any, message: str
) -> None:
    """It proves that each unusable place is an error of one line that says what is wrong, exit code 2."""
    assert main(["info", str(make(tmp_path))]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("tricue info: ")
    assert message in captured.err
    assert captured.err.count("\n") == 1


def test_a_camera_has_no_frames_to_count(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a live camera is refused instead of being read for ever."""

    class Live:
        def __init__(self, _number: int) -> None:
            pass

        def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
            return True

        def get(self, _key: int) -> float:
            return 30.0

        def read(self) -> tuple[bool, object]:
            time.sleep(0.01)
            return True, np.zeros((4, 6, 3), np.uint8)

        def release(self) -> None:
            pass

    monkeypatch.setattr(cv2, "VideoCapture", Live)
    assert main(["info", "0"]) == 2
    assert "camera 0: expected a recording" in capsys.readouterr().err
