# SPDX-License-Identifier: MIT
from collections.abc import Callable, Iterable
from pathlib import Path
from time import sleep

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Box, Intrinsics
from tricue.camera.read_calibration import read_intrinsics
from tricue.data.open_source import Source, open_source


def write_depth(path: Path, units: int, size: tuple[int, int] = (40, 30)) -> Path:
    """A 16-bit image, one value all over but for a corner of 0: nothing measured there."""
    image = np.full(size[::-1], units, np.uint16)
    image[0, 0] = 0
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), image)
    return path


def write_color(path: Path, level: int = 90) -> Path:
    """A color image of one level, larger than the depth images."""
    path.parent.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(path), np.full((48, 64, 3), level, np.uint8))
    return path


def depth_folder(folder: Path, values: Iterable[int]) -> Path:
    """A folder of 16-bit images 1.png, 2.png, ..."""
    for index, units in enumerate(values, 1):
        write_depth(folder / f"{index}.png", units)
    return folder


def color_folder(folder: Path, count: int) -> Path:
    """A folder of color images of the levels 10, 20, ..."""
    for index in range(1, count + 1):
        write_color(folder / f"{index}.png", 10 * index)
    return folder


def meters(source: Source) -> list[float]:
    """The depth in the middle of each frame."""
    return [float(frame.depth[15, 20]) for frame in source if frame.depth is not None]


def levels(source: Source) -> list[int]:
    """The mean level of each frame's color."""
    return [round(float(frame.color.mean())) for frame in source if frame.color is not None]


def test_a_folder_of_depth_alone(tmp_path: Path) -> None:
    """It proves that 16-bit images come as meters by the scale, NaN where they are 0, without color."""
    source = open_source(depth_folder(tmp_path / "walk", [1000, 2500]), depth_scale=0.001)
    assert (source.name, source.length, source.size) == ("walk", 2, (40, 30))
    first, second = source
    assert first.channels == second.channels == ("depth",)
    assert first.depth is not None
    assert first.depth.dtype == np.float32
    assert np.isnan(first.depth[0, 0])
    assert np.isnan(first.depth).sum() == 1
    assert meters(source) == pytest.approx([1.0, 2.5])


def test_a_real_unit_is_kept(tmp_path: Path) -> None:
    """It proves that the scale is what the meters are computed with, to float32's last bit."""
    source = open_source(depth_folder(tmp_path, [54321]), depth_scale=0.00025)
    assert meters(source) == [float(np.float32(54321) * np.float32(0.00025))]


@pytest.mark.parametrize("sub", ["img", "color", "left", "rgb"])
def test_depth_beside_color(tmp_path: Path, sub: str) -> None:
    """It proves that a folder's color/ and depth/ are two channels of one frame, of sizes of their own."""
    color_folder(tmp_path / sub, 2)
    depth_folder(tmp_path / "depth", [1500, 3000])
    source = open_source(tmp_path, depth_scale=0.001)
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([1.5, 3.0])
    frame = next(iter(source))
    assert frame.color is not None
    assert frame.depth is not None
    assert (frame.color.shape, frame.depth.shape) == ((48, 64, 3), (30, 40))


def test_depth_of_an_unknown_unit_is_left_out_with_a_note(tmp_path: Path) -> None:
    """It proves that color can still be tracked where depth/ has no known scale, and that this is said."""
    color_folder(tmp_path / "color", 2)
    depth_folder(tmp_path / "depth", [1500])  # fewer, which doesn't matter then
    source = open_source(tmp_path)
    assert list(source.channels) == ["color"]
    (note,) = source.notes
    assert note.startswith(f"left out {tmp_path / 'depth'}: --depth-scale")


def test_a_second_folder_of_depth(tmp_path: Path) -> None:
    """It proves that --depth's folder is paired with color by order, whatever the files are called."""
    color_folder(tmp_path / "a", 2)
    depth = depth_folder(tmp_path / "b" / "raw", [700, 900])
    (tmp_path / "b" / "intrinsics.toml").touch()
    source = open_source(tmp_path / "a", depth=depth, depth_scale=0.001)
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([0.7, 0.9])
    assert source.calibration == tmp_path / "b" / "intrinsics.toml"


