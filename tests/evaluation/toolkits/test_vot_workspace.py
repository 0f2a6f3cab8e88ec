# SPDX-License-Identifier: MIT
"""Workspaces as they lie on the disk; test_vot_toolkit.py has the toolkit read them."""

import configparser
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue.data.open_source import open_source
from tricue.evaluation.toolkits.millimeters import to_millimeters
from tricue.evaluation.toolkits.vot_sequences import anchors, vot_channels, write_sequence
from tricue.evaluation.toolkits.vot_workspace import check_python, write_workspace

pytest.importorskip("trax")

FRAMES, HEIGHT, WIDTH = 4, 48, 64
BOXES = np.array([[10.5, 12, 16, 20], [12.25, 12, 16, 20], [np.nan] * 4, [16, 12.125, 16, 20]])


def colors() -> list[NDArray[np.uint8]]:
    """Images of noise, each another."""
    rng = np.random.default_rng(0)
    return [rng.integers(0, 256, (HEIGHT, WIDTH, 3), np.uint8) for _ in range(FRAMES)]


def depths() -> list[NDArray[np.uint16]]:
    """Depth in whole millimeters up to 8 m, some of it not measured."""
    rng = np.random.default_rng(1)
    images = [rng.integers(400, 8000, (HEIGHT, WIDTH)).astype(np.uint16) for _ in range(FRAMES)]
    for image in images:
        image[:5] = 0
    return images


def save(folder: Path, names: list[str], images: list[NDArray[np.uint8]] | list[NDArray[np.uint16]]) -> None:
    """Write images under names."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, image in zip(names, images, strict=True):
        assert cv2.imwrite(str(folder / name), image)


def write_truth(path: Path, boxes: NDArray[np.float64] = BOXES, origin: int = 0) -> None:
    """A line a box, pixels counted from ``origin``."""
    lines = [",".join(map(str, box)) for box in boxes + [origin, origin, 0, 0]]
    path.write_text("\n".join(lines))


def otb(folder: Path, suffix: str = "jpg") -> Path:
    """OTB's layout: color alone."""
    save(folder / "img", [f"{index:04}.{suffix}" for index in range(FRAMES)], colors())
    write_truth(folder / "groundtruth_rect.txt", origin=1)
    return folder


def bitmaps(folder: Path) -> Path:
    """Images that the toolkit doesn't read."""
    return otb(folder, "bmp")


def mixed(folder: Path) -> Path:
    """Images of several kinds, of which the toolkit reads one."""
    save(folder / "img", ["0.jpg", "1.png", "2.jpeg", "3.bmp"], colors())
    write_truth(folder / "groundtruth.txt")
    return folder


def video(folder: Path) -> Path:
    """One video in a folder."""
    folder.mkdir(parents=True)
    writer = cv2.VideoWriter(str(folder / "v.avi"), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (WIDTH, HEIGHT))
    for image in colors():
        writer.write(image)
    writer.release()
    write_truth(folder / "groundtruth.txt")
    return folder


def vot(folder: Path) -> Path:
    """VOT's layout, color and depth in millimeters."""
    names = [f"{number:08}" for number in range(1, FRAMES + 1)]
    save(folder / "color", [f"{name}.jpg" for name in names], colors())
    save(folder / "depth", [f"{name}.png" for name in names], depths())
    write_truth(folder / "groundtruth.txt")
    return folder


def princeton(folder: Path) -> Path:
    """The Princeton benchmark's layout: the bits of the depth are turned by three places."""
    save(folder / "rgb", [f"r-{33333 * index}-{index + 1}.png" for index in range(FRAMES)], colors())
    turned = [np.asarray((image << 3) | (image >> 13), np.uint16) for image in depths()]
    save(folder / "depth", [f"d-{33333 * index}-{index + 1}.png" for index in range(FRAMES)], turned)
    write_truth(folder / f"{folder.name}.txt")
    return folder


def tum(folder: Path) -> Path:
    """TUM's layout: depth in units of 0.2 mm."""
    names = [f"{index}.png" for index in range(FRAMES)]
    save(folder / "rgb", names, colors())
    save(folder / "depth", names, [image * np.uint16(5) for image in depths()])
    for channel in ("rgb", "depth"):
        lines = [f"{index / 20} {channel}/{name}" for index, name in enumerate(names)]
        (folder / f"{channel}.txt").write_text("\n".join(lines))
    return folder


