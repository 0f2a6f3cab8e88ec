# SPDX-License-Identifier: MIT
"""The attributes of a sequence, measured once and stored beside the runs."""

import hashlib
import json
import math
import os
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.arrays import Floats
from tricue.draw.writable import naming
from tricue.evaluation.attributes.definitions import ATTRIBUTES, BY_KEY
from tricue.evaluation.attributes.depth_values import depth_values
from tricue.evaluation.attributes.image_values import image_values
from tricue.evaluation.attributes.truth_values import truth_values
from tricue.evaluation.dataset import OpenedSequence

FOLDER = "attributes"  # in an evaluation's folder


@dataclass(frozen=True, slots=True, eq=False)
class SequenceAttributes:
    """A sequence's attributes. values: (M,) for the labeled frames, by attribute key; NaN where unknown."""

    values: Mapping[str, Floats]

    def known(self, key: str) -> int:
        """The number of frames in which an attribute is known."""
        values = self.values.get(key)
        return 0 if values is None else int((~np.isnan(values)).sum())

    def share(self, key: str) -> float:
        """The share of those frames that have it; NaN without any."""
        known = self.known(key)
        return float(BY_KEY[key].flags(self.values[key]).sum()) / known if known else math.nan

    def has(self, key: str) -> bool:
        """Whether the sequence has it; False if unknown."""
        return self.share(key) > BY_KEY[key].share

    def flags(self, key: str, frames: NDArray[np.intp]) -> NDArray[np.bool_]:
        """Which of the frames with these numbers have it; False beyond the labels."""
        values = self.values.get(key)
        if values is None:
            return np.zeros(len(frames), np.bool_)
        flags = BY_KEY[key].flags(values)
        return np.asarray(np.where(frames < len(flags), flags[np.minimum(frames, len(flags) - 1)], False))


def measure(opened: OpenedSequence) -> SequenceAttributes:
    """Read the whole sequence once. ValueError or OSError if that can't be done."""
    boxes = opened.boxes[: opened.frames]
    depth = opened.channel == "depth" or ("depth" in opened.channels and opened.registered)
    color = opened.channel == "color"
    found = truth_values(opened)
    if color and depth:
        # each reads the frames anew, because keeping them for both would hold all of them in memory
        found |= image_values(opened.source, boxes) | depth_values(opened.source, boxes)
    elif color:
        found |= image_values(opened.source, boxes)
    elif depth:
        found |= depth_values(opened.source, boxes)
    return SequenceAttributes({each.key: found[each.key] for each in ATTRIBUTES if each.key in found})


def measure_all(
    opened: Sequence[OpenedSequence],
    folder: Path,
    on_progress: Callable[[int], None] = lambda _: None,
) -> dict[str, SequenceAttributes]:
    """The attributes by sequence name: read from the evaluation's folder, or measured and stored there.

    A sequence that can't be read is left out; OSError if its attributes can't be stored. on_progress: called
    with the number of finished sequences.
    """
    found = {}
    for done, each in enumerate(opened, 1):
        name = each.entry.name
        path = folder / FOLDER / f"{re.sub(r'[^A-Za-z0-9._-]', _escaped, name)}.json"
        fingerprint = hashlib.sha256(f"{each.digest}\n{_code_digest()}".encode()).hexdigest()
        if (stored := _stored(path, fingerprint)) is not None:
            found[name] = stored
        else:
            with suppress(OSError, ValueError):  # its runs say why
                found[name] = measure(each)
            if name in found:
                _store(path, fingerprint, name, found[name])
        on_progress(done)
    return found


def _stored(path: Path, fingerprint: str) -> SequenceAttributes | None:
    """What an earlier evaluation stored; None if there is nothing, or if its fingerprint differs."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        if content["fingerprint"] == fingerprint:
            stored = content["values"].items()
            return SequenceAttributes({key: np.array(each, np.float64) for key, each in stored})
    except (OSError, ValueError, KeyError, TypeError):
        pass  # missing, truncated, or of another version
    return None


def _store(path: Path, fingerprint: str, name: str, found: SequenceAttributes) -> None:
    values = {
        key: [None if math.isnan(value) else value for value in each.tolist()]
        for key, each in found.values.items()
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_suffix(f".{os.getpid()}.part")
    text = json.dumps({"fingerprint": fingerprint, "sequence": name, "values": values})
    with naming(path):
        part.write_text(f"{text}\n", encoding="utf-8")
        part.replace(path)


def _escaped(found: re.Match[str]) -> str:
    return f"%{ord(found[0]):02X}"


@cache
def _code_digest() -> str:
    found = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*_values.py")):
        found.update(path.read_bytes())
    return found.hexdigest()
