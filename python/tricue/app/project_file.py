# SPDX-License-Identifier: MIT
"""The file of a project, beside its video: read, written atomically, and tied to its video."""

import hashlib
import json
import math
import os
import sys
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from tricue.app.project import Project, ProjectTarget
from tricue.camera.box import Box, as_box
from tricue.camera.pose import Pose
from tricue.data.files import image_paths
from tricue.track.base.adapter import with_known_numbers
from tricue.track.base.track import Status, Track

SUFFIX = ".tricue.json"
FORMAT = 1
MAX_NAME_BYTES = 225  # of a project's file name: file systems allow 255, and some are added temporarily
SAMPLES, SAMPLE_BYTES = 16, 1 << 16  # of a video, to distinguish it from another of the same length
COLUMNS = "frame status score x y width height [X Y Z] [XX XY XZ YY YZ ZZ] depth"


@dataclass(frozen=True)
class Footprint:
    """Identifies a recording: its number of bytes, samples of them, its frames and their size."""

    name: str
    bytes: int
    modified: float
    sample: str
    frames: int
    width: int
    height: int

    def differences(self, before: "Footprint") -> list[str]:
        """The differences from an earlier footprint, in words; a different modification time isn't one."""
        found = []
        if self.frames != before.frames:
            found.append(f"{before.frames} frames then, {self.frames} now")
        if (self.width, self.height) != (before.width, before.height):
            found.append(f"{before.width}x{before.height} px then, {self.width}x{self.height} now")
        if self.bytes != before.bytes:
            found.append(f"{before.bytes:,} bytes then, {self.bytes:,} now")
        elif self.sample != before.sample:
            found.append("other contents of the same size")
        return found