def color_video(path: Path, frames: int) -> Path:
    """An MJPG video."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(frames):
        writer.write(np.full((48, 64, 3), 90, np.uint8))
    writer.release()
    return path


def test_depth_beside_a_video(tmp_path: Path) -> None:
    """It proves that a video's frames get depth and keep their times; a video of another length is an error
    at its end.
    """
    depth = depth_folder(tmp_path / "d", [700, 900, 1100])
    source = open_source(color_video(tmp_path / "v.avi", 3), depth=depth, depth_scale=0.001)
    assert source.length == 3
    assert [frame.timestamp for frame in source] == pytest.approx([0.0, 0.1, 0.2])
    assert meters(source) == pytest.approx([0.7, 0.9, 1.1])
    for frames, message in ((2, "got 2 color and more depth"), (4, "got 3 depth and more color")):
        longer = open_source(color_video(tmp_path / "w.avi", frames), depth=depth, depth_scale=0.001)
        with pytest.raises(ValueError, match=f"w: expected as many color as depth images, {message}"):
            list(longer)


def vot(folder: Path, lines: str) -> Path:
    """A VOT folder of two frames, color and depth."""
    color_folder(folder / "color", 2)
    depth_folder(folder / "depth", [1234, 2345])
    (folder / "sequence").write_text(f"fps=4\n{lines}")
    return folder


CHANNELS = "channels.color=color/%08d.png\nchannels.depth=depth/%08d.png\n"


def test_vot_depth_is_millimeters(tmp_path: Path) -> None:
    """It proves that VOT's depth channel comes in meters without being told its unit, or by the one told."""
    folder = vot(tmp_path, f"channel.default=color\n{CHANNELS}")
    source = open_source(folder)
    assert (source.fps, list(source.channels)) == (4.0, ["color", "depth"])
    assert levels(source) == [10, 20]
    assert meters(source) == pytest.approx([1.234, 2.345])
    assert meters(open_source(folder, depth_scale=0.0001)) == pytest.approx([0.1234, 0.2345])


@pytest.mark.parametrize("place", ["../other/%08d.png", "color/../../other/%08d.png", "/etc/%08d.png"])
def test_lists_stay_in_their_folder(tmp_path: Path, place: str) -> None:
    """It proves that a recording's list can't make tricue read files elsewhere."""
    write_color(tmp_path / "other" / "00000001.png", 10)
    folder = vot(tmp_path / "sequence", f"channel.default=color\nchannels.color={place}\n")
    with pytest.raises(ValueError, match=r"sequence: expected files below its folder, got '"):
        open_source(folder)
    times = tum(tmp_path / "tum", [1.0], [1.0])
    (times / "rgb.txt").write_text(f"1.0 {place.replace('%08d', '00000001')}\n")
    with pytest.raises(ValueError, match=r"rgb\.txt: expected files below its folder, got '"):
        open_source(times)


def test_vot_depth_alone(tmp_path: Path) -> None:
    """It proves that a VOT sequence whose only, default channel is depth isn't read as color."""
    source = open_source(vot(tmp_path, "channel.default=depth\nchannels.depth=depth/%08d.png\n"))
    assert list(source.channels) == ["depth"]
    assert meters(source) == pytest.approx([1.234, 2.345])


def vot_rgbd(folder: Path) -> Path:
    """A VOT folder without its sequence file, as DepthTrack's come."""
    for index in (1, 2):
        write_color(folder / "color" / f"{index:08}.png", 10 * index)
        write_depth(folder / "depth" / f"{index:08}.png", 1000 * index)
    (folder / "groundtruth.txt").write_text("1,2,3,4\nnan,nan,nan,nan\n")
    return folder


def test_vot_rgbd_is_known_without_its_sequence_file(tmp_path: Path) -> None:
    """It proves that color/ and depth/ of eight-digit names beside VOT's true boxes are in millimeters, that
    their frame rate can be given, and that folders of other names still ask for the unit.
    """
    source = open_source(vot_rgbd(tmp_path), fps=20)
    assert (levels(source), meters(source)) == ([10, 20], pytest.approx([1.0, 2.0]))
    assert [frame.timestamp for frame in source] == [0.0, 0.05]
    assert source.first_box == Box(1, 2, 3, 4)
    assert source.truth is not None
    assert np.isnan(source.truth[1]).all()
    assert meters(open_source(tmp_path, depth_scale=0.0001)) == pytest.approx([0.1, 0.2])
    for index in (1, 2):
        (tmp_path / "depth" / f"{index:08}.png").rename(tmp_path / "depth" / f"frame{index}.png")
    (note,) = open_source(tmp_path).notes
    assert "--depth-scale" in note


