# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.data.recordings.messages import ImageMessage
from tricue.data.recordings.topics import guess_topics

EMPTY = np.zeros(0, np.uint8)


def image(encoding: str) -> ImageMessage:
    """An image of which the encoding matters; one with a space is a format."""
    return ImageMessage(0, "", encoding, EMPTY, compressed=" " in encoding or encoding == "jpeg")


@pytest.mark.parametrize(
    ("first", "chosen"),
    [
        pytest.param(
            {
                "/camera/color/image_raw": "rgb8",
                "/camera/color/image_raw/compressed": "jpeg",
                "/camera/depth/image_rect_raw": "16UC1",
                "/camera/aligned_depth_to_color/image_raw": "16UC1",
                "/camera/infra1/image_rect_raw": "mono8",
                "/camera/infra2/image_rect_raw": "mono8",
            },
            {"color": "/camera/color/image_raw", "depth": "/camera/aligned_depth_to_color/image_raw"},
            id="realsense-ros",
        ),
        pytest.param(
            {
                "/device_0/sensor_0/Depth_0/image/data": "mono16",
                "/device_0/sensor_0/Infrared_1/image/data": "8UC1",
                "/device_0/sensor_1/Color_0/image/data": "rgb8",
            },
            {
                "color": "/device_0/sensor_1/Color_0/image/data",
                "depth": "/device_0/sensor_0/Depth_0/image/data",
            },
            id="realsense-viewer",
        ),
        pytest.param(
            {
                "/camera/rgb/image_color": "bgr8",
                "/camera/depth/image": "32FC1",
            },
            {"color": "/camera/rgb/image_color", "depth": "/camera/depth/image"},
            id="tum",
        ),
        pytest.param(
            {
                "/zed/left/image_rect_color": "bgra8",
                "/zed/right/image_rect_color": "bgra8",
                "/zed/left_raw/image_raw_color": "bgra8",
                "/zed/depth/depth_registered": "32FC1",
                "/zed/confidence/confidence_map": "32FC1",
            },
            {"color": "/zed/left/image_rect_color", "depth": "/zed/depth/depth_registered"},
            id="zed",
        ),
        pytest.param(
            {
                "/zed/left/image_rect_color": "bgra8",
                "/zed/right/image_rect_color": "bgra8",
                "/zed/confidence/confidence_map": "32FC1",
                "/zed/disparity/image": "32FC1",
            },
            {"color": "/zed/left/image_rect_color", "right": "/zed/right/image_rect_color"},
            id="zed-without-depth",
        ),
        pytest.param(
            {"/a/rgb": "bgr8", "/a/depth/confidence": "32FC1", "/a/depth/image": "32FC1"},
            {"color": "/a/rgb", "depth": "/a/depth/image"},
            id="confidence-of-depth",
        ),
        pytest.param(
            {"/cam1/image_raw": "mono8", "/cam0/image_raw": "mono8"},
            {"color": "/cam0/image_raw", "right": "/cam1/image_raw"},
            id="euroc",
        ),
        pytest.param(
            {"/cam2/image_raw": "mono8", "/cam1/image_raw": "mono8"},
            {"color": "/cam1/image_raw", "right": "/cam2/image_raw"},
            id="counted-from-1",
        ),
        pytest.param(
            {f"/camera_{number:02}/image_raw": "bgr8" for number in (1, 2)},
            {"color": "/camera_01/image_raw", "right": "/camera_02/image_raw"},
            id="two-digits",
        ),
        pytest.param(
            {f"/camera{number}/image_raw": "bgr8" for number in (1, 2, 3, 10)},
            {"color": "/camera1/image_raw"},
            id="three-cameras",
        ),
        pytest.param(
            {f"/alphasense/cam{number}/image_raw": "mono8" for number in range(5)},
            {"color": "/alphasense/cam0/image_raw", "right": "/alphasense/cam1/image_raw"},
            id="stereo-pair-and-three",
        ),
        pytest.param(
            {f"/camera{a}/infra{b}/image_rect_raw": "mono8" for a in (1, 2) for b in (1, 2)},
            {"color": "/camera1/infra1/image_rect_raw", "right": "/camera1/infra2/image_rect_raw"},
            id="two-stereo-cameras",
        ),
        pytest.param(
            {f"/device_0/sensor_0/Infrared_{number}/image/data": "8UC1" for number in (1, 2)},
            {
                "color": "/device_0/sensor_0/Infrared_1/image/data",
                "right": "/device_0/sensor_0/Infrared_2/image/data",
            },
            id="infrared-pair",
        ),
        pytest.param(
            {f"/t265/fisheye{number}/image_raw": "mono8" for number in (1, 2)},
            {"color": "/t265/fisheye1/image_raw", "right": "/t265/fisheye2/image_raw"},
            id="fisheye-pair",
        ),
        pytest.param(
            {f"/camera/image_{number:02}": "mono8" for number in range(4)},
            {"color": "/camera/image_00", "right": "/camera/image_01"},
            id="kitti",
        ),
        pytest.param(
            {"/Cameras/Right": "bgr8", "/Cameras/Left": "bgr8"},
            {"color": "/Cameras/Left", "right": "/Cameras/Right"},
            id="capital-letters",
        ),
        pytest.param(
            {"/snappy_cam/stereo_r": "mono8", "/snappy_cam/stereo_l": "mono8"},
            {"color": "/snappy_cam/stereo_l", "right": "/snappy_cam/stereo_r"},
            id="uzh-fpv",
        ),
        pytest.param(
            {"/cam0/image_raw": "mono8", "/cam1/image_raw": "mono8", "/cam1/image_rect": "mono8"},
            {"color": "/cam0/image_raw", "right": "/cam1/image_raw"},
            id="only-the-right-one-rectified",
        ),
        pytest.param(
            {"/stereo/right/image_raw": "bayer_rggb8", "/stereo/left/image_raw": "bayer_rggb8"},
            {"color": "/stereo/left/image_raw", "right": "/stereo/right/image_raw"},
            id="stereo",
        ),
        pytest.param(
            {
                "/oak/rgb/image_raw/compressed": "jpeg",
                "/oak/stereo/image_raw/compressedDepth": "16UC1; compressedDepth",
            },
            {"color": "/oak/rgb/image_raw/compressed", "depth": "/oak/stereo/image_raw/compressedDepth"},
            id="oak-compressed",
        ),
        pytest.param(
            {"/front/image_raw": "bgr8", "/front/segmentation": "bgr8"},
            {"color": "/front/image_raw"},
            id="one-camera",
        ),
        pytest.param({"/depth": "16UC1"}, {"depth": "/depth"}, id="depth-alone"),
        pytest.param({"/thermal/image": "mono16"}, {"color": "/thermal/image"}, id="infrared-of-16-bits"),
        pytest.param({}, {}, id="nothing"),
    ],
)
def test_guesses(first: dict[str, str], chosen: dict[str, str]) -> None:
    """It proves what is taken of the topics that cameras' drivers are known to publish, in any order."""
    images = {name: image(encoding) for name, encoding in first.items()}
    assert guess_topics(images) == chosen
    assert guess_topics(dict(reversed(images.items()))) == chosen
