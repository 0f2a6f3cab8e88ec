# SPDX-License-Identifier: MIT
"""Recorded color sequences with true boxes, decoded before anything is measured."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tricue.camera.frame import Frame
from tricue.data.open_source import open_source
from tricue.data.truth import OTB_TRUTH, VOT_TRUTH


@dataclass(frozen=True, slots=True, eq=False)
class Sequence:
    """Decoded frames, and a true box for each, (M, 4) pixels counted from 0; NaN in frames without truth."""

    name: str
    frames: tuple[Frame, ...]
    truth: NDArray[np.float64]


def data_folder() -> Path:
    """The folder of recorded data: TRICUE_DATA of the environment, else ../shared/data."""
    return Path(os.environ.get("TRICUE_DATA", "../shared/data"))


def find(root: Path) -> list[Path]:
    """The sequence folders directly under ``root`` that hold true boxes, by name."""
    return sorted({path.parent for name in (OTB_TRUTH, VOT_TRUTH) for path in root.glob(f"*/{name}")})


def load(folder: Path) -> Sequence:
    """Decode a whole sequence into memory. ValueError if its first frame has no true box."""
    source = open_source(folder)
    if source.truth is None or source.first_box is None:
        raise ValueError(f"{folder}: expected a true box in the first frame")
    frames = tuple(source)
    return Sequence(source.name, frames, _for_each(frames, source.truth))


def _for_each(frames: tuple[Frame, ...], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """A row per frame: those of ``values``, NaN after their end."""
    rows = np.full((len(frames), *values.shape[1:]), np.nan)
    known = values[: len(frames)]
    rows[: len(known)] = known
    return rows
