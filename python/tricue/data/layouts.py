# SPDX-License-Identifier: MIT
"""The layouts of sequence folders: VOT's, TUM's, Princeton's, KITTI's, OTB's, plain images or one video."""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from tricue.camera.read_calibration import KITTI_COLOR_CAMERAS
from tricue.data import kitti, otb, princeton, tum, viewer_images, vot
from tricue.data.box_table import find_box_table, read_box_table
from tricue.data.depth_images import DepthReader, is_depth, require_scale
from tricue.data.files import image_paths, is_video, natural_order, video_paths, without_copies
from tricue.data.streams import Images, Stream, Video, image_names, timed_images
from tricue.data.truth import (
    Truth,
    add_tags_and_depths,
    check_target,
    find_princeton_truth,
    find_truth,
    otb_targets,
)

COLOR_FOLDERS = ("img", "color", "left", "rgb")  # OTB, VOT, stereo pairs, RGB-D recordings


class Layout(NamedTuple):
    """A folder's content: its format's name, one stream per channel, the truth, and notes for the user."""

    format: str
    channels: dict[str, Stream]
    truth: Truth | None = None
    notes: tuple[str, ...] = ()
    calibration: Path | None = None
    kitti_cameras: tuple[int, int] = KITTI_COLOR_CAMERAS


class _EmptyFolderError(ValueError):
    """A folder has neither images nor a video."""


def read_layout(folder: Path, scale: float | None, target: str | None = None) -> Layout:
    """The folder's channels and truth.

    scale: meters per unit of depth, if the format doesn't define it or the files deviate from the format.
    target: one of those that :func:`list_targets` lists; a KITTI sequence is limited to the frames in which
    it is labeled. ValueError names the folder or the file in it, and what was expected.
    """
    if target is not None:
        check_target(target, _list_all_targets(folder), folder)
    try:
        layout = _detect_layout(folder, scale, target)
    except _EmptyFolderError as error:
        if below := _sequence_below(folder):
            raise ValueError(f"{error}; name a folder in it, such as {below}") from None
        raise
    if layout.truth is not None:
        return layout
    color = layout.channels.get("color")
    table = find_box_table(folder, color.path if isinstance(color, Video) else None)
    if table is None:
        return layout
    truth = add_tags_and_depths(read_box_table(table, image_names(layout.channels)), folder)
    return layout._replace(truth=truth, notes=(*layout.notes, note_box_table(table)))


def note_box_table(table: Path) -> str:
    """The note that says where the truth comes from, since a table may be a tracker's result."""
    return f"true boxes found: {table}"


def list_targets(folder: str | Path) -> tuple[str, ...]:
    """The names of a folder's targets, if it has several.

    For KITTI, these are the targets that are labeled in two frames or more, such as "Car 31"; for OTB, the
    numbers of its files of true boxes. ValueError names a malformed label.
    """
    folder = Path(folder)
    names = _list_all_targets(folder)
    return names if len(names) > 1 or kitti.find_labels(folder) else ()


def layout_files(folder: Path) -> Iterator[Path]:
    """The lists and labels in a folder from which its layout is read."""
    names = (vot.SEQUENCE_FILE, *tum.LIST_FILES.values())
    yield from (path for path in map(folder.joinpath, names) if path.is_file())
    with suppress(ValueError):  # several sequences, none of which is read
        if labels := kitti.find_labels(folder):
            yield labels


def depth_images(paths: Sequence[Path], scale: float | None) -> Images:
    """A stream of depth images; ValueError if their unit isn't known.

    Princeton's images, whose unit is known, are recognized by their names.
    """
    if len(images := princeton.timestamped_images(paths)) == len(paths):
        return princeton.depth_images(images, scale)
    return Images(paths, read=DepthReader(require_scale(paths[0].parent, scale)))


def _list_all_targets(folder: Path) -> tuple[str, ...]:
    if labels := kitti.find_labels(folder):
        return tuple(label.name for label in kitti.read_labels(labels) if len(label.frames) > 1)
    return otb_targets(folder)