def test_vot_masks_and_polygons_have_boxes(tmp_path: Path) -> None:
    """It proves that VOT's polygons and masks, which CDTB has, come as the boxes round them."""
    (vot_rgbd(tmp_path) / "groundtruth.txt").write_text("10,20,30,20,30,60,10,60\nm5,6,7,8,0,3,4\n")
    truth = open_source(tmp_path).truth
    assert truth is not None
    assert truth.tolist() == [[10, 20, 20, 40], [5, 6, 7, 8]]


def tum(folder: Path, color: Iterable[float], depth: Iterable[float]) -> Path:
    """A TUM folder: depth of 5000, 5001, ... units in the order given, and the path of the camera."""
    lists: dict[str, list[str]] = {"rgb": [], "depth": []}
    for index, time in enumerate(color, 1):
        write_color(folder / "rgb" / f"{time:.6f}.png", 10 * index)
        lists["rgb"].append(f"{time:.6f} rgb/{time:.6f}.png")
    for index, time in enumerate(depth):
        write_depth(folder / "depth" / f"{time:.6f}.png", 5000 + index)
        lists["depth"].append(f"{time:.6f} depth/{time:.6f}.png")
    for name, lines in lists.items():
        if lines:
            (folder / f"{name}.txt").write_text("\n".join(["# images", "#timestamp filename", *lines, ""]))
    (folder / "groundtruth.txt").write_text("# timestamp tx ty tz qx qy qz qw\n1.0 1 2 3 0 0 0 1\n")
    return folder


def test_tum_pairs_by_time(tmp_path: Path) -> None:
    """It proves that TUM's images are paired by the nearest time within 20 ms, each once, times kept."""
    color = [100.000, 100.033, 100.066, 100.200, 100.300]
    depth = [100.005, 100.028, 100.070, 100.225, 100.290, 100.295]
    source = open_source(tum(tmp_path, color, depth))
    assert levels(source) == [10, 20, 30, 50]
    assert [frame.timestamp for frame in source] == [100.000, 100.033, 100.066, 100.300]
    assert [round(5000 * z) - 5000 for z in meters(source)] == [0, 1, 2, 5]
    assert source.fps == pytest.approx(1 / 0.033)
    assert source.notes == ("left out 1 of 5 color images, with no depth image within 0.02 s",)


def test_tum_serves_the_closest_first(tmp_path: Path) -> None:
    """It proves that of two color images that are near one depth image the nearer one gets it."""
    source = open_source(tum(tmp_path, [10.0, 10.012], [10.010]))
    assert levels(source) == [20]


def test_tum_camera_paths_are_no_boxes(tmp_path: Path) -> None:
    """It proves that TUM's groundtruth.txt, whose lines could pass for polygons, isn't taken for boxes."""
    source = open_source(tum(tmp_path, [1.0], [1.0]))
    assert source.truth is None
    assert source.first_box is None


def test_tum_channels_alone(tmp_path: Path) -> None:
    """It proves that a TUM folder with one of its lists is a source of that channel, in the order of time."""
    depth = open_source(tum(tmp_path / "d", [], [2.0, 1.0]))
    assert (list(depth.channels), [f.timestamp for f in depth]) == (["depth"], [1.0, 2.0])
    assert meters(depth) == pytest.approx([5001 / 5000, 1.0])
    color = open_source(tum(tmp_path / "c", [1.0, 2.0], []))
    assert (list(color.channels), levels(color)) == (["color"], [10, 20])


@pytest.mark.parametrize("apart", [" ", "\t", ",", ", "])
def test_tum_lists_may_be_parted_by_commas(tmp_path: Path, apart: str) -> None:
    """It proves that blanks, tabs and commas part a list's columns, and that file names may hold blanks."""
    write_depth(tmp_path / "depth" / "a b.png", 5000)
    (tmp_path / "depth.txt").write_text(f"# depth maps\n\n1305031102.160407{apart}depth/a b.png\r\n")
    source = open_source(tmp_path)
    assert [frame.timestamp for frame in source] == [1305031102.160407]
    assert meters(source) == pytest.approx([1.0])


