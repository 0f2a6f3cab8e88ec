# SPDX-License-Identifier: MIT
import math

import cv2
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue.camera.registration import Registration, Reprojection
from tricue.data.recordings.cameras import Cameras, View, calibrate, find_extrinsics, find_info
from tricue.data.recordings.messages import CameraMessage, Transform

SIZE = 64, 48
IDENTITY = (0.0, 0.0, 0.0, 1.0)
QUARTER = (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4))  # about z


def info(
    focal: float = 60.0, frame: str = "", shift: float = 0.0, **other: tuple[float, ...]
) -> CameraMessage:
    """A camera_info. shift: meters to the right of the left camera."""
    k = (focal, 0, 31.5, 0, focal, 23.5, 0, 0, 1)
    p = (focal, 0, 31.5, -focal * shift, 0, focal, 23.5, 0, 0, 0, 1, 0)
    camera = CameraMessage(frame, *SIZE, "plumb_bob", (0.0,) * 5, k, (1, 0, 0, 0, 1, 0, 0, 0, 1), p)
    return camera._replace(**other)  # type: ignore[arg-type]


def view(camera: CameraMessage | None, frame: str = "", rectified: bool = True) -> View:
    """A channel with this camera."""
    return View("/a", SIZE, frame, camera, rectified)


def test_extrinsics_along_a_tree() -> None:
    """It proves the transform from one camera to another over their common parent, by a hand-made point.

    The depth camera is 0.1 m along the body's x; color is turned by 90 degrees about z, 0.2 m along y.
    """
    tree = [
        Transform("map", "body", (5.0, 5.0, 5.0), QUARTER),
        Transform("body", "depth", (0.1, 0.0, 0.0), IDENTITY),
        Transform("body", "mount", (0.0, 0.2, 0.0), QUARTER),
        Transform("mount", "color", (0.0, 0.0, 0.0), IDENTITY),
    ]
    found = find_extrinsics(tree, "depth", "color")
    assert found is not None
    point = np.array([0.0, 0.0, 2.0])  # in depth; (0.1, 0, 2) in the body; (0.1, -0.2, 2) from the mount
    assert np.allclose(found.rotation @ point + found.translation, [-0.2, -0.1, 2.0])
    back = find_extrinsics(tree, "color", "depth")
    assert back is not None
    assert np.allclose(back.rotation @ found.rotation, np.eye(3))
    assert find_extrinsics(tree, "depth", "elsewhere") is None
    assert find_extrinsics(tree, "", "color") is None


@pytest.mark.parametrize("turn", [(0.0,) * 4, (math.nan,) * 4])
def test_a_transform_without_a_rotation_connects_nothing(turn: tuple[float, ...]) -> None:
    """It proves that a quaternion of 0 or NaN, which would make all depth NaN, is left out."""
    unfilled = Transform("color", "depth", (0.1, 0.0, 0.0), turn)
    assert find_extrinsics([unfilled], "depth", "color") is None


@pytest.mark.parametrize(
    ("image", "topic"),
    [
        ("/camera/color/image_raw", "/camera/color/camera_info"),
        ("/camera/color/image_raw/compressed", "/camera/color/camera_info"),
        ("/device_0/sensor_1/Color_0/image/data", "/device_0/sensor_1/Color_0/info/camera_info"),
        ("/cam/image", "/cam/calibration"),
        ("/by/frame", "/elsewhere/info"),
        ("/nothing/here", None),
    ],
)
def test_the_camera_info_of_an_image(image: str, topic: str | None) -> None:
    """It proves where a camera_info is looked for: beside the image, then by the coordinate frame."""
    names = [
        "/camera/color/camera_info",
        "/camera/depth/camera_info",
        "/device_0/sensor_1/Color_0/info/camera_info",
        "/cam/calibration",
        "/elsewhere/info",
    ]
    infos = {name: info(50.0 + index, frame=name) for index, name in enumerate(names)}
    frame = "/elsewhere/info" if image == "/by/frame" else "other"
    found = find_info(image, frame, infos)
    assert found == (None if topic is None else infos[topic])


def test_one_camera() -> None:
    """It proves that K counts of raw images and P of rectified ones, and that a bent lens is told."""
    raw = info(d=(0.1, 0.0, 0.0, 0.0, 0.0), p=(55.0, 0, 30.0, 0, 0, 56.0, 22.0, 0, 0, 0, 1, 0))
    assert calibrate({"color": view(raw, rectified=False)}, []) == Cameras(
        Intrinsics(60, 60, 31.5, 23.5, *SIZE), notes=("/a: its lens' distortion isn't taken out",)
    )
    assert calibrate({"color": view(raw)}, []) == Cameras(Intrinsics(55, 56, 30, 22, *SIZE))


def test_skew_is_told() -> None:
    """It proves that the skew of the images' camera, K's of raw ones and P's of rectified ones, is a note."""
    camera = info(k=(60.0, 3.0, 31.5, 0, 60, 23.5, 0, 0, 1))
    found = calibrate({"color": view(camera, rectified=False)}, [])
    assert found.notes == ("/a: its skew of 3 px, up to 1.2 px, isn't taken out",)
    assert calibrate({"color": view(camera)}, []).notes == ()


