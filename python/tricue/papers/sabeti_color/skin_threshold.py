# SPDX-License-Identifier: MIT
"""The skin classifier's threshold from its ROC curve: Sabeti, Parvizi, Wu (2008), section III.A, (10)."""

import csv
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tricue import kernels
from tricue.arrays import Image
from tricue.draw import figures
from tricue.draw.writable import check_writable, naming
from tricue.papers import tables
from tricue.papers.experiment import Report
from tricue.papers.plots import show_frame
from tricue.papers.roc import LOWEST_SKIN_THRESHOLD, Brightest, Roc, round_up, skin_roc
from tricue.papers.sabeti_color.skin_images import Mask, RenderedSkin, SkinFolder, SkinImages
from tricue.track.color_particle.params import ColorParticleParams

NAME = "sabeti-roc"
MAX_FALSE_POSITIVES = 0.1
"""Default share of the other pixels that may be classified as skin."""
COLUMNS = ("reference color", "images", "area", "threshold", "true-positive rate", "false-positive rate")
CSV_COLUMNS = ("reference", "threshold", "false_positive_rate", "true_positive_rate")
PICTURES = 6
OWN, SHARED, IMAGE_MAXIMUM = "each image's own", "one for all", "own, η of the image"
DEFAULT_THRESHOLD = ColorParticleParams().skin_threshold
TINTS = {"right": (90, 190, 0), "false": (40, 40, 240), "missed": (240, 130, 0)}  # BGR, over pixels


class _Chosen(NamedTuple):
    """A curve and the threshold chosen on it."""

    curve: Roc
    threshold: float
    tpr: float

    @property
    def fpr(self) -> float:
        return self.rates(self.threshold)[0]

    def rates(self, threshold: float) -> tuple[float, float]:
        """False- and true-positive rates at a threshold; between two levels it acts as the lower one."""
        index = int(np.argmax(self.curve.thresholds <= threshold))
        return float(self.curve.fpr[index]), float(self.curve.tpr[index])


def run(
    output: Path,
    data: Path | None = None,
    rate: float = MAX_FALSE_POSITIVES,
    count: int = 20,
    progress: Callable[[int, int], None] | None = None,
) -> Report:
    """Write ``output/sabeti-roc.png`` and ``output/sabeti-roc.csv``, a line per reference and threshold.

    data: a folder of images and masks (:class:`SkinFolder`); None: ``count`` rendered images. rate: the
    greatest false-positive rate, 0 to 1. Nothing is written before all images are read. ValueError or OSError
    says what is wrong with a file or an argument; ImportError names the missing extra.
    """
    if not 0 <= rate <= 1:
        raise ValueError(f"rate: expected a share, 0 to 1, got {rate}")
    figures.require()
    for suffix in (".png", ".csv"):  # check before reading the images, which may be many
        check_writable(output / f"{NAME}{suffix}")
    images: SkinImages = RenderedSkin(count) if data is None else SkinFolder(data)
    try:
        with_skin, shared = _shared_color(images, progress)
        curves = {
            OWN: _curve(images, None),
            SHARED: _curve(images, shared),
            IMAGE_MAXIMUM: _curve(images, None, "image"),
        }
    except ValueError as error:
        if str(error).startswith("masks:"):  # of all, not of one file
            raise ValueError(f"{data}: {error}") from None
        raise
    chosen = {
        name: _Chosen(curve, *curve.at_false_positive_rate(rate, LOWEST_SKIN_THRESHOLD))
        for name, curve in curves.items()
    }
    pictures = list(islice(((image, mask) for image, mask in images if mask.any()), PICTURES))
    report = Report(
        _summarize(chosen, len(images), with_skin, rate), output / f"{NAME}.png", output / f"{NAME}.csv"
    )
    output.mkdir(parents=True, exist_ok=True)
    figures.save(partial(_draw, pictures, images.title), [*chosen.items()], {}, report.figure)
    _write_csv(report.table, curves)
    return report


def _shared_color(
    images: SkinImages, progress: Callable[[int, int], None] | None
) -> tuple[int, NDArray[np.uint8]]:
    """How many images have skin, and the most frequent color (3) of all skin."""
    skins: list[Image] = []
    for done, (image, mask) in enumerate(images, start=1):
        if mask.any():
            skins.append(image[mask])
        if progress:
            progress(done, len(images))
    if not skins:
        raise ValueError("masks: expected skin and other pixels, found no skin")
    return len(skins), kernels.load("native").skin_reference(np.concatenate(skins)[None])


