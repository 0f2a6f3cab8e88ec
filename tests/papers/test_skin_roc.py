# SPDX-License-Identifier: MIT
import cv2
import numpy as np
import pytest
from tricue import kernels
from tricue.papers.roc import skin_roc

RNG = np.random.default_rng(5)
SKIN_COLOR = np.array([90, 120, 180])


def picture(share):
    """A picture with ``share`` of skin-colored pixels over random ones, and its mask."""
    mask = RNG.random((30, 40)) < share
    skin = np.clip(SKIN_COLOR + RNG.normal(0, 6, (30, 40, 3)), 0, 255)
    return np.where(mask[..., None], skin, RNG.integers(0, 256, (30, 40, 3))).astype(np.uint8), mask


PICTURES = [picture(0.3), picture(0.0), picture(0.6)]


@pytest.mark.parametrize("name", ["native", "reference"])
def test_curve_is_that_of_equation_10(name):
    """With one reference, each point counts the pixels with max(c) - max abs(c - c0) above its threshold."""
    curve = skin_roc(*zip(*PICTURES, strict=True), SKIN_COLOR.astype(np.uint8), kernel_set=name)
    colors = np.concatenate([image.reshape(-1, 3) for image, _ in PICTURES]) / 255.0
    mask = np.concatenate([mask.ravel() for _, mask in PICTURES])
    boundary = colors.max(axis=1) - np.abs(colors - SKIN_COLOR / 255.0).max(axis=1)
    for index in range(0, len(curve.thresholds), 7):
        above = boundary > curve.thresholds[index] + 1e-9  # the sums here round, those of integers do not
        assert curve.fpr[index] == np.mean(above[~mask])
        assert curve.tpr[index] == np.mean(above[mask])
    assert curve.area > 0.9


def test_the_brightest_may_be_the_images():
    """With the text's reading of (9), each point counts pixels by the image's largest channel; darker images
    have a lower one.
    """
    images = [
        (image * gain).astype(np.uint8) for (image, _), gain in zip(PICTURES, (1, 0.7, 0.4), strict=True)
    ]
    masks = [mask for _, mask in PICTURES]
    curve = skin_roc(images, masks, SKIN_COLOR.astype(np.uint8), brightest="image")
    boundary = np.concatenate(
        [
            (image.max() / 255.0 - np.abs(image / 255.0 - SKIN_COLOR / 255.0).max(axis=2)).ravel()
            for image in images
        ]
    )
    mask = np.concatenate([mask.ravel() for mask in masks])
    for index in range(0, len(curve.thresholds), 7):
        above = boundary > curve.thresholds[index] + 1e-9  # the sums here round, those of integers do not
        assert curve.fpr[index] == np.mean(above[~mask])
        assert curve.tpr[index] == np.mean(above[mask])


@pytest.mark.parametrize("name", ["native", "reference"])
def test_own_reference_leaves_out_pictures_without_skin(name):
    """Without a reference each picture takes its own skin's, and one that has no skin adds no negatives."""
    with_it = skin_roc(*zip(*PICTURES, strict=True), kernel_set=name)
    without = skin_roc(*zip(PICTURES[0], PICTURES[2], strict=True), kernel_set=name)
    np.testing.assert_array_equal(with_it.fpr, without.fpr)
    np.testing.assert_array_equal(with_it.tpr, without.tpr)
    assert with_it.area > 0.9


def test_classifier_tells_recorded_skin_from_the_rest(data):
    """On recorded pictures of many people the classifier is far from chance, with either reference."""
    folder = data / "skin"
    paths = sorted((folder / "image").iterdir())
    images = [cv2.imread(str(path)) for path in paths]
    masks = [cv2.imread(str(next((folder / "mask").glob(f"{path.stem}.*"))), 0) > 127 for path in paths]
    skin = np.concatenate([image[mask] for image, mask in zip(images, masks, strict=True)])
    shared = kernels.load("native").skin_reference(skin[None])
    assert skin_roc(images, masks, shared).area > 0.8
    assert skin_roc(images, masks).area > 0.7