@pytest.mark.parametrize("value", [0.0, math.nan, math.inf])
def test_a_camera_without_a_projection(value: float) -> None:
    """It proves that K counts where P isn't filled in, and that a pair then has no baseline."""
    unfilled = info(p=(value,) * 12)
    assert calibrate({"color": view(unfilled)}, []).camera == Intrinsics(60, 60, 31.5, 23.5, *SIZE)
    assert "the baseline isn't known" in pair(view(info()), view(unfilled)).notes[-1]


@pytest.mark.parametrize(
    ("camera", "note"),
    [
        (None, "/a has no camera_info"),
        (info(k=(0.0,) * 9), "the camera of /a isn't calibrated"),
        (info(k=(math.nan,) * 9), "the camera of /a isn't calibrated"),
        (info(k=()), "the camera of /a isn't calibrated"),
        (info()._replace(width=640, height=480), "/a has images of 64x48, its camera_info is for 640x480"),
    ],
)
def test_an_unknown_camera(camera: CameraMessage | None, note: str) -> None:
    """It proves that a camera that nobody calibrated, or for another size, is none, and that it's told."""
    found = calibrate({"depth": view(camera)}, [])
    assert found.camera is None
    assert found.notes[0].startswith(note)


def both(color: View, depth: View, *transforms: Transform) -> Cameras:
    """The cameras of color and depth."""
    return calibrate({"color": color, "depth": depth}, transforms)


def test_registered_depth_stays_as_it_is() -> None:
    """It proves that two equal cameras in one place need nothing."""
    assert both(view(info(), "a"), view(info(), "a")) == Cameras(Intrinsics(60, 60, 31.5, 23.5, *SIZE))


def test_depth_with_the_camera_info_of_color_stays_as_it_is() -> None:
    """It proves that depth in a raw color image's pixels isn't warped from P to K, as it would be between two
    cameras; with an info or in a place of its own it is another camera's.
    """
    calibrated = info(p=(62.0, 0, 33.5, 0, 0, 62.0, 23.5, 0, 0, 0, 1, 0))
    color, depth = view(calibrated, "c", rectified=False), view(calibrated, "c")
    assert both(color, depth) == Cameras(Intrinsics(60, 60, 31.5, 23.5, *SIZE))
    assert both(color._replace(rectified=True), depth).camera == Intrinsics(62, 62, 33.5, 23.5, *SIZE)
    assert both(color, depth._replace(info=info(62.0))).register is not None
    beside = Transform("c", "d", (0.015, 0.0, 0.0), IDENTITY)
    assert both(color, depth._replace(frame="d"), beside).register is not None


def test_depth_of_another_camera() -> None:
    """It proves that it's registered by the transform between the cameras, or, without, as from one place."""
    color, depth = view(info(), "c"), view(info(90.0), "d")
    beside = Transform("c", "d", (0.015, 0.0, 0.0), IDENTITY)
    found = both(color, depth, beside)
    assert isinstance(found.register, Reprojection)
    assert np.allclose(found.register.extrinsics.translation, [0.015, 0, 0])
    assert "15.0 mm beside it" in found.notes[0]
    found = both(color, depth)
    assert isinstance(found.register, Registration)
    assert "as from one place" in found.notes[0]
    assert found.camera == Intrinsics(60, 60, 31.5, 23.5, *SIZE)
    # equal lenses in two places are two cameras
    assert isinstance(both(color, view(info(), "d"), beside).register, Reprojection)


def test_depth_without_cameras() -> None:
    """It proves that depth is left as it is where a camera isn't known, and that both cases are told."""
    assert "is taken to be registered" in both(view(None), view(info())).notes[-1]
    small = view(None)._replace(size=(32, 24))
    assert "can't be registered" in both(view(info()), small).notes[-1]


def pair(left: View, right: View, *transforms: Transform) -> Cameras:
    """The cameras of a stereo pair."""
    return calibrate({"color": left, "right": right}, transforms)


def test_a_rectified_pair() -> None:
    """It proves that the baseline is what the right camera's P says."""
    rig = StereoRig(Intrinsics(60, 60, 31.5, 23.5, *SIZE), 0.125)
    assert pair(view(info()), view(info(shift=0.125))) == Cameras(rig)


@pytest.mark.parametrize(
    ("right", "note"),
    [
        (
            view(info(p=(60.0, 0, 35.5, -7.5, 0, 60.0, 23.5, 0, 0, 0, 1, 0))),
            "the two cameras of the rectified pair differ (cx 31.5 and 35.5)",
        ),
        (view(info(61.0, shift=0.125)), "(fx 60 and 61, fy 60 and 61)"),
        (view(info(shift=0.125)._replace(width=640)), "its camera_info is for 640x48"),
    ],
)
def test_a_pair_rectified_to_two_cameras_is_no_rig(right: View, note: str) -> None:
    """It proves that a pair without zero disparity at infinity, whose depths would be wrong, is no rig, and
    that a note says so; nor is one whose right camera isn't known.
    """
    found = pair(view(info()), right)
    assert found.camera == Intrinsics(60, 60, 31.5, 23.5, *SIZE)
    assert note in found.notes[-1]


