# SPDX-License-Identifier: MIT
"""Recorded sequences with true boxes, decoded before they are measured on."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tricue.camera.frame import Frame
from tricue.camera.intrinsics_files import read_intrinsics
from tricue.camera.rig import Intrinsics
from tricue.camera.sources import Source, open_source
from tricue.camera.truth import OTB, VOT

DEPTHS = "position_z_mm.txt"  # a line a frame, the target's median depth in millimetres


@dataclass(frozen=True, slots=True, eq=False)
class Sequence:
    """Decoded frames, and a true box for each, (M, 4) pixels counted from 0; NaN in frames without truth."""

    name: str
    frames: tuple[Frame, ...]
    truth: NDArray[np.float64]
    depths: NDArray[np.float64]
    """(M,) true depths of the target, metres; NaN where unknown."""
    intrinsics: Intrinsics | None = None
    """The depth camera's, where the sequence has depth and a calibration beside it."""


def data_folder() -> Path:
    """Where recorded data is looked for: the environment's TRICUE_DATA, else ../shared/data."""
    return Path(os.environ.get("TRICUE_DATA", "../shared/data"))


def find(root: Path) -> list[Path]:
    """The sequence folders directly under ``root`` that hold true boxes, by name."""
    return sorted({path.parent for name in (OTB, VOT) for path in root.glob(f"*/{name}")})


def load(folder: Path) -> Sequence:
    """Decode a whole sequence into memory. ValueError where it has no true box in its first frame."""
    source = open_source(folder)
    if source.truth is None or source.first_box is None:
        raise ValueError(f"{folder}: expected a true box in the first frame")
    frames = tuple(source)
    truth = _for_each(frames, source.truth)
    return Sequence(source.name, frames, truth, _for_each(frames, _depths(folder)), _intrinsics(source))


def _for_each(frames: tuple[Frame, ...], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """A row a frame: those of ``values`` that are there, NaN for the others."""
    rows = np.full((len(frames), *values.shape[1:]), np.nan)
    known = values[: len(frames)]
    rows[: len(known)] = known
    return rows


def _depths(folder: Path) -> NDArray[np.float64]:
    path = folder / DEPTHS
    return np.loadtxt(path, ndmin=1) / 1000 if path.is_file() else np.empty(0)


def _intrinsics(source: Source) -> Intrinsics | None:
    if source.calibration is None or "depth" not in source.channels:
        return None
    return read_intrinsics(source.calibration, source.size, "depth")
