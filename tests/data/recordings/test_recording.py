# SPDX-License-Identifier: MIT
import re
import tracemalloc
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig, open_source
from tricue.cli.program import main

from tests.data.recordings.recording_files import (
    COLOR,
    DEPTH,
    WRITERS,
    Writer,
    bag1,
    blues,
    mcap,
    meters,
    ros2_mcap,
    sqlite,
)
from tests.data.recordings.written import (
    SECOND,
    START,
    color,
    depth,
    info,
    raw,
    transform,
    walk,
)


@pytest.mark.parametrize("write", WRITERS)
def test_color_and_depth(tmp_path: Path, write: Writer) -> None:
    """It proves that every format gives the same frames: images, meters, times, and the camera."""
    source = open_source(write(tmp_path, walk(5, lag=SECOND // 100)))
    frames = list(source)
    assert [frame.channels for frame in frames] == [("color", "depth")] * 5
    assert blues(source) == [10, 20, 30, 40, 50]
    assert meters(source) == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
    assert [frame.timestamp for frame in frames] == pytest.approx(
        [1.7e9 + index / 30 for index in range(5)], abs=1e-6
    )
    assert np.isnan(frames[0].depth[0, 0])  # type: ignore[index]
    assert source.fps == pytest.approx(30)
    assert source.camera == Intrinsics(30, 30, 15.5, 11.5, 32, 24)
    assert source.notes == (f"topics chosen: color={COLOR}, depth={DEPTH}",)
    assert source.remarks == ()
    assert [frame.timestamp for frame in source.frames([1, 3])] == [frames[1].timestamp, frames[3].timestamp]


def test_bag_time_where_the_header_has_none(tmp_path: Path) -> None:
    """It proves that a header's time counts, and the time of recording where that is 0."""
    late = 5 * SECOND
    stamped = [
        raw("/a", START + index, color(1), "bgr8", recorded=START + index + late) for index in range(2)
    ]
    bare = [each._replace(fields=each.fields | {"header": {"stamp": 0, "frame_id": ""}}) for each in stamped]
    for sent, seconds in ((stamped, 1.7e9), (bare, 1.7e9 + 5)):
        folder = tmp_path / str(seconds)
        folder.mkdir()
        assert next(iter(open_source(mcap(folder, sent)))).timestamp == pytest.approx(seconds, abs=1e-6)


def test_unpaired_images_are_counted(tmp_path: Path) -> None:
    """It proves that frames without depth are left out, and that this is told after reading."""
    sent = [each for each in walk(9) if each.topic != DEPTH or (each.time - START) // (SECOND // 30) % 3]
    source = open_source(mcap(tmp_path, sent))
    assert blues(source) == [20, 30, 50, 60, 80, 90]
    assert source.remarks == ("left out 3 of 9 color images, with no depth image within 16.7 ms",)


def test_images_that_never_meet(tmp_path: Path) -> None:
    """It proves that color and depth of two clocks are an error that says how to read one of them."""
    source = open_source(mcap(tmp_path, walk(4, lag=SECOND)))
    with pytest.raises(
        ValueError, match=re.escape(f"found none; topics={ {'color': COLOR} } reads one alone")
    ):
        list(source)


def test_a_clock_that_was_set_back(tmp_path: Path) -> None:
    """It proves that frames whose times are before the previous one's are told after reading, and kept."""
    sent = walk(9)
    for index, each in enumerate(sent):
        if "header" in each.fields and each.time - START > SECOND // 9:
            stamp = each.fields["header"]["stamp"] - 5 * SECOND
            sent[index] = each._replace(
                fields=each.fields | {"header": each.fields["header"] | {"stamp": stamp}}
            )
    source = open_source(mcap(tmp_path, sent))
    assert source.remarks == ()
    assert blues(source) == [10 * number for number in range(1, 10)]
    (remark,) = source.remarks
    assert remark.startswith("the time goes back in frame 4, as if the clock had been set back")


def test_chosen_topics(tmp_path: Path) -> None:
    """It proves that topics by channel are taken as they are said, without a note."""
    path = bag1(tmp_path, walk())
    source = open_source(path, topics={"depth": DEPTH})
    assert (list(source.channels), source.notes) == (["depth"], ())
    assert meters(source) == pytest.approx([1.0, 1.1, 1.2, 1.3, 1.4])
    assert meters(open_source(path, topics={"depth": DEPTH}, depth_scale=0.0001))[0] == pytest.approx(0.1)
    with pytest.raises(ValueError, match=r"expected depth images where depth_scale is given"):
        open_source(path, topics={"color": COLOR}, depth_scale=0.001)


@pytest.mark.parametrize(
    ("topics", "message"),
    [
        ({"color": "/nowhere"}, f"expected one of the images {COLOR}, {DEPTH}, got /nowhere, which isn't"),
        (
            {"color": "/camera/color/camera_info"},
            "got /camera/color/camera_info, of the type sensor_msgs/msg/CameraInfo",
        ),
        (
            {"infrared": COLOR},
            f"topics={ {'infrared': COLOR} }: expected color, depth, or right beside color",
        ),
        ({"right": COLOR}, "expected color, depth, or right beside color"),
        ({"depth": COLOR}, f"the encoding 'bgr8' isn't one of depth; got depth={COLOR}, choose others"),
    ],
)
def test_wrong_topics(tmp_path: Path, topics: dict[str, str], message: str) -> None:
    """It proves that a topic that isn't there, or holds something else, is an error with its name."""
    with pytest.raises(ValueError, match=message):
        open_source(mcap(tmp_path, walk()), topics=topics)


def test_topics_without_a_recording(tmp_path: Path) -> None:
    """It proves that topics of a folder of images are refused."""
    with pytest.raises(ValueError, match=r"^topics: expected with a recording"):
        open_source(tmp_path, topics={"color": "/a"})


def test_depth_is_registered_by_transforms(tmp_path: Path) -> None:
    """It proves that depth of another camera is brought into color's pixels by /tf_static: a wall at 2 m,
    half as large in a camera of half the focal length that stands 0.4 m to the left, ends where it has to.
    """
    time, wall = START, np.full((24, 32), 2000, np.uint16)
    wall[:, 20:] = 0
    sent = [
        transform(time, "color", "depth", (-0.4, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)),
        info("/color/camera_info", time, (64, 48), 60.0, frame="color"),
        info("/depth/camera_info", time, (32, 24), 30.0, frame="depth"),
        raw("/color/image_raw", time, color(9, (64, 48)), "bgr8", frame="color"),
        raw("/depth/image_rect_raw", time, wall, "16UC1", frame="depth"),
    ]
    source = open_source(bag1(tmp_path, sent))
    (frame,) = source
    assert frame.depth is not None
    assert frame.depth.shape == (48, 64)
    assert source.size == (64, 48)
    assert source.camera == Intrinsics(60, 60, 31.5, 23.5, 64, 48)
    # the last column's far edge is 4 px right of the middle: 0.267 m, less 0.4 m, times 60 / 2 m
    assert np.isfinite(frame.depth[:, :28]).all()
    assert np.isnan(frame.depth[:, 28:]).all()
    assert np.nanmax(np.abs(frame.depth - 2.0)) < 1e-6
    assert "400.0 mm beside it" in source.notes[-1]


def test_a_stereo_pair(tmp_path: Path) -> None:
    """It proves that left and right are found, with the baseline of the right camera's P."""
    size, sent = (32, 24), []
    p = [30.0, 0, 15.5, -3.75, 0, 30.0, 11.5, 0, 0, 0, 1, 0]
    for index in range(3):
        time = START + index * SECOND // 20
        for side, other in (("left", {}), ("right", {"p": p})):
            level = 10 * index + (side == "right") * 100
            sent.append(info(f"/stereo/{side}/camera_info", time, size, 30.0, **other))
            sent.append(raw(f"/stereo/{side}/image_rect", time, color(level)[..., 0], "mono8"))
    source = open_source(ros2_mcap(tmp_path, sent))
    pairs = [(int(frame.color[0, 0, 0]), int(frame.right[0, 0, 0])) for frame in source]  # type: ignore[index]
    assert pairs == [(0, 100), (10, 110), (20, 120)]
    assert source.camera == StereoRig(Intrinsics(30, 30, 15.5, 11.5, 32, 24), 0.125)
    topics = {"color": "/stereo/right/image_rect", "right": "/stereo/left/image_rect"}
    swapped = open_source(tmp_path / "c", topics=topics)
    assert not isinstance(swapped.camera, StereoRig)
    right_way = {"color": "/stereo/left/image_rect", "right": "/stereo/right/image_rect"}
    assert swapped.notes[-1].endswith(f"swap the two cameras: topics={right_way}")


@pytest.mark.parametrize("baseline", [0.0001, 120.0])
def test_an_implausible_baseline_is_told_once(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], baseline: float
) -> None:
    """It proves that tricue info doubts the unit of a recording's own baseline, as it does a file's."""
    p = [30.0, 0, 15.5, -30 * baseline, 0, 30, 11.5, 0, 0, 0, 1, 0]
    sent = [
        each
        for side, other in (("left", {}), ("right", {"p": p}))
        for each in (
            info(f"/{side}/camera_info", START, (32, 24), 30.0, **other),
            raw(f"/{side}/image_rect", START, color(1), "bgr8"),
        )
    ]
    assert main(["info", str(mcap(tmp_path, sent))]) == 0
    out, error = capsys.readouterr()
    assert f"  warning      a baseline of {baseline:.4g} m is implausible" in out
    assert error == ""


def test_a_folder_of_images_beside_its_bag(tmp_path: Path) -> None:
    """It proves that images that were taken out of a bag are read, not the bag beside them."""
    (tmp_path / "rgb").mkdir()
    cv2.imwrite(str(tmp_path / "rgb" / "1.png"), color(3))
    bag1(tmp_path, walk())
    assert open_source(tmp_path).format == "images"


def test_memory_stays_flat(tmp_path: Path) -> None:
    """It proves that a recording of ten times the length needs no more memory while it's read."""
    peaks = []
    for count in (20, 200):
        folder = tmp_path / str(count)
        folder.mkdir()
        peaks.append([])
        for write in (bag1, sqlite, mcap):
            source = open_source(write(folder, walk(count, size=(160, 120))))
            tracemalloc.start()
            for frame in source:
                assert frame.color is not None
            peaks[-1].append(tracemalloc.get_traced_memory()[1])
            tracemalloc.stop()
    for short, long in zip(*peaks, strict=True):
        assert long < 1.5 * short + 1e6


def test_info_shows_topics(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves what tricue info says of a recording."""
    assert main(["info", str(bag1(tmp_path, walk()))]) == 0
    said = capsys.readouterr().out
    for line in (
        "a: ROS 1 bag",
        "  frames       5, 30 a second, 0.13 s",
        "  depth        32x24, float32",
        "               0.001 m per unit, by ROS's format",
        "               1.000 m to 1.400 m, 5th to 95th percentile; 0.1 % invalid pixels; of all frames",
        "  calibration  the recording's own",
        "               fx 30.00, fy 30.00, cx 15.50, cy 11.50 px",
        f"  topic        {COLOR}, sensor_msgs/msg/Image, 5 messages, as color",
        "  topic        /camera/color/camera_info, sensor_msgs/msg/CameraInfo, 5 messages",
    ):
        assert line in said.splitlines()


def test_the_duration_of_a_recording_with_a_gap(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that tricue info adds the time in which nothing was recorded."""
    sent = [raw("/a", START + index * SECOND // 10, color(1), "bgr8") for index in (*range(20), 100)]
    assert main(["info", str(mcap(tmp_path, sent))]) == 0
    assert "  frames       21, 10 a second, 10.00 s" in capsys.readouterr().out.splitlines()


def test_tracking_in_a_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that tricue track reads a recording with its own camera, and tells what was left out."""
    rng = np.random.default_rng(0)
    background, target = rng.integers(0, 90, (96, 128, 3)), rng.integers(90, 255, (24, 24, 3))
    sent = []
    for index in range(8):
        image = background.astype(np.uint8)
        image[30:54, 40 + index : 64 + index] = target
        time = START + index * SECOND // 30
        sent.append(raw("/color/image_raw", time, image, "bgr8"))
        sent.append(info("/color/camera_info", time, (128, 96), 100.0))
        if index != 5:
            sent.append(raw("/depth/image_raw", time, depth(1500, (128, 96)), "16UC1"))
            sent.append(info("/depth/camera_info", time, (128, 96), 100.0))
    csv = tmp_path / "track.csv"
    path = str(mcap(tmp_path, sent))
    topics = "color=/color/image_raw,depth=/depth/image_raw"
    assert main(["track", path, "--topics", topics, "--box", "40,30,24,24", "--csv", str(csv)]) == 0
    said = capsys.readouterr()
    assert said.err == ""
    assert "7 frames, 7 tracked" in said.out
    assert "left out 1 of 8 color images, with no depth image within 16.7 ms" in said.out
    assert "calibration: the recording's or the camera's own" in said.out
    assert len(csv.read_text().splitlines()) == 8


def test_true_boxes_beside_a_recording(tmp_path: Path) -> None:
    """It proves that a table of boxes with the recording's name is its truth."""
    path = mcap(tmp_path, walk(2))
    path.with_suffix(".csv").write_text("frame,x,y,width,height\n0,1,2,3,4\n")
    source = open_source(path)
    assert source.first_box == (1, 2, 3, 4)
    assert source.notes[-1].startswith("true boxes found")


def test_color_that_begins_late(tmp_path: Path) -> None:
    """It proves that a topic that begins late is told to be left out, and is read if it is named."""
    sent = [each for each in walk(100) if each.topic != COLOR or each.time > START + 3 * SECOND]
    path = mcap(tmp_path, sent)
    assert open_source(path).notes[0] == (
        f"topics chosen: depth={DEPTH}; left out {COLOR} (it has no image at the beginning); "
        "topics= chooses others"
    )
    named = open_source(path, topics={"color": COLOR, "depth": DEPTH})
    assert [frame.channels for frame in named] == [("color", "depth")] * 9


@pytest.mark.parametrize("write", WRITERS)
def test_cameras_that_come_late(tmp_path: Path, write: Writer) -> None:
    """It proves that a camera_info and a transform that are recorded seconds after the images are found."""
    sent = [each for each in walk(150) if "camera_info" not in each.topic]
    for index, each in enumerate(sent):
        if each.topic == DEPTH:
            sent[index] = raw(DEPTH, each.time, depth(1000), "16UC1", frame="depth camera")
    later = START + 4 * SECOND
    sent += [
        info("/camera/color/camera_info", later, (32, 24), 30.0),
        info("/camera/depth/camera_info", later, (32, 24), 20.0, frame="depth camera"),
        transform(later, "camera", "depth camera", [0.05, 0, 0], [0, 0, 0, 1]),
    ]
    source = open_source(write(tmp_path, sorted(sent, key=lambda each: each.time)))
    assert source.camera == Intrinsics(30.0, 30.0, 15.5, 11.5, 32, 24)
    assert any("whose camera is 50.0 mm beside it" in note for note in source.notes)