LAYOUTS = {
    "otb": (otb, ".jpg", True),
    "bitmaps": (bitmaps, ".png", False),
    "mixed": (mixed, ".png", False),
    "video": (video, ".png", False),
    "vot": (vot, ".jpg", True),
    "princeton": (princeton, ".png", True),
    "tum": (tum, ".png", True),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_written_sequence_is_the_recording(layout: str, tmp_path: Path) -> None:
    """It proves that color, depth in meters and true boxes of every layout are read from what was written,
    and which images are linked.
    """
    make, suffix, linked = LAYOUTS[layout]
    source = open_source(make(tmp_path / layout))
    if layout == "tum":  # its own groundtruth.txt is the camera's path
        source = type(source)(source.name, source.channels, BOXES)
    assert write_sequence(source, tmp_path / "out") == FRAMES
    written = open_source(tmp_path / "out")
    assert written.truth is not None
    np.testing.assert_allclose(written.truth, BOXES, rtol=0, atol=1e-12)
    for frame, original in zip(written, source, strict=True):
        assert frame.channels == original.channels
        np.testing.assert_array_equal(frame.color, original.color)
        if original.depth is not None:
            np.testing.assert_allclose(frame.depth, original.depth, rtol=0, atol=2e-6)  # float32 of 8 m
    images = sorted((tmp_path / "out" / "color").iterdir())
    assert [path.name for path in images] == [f"{number:08}{suffix}" for number in range(1, FRAMES + 1)]
    assert all(path.is_symlink() is linked for path in images)
    depth = list((tmp_path / "out").glob("depth/*"))
    assert all(path.suffix == ".png" and path.is_symlink() is (layout == "vot") for path in depth)


def test_depth_that_has_no_millimeters_is_not_measured(tmp_path: Path) -> None:
    """It proves that what 16 bits can't hold, too far or too near, becomes 0, and the rest is rounded."""
    meters = np.array([[0.0004, 0.0006, 65.535, 65.536, np.nan, np.inf, 1.2344, -1.0]], np.float32)
    assert to_millimeters(meters).tolist() == [[0, 1, 65535, 0, 0, 0, 1234, 0]]


def test_the_files_of_a_sequence(tmp_path: Path) -> None:
    """It proves the letters that the toolkit reads: properties, nan for absent, tags and anchors."""
    write_sequence(open_source(video(tmp_path / "video")), tmp_path / "out")
    lines = (tmp_path / "out" / "sequence").read_text().splitlines()
    assert lines == [
        *("name=out", "fps=25", "format=default", "channel.default=color"),
        *("width=64", "height=48", "length=4", "channels.color=color/%08d.png"),
    ]
    truth = (tmp_path / "out" / "groundtruth.txt").read_text().splitlines()
    assert truth[0] == "10.5000,12.0000,16.0000,20.0000"
    assert truth[2] == "nan,nan,nan,nan"
    assert (tmp_path / "out" / "absent.tag").read_text() == "0\n0\n1\n0\n"
    assert (tmp_path / "out" / "anchor.value").read_text() == "1\n0\n0\n0\n"


def test_frames_without_truth_are_absent(tmp_path: Path) -> None:
    """It proves that a shorter list of true boxes is filled up, and a longer one cut."""
    folder = otb(tmp_path / "a")
    write_truth(folder / "groundtruth_rect.txt", BOXES[:2], origin=1)
    write_sequence(open_source(folder), tmp_path / "short")
    assert (tmp_path / "short" / "absent.tag").read_text() == "0\n0\n1\n1\n"
    write_truth(folder / "groundtruth_rect.txt", np.concatenate([BOXES, BOXES]), origin=1)
    write_sequence(open_source(folder), tmp_path / "long")
    assert len((tmp_path / "long" / "groundtruth.txt").read_text().splitlines()) == FRAMES


def test_links_that_cannot_be_are_copies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a file system without links gets the same bytes."""

    def refuse(*_: object) -> None:
        raise OSError("no links here")

    monkeypatch.setattr(Path, "symlink_to", refuse)
    folder = otb(tmp_path / "a")
    write_sequence(open_source(folder), tmp_path / "out")
    copy = tmp_path / "out" / "color" / "00000003.jpg"
    assert not copy.is_symlink()
    assert copy.read_bytes() == (folder / "img" / "0002.jpg").read_bytes()


def test_an_error_leaves_no_half_sequence(tmp_path: Path) -> None:
    """It proves that an image that can't be read is an error that names it, and nothing is left behind."""
    folder = bitmaps(tmp_path / "a")
    (folder / "img" / "0002.bmp").write_bytes(b"no picture")
    with pytest.raises(ValueError, match=r"0002\.bmp"):
        write_sequence(open_source(folder), tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_one_frame_is_no_sequence(tmp_path: Path) -> None:
    """It proves that a recording in which nothing can be tracked is refused."""
    save(tmp_path / "a" / "img", ["0.png"], colors()[:1])
    write_truth(tmp_path / "a" / "groundtruth.txt", BOXES[:1])
    with pytest.raises(ValueError, match="expected two frames or more"):
        write_sequence(open_source(tmp_path / "a"), tmp_path / "out")


def test_depth_of_another_size_is_left_out(tmp_path: Path) -> None:
    """It proves that depth which isn't that of the color's pixels doesn't get into the workspace."""
    folder = vot(tmp_path / "a")
    for path in (folder / "depth").iterdir():
        cv2.imwrite(str(path), np.full((24, 32), 2000, np.uint16))
    names, note = vot_channels(open_source(folder))
    assert names == ("color",)
    assert note == "left out the depth of a: it is 32x24 pixels, not the color's 64x48"
    report = write_workspace(tmp_path / "ws", ["color-particle"], [folder])
    assert report.notes == [note]
    assert not (tmp_path / "ws" / "sequences" / "a" / "depth").exists()
    with pytest.raises(ValueError, match=r"has no depth, which flow-depth needs .left out the depth of a"):
        write_workspace(tmp_path / "other", ["flow-depth"], [folder])


@pytest.mark.parametrize(("measured", "kept", "other"), [(True, "depth", "color"), (False, "color", "depth")])
def test_a_channel_that_is_not_registered_to_the_boxes_is_left_out(
    measured: bool, kept: str, other: str, tmp_path: Path
) -> None:
    """It proves that no tracker is judged in one camera's image by boxes of another's: where positions were
    measured the boxes are the depth image's.
    """
    folder = vot(tmp_path / "a")
    camera = f"fx = 50.0\nfy = 50.0\ncx = 31.5\ncy = 23.5\nwidth = {WIDTH}\nheight = {HEIGHT}\n"
    (folder / "intrinsics.toml").write_text(f"[depth]\n{camera}[color]\n{camera.replace('50.0', '55.0')}")
    if measured:
        (folder / "position_z_mm.txt").write_text("2000\n" * FRAMES)
    reason = f"depth isn't registered to color, and the true boxes are those of the {kept} image"
    note = f"left out the {other} of a: {reason}"
    assert vot_channels(open_source(folder)) == ((kept,), note)
    write_sequence(open_source(folder), tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir() if path.is_dir()} == {kept}
    tracker = "color-particle" if other == "color" else "depth-particle"
    with pytest.raises(ValueError, match=f"has no {other}, which {tracker} needs"):
        write_workspace(tmp_path / "ws", [tracker], [folder])


def starts(visible: str) -> dict[int, int]:
    """The anchors of a line of 0 and 1, by frame."""
    values = anchors(np.array([mark == "1" for mark in visible]))
    assert len(values) == len(visible)
    return {frame: value for frame, value in enumerate(values) if value}


def test_anchors_are_visible_and_look_to_the_longer_part() -> None:
    """It proves where multistart runs begin: every 50 frames, where the target is, the long way."""
    assert starts("1" * 40) == {0: 1}
    assert starts("1" * 121) == {0: 1, 50: 1, 100: -1}
    assert starts("1" * 101) == {0: 1, 50: -1, 100: -1}  # as many frames on both sides: backward
    assert starts("1" * 30 + "0" * 40 + "1" * 130) == {0: 1, 70: 1, 100: -1, 150: -1}
    assert starts("1" + "0" * 99) == {0: 1}


def test_a_workspace_is_whole(tmp_path: Path) -> None:
    """It proves that all trackers and sequences are in the files that the toolkit reads."""
    report = write_workspace(
        tmp_path / "ws",
        ["color-particle", "flow-depth"],
        [vot(tmp_path / "in" / "a b"), princeton(tmp_path / "in" / "c")],
    )
    assert (report.sequences, report.added) == (["a_b", "c"], ["a_b", "c"])
    assert (tmp_path / "ws" / "sequences" / "list.txt").read_text() == "a_b\nc\n"
    assert {path.name for path in (tmp_path / "ws").iterdir()} == {
        "config.yaml",
        "stack.yaml",
        "trackers.ini",
        "sequences",
    }
    trackers = configparser.ConfigParser()
    trackers.read(tmp_path / "ws" / "trackers.ini")
    assert trackers.sections() == ["color-particle", "flow-depth"]
    for name in trackers.sections():
        section = trackers[name]
        assert (section["protocol"], section["command"]) == ("traxpython", "tricue.cli.trax")
        assert (section["env_tricue_tracker"], section["python"]) == (name, sys.executable)


def test_a_workspace_grows_and_keeps_what_it_has(tmp_path: Path) -> None:
    """It proves that a second call adds trackers and sequences, and changes neither settings nor results."""
    ws = tmp_path / "ws"
    write_workspace(ws, ["color-particle"], [vot(tmp_path / "in" / "a")])
    with (ws / "trackers.ini").open("a") as file:
        file.write("env_TRICUE_SET = particles=300\n")
    before = {path: path.read_bytes() for path in ws.rglob("*") if path.is_file()}
    report = write_workspace(
        ws, ["color-particle", "depth-particle"], [tmp_path / "in" / "a", vot(tmp_path / "in" / "b")]
    )
    assert (report.sequences, report.added) == (["a", "b"], ["b"])
    assert [note.split(" ")[0] for note in report.notes] == ["left", "kept"]
    trackers = configparser.ConfigParser()
    trackers.read(ws / "trackers.ini")
    assert trackers["color-particle"]["env_tricue_set"] == "particles=300"
    assert trackers["depth-particle"]["env_tricue_tracker"] == "depth-particle"
    changed = {path.name for path, content in before.items() if path.read_bytes() != content}
    assert changed == {"trackers.ini", "list.txt"}
    assert write_workspace(ws, ["flow-depth"]).sequences == ["a", "b"]


def test_true_boxes_that_do_not_fit_are_told(tmp_path: Path) -> None:
    """A sequence that lacks an image between others is left out, and corners in place of sizes are told."""
    gap, corners = otb(tmp_path / "gap"), vot(tmp_path / "corners")
    sorted((gap / "img").iterdir())[1].unlink()
    write_truth(corners / "groundtruth.txt", np.full((FRAMES, 4), [40, 20, 60, 45]))
    report = write_workspace(tmp_path / "ws", ["color-particle"], [gap, corners])
    assert report.sequences == ["corners"]
    left_out, doubt = report.notes
    assert left_out.startswith(
        f"left out {gap}: {gap / 'img'}: expected images 0000 to 0003, one for each of"
    )
    assert doubt.startswith(f"{corners}: {FRAMES} true boxes reach far beyond the image, {WIDTH}x{HEIGHT} px")


def test_what_trackers_cannot_run_on_is_left_out(tmp_path: Path) -> None:
    """It proves that each recording is left out with its reason, not found out by the toolkit's end."""
    color, hidden, bare = otb(tmp_path / "color"), vot(tmp_path / "hidden"), tum(tmp_path / "bare")
    write_truth(hidden / "groundtruth.txt", BOXES[2:])
    (tmp_path / "empty").mkdir()
    places = [color, hidden, bare, tmp_path / "empty", vot(tmp_path / "good")]
    report = write_workspace(tmp_path / "ws", ["flow-depth"], places)
    assert report.sequences == ["good"]
    assert report.notes[-1].startswith(f"left out {tmp_path / 'empty'}: ")
    assert report.notes[:-1] == [
        f"left out {color}: it has no depth, which flow-depth needs",
        f"left out {hidden}: it has no true box in its first frame, on which trackers start",
        f"left out {bare}: it has no true box in its first frame, on which trackers start",
    ]


def test_another_frame_rate_is_told(tmp_path: Path) -> None:
    """It proves that who assumes a frame rate is told of a recording's own, nobody else."""
    slow = vot(tmp_path / "slow")
    lines = ["fps=3", "channels.color=color/%08d.jpg", "channels.depth=depth/%08d.png"]
    (slow / "sequence").write_text("\n".join(lines))
    report = write_workspace(
        tmp_path / "ws", ["color-particle", "depth-particle"], [slow, vot(tmp_path / "any")]
    )
    assert [note.split(";")[0] for note in report.notes] == [
        "slow has 3 frames/s, color-particle assumes 30",
        "slow has 3 frames/s, depth-particle assumes 15",
    ]
    assert all(note.endswith("env_TRICUE_SET = rate=3 in trackers.ini tells it") for note in report.notes)


def test_a_tracker_that_old_sequences_do_not_serve_is_refused(tmp_path: Path) -> None:
    """It proves that a workspace of color alone doesn't get a tracker that would end the evaluation there."""
    write_workspace(tmp_path / "ws", ["color-particle"], [otb(tmp_path / "a")])
    with pytest.raises(ValueError, match="its sequence a has no depth, which flow-depth needs"):
        write_workspace(tmp_path / "ws", ["flow-depth"])
    assert "flow-depth" not in (tmp_path / "ws" / "trackers.ini").read_text()


def test_a_recording_that_cannot_be_written_is_left_out(tmp_path: Path) -> None:
    """It proves that one damaged image or a single frame costs its own sequence alone, which is noted, and
    that a workspace without any sequence is an error.
    """
    damaged, short = bitmaps(tmp_path / "damaged"), otb(tmp_path / "short")
    (damaged / "img" / "0002.bmp").write_bytes(b"no image")
    for path in sorted((short / "img").iterdir())[1:]:
        path.unlink()
    report = write_workspace(tmp_path / "ws", ["color-particle"], [damaged, short, otb(tmp_path / "whole")])
    assert report.sequences == report.added == ["whole"]
    assert [path.name for path in sorted((tmp_path / "ws" / "sequences").iterdir())] == ["list.txt", "whole"]
    first, second = report.notes
    assert first.startswith(f"left out {damaged}: ")
    assert "0002.bmp" in first
    assert second.startswith(f"left out {short}: short: expected two frames or more")
    with pytest.raises(ValueError, match=r"found none; left out .*damaged: .*0002\.bmp"):
        write_workspace(tmp_path / "other", ["color-particle"], [damaged])


@pytest.mark.parametrize("content", [{"notes.txt": "mine"}, {"config.yaml": "stack: vot2022/rgbd\n"}])
def test_a_folder_with_something_else_is_refused(content: dict[str, str], tmp_path: Path) -> None:
    """It proves that nothing is written into a folder that isn't such a workspace."""
    folder = tmp_path / "ws"
    folder.mkdir()
    for name, text in content.items():
        (folder / name).write_text(text)
    with pytest.raises(ValueError, match="expected a new folder, or a workspace that this command wrote"):
        write_workspace(folder, ["color-particle"], [otb(tmp_path / "a")])
    assert {path.name: path.read_text() for path in folder.iterdir()} == content


def test_hopeless_wishes_write_nothing(tmp_path: Path) -> None:
    """It proves that unknown and unfit trackers, no sequences, and a path that the toolkit can't read are
    errors before anything is written.
    """
    place = otb(tmp_path / "a")
    for trackers, message in ((["stereo-head"], "right image"), (["magic"], "expected one of")):
        with pytest.raises(ValueError, match=message):
            write_workspace(tmp_path / "ws", trackers, [place])
    with pytest.raises(
        ValueError, match="recordings: expected one that VOT can start on, found none; left out"
    ):
        write_workspace(tmp_path / "ws", ["depth-particle"], [place])
    with pytest.raises(ValueError, match="expected a path without %"):
        write_workspace(tmp_path / "50%", ["color-particle"], [place])
    assert [path.name for path in tmp_path.iterdir()] == ["a"]


def test_an_interpreter_without_tricue_is_refused(tmp_path: Path) -> None:
    """It proves that the toolkit's "unable to connect" is told beforehand, with what to install."""
    bare = tmp_path / "bare python"
    bare.write_text(f'#!/bin/sh\nexec "{sys.executable}" -S "$@"\n')
    bare.chmod(0o755)
    with pytest.raises(ValueError, match=r"can't run tricue for VOT: .*; pip install tricue\[vot\] there"):
        check_python(str(bare))
    with pytest.raises(ValueError, match="expected an interpreter, found none"):
        check_python(str(tmp_path / "none"))


def test_an_interpreter_s_path_may_have_blanks(tmp_path: Path) -> None:
    """It proves that the path is quoted as the toolkit's splitting wants it."""
    link = tmp_path / "a python"
    link.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n')
    link.chmod(0o755)
    write_workspace(tmp_path / "ws", ["color-particle"], [otb(tmp_path / "a")], str(link))
    assert f"python = '{link}'\n" in (tmp_path / "ws" / "trackers.ini").read_text()