def _curve(images: SkinImages, reference: NDArray[np.uint8] | None, brightest: Brightest = "pixel") -> Roc:
    pictures, masks = (image for image, _ in images), (mask for _, mask in images)
    return skin_roc(pictures, masks, reference, brightest=brightest)


def _summarize(chosen: Mapping[str, _Chosen], count: int, with_skin: int, rate: float) -> str:
    lines = tables.header(COLUMNS)
    for name, each in chosen.items():
        number = f"{count if name == SHARED else with_skin}"
        for threshold in _thresholds(name, each):
            fpr, tpr = each.rates(threshold)
            which = f"{round_up(threshold, 3):.3f}" + (" (default)" if threshold == DEFAULT_THRESHOLD else "")
            lines.append(
                tables.line([name, number, f"{each.curve.area:.3f}", which, f"{tpr:.3f}", f"{fpr:.3f}"])
            )
    threshold = round_up(chosen[OWN].threshold, 3)
    lines += [
        "",
        f"False-positive rate of at most {rate:g}, with a color of each target's own, as the tracker has:",
        f"tricue track VIDEO --tracker color-particle --set skin_threshold={threshold:.3f}",
    ]
    return "\n".join(lines)


def _thresholds(name: str, chosen: _Chosen) -> list[float]:
    """The threshold chosen on a curve, and the default, if the tracker classifies as the curve does."""
    return [chosen.threshold, *([] if name == IMAGE_MAXIMUM else [DEFAULT_THRESHOLD])]


def _write_csv(path: Path, curves: Mapping[str, Roc]) -> None:
    with naming(path), path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(CSV_COLUMNS)
        for reference, curve in curves.items():
            for values in zip(curve.thresholds, curve.fpr, curve.tpr, strict=True):
                writer.writerow([reference, *(f"{value:.5f}" for value in values)])


def _draw(
    pictures: Sequence[tuple[Image, Mask]],
    title: str,
    figure: Any,
    chosen: Sequence[tuple[str, _Chosen]],
    _scenes: Mapping[str, object],
) -> None:
    """Draw the curves with marked thresholds, and images with the skin pixels by their own color."""
    figure.set_size_inches(13, 5)
    left, right = figure.subfigures(1, 2, width_ratios=[1, 1.6])
    axes = left.subplots()
    for color, (name, each) in zip(figures.COLORS, chosen, strict=False):
        label = f"reference color: {name}, area {each.curve.area:.2f}"
        axes.plot(each.curve.fpr, each.curve.tpr, color=color, label=label)
        marks = (("o", f"threshold {each.threshold:.2f}"), ("x", "default"))
        for threshold, (marker, text) in zip(_thresholds(name, each), marks, strict=False):
            fpr, tpr = each.rates(threshold)
            axes.plot(fpr, tpr, marker, color=color, label=f"{text}: {tpr:.0%} of skin, {fpr:.0%} of others")
    axes.plot([0, 1], [0, 1], color="0.7", linewidth=0.8, linestyle=":")
    axes.set(xlabel="false-positive rate", ylabel="true-positive rate", xlim=(0, 1), ylim=(0, 1.01))
    axes.set_title(title, loc="left")
    axes.legend(frameon=False, loc="lower right", fontsize=8)
    (_, own), *_ = chosen
    panels = np.ravel(right.subplots(2, -(-PICTURES // 2)))
    for panel in panels:
        panel.axis("off")
    for panel, (image, mask) in zip(panels, pictures, strict=False):
        show_frame(panel, _overlay(image, mask, own.threshold), "")
    right.suptitle(
        f"own color, above {own.threshold:.2f}; green: skin, red: not skin; blue: skin that was missed"
    )


def _overlay(image: Image, mask: Mask, threshold: float) -> Image:
    """The image with tints over the pixels classified as skin, and over missed skin."""
    k = kernels.load("native")
    reference = k.skin_reference(np.ascontiguousarray(image[mask][None]))
    called = k.skin_boundary(image, reference) > 255 * threshold
    drawn = image.astype(np.float64)
    parts = {"right": called & mask, "false": called & ~mask, "missed": ~called & mask}
    for kind, part in parts.items():
        drawn[part] = 0.45 * drawn[part] + 0.55 * np.array(TINTS[kind])
    return np.asarray(drawn, np.uint8)
