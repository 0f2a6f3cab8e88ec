# SPDX-License-Identifier: MIT
"""Error curves: what an experiment measures, as a table and as a CSV."""

import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

LOST = 25.0  # pixels; a face further off than this is counted as lost


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One model on one scene: two numbers a frame."""

    model: str
    scene: str
    seed: int
    errors: NDArray[np.float64]
    """(M,) center errors in pixels."""
    overlaps: NDArray[np.float64]
    """(M,) intersection over union."""
    boxes: NDArray[np.float64]
    """(M, 4)"""


def summarize(curves: Sequence[Curve]) -> str:
    """Markdown, a line per model: mean error ± its spread over runs, share of frames lost, of frames held."""
    lines = [
        "| model | mean error px | frames > 25 px off | frames IoU > 0.5 | runs |",
        "| --- | --- | --- | --- | --- |",
    ]
    for model in dict.fromkeys(curve.model for curve in curves):
        errors = np.stack([curve.errors for curve in curves if curve.model == model])
        overlaps = np.stack([curve.overlaps for curve in curves if curve.model == model])
        spread = f"{errors.mean():.1f} ± {errors.mean(axis=1).std():.1f}"
        shares = f"{np.mean(errors > LOST):.1%} | {np.mean(overlaps > 0.5):.1%}"
        lines.append(f"| {model} | {spread} | {shares} | {len(errors)} |")
    return "\n".join(lines)


def write_csv(path: Path, curves: Iterable[Curve]) -> None:
    """A line per model, scene, seed and frame."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["model", "scene", "seed", "frame", "error_px", "iou"])
        for curve in curves:
            for frame, (error, overlap) in enumerate(zip(curve.errors, curve.overlaps, strict=True)):
                writer.writerow(
                    [curve.model, curve.scene, curve.seed, frame, f"{error:.3f}", f"{overlap:.4f}"]
                )
