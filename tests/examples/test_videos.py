# SPDX-License-Identifier: MIT
"""The examples that take videos: several targets, a folder of them, an alarm."""

import csv
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import cv2
import pytest
import tricue
from tricue import Box, Frame, open_source
from tricue.data.source import Source
from tricue.doctor.install import install_extra
from tricue.draw import OverlayWriter
from tricue.scenes import Scene

EXAMPLES = Path(__file__).parents[2] / "examples"
Program = Callable[[str], ModuleType]


def test_several_targets_and_their_overlay(
    face_video: Path, face_box: str, tmp_path: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that all boxes are followed, and that the overlay has every frame."""
    output = tmp_path / "overlay.avi"
    boxes = ["--box", face_box, "--box", "10,10,60,60"]
    program("webcam_targets").main([str(face_video), *boxes, "--output", str(output), "--no-window"])
    out = capsys.readouterr().out
    assert "1: tracked at the end" in out
    assert "2: " in out
    assert sum(1 for _ in open_source(output)) == 25


def test_boxes_are_drawn_where_there_is_a_window(
    face_video: Path, face: Scene, program: Program, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    """It proves that the boxes drawn with the mouse are those that are followed, until q is pressed."""
    module = program("webcam_targets")
    shown: list[Any] = []
    monkeypatch.setattr(cv2, "namedWindow", lambda title: None)
    monkeypatch.setattr(cv2, "selectROIs", lambda title, image: [[round(n) for n in face.boxes[0]]])
    monkeypatch.setattr(cv2, "imshow", lambda title, image: shown.append(image))
    monkeypatch.setattr(cv2, "waitKey", lambda wait: ord("q") if len(shown) == 10 else -1)
    module.main([str(face_video)])
    assert len(shown) == 10
    assert capsys.readouterr().out.startswith("1: tracked")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [([], "give --box"), (["--box", "a"], "'a'"), (["--box", "1,2,3"], "four numbers")],
)
def test_a_wrong_box_is_one_line(
    arguments: list[str], message: str, face_video: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a missing or wrong box is told, with exit code 2."""
    with pytest.raises(SystemExit) as stop:
        program("webcam_targets").main([str(face_video), "--no-window", *arguments])
    assert stop.value.code == 2
    assert message in capsys.readouterr().err.splitlines()[-1]


def test_a_folder_of_videos(face_video: Path, face_box: str, tmp_path: Path) -> None:
    """It proves that each video gets its CSV, and that one that can't be read leaves the others."""
    folder, output = tmp_path / "videos", tmp_path / "tracks"
    folder.mkdir()
    for name in ("a.avi", "b.avi"):
        (folder / name).write_bytes(face_video.read_bytes())
    (folder / "broken.mp4").write_bytes(b"no video")
    (tmp_path / "boxes.csv").write_text(f"a.avi,{face_box}\nb.avi,{face_box}\n")
    program = EXAMPLES / "batch_folder.py"
    command = [sys.executable, program, folder, "--boxes", tmp_path / "boxes.csv", "--output", output]
    told = subprocess.run([*command, "--jobs", "1"], capture_output=True, text=True, check=False)
    assert told.returncode == 1
    assert "a.avi: 25 frames, 25 tracked, 0 occluded, 0 lost" in told.stdout
    assert "2 of 3 videos" in told.stdout
    assert "broken.mp4: " in told.stderr
    assert "Traceback" not in told.stderr
    assert not (output / "broken.csv").exists()
    with (output / "b.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 25
    assert rows[-1]["status"] == "tracked"


def test_an_overlay_over_its_video(
    face_video: Path, face_box: str, tmp_path: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the video that is read stays as it was."""
    video = tmp_path / "holiday.avi"
    video.write_bytes(face_video.read_bytes())
    options = ["--box", face_box, "--output", str(video), "--no-window"]
    with pytest.raises(SystemExit) as stop:
        program("webcam_targets").main([str(video), *options])
    assert stop.value.code == 2
    assert "holiday.avi: expected a file to write to that isn't read" in capsys.readouterr().err
    assert video.read_bytes() == face_video.read_bytes()


@pytest.mark.parametrize(
    ("names", "table", "output", "message"),
    [
        (["a.avi"], "a.mp4,1,2,30,40\n", "tracks", "has no a.mp4"),
        (["a.avi", "a.mp4"], "", "tracks", "a.avi and a.mp4 would have the same CSV"),
        (["a.avi"], "", "videos", "--output: expected another folder"),
        ([], "", "tracks", "videos: no videos"),
        (["._a.mp4"], "", "tracks", "videos: no videos"),
    ],
)
def test_a_folder_that_would_give_wrong_tables(
    names: list[str],
    table: str,
    output: str,
    message: str,
    tmp_path: Path,
    program: Program,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It proves that a box without its video, tables over one another, over those beside the videos, and no
    videos at all are told before anything is written.
    """
    (tmp_path / "videos").mkdir()
    for name in names:
        (tmp_path / "videos" / name).touch()
    (tmp_path / "boxes.csv").write_text(table)
    options = ["--boxes", str(tmp_path / "boxes.csv"), "--output", str(tmp_path / output)]
    with pytest.raises(SystemExit) as stop:
        program("batch_folder").main([str(tmp_path / "videos"), *options])
    assert stop.value.code == 2
    assert message in capsys.readouterr().err.splitlines()[-1]
    assert not (tmp_path / "tracks").exists()


def test_a_video_that_cannot_start(face_video: Path, tmp_path: Path) -> None:
    """It proves that an earlier run's table stays, and that the line says where a box is looked for."""
    folder, output = tmp_path / "videos", tmp_path / "tracks"
    folder.mkdir()
    output.mkdir()
    (folder / "a.avi").write_bytes(face_video.read_bytes())
    (output / "a.csv").write_text("earlier")
    command = [sys.executable, EXAMPLES / "batch_folder.py", folder, "--output", output, "--jobs", "1"]
    told = subprocess.run(command, capture_output=True, text=True, check=False)
    assert told.returncode == 1
    assert "a.avi: no box; give it a line in --boxes, or a.csv beside it" in told.stderr
    assert (output / "a.csv").read_text() == "earlier"


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="a terminal's Ctrl-C goes to a group of processes")
def test_ctrl_c_in_a_folder(face: Scene, face_video: Path, face_box: str, tmp_path: Path) -> None:
    """It proves that Ctrl-C ends all processes, without a traceback and without half a table."""
    folder, output = tmp_path / "videos", tmp_path / "tracks"
    folder.mkdir()
    (folder / "a.avi").write_bytes(face_video.read_bytes())
    with OverlayWriter(folder / "long.avi", 30) as writer:
        for number in range(1500):
            image = face.frames[number % len(face.frames)].color
            assert image is not None
            writer.write(image)
    (tmp_path / "boxes.csv").write_text(f"a.avi,{face_box}\nlong.avi,{face_box}\n")
    options = ["--boxes", tmp_path / "boxes.csv", "--output", output, "--jobs", "1"]
    command = [sys.executable, "-u", EXAMPLES / "batch_folder.py", folder, *options]
    # Python doesn't hear Ctrl-C where its parent ignores it, as what a shell runs in the background does.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    started = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )
    signal.signal(signal.SIGINT, before)
    with started as running:
        assert running.stdout is not None
        assert running.stdout.readline().startswith("a.avi: 25 frames")
        os.killpg(running.pid, signal.SIGINT)
        out, err = running.communicate(timeout=60)
    assert (out, err, running.returncode) == ("ended\n", "", 130)
    assert [path.name for path in output.iterdir()] == ["a.csv"]


@pytest.mark.parametrize("line", ["a.avi,1,2,3", "a.avi,1,2,x,4", "a.avi"])
def test_a_table_without_a_box(
    tmp_path: Path, line: str, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the table's line is named."""
    table = tmp_path / "boxes.csv"
    table.write_text(f"b.avi,1,2,3,4\n{line}\n")
    with pytest.raises(SystemExit) as stop:
        program("batch_folder").main([str(tmp_path), "--boxes", str(table)])
    assert stop.value.code == 2
    assert f"{table}:2: expected name.mp4,x,y,width,height, got '{line}'" in capsys.readouterr().err


def test_a_table_of_a_spreadsheet(tmp_path: Path, program: Program) -> None:
    """Its byte order mark is no part of the first name, and lines without anything are no boxes."""
    (tmp_path / "boxes.csv").write_bytes(b"\xef\xbb\xbfa.mp4,1,2,30,40\r\n\r\nb.mp4,5,6,30,40\r\n\r\n")
    boxes = program("batch_folder").read_boxes(tmp_path / "boxes.csv")
    assert boxes == {"a.mp4": [1, 2, 30, 40], "b.mp4": [5, 6, 30, 40]}


@pytest.mark.parametrize("name", ["gate_alarm", "webcam_targets"])
def test_a_camera_without_its_package_is_one_line(
    name: str, program: Program, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What has to be installed is told, with exit code 2."""
    monkeypatch.setitem(sys.modules, "pyrealsense2", None)
    region = ["--region", "1,1,20,20"] if name == "gate_alarm" else []
    with pytest.raises(SystemExit) as stop:
        program(name).main(["realsense:", "--box", "1,2,30,40", *region])
    assert stop.value.code == 2
    assert install_extra("realsense") in capsys.readouterr().err


def test_the_alarm(
    face_video: Path, face: Scene, face_box: str, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the alarm comes in the frame in which the target's center leaves the region."""
    centers = [box.center for box in face.boxes]
    far = max(range(25), key=lambda index: abs(centers[index][0] - centers[0][0]))
    half = abs(centers[far][0] - centers[0][0]) / 2
    region = Box(centers[0][0] - half, -500, 2 * half, 2000)
    left = next(index for index, center in enumerate(centers) if not region.contains(*center))
    arguments = [str(face_video), "--box", face_box, f"--region={','.join(map(str, region))}"]
    assert program("gate_alarm").main(arguments) == 1
    first = capsys.readouterr().out.splitlines()[0]
    assert first.endswith("ALARM: target 1 has left the region")
    assert float(first.split()[0]) == pytest.approx(left / 30, abs=1.5 / 30)


def test_no_alarm_where_nothing_happens(
    face_video: Path, face_box: str, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a target that stays inside raises none."""
    arguments = [str(face_video), "--box", face_box, "--region=-500,-500,2000,2000"]
    assert program("gate_alarm").main(arguments) == 0
    assert capsys.readouterr().out == "0 alarms\n"


def test_ctrl_c_at_the_gate(
    face: Scene,
    face_box: str,
    program: Program,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It proves that Ctrl-C, the only end that a camera has, still tells the alarms."""

    class Interrupted(Source):
        def __iter__(self) -> Iterator[Frame]:
            yield from face.frames[:5]
            raise KeyboardInterrupt

    stream = SimpleNamespace(timed=True, fps=30, length=None)
    source = Interrupted("gate", {"color": stream})  # type: ignore[dict-item]
    monkeypatch.setattr(tricue, "open_source", lambda place: source)
    assert program("gate_alarm").main(["0", "--box", face_box, "--region=-500,-500,2000,2000"]) == 0
    assert capsys.readouterr().out == "0 alarms\n"


def test_the_alarm_of_a_lost_target(
    face: Scene, face_box: str, tmp_path: Path, program: Program, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a target that disappears raises one."""
    video = tmp_path / "gone.avi"
    writer = cv2.VideoWriter(str(video), cv2.VideoWriter.fourcc(*"MJPG"), 30, (320, 240))
    for index in range(20):
        image = face.frames[min(index, 7)].color
        assert image is not None
        writer.write(image if index < 8 else image * 0)
    writer.release()
    arguments = [str(video), "--box", face_box, "--region=-500,-500,2000,2000"]
    assert program("gate_alarm").main(arguments) == 1
    assert "ALARM: target 1 is lost" in capsys.readouterr().out


def test_the_alarm_of_a_camera_that_stops(
    face: Scene,
    face_box: str,
    program: Program,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """While the loop waits for an image, one alarm comes, and none after the end."""

    class Stopped(Source):
        def __iter__(self) -> Iterator[Frame]:
            yield from face.frames[:5]
            time.sleep(1.0)
            yield face.frames[5]

    stream = SimpleNamespace(timed=True, fps=30, length=None)
    source = Stopped("gate", {"color": stream})  # type: ignore[dict-item]
    monkeypatch.setattr(tricue, "open_source", lambda place: source)
    gate = program("gate_alarm")
    monkeypatch.setattr(gate, "MAX_SILENCE", 0.5)
    assert gate.main(["0", "--box", face_box, "--region=-500,-500,2000,2000"]) == 1
    time.sleep(0.7)
    assert capsys.readouterr().out.count("ALARM: no images come") == 1