BARE = info(p=(0.0,) * 12, r=(0.0,) * 9)
APART = [
    Transform("left", "reference 0", (0.0, 0.0, 0.0), IDENTITY),
    Transform("right", "reference 0", (-0.05, 0.0, 0.0), IDENTITY),
]
BENT = {"d": (-0.1, 0.0, 0.0, 0.0, 0.0)}


@pytest.mark.parametrize(
    ("left", "right"),
    [
        (view(info(shift=0.125)), view(info())),  # as ROS has it: the left camera's P has no baseline
        (view(info()), view(info(shift=-0.125))),
        (view(info(shift=0.125, **BENT), rectified=False), view(info(**BENT), rectified=False)),
        (view(BARE, "right"), view(BARE, "left")),
    ],
)
def test_a_pair_of_swapped_cameras(left: View, right: View) -> None:
    """It proves that a pair whose right camera is left of the left one, by P or the extrinsics, is no rig,
    and that a note says what to do.
    """
    found = pair(left, right._replace(topic="/b"), *APART)
    assert isinstance(found.camera, Intrinsics)
    assert found.rectify is None
    assert "the right camera is left of the left one; swap the two cameras" in found.notes[-1]


def test_a_pair_of_realsense() -> None:
    """It proves that without P the baseline comes from the extrinsics between both cameras."""
    found = pair(view(BARE, "left"), view(BARE, "right"), *APART)
    assert isinstance(found.camera, StereoRig)
    assert found.camera.baseline == pytest.approx(0.05)
    assert "the baseline isn't known" in pair(view(BARE), view(BARE)).notes[0]


def test_a_raw_pair_whose_right_camera_info_is_for_another_size() -> None:
    """It proves that such a pair isn't rectified, as the right image would be another one's."""
    right = info(shift=0.125, **BENT)._replace(width=640, height=480)
    found = pair(view(info(**BENT), rectified=False), view(right, rectified=False))
    assert found.rectify is None
    assert found.notes[-1] == "/a has images of 64x48, its camera_info is for 640x480"


@pytest.mark.parametrize(
    ("other", "note"),
    [
        ({"d": (-0.1, 0.0, 0.0)}, "D isn't one of plumb_bob"),
        ({"d": (-0.1, math.nan, 0.0, 0.0)}, "D isn't one of plumb_bob"),
        ({"r": (0.0,) * 9}, "R isn't a rotation"),
        ({"r": (math.nan,) * 9}, "R isn't a rotation"),
        ({"r": ()}, "R isn't a rotation"),
        ({"p": ()}, "P isn't known"),
    ],
)
def test_a_raw_pair_with_an_incomplete_camera_info(other: dict[str, tuple[float, ...]], note: str) -> None:
    """It proves that a pair isn't rectified to black images, or at all, by numbers that weren't filled in."""
    left, right = info(**{**BENT, **other}), info(shift=0.125, **BENT)
    found = pair(view(left, rectified=False), view(right, rectified=False))
    assert found.rectify is None
    assert found.notes[-1] == f"the pair can't be rectified: {note}"


def test_a_raw_pair_is_rectified() -> None:
    """It proves that lenses that bend, and cameras that are turned, are rectified by the recorded R and P, as
    OpenCV would with its own.
    """
    bent, turn = np.array([-0.2, 0.05, 0.001, 0.0, 0.0]), cv2.Rodrigues(np.array([0.01, 0.03, -0.02]))[0]
    k = np.reshape(info().k, (3, 3))
    first, second, left, right, _, _, _ = cv2.stereoRectify(
        k, bent, k, bent, SIZE, turn, np.array([[-0.1], [0.0], [0.0]]), flags=0x400, alpha=0
    )
    cameras = [
        info(d=tuple(bent), r=tuple(rotation.ravel()), p=tuple(projection.ravel()))
        for rotation, projection in ((first, left), (second, right))
    ]
    found = pair(*(view(camera, rectified=False) for camera in cameras))
    assert isinstance(found.camera, StereoRig)
    assert found.camera.baseline == pytest.approx(0.1, rel=1e-6)
    assert found.rectify is not None
    image = np.random.default_rng(0).integers(0, 255, (SIZE[1], SIZE[0], 3), dtype=np.uint8)
    maps = cv2.initUndistortRectifyMap(k, bent, first, left[:, :3], SIZE, cv2.CV_16SC2)
    assert np.array_equal(found.rectify(image, image)[0], cv2.remap(image, *maps, cv2.INTER_LINEAR))
    other = [camera._replace(model="equidistant") for camera in cameras]
    assert (
        "can't be rectified: the distortion model equidistant"
        in pair(*(view(camera, rectified=False) for camera in other)).notes[-1]
    )