def test_times_of_their_own_go_before_those_of_other_channels(tmp_path: Path) -> None:
    """It proves that color images without times take those of the depth beside them, so that --fps is
    refused there; where neither has times it counts.
    """
    color, depth = color_folder(tmp_path / "c", 2), tum(tmp_path / "d", [], [7.0, 7.25])
    source = open_source(color, depth=depth)
    assert ([frame.timestamp for frame in source], source.fps) == ([7.0, 7.25], 4.0)
    with pytest.raises(
        ValueError, match=r"^--fps 15: .* but c has its own, 4 frames per second; leave it out"
    ):
        open_source(color, depth=depth, fps=15)
    plain = depth_folder(tmp_path / "e", [1000, 2000])
    source = open_source(color, depth=plain, depth_scale=0.001, fps=8)
    assert ([frame.timestamp for frame in source], source.fps) == ([0.0, 0.125], 8.0)


def rotated(units: int) -> int:
    """The Princeton benchmark's bits: turned three places to the left."""
    return ((units << 3) | (units >> 13)) & 0xFFFF


def ptb(folder: Path) -> Path:
    """A Princeton folder: three color images and two depth images, numbers that don't sort as text."""
    for index, (time, frame) in enumerate([(0, 9), (33_000, 10), (66_000, 11)], 1):
        write_color(folder / "rgb" / f"r-{time}-{frame}.png", 10 * index)
    write_depth(folder / "depth" / "d-1000-1.png", rotated(9000))  # its top bit is set by the turn
    write_depth(folder / "depth" / "d-60000-2.png", rotated(1500))
    return folder


@pytest.mark.parametrize("make", [lambda f: tum(f, [1.0], [1.0]), lambda f: tum(f, [], [1.0]), ptb])
def test_fps_beside_recorded_times_is_refused(tmp_path: Path, make: Callable[[Path], Path]) -> None:
    """It proves that TUM's and Princeton's images keep their own times, also a single one."""
    with pytest.raises(ValueError, match=r"^--fps 15: expected with images without times"):
        open_source(make(tmp_path), fps=15)


def test_princeton_depth_is_turned_back(tmp_path: Path) -> None:
    """It proves that Princeton's frames come in the order of their numbers with the depth nearest in time,
    its bits turned back.
    """
    source = open_source(ptb(tmp_path))
    assert levels(source) == [10, 20, 30]
    assert meters(source) == pytest.approx([9.0, 1.5, 1.5])
    assert [frame.timestamp for frame in source] == pytest.approx([0.0, 0.033, 0.066])


@pytest.mark.parametrize("units", [1001, 1007, 1008, 8191, 8192, 10_000, 40_001])
def test_princeton_bits(tmp_path: Path, units: int) -> None:
    """It proves that a value comes back as it was, whichever of its bits are set."""
    folder = ptb(tmp_path)
    for path in (folder / "depth").iterdir():
        write_depth(path, rotated(units))
    assert meters(open_source(folder)) == pytest.approx(3 * [units / 1000])


def test_princeton_folders_alone(tmp_path: Path) -> None:
    """It proves that Princeton's rgb/ or depth/ alone is known by its names: order, times, bits and unit."""
    folder = ptb(tmp_path)
    depth = open_source(folder / "depth")
    assert (list(depth.channels), meters(depth)) == (["depth"], pytest.approx([9.0, 1.5]))
    assert [frame.timestamp for frame in depth] == pytest.approx([0.001, 0.06])
    color = open_source(folder / "rgb")
    assert levels(color) == [10, 20, 30]
    assert [frame.timestamp for frame in color] == pytest.approx([0.0, 0.033, 0.066])
    beside = open_source(color_folder(tmp_path / "c", 2), depth=folder / "depth")
    assert meters(beside) == pytest.approx([9.0, 1.5])


def frames_mat(folder: Path) -> None:
    """Princeton's frames.mat, with the camera matrix that counts from 1."""
    matrix = [[575.0, 0, 321], [0, 576.0, 241], [0, 0, 1]]
    io = pytest.importorskip("scipy.io")
    io.savemat(folder / "frames.mat", {"frames": {"length": 3.0, "K": matrix, "imageTimestamp": [0, 33_000]}})


def test_princeton_camera(tmp_path: Path) -> None:
    """It proves that the camera matrix of frames.mat is found, and counts from 0 then, as all of ours do."""
    folder = ptb(tmp_path)
    frames_mat(folder)
    source = open_source(folder)
    assert source.calibration == folder / "frames.mat"
    camera = read_intrinsics(source.calibration, source.size, "depth")
    assert camera == Intrinsics(575.0, 576.0, 320.0, 240.0, 40, 30)
    (folder / "intrinsics.toml").touch()
    assert open_source(folder).calibration == folder / "intrinsics.toml"