def footprint(place: Path, frames: int, size: tuple[int, int]) -> Footprint:
    """The footprint of a video file or a folder; a folder's samples are its images' names and sizes."""
    stat = place.stat()
    if place.is_dir():
        files = image_paths(place) or sorted(each for each in place.rglob("*") if each.is_file())
        listed = [(file.name, file.stat().st_size) for file in files if not file.name.endswith(SUFFIX)]
        total, digest = sum(length for _, length in listed), hashlib.sha256(repr(listed).encode())
    else:
        total, digest = stat.st_size, hashlib.sha256()
        with place.open("rb") as file:
            for index in range(SAMPLES):
                file.seek(max(0, total - SAMPLE_BYTES) * index // (SAMPLES - 1))
                digest.update(file.read(SAMPLE_BYTES))
    return Footprint(
        readable(place.resolve().name),
        total,
        stat.st_mtime,
        digest.hexdigest()[:32],
        frames,
        size[0],
        size[1],
    )


def readable(name: Path | str) -> str:
    """The name of a file with a question mark for each byte that isn't UTF-8."""
    return str(name).encode(errors="replace").decode()


def path_beside(place: Path) -> Path:
    """The path of a recording's project beside it."""
    place = place.resolve()
    return place.with_name(place.name + SUFFIX)


def project_path(place: Path) -> Path:
    """The path of a recording's project: beside it, or in the user's data folder if that isn't writable."""
    beside = path_beside(place)
    fits = len(os.fsencode(beside.name)) <= MAX_NAME_BYTES
    if fits and all(os.access(each, os.W_OK) for each in (beside.parent, beside) if each.exists()):
        return beside
    place = place.resolve()
    key = hashlib.sha256(str(place).encode(errors="surrogateescape")).hexdigest()[:12]
    return data_folder() / (f"{place.name}-{key}{SUFFIX}" if fits else key + SUFFIX)


def data_folder() -> Path:
    """The user's data folder for tricue, created if missing."""
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = Path(os.environ.get("XDG_DATA_HOME") or Path.home() / ".local" / "share")
    folder = base / "tricue"
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def load(path: Path, pose: Pose | None = None) -> tuple[Project, Footprint]:
    """A project and the footprint of its video; ValueError for a file that isn't a project.

    pose: the camera's, added to tracks with a position.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["format"] <= FORMAT:
            targets = tuple(_target(each, pose) for each in content["targets"])
            ids, next_id = [each.id for each in targets], int(content["next_id"])
            if len({*ids}) < len(ids) or not all(0 < each < next_id for each in ids):
                raise ValueError(f"expected different ids from 1 to before {next_id}, got {ids}")
            return Project(targets, next_id), Footprint(**content["video"])
        newer = content["tricue"]
    except (AttributeError, KeyError, TypeError, IndexError, OverflowError, ValueError) as error:
        raise ValueError(
            f"{path}: expected a project of tricue open, can't read it; rename it to start over ({error!r})"
        ) from None
    raise ValueError(f"{path}: written by a newer tricue ({newer}); update this one")


def save(path: Path, project: Project, video: Footprint) -> None:
    """Write the project atomically: the file has all of it, or stays as it was."""
    path = path.resolve()  # a link stays a link
    part = path.with_name(f".{path.name}.part")
    try:
        with part.open("w", encoding="utf-8") as file:
            file.writelines(_lines(project, video))
            file.flush()
            os.fsync(file.fileno())
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def put_aside(path: Path) -> Path:
    """Rename a project that must not be overwritten; return its new path."""
    count = 1
    while (kept := path.with_name(path.name.removesuffix(SUFFIX) + f".{count}{SUFFIX}")).exists():
        count += 1
    return path.rename(kept)


def _lines(project: Project, video: Footprint) -> Iterator[str]:
    """The file's text: one line per entry and per track."""
    import tricue

    yield f'{{\n "tricue": {json.dumps(tricue.__version__)},\n "format": {FORMAT},\n'
    yield f' "video": {json.dumps(asdict(video), ensure_ascii=False)},\n'
    yield f' "next_id": {project.next_id},\n "columns": {json.dumps(COLUMNS)},\n "targets": ['
    for index, target in enumerate(project.targets):
        name = json.dumps(target.name, ensure_ascii=False)
        yield f'{"," * (index > 0)}\n  {{"id": {target.id}, "name": {name}'
        yield f', "tracker": {json.dumps(target.tracker)},\n   "drawn": {{'
        yield ", ".join(f'"{at}": {json.dumps(_rounded(box))}' for at, box in sorted(target.drawn.items()))
        yield f'}},\n   "untracked": {json.dumps(sorted(target.untracked))},\n   "tracks": ['
        rows = (json.dumps(row(at, track)) for at, track in sorted(target.tracks.items()))
        yield ",".join(f"\n    {text}" for text in rows) + "\n   ]}"
    yield "\n ]\n}\n"


def row(frame: int, track: Track) -> list[Any]:
    """A track's values in the file, without missing ones at the end."""
    values: list[Any] = [frame, str(track.status), round(track.score, 6), *_rounded(track.box)]
    if track.position is None and track.depth is None:
        return values
    position = None if track.position is None else _rounded(track.position.tolist())
    triangle = None
    if track.covariance is not None:
        triangle = [float(f"{value:.6g}") for value in track.covariance[np.triu_indices(3)]]
    return [*values, position, triangle, None if track.depth is None else round(track.depth, 6)]


def _rounded(numbers: Any) -> list[float]:
    return [round(float(number), 6) for number in numbers]


def _target(entry: Mapping[str, Any], pose: Pose | None) -> ProjectTarget:
    drawn = {_frame(at): as_box(box) for at, box in entry["drawn"].items()}
    tracks = {_frame(values[0]): _track(values, pose) for values in entry["tracks"]}
    untracked = map(_frame, entry.get("untracked", ()))  # older files lack it
    return ProjectTarget(
        int(entry["id"]),
        str(entry["name"]),
        str(entry["tracker"]),
        MappingProxyType(drawn),
        MappingProxyType(tracks),
        frozenset(untracked).intersection(drawn),
    )


def _frame(value: Any) -> int:
    number = int(value)
    if number < 0:
        raise ValueError(f"expected the number of a frame, got {value}")
    return number


def _track(values: list[Any], pose: Pose | None) -> Track:
    _, status, score, *box = values[:7]
    position, triangle, depth = values[7:10] if len(values) > 7 else (None, None, None)
    covariance = None
    if triangle is not None:
        covariance = np.zeros((3, 3))
        covariance[np.triu_indices(3)] = triangle
        covariance = covariance + np.triu(covariance, 1).T
    numbers = [float(score), *map(float, box)]
    if not all(map(math.isfinite, numbers)):
        raise ValueError(f"expected a finite score and box, got {values[2:7]}")
    track = Track(
        Box(*numbers[1:]),
        numbers[0],
        Status(status),
        None if position is None else np.array(position, np.float64).reshape(3),
        covariance,
        None if depth is None else float(depth),
        pose,
    )
    return with_known_numbers(track, track.box)
