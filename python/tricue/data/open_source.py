# SPDX-License-Identifier: MIT
"""Opens any input for tracking: a video, a folder of images, a sequence, a recording, a camera."""

import os
import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from tricue.camera.numbers import positive
from tricue.data import oak, realsense
from tricue.data.box_table import find_box_table, find_video_box_table, read_box_table
from tricue.data.capture import Capture, is_capture, is_file_url, without_password
from tricue.data.files import has_several_pictures, image_paths, is_image
from tricue.data.layouts import depth_images, note_box_table, read_layout
from tricue.data.live import Device, Live, LiveStream, Patience, live_channels
from tricue.data.recordings.recording import is_recording, open_recording
from tricue.data.source import Source
from tricue.data.streams import Stream, Video
from tricue.data.truth import Truth, check_target

__all__ = ["Source", "open_source"]

TEXT_SUFFIXES = {".ans", ".art", ".asc", ".diz", ".ice", ".nfo", ".txt", ".vt"}  # FFmpeg plays them as videos
BOOT_SECONDS = 30.0  # until the first image of a camera that boots an operating system of its own
CALIBRATION_FILE = "intrinsics.toml"  # searched in a sequence's folder and in the folder above
PRINCETON_CALIBRATION_FILE = "frames.mat"  # searched in the sequence's folder
FORMAT_RATES = {"KITTI tracking": 10.0}
"""Frame rates (frames/s) of formats whose files don't contain them (Geiger et al. 2013)."""


def open_source(
    place: str | Path | int,
    *,
    depth: str | Path | None = None,
    depth_scale: float | None = None,
    fps: float | None = None,
    right: str | Path | int | None = None,
    target: str | None = None,
    timeout: float | None = None,
    topics: Mapping[str, str] | None = None,
) -> Source:
    """Open a video file, a folder of images, a sequence folder, a recording, or a live camera.

    A sequence folder is OTB's (``img/``), VOT's (``sequence``), TUM's (``depth.txt``), the Princeton
    benchmark's (``rgb/r-0-1.png``), or holds one video, with a file of true boxes. 16-bit images are depth.
    Stereo pairs are KITTI's (``image_02`` and ``image_03``, or gray), or in ``left`` and ``right``.

    A recording is a ROS 1 bag (also a RealSense one), a ROS 2 folder, or an MCAP file. A camera is a number,
    a file such as ``/dev/video0``, a URL (rtsp, rtmp, srt, http, udp, tcp), or ``realsense:`` or ``oak:``,
    followed by a serial number if needed. A camera's frame is always the newest; :attr:`Source.health` gives
    the number of dropped ones. :meth:`Source.close`, or a ``with`` statement, releases it.

    depth: a folder of 16-bit images, or a sequence folder with depth, for the color images of ``place``;
        they are paired by order.
    depth_scale: meters per unit of depth. It is required unless the format defines it, as VOT, TUM, Princeton
        and recordings do, and overrides the format's.
    fps: frames per second of images without times, by default 10 for KITTI's tracking sequences and 30 for
        others; ValueError for images with times.
    right: the right camera's video, folder, number or URL; ``place`` is the left camera's. They are paired by
        order.
    target: one of :func:`tricue.data.layouts.list_targets`, for a folder with several. A KITTI sequence is
        limited to the frames in which it is labeled.
    timeout: seconds without an image, 60 by default, after which iterating over a live camera raises
        TimeoutError. Iterating again opens it again. Opening may take ten seconds, thirty for a local camera.
    topics: a recording's topics by channel: "color", "depth", "right". By default they are guessed, and named
        in a note.
    Raises ValueError or OSError that names the place and says what is wrong with it.
    """
    place = _checked(place, "place")
    if depth_scale is not None and depth is None:
        _refuse_scale_of_device(place)
    if right is not None:
        _refuse_same(place, _checked(right, "right"))
    source = _opened(place, depth_scale, target, topics, timeout)
    shown = without_password(str(place))
    try:
        if right is not None:
            source = _with_right(source, shown, _checked(right, "right"), timeout)
        if depth is not None:
            source = _with_depth(source, shown, Path(depth), depth_scale)
        if depth_scale is not None and "depth" not in source.channels:
            raise ValueError(f"{shown}: expected depth images where depth_scale is given, found only color")
        if fps is None and not source.clock.timed:
            fps = FORMAT_RATES.get(source.format)
        return source if fps is None else replace(source, rate=fps)
    except BaseException:
        source.close()  # a camera, whose thread would read on
        raise