def _detect_layout(folder: Path, scale: float | None, target: str | None) -> Layout:
    """The folder's layout, with the truth that its format defines."""
    if channels := vot.read_channels(folder, scale):
        name = "VOT RGB-D" if "depth" in channels else "VOT"
        return Layout(name, channels, find_truth(folder, target))
    if tum.is_tum(folder):
        channels, notes = tum.read_channels(folder, scale)
        return Layout("TUM RGB-D", channels, notes=notes)
    if channels := princeton.read_channels(folder, scale):
        return Layout("Princeton", channels, find_princeton_truth(folder))
    if sequence := kitti.find_sequence(folder):
        name = "KITTI tracking" if sequence.tracking else "KITTI"
        channels, truth = kitti.read_channels(sequence, target)
        return Layout(name, channels, truth, calibration=sequence.calibration, kitti_cameras=sequence.cameras)
    if found := viewer_images.read_channels(folder, scale):
        channels, notes = found
        return Layout("viewer's images", channels, find_truth(folder, target), notes)
    return _read_plain_layout(folder, scale, target)


def _read_plain_layout(folder: Path, scale: float | None, target: str | None) -> Layout:
    """Images in one of COLOR_FOLDERS or in the folder itself, or one video.

    Depth is in depth/. Right images are in right/ if the left ones are in left/.
    """
    truth = find_truth(folder, target)
    images = without_copies(every := find_plain_images(folder))
    if images and is_depth(images[0]):
        return Layout("images", {"depth": depth_images(images, scale)}, truth)
    depth = without_copies(image_paths(folder / "depth")) if (folder / "depth").is_dir() else []
    channels: dict[str, Stream] = {}
    notes: tuple[str, ...] = ()
    if images:
        channels["color"] = _color_images(images)
        if len(images) < len(every):
            copy = min(set(every) - set(images))
            notes = (f"left out {copy} and others, as images of these names are there in another format",)
        if images[0].parent == folder and (video := next(filter(is_video, video_paths(folder)), None)):
            notes = (*notes, f"left out {video}, as images are beside it; name the file to open it")
        if images[0].parent == folder / "left" and (folder / "right").is_dir():
            channels["right"] = Images(without_copies(image_paths(folder / "right")))
    elif found := _video(folder, optional=bool(depth)):
        channels["color"] = found
    if depth and channels and scale is None:
        unit = "depth_scale gives its meters per unit, 0.001 for millimeters"
        notes = (*notes, f"left out {folder / 'depth'}: {unit}")
    elif depth:
        channels["depth"] = depth_images(depth, scale)
    return _otb_range(folder, Layout(_plain_name(folder, channels), channels, truth, notes))


def find_plain_images(folder: Path) -> list[Path]:
    """The images in the first of COLOR_FOLDERS that has any, else those in the folder itself."""
    places = [folder / sub for sub in COLOR_FOLDERS if (folder / sub).is_dir()]
    return next((paths for place in (*places, folder) if (paths := image_paths(place))), [])


def _plain_name(folder: Path, channels: dict[str, Stream]) -> str:
    if "right" in channels:
        return "stereo pair"
    if isinstance(channels.get("color"), Video):
        return "video"
    return "OTB" if otb.has_otb_truth(folder) else "images"


def _otb_range(folder: Path, layout: Layout) -> Layout:
    """The layout, without the images before and after OTB's true boxes."""
    if layout.format != "OTB" or layout.truth is None or len(layout.channels) != 1:
        return layout
    color = layout.channels["color"]
    in_range = otb.cut_to_range(folder, color, len(layout.truth.boxes))
    if in_range is None:
        return layout
    ends = f"{in_range.paths[0].name} to {in_range.paths[-1].name}"
    note = f"took {len(in_range.paths)} of {color.length} images, {ends}, which OTB's true boxes are for"
    return layout._replace(channels={"color": in_range}, notes=(*layout.notes, note))


def _color_images(paths: Sequence[Path]) -> Images:
    images = princeton.timestamped_images(paths)
    return timed_images(images) if len(images) == len(paths) else Images(paths)


def _video(folder: Path, optional: bool) -> Video | None:
    found = video_paths(folder)
    if len(found) == 1:
        return Video(found[0])
    if optional and not found:
        return None
    expected = f"{folder}: expected a folder of images or a sequence"
    if found:
        raise ValueError(f"{expected}, found {len(found)} videos; name one of them")
    raise _EmptyFolderError(f"{expected}, found neither images nor a video")


def _sequence_below(folder: Path) -> Path | None:
    """The first folder in a folder that can be read."""
    for path in natural_order(each for each in folder.iterdir() if each.is_dir()):
        with suppress(ValueError, OSError):
            _detect_layout(path, None, None)
            return path
    return None
