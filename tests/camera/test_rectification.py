# SPDX-License-Identifier: MIT
import pickle
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import StereoRig
from tricue.camera.rectification import Rectification, StereoCalibration

SIZE = (640, 480)
RAW = StereoCalibration(
    (
        np.array([[520.0, 0, 330], [0, 522, 235], [0, 0, 1]]),
        np.array([[512.0, 0, 312], [0, 513, 246], [0, 0, 1]]),
    ),
    (np.array([-0.21, 0.08, 0.001, -0.0005, 0.01]), np.array([-0.19, 0.07, -0.0008, 0.0003, 0.0])),
    cv2.Rodrigues(np.array([0.015, -0.03, 0.02]))[0],
    np.array([-0.118, 0.002, 0.004]),
)


def opencv_file(path: Path, **values: Any) -> Path:
    """A file as OpenCV writes it."""
    storage = cv2.FileStorage(str(path), cv2.FILE_STORAGE_WRITE)
    for name, value in values.items():
        storage.write(name, value)
    storage.release()
    return path


def stereo_file(path: Path, **changes: Any) -> Path:
    """RAW in a file, with changes; None leaves a value out."""
    (m1, m2), (d1, d2), rotation, translation = RAW
    values = {"M1": m1, "D1": d1, "M2": m2, "D2": d2, "R": rotation, "T": translation}
    values |= {"image_width": SIZE[0], "image_height": SIZE[1]}
    return opencv_file(path, **{key: v for key, v in (values | changes).items() if v is not None})


def dots(pixels: NDArray[np.float64]) -> NDArray[np.uint8]:
    """A black image with a bright Gaussian dot at each of (n, 2) places between the pixels."""
    v, u = np.indices(SIZE[::-1])
    image = np.zeros(SIZE[::-1])
    for x, y in pixels:
        image += 250 * np.exp(-((u - x) ** 2 + (v - y) ** 2) / (2 * 3.0**2))
    return np.rint(image).clip(0, 255).astype(np.uint8)


def center_near(image: NDArray[np.uint8], place: NDArray[np.float64]) -> NDArray[np.float64]:
    """The center of mass of the dot near (x, y)."""
    x, y = np.rint(place).astype(int)
    part = image[y - 12 : y + 13, x - 12 : x + 13].astype(float)
    v, u = np.indices(part.shape)
    return np.array([(u * part).sum(), (v * part).sum()]) / part.sum() + [x - 12, y - 12]


def test_points_come_where_the_rig_projects_them() -> None:
    """It proves rows, disparity and position: dots at known points, drawn through the raw cameras' distortion
    by cv2.projectPoints, come to lie where the rectified rig has them, to a tenth of a pixel.
    """
    made = Rectification(RAW, SIZE)
    points = np.array([[x, y, 2.0 + 0.4 * x] for x in (-0.6, 0.0, 0.55) for y in (-0.45, 0.0, 0.4)])
    still, pose = (np.zeros(3), np.zeros(3)), (cv2.Rodrigues(RAW.rotation)[0], RAW.translation)
    raw_left, raw_right = (
        cv2.projectPoints(points, *view, camera, bent)[0][:, 0]
        for view, camera, bent in zip((still, pose), RAW.cameras, RAW.distortions, strict=True)
    )
    left, right = made(dots(raw_left), dots(raw_right))
    turn = cv2.stereoRectify(
        RAW.cameras[0],
        RAW.distortions[0],
        RAW.cameras[1],
        RAW.distortions[1],
        SIZE,
        RAW.rotation,
        RAW.translation[:, None],
    )[0]
    turned = points @ turn.T
    expected = made.rig.intrinsics.project(turned)
    disparity = made.rig.intrinsics.fx * made.rig.baseline / turned[:, 2]
    for place, shift, z in zip(expected, disparity, turned[:, 2], strict=True):
        one = center_near(left, place)
        other = center_near(right, place - [shift, 0])
        assert one == pytest.approx(place, abs=0.1)
        assert other == pytest.approx(place - [shift, 0], abs=0.1)
        assert made.rig.depth(one[0] - other[0]) == pytest.approx(z, rel=0.01)


def test_the_baseline_is_the_distance_of_the_cameras() -> None:
    """It proves that the rig's baseline is the translation's length, in meters by the board's unit."""
    assert Rectification(RAW, SIZE).rig.baseline == pytest.approx(np.linalg.norm(RAW.translation))
    millimeters = RAW._replace(translation=RAW.translation * 1000)
    assert Rectification(millimeters, SIZE, unit=0.001).rig.baseline == pytest.approx(
        np.linalg.norm(RAW.translation)
    )


