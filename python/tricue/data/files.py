# SPDX-License-Identifier: MIT
"""Recognizes image and video files, mostly by their names, and sorts them in natural order."""

import re
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Literal

_IMAGE_SUFFIXES = {
    ".bmp",
    ".jp2",
    ".jpeg",
    ".jpg",
    ".pbm",
    ".pgm",
    ".png",
    ".pnm",
    ".ppm",
    ".tif",
    ".tiff",
    ".webp",
}
_LOSSY_SUFFIXES = {".jp2", ".jpeg", ".jpg", ".webp"}
_VIDEO_SUFFIXES = {".avi", ".m4v", ".mkv", ".mov", ".mp4", ".mpeg", ".mpg", ".ogv", ".webm", ".wmv"}
_OTHER_VIDEO_SUFFIXES = {
    ".3g2",
    ".3gp",
    ".asf",
    ".f4v",
    ".flv",
    ".gif",
    ".m2ts",
    ".m2v",
    ".mjpeg",
    ".mjpg",
    ".mts",
    ".mxf",
    ".ts",
    ".vob",
    ".y4m",
}
"""Suffixes of videos, but also of previews beside a video, of other files, and of cameras' streams."""

_NUMBER = re.compile(r"([0-9]{10,}\.[0-9]+|[0-9]+)")
"""A time since 1970 with decimals, in seconds or a smaller unit, or a whole number."""

_HEAD = 1 << 16  # bytes of a file that are read to recognize animations

_JPEG_FRAMES = set(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC}
"""The markers of a JPEG file's segments that begin with the image's size."""


def listed_path(folder: Path, name: str, list_file: Path) -> Path:
    """The path of a file that a list names; ValueError for one outside the folder."""
    name = name.replace("\\", "/")  # lists that were written on Windows
    if Path(name).is_absolute() or ".." in Path(name).parts:
        raise ValueError(f"{list_file}: expected files below its folder, got {name!r:.80}")
    return folder / name


def image_paths(folder: Path) -> list[Path]:
    """The image files in a folder, in natural order: 2.png before 10.png. Hidden files are left out."""
    paths = (p for p in folder.iterdir() if is_image(p) and not p.name.startswith("."))
    return natural_order(paths)


def without_copies(paths: list[Path]) -> list[Path]:
    """The images without those that are there in another format, too: 1.png and not 1.jpg.

    Of a name's formats, that of the most images is kept; of equally many, one that doesn't lose anything.
    """
    names = Counter(path.stem for path in paths)
    if len(names) == len(paths):
        return paths
    formats = Counter(path.suffix.lower() for path in paths)

    def rank(path: Path) -> tuple[int, bool, str]:
        suffix = path.suffix.lower()
        return -formats[suffix], suffix in _LOSSY_SUFFIXES, path.name

    best = {path.stem: path for path in sorted(paths, key=rank, reverse=True)}
    return [path for path in paths if best[path.stem] == path]


def natural_order(paths: Iterable[Path]) -> list[Path]:
    """The paths, sorted by the numbers in their names: 2.png before 10.png."""
    return sorted(paths, key=lambda path: [_natural(part) for part in path.parts])


def is_image(path: Path) -> bool:
    """Whether the file's suffix is that of an image."""
    return path.suffix.lower() in _IMAGE_SUFFIXES


def has_several_pictures(path: Path) -> bool:
    """Whether an image file is an animation in WebP or PNG, or has several pages in TIFF."""
    with path.open("rb") as file:
        head = file.read(_HEAD)
        if head.startswith(b"RIFF"):
            return b"ANIM" in head[:64]
        if head.startswith(b"\x89PNG"):
            return b"acTL" in head.partition(b"IDAT")[0]
        if not head.startswith((b"II*\0", b"MM\0*")):
            return False
        order: Literal["little", "big"] = "little" if head.startswith(b"II") else "big"

        def number(place: int, size: int) -> int:
            file.seek(place)
            return int.from_bytes(file.read(size), order)

        page = number(4, 4)
        return number(page + 2 + 12 * number(page, 2), 4) > 0  # where the next page is


def stated_size(path: Path) -> tuple[int, int] | None:
    """Width and height in the header of a PNG or JPEG file, before a turn by EXIF data.

    None for other files, and for those that can't be read.
    """
    try:
        with path.open("rb") as file:
            head = file.read(24)
            if head.startswith(b"\x89PNG"):
                return int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")
            place = 2 if head.startswith(b"\xff\xd8") else -1
            while place > 0:  # from one segment of a JPEG file to the next
                file.seek(place)
                head = file.read(9)
                if len(head) < 9 or head[0] != 0xFF:
                    return None
                if head[1] in _JPEG_FRAMES:
                    return int.from_bytes(head[7:9], "big"), int.from_bytes(head[5:7], "big")
                place += 2 + int.from_bytes(head[2:4], "big")
    except OSError:
        pass
    return None


def is_video(path: Path) -> bool:
    """Whether the file has a suffix that only videos have."""
    return path.suffix.lower() in _VIDEO_SUFFIXES


def may_be_video(path: Path) -> bool:
    """Whether the file has a suffix that videos and other files have."""
    return is_video(path) or path.suffix.lower() in _OTHER_VIDEO_SUFFIXES


def video_paths(folder: Path) -> list[Path]:
    """The video files in a folder, in natural order; if there are none, those that may be videos.

    Hidden files are left out.
    """
    paths = [path for path in folder.iterdir() if not path.name.startswith(".")]
    others = (path for path in paths if path.suffix.lower() in _OTHER_VIDEO_SUFFIXES and path.is_file())
    return natural_order(filter(is_video, paths)) or natural_order(others)


def _natural(name: str) -> list[tuple[int, str]]:
    """The sort key of a name: its texts and numbers in turn.

    A number's decimals are compared as digits, as Python writes times without trailing zeros: .5 comes after
    .123.
    """
    parts = enumerate(_NUMBER.split(name))  # every other part is a number
    return [_number(part) if index % 2 else (-1, part) for index, part in parts]


def _number(text: str) -> tuple[int, str]:
    whole, _, decimals = text.partition(".")
    return int(whole), decimals
