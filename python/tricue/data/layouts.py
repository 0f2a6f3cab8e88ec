# SPDX-License-Identifier: MIT
"""How sequence folders are laid out: VOT's, TUM's, Princeton's, KITTI's, OTB's, images alone."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from tricue.data import kitti, otb, princeton, tum, vot
from tricue.data.box_table import find_table, read_table
from tricue.data.depth_images import DepthReader, is_depth, known_scale
from tricue.data.files import image_paths, is_video, natural_order
from tricue.data.streams import Images, Stream, Video, timed_images
from tricue.data.truth import Truth, check_target, completed, find_ptb_truth, find_truth, otb_targets

COLOR_FOLDERS = ("img", "color", "left", "rgb")  # OTB, VOT, stereo pairs, RGB-D recordings


class Layout(NamedTuple):
    """What a folder holds: the format's name, a stream a channel, the truth, what its user should know."""

    format: str
    channels: dict[str, Stream]
    truth: Truth | None = None
    notes: tuple[str, ...] = ()
    calibration: Path | None = None


def read_layout(folder: Path, scale: float | None, target: str | None = None) -> Layout:
    """The folder's channels and truth.

    scale: metres per unit of depth, where the format doesn't say it or the files don't keep to it. target:
    one of :func:`targets`; a KITTI sequence is cut to the frames in which it is labelled.
    ValueError names the folder or the file in it, and what was expected.
    """
    if target is not None:
        check_target(target, _all_targets(folder), folder)
    layout = _recognised(folder, scale, target)
    if layout.truth is not None:
        return layout
    color = layout.channels.get("color")
    table = find_table(folder, color.path if isinstance(color, Video) else None)
    if table is None:
        return layout
    truth = completed(read_table(table), folder)
    return layout._replace(truth=truth, notes=(*layout.notes, table_note(table)))


def table_note(table: Path) -> str:
    """Says where the truth is from: a table may be a tracker's, which is none."""
    return f"true boxes found: {table}"


def targets(folder: Path) -> tuple[str, ...]:
    """The names of a folder's targets where it has several: KITTI's labels of two frames and more, such as
    "Car 31", and the numbers of OTB's files of true boxes. ValueError names a malformed label.
    """
    names = _all_targets(folder)
    return names if len(names) > 1 or kitti.find_labels(folder) else ()


def depth_images(paths: Sequence[Path], scale: float | None) -> Images:
    """Images of depth; ValueError where their unit is needed and unknown. Princeton's are known by their
    names.
    """
    if len(images := princeton.named_images(paths)) == len(paths):
        return princeton.depth_images(images, scale)
    return Images(paths, read=DepthReader(known_scale(paths[0].parent, scale)))


def _all_targets(folder: Path) -> tuple[str, ...]:
    if labels := kitti.find_labels(folder):
        return tuple(label.name for label in kitti.read_labels(labels) if len(label.frames) > 1)
    return otb_targets(folder)


def _recognised(folder: Path, scale: float | None, target: str | None) -> Layout:
    """The layout, whose truth is that of its own format."""
    if channels := vot.channels(folder, scale):
        name = "VOT RGB-D" if "depth" in channels else "VOT"
        return Layout(name, channels, find_truth(folder, target))
    if tum.is_tum(folder):
        channels, notes = tum.channels(folder, scale)
        return Layout("TUM RGB-D", channels, notes=notes)
    if channels := princeton.channels(folder, scale):
        return Layout("Princeton", channels, find_ptb_truth(folder))
    if sequence := kitti.find_sequence(folder):
        name = "KITTI tracking" if sequence.tracking else "KITTI"
        channels, truth = kitti.channels(sequence, target)
        return Layout(name, channels, truth, calibration=sequence.calibration)
    return _plain(folder, scale, target)


def _plain(folder: Path, scale: float | None, target: str | None) -> Layout:
    """Images in a folder of a usual name or in the folder itself, or one video; depth in depth/, and right/
    beside left/.
    """
    truth = find_truth(folder, target)
    images = plain_images(folder)
    if images and is_depth(images[0]):
        return Layout("images", {"depth": depth_images(images, scale)}, truth)
    depth = image_paths(folder / "depth") if (folder / "depth").is_dir() else []
    channels: dict[str, Stream] = {}
    notes: tuple[str, ...] = ()
    if images:
        channels["color"] = _color_images(images)
        if images[0].parent == folder / "left" and (folder / "right").is_dir():
            channels["right"] = Images(image_paths(folder / "right"))
    elif video := _video(folder, optional=bool(depth)):
        channels["color"] = video
    if depth and channels and scale is None:
        unit = "--depth-scale gives its metres per unit, 0.001 for millimetres"
        notes = (f"left out {folder / 'depth'}: {unit}",)
    elif depth:
        channels["depth"] = depth_images(depth, scale)
    return _otb_range(folder, Layout(_plain_name(folder, channels), channels, truth, notes))


def plain_images(folder: Path) -> list[Path]:
    """The images in the folder of a usual name, else in the folder itself."""
    places = [folder / sub for sub in COLOR_FOLDERS if (folder / sub).is_dir()]
    return next((paths for place in (*places, folder) if (paths := image_paths(place))), [])


def _plain_name(folder: Path, channels: dict[str, Stream]) -> str:
    if "right" in channels:
        return "stereo pair"
    if isinstance(channels.get("color"), Video):
        return "video"
    return "OTB" if otb.is_otb(folder) else "images"


def _otb_range(folder: Path, layout: Layout) -> Layout:
    """The layout, without the images before and behind OTB's true boxes."""
    if layout.format != "OTB" or layout.truth is None or len(layout.channels) != 1:
        return layout
    color = layout.channels["color"]
    within = otb.cut(folder, color, len(layout.truth.boxes))
    if within is None:
        return layout
    ends = f"{within.paths[0].name} to {within.paths[-1].name}"
    note = f"took {len(within.paths)} of {color.length} images, {ends}, which OTB's true boxes are for"
    return layout._replace(channels={"color": within}, notes=(*layout.notes, note))


def _color_images(paths: Sequence[Path]) -> Images:
    images = princeton.named_images(paths)
    return timed_images(images) if len(images) == len(paths) else Images(paths)


def videos(folder: Path) -> list[Path]:
    """The video files of a folder, in natural order."""
    return natural_order(path for path in folder.iterdir() if is_video(path))


def _video(folder: Path, optional: bool) -> Video | None:
    found = videos(folder)
    if len(found) == 1:
        return Video(found[0])
    if optional and not found:
        return None
    got = f"{len(found)} videos; name one of them" if found else "neither images nor a video"
    raise ValueError(f"{folder}: expected a folder of images or a sequence, found {got}")