@pytest.mark.parametrize("suffix", ["yml", "xml", "json"])
def test_files_are_read(tmp_path: Path, suffix: str) -> None:
    """It proves that a file gives the same rectification as its numbers."""
    made = Rectification.from_opencv(stereo_file(tmp_path / f"c.{suffix}"))
    assert made.rig == Rectification(RAW, SIZE).rig


@pytest.mark.parametrize("count", [4, 5, 8, 12, 14])
def test_every_distortion_model_of_opencv_is_read(tmp_path: Path, count: int) -> None:
    """It proves that a file may have as many coefficients as cv2.stereoCalibrate gives."""
    distortion = np.zeros(count)
    distortion[:2] = -0.1, 0.02
    raw = RAW._replace(distortions=(distortion, distortion))
    path = stereo_file(tmp_path / "c.yml", D1=distortion, D2=distortion)
    assert Rectification.from_opencv(path).rig == Rectification(raw, SIZE).rig


def test_other_names_and_rodrigues_vectors_are_read(tmp_path: Path) -> None:
    """It proves that K1, distCoeffs1 and so on are known, and R may be a rotation vector."""
    (m1, m2), (d1, d2), rotation, translation = RAW
    path = opencv_file(
        tmp_path / "c.yml",
        K1=m1,
        K2=m2,
        distCoeffs1=d1,
        distCoeffs2=d2,
        R=cv2.Rodrigues(rotation)[0],
        T=translation[:, None],
    )
    rig = Rectification.from_opencv(path, size=SIZE).rig
    assert rig.baseline == pytest.approx(Rectification(RAW, SIZE).rig.baseline)
    assert rig.intrinsics.fx == pytest.approx(Rectification(RAW, SIZE).rig.intrinsics.fx)


def test_two_files_hold_it_together(tmp_path: Path) -> None:
    """It proves that OpenCV's sample's intrinsics.yml and extrinsics.yml are read, and R1 to P2 are kept."""
    (m1, m2), (d1, d2), rotation, translation = RAW
    r1, r2, p1, p2, *_ = cv2.stereoRectify(m1, d1, m2, d2, SIZE, rotation, translation[:, None], alpha=1)
    inner = opencv_file(tmp_path / "intrinsics.yml", M1=m1, D1=d1, M2=m2, D2=d2)
    outer = opencv_file(tmp_path / "extrinsics.yml", R=rotation, T=translation, R1=r1, R2=r2, P1=p1, P2=p2)
    made = Rectification.from_opencv(inner, outer, size=SIZE)
    assert made.rig.intrinsics.fx == pytest.approx(p1[0, 0])
    assert made.rig == StereoRig.from_opencv(outer, size=SIZE)
    assert made.rig.intrinsics.fx != Rectification(RAW, SIZE).rig.intrinsics.fx


def test_color_and_gray(tmp_path: Path) -> None:
    """It proves that both kinds of images keep their kind, and that gray is what color would give."""
    made = Rectification.from_opencv(stereo_file(tmp_path / "c.yml"))
    gray = np.random.default_rng(0).integers(0, 256, (480, 640), dtype=np.uint8)
    color = np.repeat(gray[..., None], 3, axis=2)
    (left, right), (left_color, right_color) = made(gray, gray[::-1]), made(color, color[::-1])
    assert left.shape == right.shape == gray.shape
    for one, three in ((left, left_color), (right, right_color)):
        np.testing.assert_array_equal(three, np.repeat(one[..., None], 3, axis=2))


def test_the_calibration_of_cv2_is_taken_as_it_is() -> None:
    """cv2.stereoCalibrate gives T as a column and the coefficients as rows; the rig is the same."""
    (first, second), (m1, m2) = (raw[None] for raw in RAW.distortions), RAW.cameras
    given = StereoCalibration((m1, m2), (first, second), RAW.rotation, RAW.translation[:, None])
    assert Rectification(given, SIZE).rig == Rectification(RAW, SIZE).rig


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"translation": np.zeros(3)}, "two cameras apart from each other, got a T of 0"),
        ({"translation": np.ones(2)}, r"a translation T \(3,\) of finite numbers, got \(2,\)"),
        ({"rotation": 2 * np.eye(3)}, "a rotation R, got another matrix"),
        (
            {"cameras": (np.eye(3), np.eye(3)[:2])},
            r"a camera matrix \(3, 3\) of finite numbers, got \(2, 3\)",
        ),
        ({"distortions": (np.zeros(5), np.zeros(3))}, "4, 5, 8, 12 or 14 distortion coefficients, got 3"),
    ],
)
def test_a_bad_calibration_is_refused(changes: dict[str, Any], message: str) -> None:
    """It is named as in a file, instead of an error of OpenCV or NumPy."""
    with pytest.raises(ValueError, match=rf"^rectification: expected {message}$"):
        Rectification(RAW._replace(**changes), SIZE)