def test_princeton_truth(tmp_path: Path) -> None:
    """It proves that Princeton's boxes are read from <sequence>.txt, else init.txt has the first one."""
    folder = ptb(tmp_path / "bear_front")
    (folder / "init.txt").write_text("10,20,30,40\n")
    assert open_source(folder).first_box == Box(10, 20, 30, 40)
    (folder / "bear_front.txt").write_text("1,2,3,4,0\nNaN,NaN,NaN,NaN,1\n5,6,7,8,0\n")
    truth = open_source(folder).truth
    assert truth is not None
    assert truth[[0, 2]].tolist() == [[1, 2, 3, 4], [5, 6, 7, 8]]
    assert np.isnan(truth[1]).all()


def test_a_calibration_beside_the_images_is_found(tmp_path: Path) -> None:
    """It proves that intrinsics.toml is found in the sequence's folder first, then in the one above."""
    folder = depth_folder(tmp_path / "walk", [1000])
    assert open_source(folder, depth_scale=0.001).calibration is None
    for place in (tmp_path, folder):
        (place / "intrinsics.toml").touch()
        assert open_source(folder, depth_scale=0.001).calibration == place / "intrinsics.toml"


def test_real_depth(data: Path) -> None:
    """It proves that the real RGB-D sequences open with both channels, and that the true boxes' middles lie
    at the depths that their description gives.
    """
    for name, length in {"walk-away": 34, "queue-first": 24, "queue-second": 25}.items():
        source = open_source(data / "rgbd" / name)
        assert (source.length, list(source.channels), source.size) == (length, ["color", "depth"], (640, 480))
        assert source.calibration is not None
        assert source.truth is not None
        written = (data / "rgbd" / name / "position_z_mm.txt").read_text().split()
        apart = []
        for frame, box, z in zip(source, source.truth, map(float, written), strict=True):
            assert frame.color is not None
            assert frame.depth is not None
            if np.isfinite(box).all() and np.isfinite(z):
                x, y = (round(number) for number in Box(*box.tolist()).center)
                apart.append(abs(float(np.nanmedian(frame.depth[y - 9 : y + 9, x - 9 : x + 9])) - z / 1000))
        assert np.median(apart) < 0.15


def eight_bits(folder: Path) -> Path:
    """A color picture of depth."""
    write_color(folder / "1.png")
    return folder


def gray_bits(folder: Path) -> NDArray[np.uint8]:
    """An 8-bit gray image."""
    image = np.full((30, 40), 90, np.uint8)
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / "1.png"), image)
    return image


def wide_bits(folder: Path) -> None:
    """A 16-bit color image."""
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / "1.png"), np.full((30, 40, 3), 9000, np.uint16))


def beside(make: Callable[[Path], object]) -> Callable[[Path], Source]:
    """One color image, with what ``make`` puts into another folder as its depth."""

    def opened(folder: Path) -> Source:
        make(folder / "d")
        return open_source(color_folder(folder / "c", 1), depth=folder / "d", depth_scale=0.001)

    return opened


def cut_off(folder: Path) -> Source:
    """A folder of depth whose second image ends in the middle."""
    depth_folder(folder, [1000, 1000])
    (folder / "2.png").write_bytes((folder / "2.png").read_bytes()[:60])
    return open_source(folder, depth_scale=0.001)


def eight_bits_in_the_middle(folder: Path) -> Source:
    """A folder of depth whose second image is a picture."""
    write_color(depth_folder(folder, [1000]) / "2.png")
    return open_source(folder, depth_scale=0.001)


def unlisted(folder: Path) -> Source:
    """A TUM folder whose list names a file that isn't there."""
    (tum(folder, [], [1.0, 2.0]) / "depth" / "2.000000.png").unlink()
    return open_source(folder)


def misspelt(line: str) -> Callable[[Path], Source]:
    """A TUM folder with a bad line in its list."""

    def opened(folder: Path) -> Source:
        (tum(folder, [], [1.0]) / "depth.txt").write_text(f"# list\n{line}\n")
        return open_source(folder)

    return opened


def uneven_vot(folder: Path) -> Source:
    """A VOT folder with one depth image too many."""
    write_depth(vot(folder, CHANNELS) / "depth" / "3.png", 1000)
    return open_source(folder)


