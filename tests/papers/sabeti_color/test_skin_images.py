# SPDX-License-Identifier: MIT
"""Folders of images and skin masks: two layouts, and every way in which one can be wrong."""

import cv2
import numpy as np
import pytest
from tricue.papers.sabeti_color.skin_images import RenderedSkin, SkinFolder

IMAGE = np.arange(12 * 16 * 3, dtype=np.uint8).reshape(12, 16, 3)
LEVELS = np.tile(np.array([0, 127, 128, 255], np.uint8), (12, 4))


@pytest.fixture
def folder(tmp_path):
    """Two images and masks."""
    for name in ("images", "masks"):
        (tmp_path / name).mkdir()
    for name in ("2", "10"):
        cv2.imwrite(str(tmp_path / "images" / f"{name}.png"), IMAGE)
        cv2.imwrite(str(tmp_path / "masks" / f"{name}.bmp"), LEVELS)
    return tmp_path


def test_both_layouts_are_read(folder):
    """images and masks, or image and mask; suffixes may differ, levels of 128 are skin; as often as asked."""
    for rename in (False, True):
        if rename:
            (folder / "images").rename(folder / "image")
            (folder / "masks").rename(folder / "mask")
        images = SkinFolder(folder)
        assert len(images) == 2
        for _ in range(2):
            for image, mask in images:
                np.testing.assert_array_equal(image, IMAGE)
                np.testing.assert_array_equal(mask, LEVELS >= 128)


def remove_mask(folder):
    """An image has no mask."""
    (folder / "masks" / "10.bmp").unlink()


def remove_image(folder):
    """A mask has no image."""
    (folder / "images" / "10.png").unlink()


def remove_all(folder):
    """Both folders are empty."""
    for path in [*folder.glob("*/*.*")]:
        path.unlink()


def remove_masks(folder):
    """There is no folder of masks."""
    for path in (folder / "masks").iterdir():
        path.unlink()
    (folder / "masks").rmdir()


def double_mask(folder):
    """A name has two masks."""
    cv2.imwrite(str(folder / "masks" / "10.png"), LEVELS)


def shrink_mask(folder):
    """A mask has another size."""
    cv2.imwrite(str(folder / "masks" / "10.bmp"), LEVELS[:6])


def break_image(folder):
    """An image is no image."""
    (folder / "images" / "10.png").write_bytes(b"not an image")


def break_mask(folder):
    """A mask is no image."""
    (folder / "masks" / "10.bmp").write_bytes(b"BM")


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (remove_mask, r"images.10\.png: expected a mask of the same name in .*masks, found none"),
        (remove_image, r"masks.10\.bmp: expected an image of the same name in .*images, found none"),
        (remove_all, r"images: expected images, found none"),
        (remove_masks, r"expected the folders image and mask in it"),
        (double_mask, r"masks.10\.png: expected one image of this name, got also 10\.bmp"),
        (shrink_mask, r"masks.10\.bmp: expected a mask of 16x12 pixels, as 10\.png has, got 16x6"),
        (break_image, r"images.10\.png: expected an image, this file can't be read as one"),
        (break_mask, r"masks.10\.bmp: expected an image, this file can't be read as one"),
    ],
)
def test_bad_folders_name_the_file(folder, spoil, words):
    """Each mistake is a ValueError that begins with the path of the file, or of the folder."""
    spoil(folder)
    with pytest.raises(ValueError, match=words) as error:
        list(SkinFolder(folder))
    assert str(error.value).startswith(str(folder))


def test_missing_folder_is_named(tmp_path):
    """A folder that isn't there is a FileNotFoundError."""
    with pytest.raises(FileNotFoundError, match="nowhere: expected a folder"):
        SkinFolder(tmp_path / "nowhere")


def test_rendered_images_are_rendered_once():
    """Iterating again gives the very same arrays."""
    images = RenderedSkin(1)
    ((first, mask),), ((again, _),) = list(images), list(images)
    assert first is again
    assert 0.02 < mask.mean() < 0.5