def _checked(place: Any, name: str) -> str | Path:
    if isinstance(place, int) and not isinstance(place, bool):
        return str(place) if is_capture(str(place)) else f"/dev/video{place}"  # a folder has that name
    if not isinstance(place, str | os.PathLike):
        raise TypeError(f"{name}: expected a path, a URL or a camera's number, got {place!r:.80}")
    return place if isinstance(place, str) else Path(place)


def _opened(
    place: str | Path,
    scale: float | None,
    target: str | None = None,
    topics: Mapping[str, str] | None = None,
    timeout: float | None = None,
) -> Source:
    if isinstance(place, str) and (device := live_device(place)):
        _refuse_topics(topics, device.name)
        _refuse_target(target, device.name)
        return _open_live(device, timeout)
    if timeout is not None:
        raise ValueError(
            f"timeout: expected with a live camera, got {without_password(str(place))}; leave it out"
        )
    if isinstance(place, str) and is_file_url(place):
        _refuse_topics(topics, without_password(place))
        _refuse_target(target, without_password(place))
        file = Path(urlsplit(place).path)
        return Source(file.stem, {"color": Video(file, place, without_password(place))}, format="video")
    path = _existing(Path(place))
    if is_recording(path):
        _refuse_target(target, place)
        return _with_table(open_recording(path, topics, scale), path)
    _refuse_topics(topics, place)
    if path.is_dir():
        layout = read_layout(path, scale, target)
        name = path.resolve().name if target is None else f"{path.resolve().name} {target}"
        return _with_truth(
            Source(
                name,
                layout.channels,
                calibration=_calibration(path) or layout.calibration,
                kitti_cameras=layout.kitti_cameras,
                notes=layout.notes,
                format=layout.format,
            ),
            layout.truth,
        )
    if path.suffix.lower() in TEXT_SUFFIXES:
        raise ValueError(f"{place}: expected a video or a folder, got a text")
    if is_image(path):
        if has_several_pictures(path):
            hint = "several pictures in one image file; turn it into a video or a folder of 8-bit images"
        else:
            hint = "one picture; give its folder"
        raise ValueError(f"{place}: expected a video or a folder, got {hint}")
    _refuse_target(target, place)
    return _with_table(Source(path.stem, {"color": Video(path)}, format="video"), path)


def _refuse_scale_of_device(place: str | Path) -> None:
    """ValueError for a live device: if it has depth, that is in meters."""
    if isinstance(place, str) and (device := live_device(place)):
        raise ValueError(f"depth_scale: expected with recorded depth, got {device.name}; leave it out")


def _refuse_topics(topics: Mapping[str, str] | None, place: str | Path) -> None:
    """ValueError if topics are given for a place that isn't a recording."""
    if topics is not None:
        raise ValueError(f"topics: expected with a recording (.bag, .mcap, .db3), got {place}; leave it out")


def _refuse_target(target: str | None, place: str | Path) -> None:
    """ValueError if a target is named for a place that has only one."""
    if target is not None:
        check_target(target, (), place)


def _refuse_same(left: str | Path, right: str | Path) -> None:
    """ValueError if the right camera's images are the left one's: all would be infinitely far away."""
    paths = Path(left), Path(right)
    if left == right or (all(path.exists() for path in paths) and paths[0].samefile(paths[1])):
        shown = without_password(str(right))
        raise ValueError(f"right={shown}: expected other images than the left camera's, got the same")


def live_device(place: str) -> Device | None:
    """The live device with this name; None for files and folders."""
    if place.startswith(realsense.PREFIX):
        return realsense.RealSense(place.removeprefix(realsense.PREFIX))
    if place.startswith(oak.PREFIX):
        return oak.Oak(place.removeprefix(oak.PREFIX))
    return Capture(place) if is_capture(place) else None


