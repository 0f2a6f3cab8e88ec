# SPDX-License-Identifier: MIT
"""The experiment sabeti-roc, on a folder of made images."""

import csv
import re

import cv2
import numpy as np
import pytest
from tricue import ColorParticleTracker, reference
from tricue.cli.program import main
from tricue.papers import reproduce
from tricue.papers.sabeti_color.skin_threshold import DEFAULT_THRESHOLD

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install tricue[demo]")

SKIN = np.array([120, 150, 220])


@pytest.fixture
def folder(tmp_path):
    """Four images of skin over random colors, and their masks; one has no skin."""
    rng = np.random.default_rng(2)
    for name in ("images", "masks"):
        (tmp_path / "data" / name).mkdir(parents=True)
    for index, share in enumerate((0.3, 0.0, 0.5, 0.2)):
        mask = rng.random((40, 50)) < share
        skin = np.clip(SKIN + rng.normal(0, 12, (40, 50, 3)), 0, 255)
        image = np.where(mask[..., None], skin, rng.integers(0, 256, (40, 50, 3))).astype(np.uint8)
        cv2.imwrite(str(tmp_path / "data" / "images" / f"{index}.png"), image)
        cv2.imwrite(str(tmp_path / "data" / "masks" / f"{index}.png"), 255 * mask.astype(np.uint8))
    return tmp_path / "data"


def test_the_threshold_keeps_the_rate_and_sets_the_tracker(folder, tmp_path):
    """The summary's threshold is the lowest of the CSV that keeps the rate, and the tracker takes it."""
    report = reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder, rate=0.02)
    (text,) = re.findall(r"--tracker color-particle --set (skin_threshold=\S+)", report.summary)
    threshold = float(text.partition("=")[2])
    with report.table.open() as file:
        rows = [row for row in csv.DictReader(file) if row["reference"] == "each image's own"]
    kept = [float(row["threshold"]) for row in rows if float(row["false_positive_rate"]) <= 0.02]
    assert threshold == pytest.approx(min(kept), abs=5e-4)
    assert ColorParticleTracker(skin_threshold=threshold).params.skin_threshold == threshold
    assert "| each image's own | 3 |" in report.summary  # an image without skin has no color of its own
    assert "| one for all | 4 |" in report.summary
    (row,) = re.findall(r"\| own, η of the image \| 3 \| .*", report.summary)  # no default: no tracker has it
    assert "default" not in row
    image = cv2.imread(str(report.figure))
    assert image.shape[1] > 1000
    assert image.std() > 20


def test_rates_are_those_that_the_tracker_has(folder, tmp_path):
    """Of the default, which lies between two levels, and of the option in the last line."""
    report = reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder, rate=0.02)
    rows = [line.split(" | ") for line in report.summary.splitlines() if "each image's own" in line]
    option = float(report.summary.rpartition("=")[2])
    called, total = np.zeros((2, 2)), np.zeros(2)
    for path in sorted((folder / "images").iterdir()):
        image = cv2.imread(str(path))
        mask = cv2.imread(str(folder / "masks" / path.name), cv2.IMREAD_GRAYSCALE) > 0
        if not mask.any():
            continue
        boundary = reference.skin_boundary(image, reference.skin_reference(image[mask][None]))
        total += np.count_nonzero(mask), np.count_nonzero(~mask)
        for index, threshold in enumerate((option, DEFAULT_THRESHOLD)):
            skin = boundary > 255 * threshold
            called[index] += np.count_nonzero(skin & mask), np.count_nonzero(skin & ~mask)
    printed = [[float(row[4]), float(row[5].rstrip(" |"))] for row in rows]
    np.testing.assert_allclose(printed, called / total, atol=5e-4)


def test_any_false_positives_give_a_threshold_that_the_tracker_takes(folder, tmp_path):
    """The lowest threshold of a curve is below the range of the parameter."""
    report = reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder, rate=1)
    assert report.summary.endswith("--set skin_threshold=-1.000")


def test_an_output_that_can_not_be_written_is_told_first(folder, tmp_path):
    """Before the images are read."""
    (tmp_path / "out").touch()
    calls = []
    with pytest.raises(OSError, match="Not a directory"):
        reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder, progress=lambda *n: calls.append(n))
    assert not calls


def test_nothing_is_written_of_a_folder_with_a_mistake(folder, tmp_path, capsys):
    """An image that can't be read, the last one, is one line of error, and no output folder is made."""
    (folder / "images" / "3.png").write_bytes(b"nothing")
    code = main(["reproduce", "sabeti-roc", "--data", str(folder), "--output", str(tmp_path / "out")])
    assert code == 2
    assert re.search(r"images.3\.png: expected an image", capsys.readouterr().err)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("level", "found"), [(0, "no skin"), (255, "only skin")])
def test_masks_of_one_kind_are_refused(folder, tmp_path, level, found):
    """Without any skin, or anything else, there is no curve; the error names the folder."""
    for path in (folder / "masks").iterdir():
        cv2.imwrite(str(path), np.full((40, 50), level, np.uint8))
    with pytest.raises(
        ValueError, match=f"data: masks: expected skin and other pixels, found {found}"
    ) as error:
        reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder)
    assert str(error.value).startswith(str(folder))
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("rate", [-0.1, 1.5, float("nan")])
def test_bad_rates_are_named(folder, tmp_path, rate):
    """A rate that is no share is refused before anything is read."""
    with pytest.raises(ValueError, match="rate: expected a share"):
        reproduce.run("sabeti-roc", output=tmp_path / "out", data=folder, rate=rate)


def test_recorded_images_are_read(data, tmp_path):
    """The recorded images with masks, of the layout image and mask, give the curve that the docs report."""
    report = reproduce.run("sabeti-roc", output=tmp_path, data=data / "skin")
    assert re.search(r"\| one for all \| 86 \| 0\.8\d+ \|", report.summary)