def test_it_pickles() -> None:
    """It proves that an unpickled rectification gives the same pair."""
    made = Rectification(RAW, SIZE)
    again = pickle.loads(pickle.dumps(made))
    image = np.random.default_rng(0).integers(0, 256, (480, 640, 3), dtype=np.uint8)
    for first, second in zip(made(image, image), again(image, image), strict=True):
        np.testing.assert_array_equal(first, second)
    assert again.rig == made.rig


def test_the_conveyors_raw_cameras(data: Path) -> None:
    """It proves the reader on a real file: raw cameras of 1280x720 pixels whose distortion can't be
    undone in the corners, a baseline of 3.56 squares; its author rectified to the same focal length.
    """
    path = data / "stereo/conveyor-box/calibration.yml"
    made = Rectification.from_opencv(path, unit=0.025, size=(1280, 720))
    assert made.rig.baseline == pytest.approx(0.025 * 3.56133, abs=1e-5)
    assert made.rig.intrinsics.fx == pytest.approx(701.3, abs=0.5)
    assert (made.rig.intrinsics.cx, made.rig.intrinsics.cy) == pytest.approx((640, 360), abs=20)


def test_another_size_than_the_files_is_refused(tmp_path: Path) -> None:
    """It proves that raw cameras aren't taken for images of another size: not for a given one, nor for that
    of the other file.
    """
    path = stereo_file(tmp_path / "c.yml")
    assert Rectification.from_opencv(path, size=SIZE).rig == Rectification.from_opencv(path).rig
    message = r"c\.yml: expected a calibration for images of 160x120 pixels, got one for 640x480"
    with pytest.raises(ValueError, match=message):
        Rectification.from_opencv(path, size=(160, 120))
    small = opencv_file(tmp_path / "small.yml", image_width=160, image_height=120)
    with pytest.raises(ValueError, match=message):
        Rectification.from_opencv(small, path)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"M2": None}, "found no M1 and M2"),
        ({"D1": None, "T": None}, "found no D1 and D2 and no T"),
        ({"R": None}, "found no R"),
        ({"M1": np.eye(4)}, r"expected a camera matrix \(3, 3\)"),
        ({"M1": np.eye(3) * np.nan}, "of finite numbers"),
        ({"M2": np.zeros((3, 3))}, "focal lengths above 0"),
        ({"D1": np.full(5, np.nan)}, "finite distortion coefficients"),
        ({"R": np.zeros((3, 3))}, "expected a rotation R, got another matrix"),
        ({"T": np.zeros(3)}, "got a T of 0"),
        ({"R": np.eye(2)}, r"expected a rotation R \(3, 3\)"),
        ({"T": np.zeros(4)}, r"expected a translation T \(3,\)"),
        ({"D2": np.zeros(3)}, "expected 4, 5, 8, 12 or 14 distortion coefficients, got 3"),
        ({"T": -RAW.translation}, "swap the two cameras"),
        ({"T": RAW.translation[[1, 0, 2]]}, "one above the other"),
        ({"image_width": None}, r"pass size=\(width, height\)"),
    ],
)
def test_bad_files_are_refused(tmp_path: Path, changes: dict[str, Any], message: str) -> None:
    """It proves that what can't rectify a pair is a ValueError with the file's name and the reason."""
    with pytest.raises(ValueError, match=rf"c\.yml: .*{message}"):
        Rectification.from_opencv(stereo_file(tmp_path / "c.yml", **changes))


def test_skew_is_told(tmp_path: Path) -> None:
    """It proves that the skew of a raw camera, which OpenCV leaves out, is warned of."""
    skewed = RAW.cameras[1].copy()
    skewed[0, 1] = 30.0
    with pytest.warns(UserWarning, match=r"c\.yml: its skew of 30 px, up to .* px, isn't taken out"):
        Rectification.from_opencv(stereo_file(tmp_path / "c.yml", M2=skewed))


def test_bad_images_are_refused() -> None:
    """It proves that images of another size, of two sizes, or none are refused by name."""
    made = Rectification(RAW, SIZE)
    image, small = np.zeros((480, 640), np.uint8), np.zeros((240, 320), np.uint8)
    with pytest.raises(ValueError, match=r"left: expected images of 640x480 pixels, .* got 320x240"):
        made(small, small)
    with pytest.raises(ValueError, match="right: expected the shape of color"):
        made(image, small)
    with pytest.raises(TypeError, match="right: expected uint8"):
        made(image, image.astype(np.float32))
    with pytest.raises(ValueError, match="paths: expected a calibration file, got none"):
        Rectification.from_opencv()