@pytest.mark.parametrize(
    ("opened", "message"),
    [
        (
            lambda f: open_source(depth_folder(f / "walk", [1])),
            r"walk: expected --depth-scale, the meters per unit .*; 0\.001 where they are millimeters",
        ),
        (
            lambda f: open_source(color_folder(f / "c", 1), depth=depth_folder(f / "d", [1])),
            "d: expected --depth-scale",
        ),
        (
            lambda f: open_source(depth_folder(f, [1]), depth_scale=0),
            "depth_scale: expected meters per unit above 0, got 0",
        ),
        (
            lambda f: open_source(color_folder(f / "c", 3), depth=depth_folder(f / "d", [1]), depth_scale=1),
            "c: expected as many color as depth images, got 3 color and 1 depth",
        ),
        (uneven_vot, "expected as many color as depth images, got 2 color and 3 depth"),
        (
            lambda f: open_source(color_folder(f, 1), depth_scale=0.001),
            "expected depth images where --depth-scale is given, found only color",
        ),
        (beside(eight_bits), r"1.png: expected depth, 16 bits .*, got uint8 \(48, 64, 3\); .* not meters"),
        (beside(gray_bits), r"1.png: .* got uint8 \(30, 40\); 8 bits are a picture of the depth, not meters"),
        (beside(wide_bits), r"1.png: expected depth, 16 bits of one channel, got uint16 \(30, 40, 3\)"),
        (eight_bits_in_the_middle, "expected images of one kind, found 1 of color and 1 of depth"),
        (cut_off, "2.png: expected an image, this file can't be read as one"),
        (beside(lambda f: f.mkdir()), "d: expected a folder of images or a sequence, found neither"),
        (
            beside(lambda f: color_folder(f / "img", 1)),
            "d: expected a folder of 16-bit images of depth, found only",
        ),
        (beside(lambda f: None), "d: there is no such file or folder"),
        (beside(lambda f: f.write_text("x")), "d: expected a folder of 16-bit images of depth, got a file"),
        (
            lambda f: open_source(depth_folder(f / "a", [1]), depth=f / "a", depth_scale=1),
            "a: expected color images beside --depth .*, found only depth",
        ),
        (unlisted, "2.000000.png: there is no such file"),
        (misspelt("1.0"), "depth.txt, line 2: expected a timestamp and a file name, got '1.0'"),
        (misspelt("one depth/1.png"), "depth.txt, line 2: expected a timestamp"),
        (misspelt("nan depth/1.png"), "depth.txt, line 2: expected a timestamp"),
        (misspelt("# nothing"), "depth.txt: expected a line of timestamp and file name an image, found none"),
        (
            lambda f: open_source(tum(f, [1.0], [2.0])),
            "expected color and depth images within 0.02 s of each other, found none",
        ),
        (
            lambda f: open_source(vot(f, "channels.color=color/%08d.png\nchannels.depth=d/%08d.png\n")),
            "sequence: expected channels.depth=depth/%08d.png, got 'd/%08d.png'",
        ),
    ],
)
def test_bad_depth_is_named(tmp_path: Path, opened: Callable[[Path], Source], message: str) -> None:
    """It proves that each unusable input is an error that names the place and what is wrong with it."""
    with pytest.raises((ValueError, OSError), match=message):
        list(opened(tmp_path))


def test_a_cut_off_image_is_one_error(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """It proves that of an image that ends in the middle only the exception tells: libpng keeps quiet."""
    path = tmp_path / "1.png"
    noise = np.random.default_rng(0).integers(500, 4000, (120, 160)).astype(np.uint16)
    cv2.imwrite(str(path), noise)
    path.write_bytes(path.read_bytes()[:10_000])
    with pytest.raises(ValueError, match=r"1\.png: expected an image"):
        list(open_source(tmp_path))
    assert capfd.readouterr() == ("", "")


def test_a_camera_has_no_depth_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It proves that a live camera can't be paired with recorded depth."""

    class Endless:
        def __init__(self, _number: int) -> None:
            pass

        def isOpened(self) -> bool:  # noqa: N802 (as cv2 names it)
            return True

        def get(self, _key: int) -> float:
            return 0.0

        def read(self) -> tuple[bool, object]:
            sleep(0.01)
            return True, np.zeros((48, 64, 3), np.uint8)

        def release(self) -> None:
            pass

    monkeypatch.setattr(cv2, "VideoCapture", Endless)
    assert open_source("0").size == (64, 48)
    with pytest.raises(ValueError, match=r"--depth .*: expected with a video or a folder, got camera 0"):
        open_source("0", depth=depth_folder(tmp_path, [1]), depth_scale=0.001)
