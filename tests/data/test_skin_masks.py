# SPDX-License-Identifier: MIT
"""Images with masks: paired by their names, and errors that name the file."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.data.skin_masks import find_masked_images, is_mask_folder


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Two images of 6x4 pixels, 2 and 10, with masks of another suffix that mark their left half."""
    for name in ("image", "mask"):
        (tmp_path / name).mkdir()
    for level, name in enumerate(("2", "10"), start=1):
        cv2.imwrite(str(tmp_path / "image" / f"{name}.bmp"), np.full((4, 6, 3), 50 * level, np.uint8))
        mask = np.zeros((4, 6), np.uint8)
        mask[:, :3] = 255
        cv2.imwrite(str(tmp_path / "mask" / f"{name}.png"), mask)
    return tmp_path


def test_images_come_with_their_masks_in_natural_order(folder):
    """2 comes before 10, each with its own mask, True where that is white."""
    pairs = [pair.read() for pair in find_masked_images(folder)]
    assert [image[0, 0, 0] for image, _ in pairs] == [50, 100]
    for image, mask in pairs:
        assert image.shape == (4, 6, 3)
        assert mask.dtype == np.bool_
        np.testing.assert_array_equal(mask, np.arange(6)[None].repeat(4, 0) < 3)


def test_folders_may_have_plural_names(folder):
    """images/ and masks/ are taken, too."""
    (folder / "image").rename(folder / "images")
    (folder / "mask").rename(folder / "masks")
    assert is_mask_folder(folder)
    assert len(find_masked_images(folder)) == 2


def test_an_image_without_a_mask_is_named(folder):
    """Every image needs its mask; the error names the image."""
    (folder / "mask" / "10.png").unlink()
    with pytest.raises(ValueError, match=r"10.bmp: expected a mask of the same name in .*mask, found none"):
        find_masked_images(folder)


def test_a_mask_of_another_size_is_named(folder):
    """A mask has the size of its image; the error names the mask and both sizes."""
    cv2.imwrite(str(folder / "mask" / "2.png"), np.zeros((5, 6), np.uint8))
    with pytest.raises(ValueError, match=r"mask/2.png: expected a mask of 6x4 pixels, as 2.bmp has, got 6x5"):
        find_masked_images(folder)[0].read()


def test_a_mask_of_zeros_and_ones_is_named(folder):
    """None of its marks would be white; a black mask marks nothing, which is no mistake."""
    cv2.imwrite(str(folder / "mask" / "2.png"), np.eye(4, 6, dtype=np.uint8))
    cv2.imwrite(str(folder / "mask" / "10.png"), np.zeros((4, 6), np.uint8))
    first, second = find_masked_images(folder)
    with pytest.raises(ValueError, match=r"mask/2.png: expected white, 128 to 255, .* got levels up to 1$"):
        first.read()
    assert not second.read()[1].any()


def test_a_file_in_place_of_the_folder_is_named(folder):
    """It is there, but no folder."""
    with pytest.raises(ValueError, match=r"2.bmp: expected a folder$"):
        find_masked_images(folder / "image" / "2.bmp")


def test_a_file_that_is_no_image_is_named(folder):
    """A text file with the suffix of an image is named."""
    (folder / "mask" / "2.png").write_text("no image")
    with pytest.raises(ValueError, match=r"mask/2.png: expected an image"):
        find_masked_images(folder)[0].read()


def test_a_gray_image_is_named(folder):
    """It has no color to learn, and read as BGR would teach gray as the color of skin."""
    cv2.imwrite(str(folder / "image" / "2.bmp"), np.full((4, 6), 50, np.uint8))
    with pytest.raises(ValueError, match=r"image/2.bmp: expected a color image, got a gray one"):
        find_masked_images(folder)[0].read()


def test_a_folder_without_masks_is_named(folder):
    """Without the two folders, or without images, the folder is named."""
    (folder / "mask").rename(folder / "other")
    assert is_mask_folder(folder)
    with pytest.raises(ValueError, match=rf"{folder.name}: expected the folders image and mask"):
        find_masked_images(folder)
    (folder / "other").rename(folder / "mask")
    for path in (folder / "image").iterdir():
        path.unlink()
    with pytest.raises(ValueError, match="image: expected images, found none"):
        find_masked_images(folder)


def test_recorded_masks_are_read(data):
    """All recorded images have a mask of their size; two of them show no skin."""
    pairs = [pair.read() for pair in find_masked_images(data / "skin")]
    assert len(pairs) == 86
    assert sum(not mask.any() for _, mask in pairs) == 2


@pytest.mark.parametrize("depth", [np.uint8, np.uint16])
@pytest.mark.parametrize("color", ["white", "black", "white on hidden black", "white with hidden white"])
def test_a_shape_may_be_in_the_opacity(folder, color, depth):
    """As drawing programs save what is drawn on a transparent layer, whose hidden color is any."""
    mask = np.zeros((4, 6, 4), depth)
    mask[:, :3, 3] = np.iinfo(depth).max
    white = {"white": np.s_[:], "black": np.s_[:0], "white on hidden black": np.s_[:3]}
    mask[:, white.get(color, np.s_[1:]), :3] = np.iinfo(depth).max
    cv2.imwrite(str(folder / "mask" / "2.png"), mask)
    marked = find_masked_images(folder)[0].read()[1]
    expected = np.zeros((4, 6), np.bool_)
    expected[:, 1 if color == "white with hidden white" else 0 : 3] = True
    np.testing.assert_array_equal(marked, expected)


def test_an_opaque_mask_is_read_by_its_color(folder):
    """An alpha channel that is 255 throughout marks nothing by itself."""
    mask = np.full((4, 6, 4), 255, np.uint8)
    mask[:, 3:, :3] = 0
    cv2.imwrite(str(folder / "mask" / "2.png"), mask)
    assert find_masked_images(folder)[0].read()[1].sum() == 12
