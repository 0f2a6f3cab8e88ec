# SPDX-License-Identifier: MIT
"""``tricue track`` from a frame to a frame, with boxes of any frame, or drawn in the browser."""

import csv
import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import tricue.app
from tricue import Box
from tricue.cli.program import main
from tricue.data.open_source import open_source
from tricue.draw.video import OverlayWriter

from tests.cli.info_recordings import kitti
from tests.cli.test_track_several import images, rows
from tests.data.depth_folders import color_folder, depth_folder

__all__ = ["images"]

FIRST, OTHER = "17,20,24,32", "86,60,24,32"  # where two of the things are in frames 3 and 4


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[str], str]:
    """Exit code, printed lines and errors of ``tricue track``."""
    code = main(["track", *words])
    out, err = capsys.readouterr()
    return code, out.splitlines(), err


def test_a_part_is_tracked(images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --start and --end are the first and the last frame, whose numbers stay."""
    words = ["--box", FIRST, "--start", "3", "--end", "5", "--csv", str(tmp_path / "o.csv")]
    code, printed, _ = run(capsys, str(images), *words)
    assert (code, printed[0].split(": ")[1].startswith("3 frames, 3 tracked")) == (0, True)
    assert "started in frame 3" in printed
    found = rows(tmp_path / "o.csv")
    assert [row["frame"] for row in found] == ["3", "4", "5"]
    assert [float(row["x"]) for row in found] == pytest.approx([17, 16, 15], abs=1.5)
    assert float(found[0]["time_s"]) == pytest.approx(0.1)


def test_a_box_in_black_frames(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a box of a single color is told, as where a video begins black, and no other."""
    noise = np.random.default_rng(0).integers(0, 256, (48, 64, 3), np.uint8)
    for number in range(6):
        cv2.imwrite(str(tmp_path / f"{number}.png"), noise if number > 2 else noise // 64)
    told = (
        "the box in frame 1 shows a single color; "
        "give one in a frame that shows the target, --box FRAME:x,y,width,height"
    )
    for boxes, notes in (
        (["1:20,16,16,16"], [told]),
        (["3:20,16,16,16"], []),
        (["1:50,-9,30,30", "4:20,16,16,16"], [told]),
    ):
        code, printed, _ = run(capsys, str(tmp_path), *(word for box in boxes for word in ("--box", box)))
        assert (code, [line for line in printed if "single color" in line]) == (0, notes)


def test_a_box_of_a_later_frame(images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that FRAME:x,y,w,h starts there, one target or several, each in its own frame."""
    words = ["--box", f"3:{FIRST}", "--csv", str(tmp_path / "one.csv")]
    assert run(capsys, str(images), *words)[0] == 0
    assert [row["frame"] for row in rows(tmp_path / "one.csv")] == ["3", "4", "5", "6", "7"]
    words = ["--box", f"4:{OTHER}", "--box", f"3:{FIRST}", "--csv", str(tmp_path / "two.csv")]
    assert run(capsys, str(images), *words)[0] == 0
    found = [(row["frame"], row["id"]) for row in rows(tmp_path / "two.csv")]
    assert found[:4] == [("3", "1"), ("4", "1"), ("4", "2"), ("5", "1")]


def test_a_box_of_a_frame_that_never_comes(
    images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that in a video, whose length isn't known before, the other targets are tracked, whole, and
    that the exit code tells of this one.
    """
    with OverlayWriter(tmp_path / "v.avi", 10.0) as writer:
        for path in sorted(images.iterdir()):
            writer.write(cv2.imread(str(path)))  # type: ignore[arg-type]
    words = ["--box", FIRST, "--box", f"8:{OTHER}", "--csv", str(tmp_path / "o.csv")]
    code, printed, error = run(capsys, str(writer.path), *words)
    assert (code, error) == (2, "tricue track: --box 8:...: expected a frame from 0 to 7\n")
    assert any(line.startswith("wrote") for line in printed)
    assert [row["frame"] for row in rows(tmp_path / "o.csv")] == [str(number) for number in range(8)]


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["--box", f"2:{FIRST}", "--start", "3"], "--box 2:...: expected a frame from --start to --end"),
        (["--box", FIRST, "--start", "3", "--end", "2"], "--end 2: expected 3, of --start, or more"),
        (["--box", FIRST, "--start", "99"], "frame 99: expected a frame to start in; img has 8"),
    ],
)
def test_frames_that_are_not_there(
    images: Path, words: list[str], error: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a start that can't be is told in a line."""
    assert run(capsys, str(images), *words) == (2, [], f"tricue track: {error}\n")


def test_true_boxes_count_from_the_start(
    images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a recording with true boxes starts on that of --start, and is scored from there on."""
    place = tmp_path / "walk"
    (place / "img").mkdir(parents=True)
    for path in images.iterdir():
        (place / "img" / path.name).symlink_to(path)
    boxes = [f"{21 - index},21,24,32\n" for index in range(8)]
    (place / "groundtruth_rect.txt").write_text("".join(boxes))
    code, printed, _ = run(capsys, str(place), "--start", "3")
    assert code == 0
    assert printed[-2].endswith("precision at 20 px 1.000")
    assert printed[-1].startswith(
        "30 frames/s assumed, as the images have no times; give another rate with --fps N"
    )
    assert "5 frames, 5 tracked" in printed[0]


def test_lost_ranges_are_told(
    images: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that where a target is lost is printed, and stands in the JSON."""
    for index in range(6):
        shade = 0 if index in (2, 3) else 200
        cv2.imwrite(str(tmp_path / f"{index}.png"), np.full((48, 64, 3), shade, np.uint8))
    words = [
        "--tracker",
        drift_tracker,
        "--box",
        "1,2,30,30",
        "--fps",
        "10",
        "--json",
        str(tmp_path / "o.json"),
    ]
    code, printed, _ = run(capsys, str(tmp_path), *words)
    assert (code, printed[1]) == (0, "lost in frames 2-3 (0:00.20-0:00.30)")
    lost = json.loads((tmp_path / "o.json").read_text())["lost"]
    assert lost == [{"first": 2, "last": 3, "start_s": 0.2, "end_s": 0.3}]


def test_boxes_from_the_browser(
    images: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --select starts on what was drawn, and that nothing drawn is told."""
    drawn = [(3, Box(17, 20, 24, 32))]
    monkeypatch.setattr(tricue.app, "select_boxes", lambda place, **_: drawn)
    words = [str(images), "--select", "--csv", str(tmp_path / "o.csv")]
    assert run(capsys, *words)[0] == 0
    with (tmp_path / "o.csv").open() as file:
        assert next(csv.DictReader(file))["frame"] == "3"
    drawn.clear()
    assert run(capsys, *words) == (2, [], "tricue track: --select: expected a box, none was drawn\n")


def test_the_browser_shows_the_frames_that_are_tracked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It proves that --select numbers the frames of a target, which KITTI labels in some of them only."""
    folder, seen = kitti(tmp_path / "kitti"), []

    def select(place: str, **opening: Any) -> list[tuple[int, Box]]:
        seen.append(open_source(place, **opening).length)
        return []

    monkeypatch.setattr(tricue.app, "select_boxes", select)
    assert main(["track", str(folder), "--target", "Van 3", "--select"]) == 2
    assert seen == [open_source(folder, target="Van 3").length] == [2]


def test_no_boxes_are_drawn_in_images_that_will_be_rectified(
    images: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --select refuses --rectify, after which the boxes would be in other pixels."""
    monkeypatch.setattr(tricue.app, "select_boxes", lambda place, **_: [(0, Box(17, 20, 24, 32))])
    words = [str(images), "--right", str(images), "--select", "--rectify", "--calibration", "raw.yml"]
    code, _, error = run(capsys, *words)
    assert (code, error[:56]) == (2, "tricue track: --select: expected without --rectify, as t")


def test_no_boxes_of_depth_are_drawn_in_color(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --select refuses a tracker of depth alone where depth has other pixels than color."""
    color_folder(tmp_path / "color", 2)
    depth_folder(tmp_path / "depth", [1000, 1000])
    monkeypatch.setattr(tricue.app, "select_boxes", lambda place, **_: [(0, Box(10, 8, 12, 16))])
    words = [str(tmp_path), "--depth-scale", "0.001", "--tracker", "depth-particle", "--select"]
    code, _, error = run(capsys, *words)
    assert (code, error[:56]) == (2, "tricue track: --select: depth-particle takes boxes in de")


def test_json_lines_for_other_programs(
    images: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that --json - writes an object a line and nothing else, and the report beside it."""
    words = [str(images), "--tracker", drift_tracker, "--box", FIRST, "--json", "-"]
    code, printed, err = run(capsys, *words)
    found = [json.loads(line) for line in printed]
    assert (code, [each["frame"] for each in found]) == (0, list(range(8)))
    assert found[2]["x"] == pytest.approx(found[0]["x"] + 2)
    assert "img: 8 frames" in err
    assert "wrote" not in err


def test_the_trail_is_drawn(images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that --trail draws where the target came from into the overlay, and nothing without it."""
    pictures = []
    for words in ([], ["--trail"], ["--trail", "0.05"]):
        output = tmp_path / f"{len(pictures)}.avi"
        assert run(capsys, str(images), "--box", "20,20,24,32", "--output", str(output), *words)[0] == 0
        capture, last = cv2.VideoCapture(str(output)), None
        while (frame := capture.read()[1]) is not None:
            last = frame.astype(int)
        pictures.append(last)
    changed = [np.abs(picture - pictures[0])[80:].sum(2) > 90 for picture in pictures[1:]]  # below the text
    assert changed[0].sum() > 2 * changed[1].sum() > 0


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["--trail"], "--trail: expected with --output, into which it is drawn"),
        (["--output", "o.mp4", "--trail", "-1"], "argument --trail: expected seconds above 0, got '-1'"),
    ],
)
def test_a_trail_that_cannot_be(
    images: Path, words: list[str], error: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a trail without a video, or of no time, is told in a line."""
    try:
        code = main(["track", str(images), "--box", FIRST, *words])
    except SystemExit as ended:
        code = int(str(ended.code))
    assert code == 2
    assert error in capsys.readouterr().err


@pytest.mark.parametrize("boxes", [[FIRST], [FIRST, OTHER]])
def test_an_image_of_another_size(
    images: Path, boxes: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an image of another size is named with both sizes, whatever the number of its frame."""
    for path in images.iterdir():
        image = cv2.imread(str(path))
        large = path.name == "6.png"
        cv2.imwrite(str(tmp_path / path.name), cv2.resize(image, (200, 150)) if large else image)
    words = ["--start", "3", *(word for box in boxes for word in ("--box", box))]
    code, _, err = run(capsys, str(tmp_path), *words, "--csv", str(tmp_path / "o.csv"))
    assert code == 2
    assert err.splitlines()[-1] == (
        f"tricue track: {tmp_path / '6.png'}: expected the first frame's size, 160x120, got 200x150 px; "
        "all images must have the same"
    )
    assert rows(tmp_path / "o.csv")[-1]["frame"] == "5"