def _open_live(device: Device, timeout: float | None) -> Source:
    patience = None if device.remote else Patience(start=BOOT_SECONDS)
    if timeout is not None:
        patience = (patience or Patience())._replace(silence=positive(timeout, "timeout", "seconds"))
    live = Live(device) if patience is None else Live(device, patience)
    format_ = "stream" if device.remote else "camera"
    return Source(device.name, live_channels(live), format=format_, camera=live.camera)


def _with_table(source: Source, path: Path) -> Source:
    """The source with the true boxes of the table beside its file or in its folder."""
    table = find_box_table(path, None) if path.is_dir() else find_video_box_table(path)
    if table is None:
        return source
    notes = (*source.notes, note_box_table(table))
    return replace(_with_truth(source, read_box_table(table)), notes=notes)


def _with_truth(source: Source, truth: Truth | None) -> Source:
    if truth is None:
        return source
    return replace(source, truth=truth.boxes, absent=truth.absent, positions=truth.positions)


def _with_right(source: Source, shown: str, right: str | Path, timeout: float | None) -> Source:
    """The source as a stereo pair: its color images on the left, those of ``right`` on the right."""
    streams = [opened.channels.get("color") for opened in (source, _opened(right, None, timeout=timeout))]
    argument = f"right={without_password(str(right))}"
    for stream, at in zip(streams, (shown, argument), strict=True):
        if stream is None:
            raise ValueError(f"{at}: expected color images of a stereo pair, found only depth")
    left, other = streams
    assert left
    assert other
    if isinstance(left, LiveStream) != isinstance(other, LiveStream):
        raise ValueError(f"{argument}: expected two cameras or two recordings, got one of each")
    note = "the two cameras don't expose at one time; what moves fast isn't at one place in both"
    notes = (*source.notes, note) if isinstance(left, LiveStream) else source.notes
    rest = {name: stream for name, stream in source.channels.items() if name not in ("color", "right")}
    channels = {"color": left, "right": other, **rest}
    return replace(source, channels=channels, notes=notes, format="stereo pair")


def _with_depth(source: Source, shown: str, depth: Path, scale: float | None) -> Source:
    """The source with depth images from another place."""
    color = source.channels.get("color")
    if color is None:
        raise ValueError(f"{shown}: expected color images beside depth={depth}, found only depth")
    if isinstance(color, LiveStream):
        raise ValueError(f"depth={depth}: expected with a video or a folder, got {source.name}")
    channels = {**source.channels, "depth": _depth_stream(_existing(depth), scale)}
    return replace(source, channels=channels, calibration=source.calibration or _calibration(depth))


def _depth_stream(place: Path, scale: float | None) -> Stream:
    if not place.is_dir():
        raise ValueError(f"{place}: expected a folder of 16-bit images of depth, got a file")
    if paths := image_paths(place):
        return depth_images(paths, scale)
    stream = read_layout(place, scale).channels.get("depth")
    if stream is None:
        raise ValueError(f"{place}: expected a folder of 16-bit images of depth, found only color")
    return stream


def _calibration(folder: Path) -> Path | None:
    places = (
        folder / CALIBRATION_FILE,
        folder.resolve().parent / CALIBRATION_FILE,
        folder / PRINCETON_CALIBRATION_FILE,
    )
    return next((path for path in places if path.is_file()), None)


def _existing(path: Path) -> Path:
    if path.exists():
        return path
    if str(path).lower().startswith("file:/"):
        from urllib.request import url2pathname  # it is slow to import

        file = Path(url2pathname(urlsplit(str(path)).path))
        hint = f"; give {file}" if file.exists() else ""
        raise FileNotFoundError(f"{path}: expected a path, got a URL{hint}")
    hint = ""
    if re.search(r"[*?]|%\d*d", path.name) and path.parent.is_dir():  # as shells and ffmpeg take them
        hint = f"; give the folder of the images, {path.parent}"
    raise FileNotFoundError(f"{path}: there is no such file or folder{hint}")
