# SPDX-License-Identifier: MIT
"""The ROS 2 node, with stand-ins for ROS: what it takes from messages, and what it publishes."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tricue import Box, Frame, FusedTracker
from tricue.scenes import WalkScene, overtaking

EXAMPLE = Path(__file__).parents[2] / "examples" / "ros2_node.py"


class Message(SimpleNamespace):
    """A message of any type; fields that weren't set are messages, and a list of results."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        value = [] if name == "results" else Message()
        setattr(self, name, value)
        return value


class Node:
    """What the node uses of rclpy's."""

    parameters: dict[str, Any] = {}  # noqa: RUF012 (each test sets its own)

    def __init__(self, name: str) -> None:
        self.published: dict[str, list[Any]] = {}
        self.callbacks: dict[str, Callable[..., None]] = {}
        self.warnings: list[str] = []

    def declare_parameter(self, name: str, default: Any) -> Any:
        return SimpleNamespace(value=self.parameters.get(name, default))

    def create_publisher(self, kind: Any, topic: str, depth: int) -> Any:
        messages = self.published.setdefault(topic, [])
        return SimpleNamespace(publish=messages.append)

    def create_subscription(self, kind: Any, topic: str, callback: Callable[..., None], quality: Any) -> None:
        self.callbacks[topic] = callback

    def get_logger(self) -> Any:
        return SimpleNamespace(warning=lambda text, **_: self.warnings.append(text))


class Subscriber:
    """A topic of message_filters."""

    def __init__(self, node: Node, kind: Any, topic: str, qos_profile: Any) -> None:
        self.node, self.topic = node, topic

    def registerCallback(self, callback: Callable[..., None]) -> None:  # noqa: N802 (its name there)
        self.node.callbacks[self.topic] = callback


class Synchronizer:
    """Both topics of which messages come together."""

    def __init__(self, topics: list[Subscriber], queue: int, slop: float) -> None:
        self.topics = topics

    def registerCallback(self, callback: Callable[..., None]) -> None:  # noqa: N802 (its name there)
        self.topics[0].node.callbacks["+".join(each.topic for each in self.topics)] = callback


MODULES: dict[str, dict[str, Any]] = {
    "message_filters": {"Subscriber": Subscriber, "ApproximateTimeSynchronizer": Synchronizer},
    "rclpy": {},
    "rclpy.node": {"Node": Node},
    "rclpy.qos": {"qos_profile_sensor_data": object()},
    "geometry_msgs": {},
    "geometry_msgs.msg": {"PoseWithCovarianceStamped": Message},
    "sensor_msgs": {},
    "sensor_msgs.msg": {"CameraInfo": Message, "Image": Message, "RegionOfInterest": Message},
    "std_msgs": {},
    "std_msgs.msg": {"String": Message},
    "vision_msgs": {},
    "vision_msgs.msg": {"Detection2D": Message, "ObjectHypothesisWithPose": Message},
}


@pytest.fixture
def node(program: Callable[[str], ModuleType], monkeypatch: pytest.MonkeyPatch) -> Callable[..., Any]:
    """Makes the node with parameters."""
    for name, values in MODULES.items():
        module = ModuleType(name)
        vars(module).update(values)
        monkeypatch.setitem(sys.modules, name, module)

    def make(**parameters: Any) -> Any:
        monkeypatch.setattr(Node, "parameters", parameters)
        return program("ros2_node").TargetNode()

    return make


@pytest.fixture(scope="module")
def scene() -> WalkScene:
    """A walker, in color and depth."""
    return overtaking(seed=0, frames=8, depth=True)


def image(pixels: np.ndarray, encoding: str, index: int) -> SimpleNamespace:
    """A sensor_msgs/Image."""
    stamp = SimpleNamespace(sec=5, nanosec=index * 66_000_000)
    return SimpleNamespace(
        header=SimpleNamespace(stamp=stamp, frame_id="camera"),
        height=pixels.shape[0],
        width=pixels.shape[1],
        encoding=encoding,
        is_bigendian=0,
        step=pixels.strides[0],
        data=pixels.tobytes(),
    )


def color(scene: WalkScene, index: int) -> SimpleNamespace:
    """The color image in RGB, as many drivers give it."""
    pixels = scene.frames[index].color
    assert pixels is not None
    return image(np.ascontiguousarray(pixels[..., ::-1]), "rgb8", index)


def depth(scene: WalkScene, index: int) -> SimpleNamespace:
    """The depth in millimeters."""
    return image(millimeters(scene, index), "16UC1", index)


def millimeters(scene: WalkScene, index: int) -> np.ndarray:
    """The depth as cameras give it."""
    meters = scene.frames[index].depth
    assert meters is not None
    return np.rint(np.nan_to_num(meters) * 1000).astype(np.uint16)


def info(scene: WalkScene) -> SimpleNamespace:
    """The camera."""
    camera = scene.rig.intrinsics
    p = [camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0]
    return SimpleNamespace(p=p, width=camera.width, height=camera.height)


def test_color_and_depth_give_a_pose(node: Callable[..., Any], scene: WalkScene) -> None:
    """It proves that pose, covariance and detection are the track's, in the camera's frame and meters."""
    made = node(box=list(scene.boxes[0]), use_depth=True)
    both = made.callbacks["image+depth"]
    both(color(scene, 0), depth(scene, 0))
    assert not made.published["status"]  # no camera yet
    made.callbacks["camera_info"](info(scene))
    for index in range(8):
        both(color(scene, index), depth(scene, index))
    assert [each.data for each in made.published["status"]] == ["tracked"] * 8
    pose = made.published["pose"][-1]
    assert pose.header.frame_id == "camera"
    point = pose.pose.pose.position
    assert [point.x, point.y, point.z] == pytest.approx(scene.positions[-1], abs=0.15)
    covariance = np.reshape(pose.pose.covariance, (6, 6))
    assert np.linalg.eigvalsh(covariance[:3, :3]).min() > 0
    assert np.array_equal(covariance[3:, 3:], 1e6 * np.eye(3))
    tracker = FusedTracker(intrinsics=scene.rig.intrinsics)
    for index in range(8):
        depths = millimeters(scene, index)
        frame = Frame(scene.frames[index].color, depths, timestamp=5 + 0.066 * index, depth_scale=0.001)
        track = tracker.update(frame) if index else tracker.init(frame, scene.boxes[0])
    found = made.published["detection"][-1]
    center = found.bbox.center.position
    box = Box.from_ellipse(center.x, center.y, found.bbox.size_x / 2, found.bbox.size_y / 2)
    assert tuple(box) == pytest.approx(tuple(track.box), abs=1e-6)
    assert found.results[0].hypothesis.score > 0.3


def test_color_alone_gives_a_detection(node: Callable[..., Any], scene: WalkScene) -> None:
    """It proves that it waits for a box, which a message may give, and publishes no pose without depth."""
    made = node()
    made.callbacks["image"](color(scene, 0))
    assert not made.published["status"]
    x, y, width, height = scene.boxes[0]
    made.callbacks["start"](SimpleNamespace(x_offset=round(x), y_offset=round(y), width=width, height=height))
    for index in range(4):
        made.callbacks["image"](color(scene, index))
    assert len(made.published["detection"]) == 4
    assert not made.published["pose"]


def test_a_wrong_image_is_logged(node: Callable[..., Any], scene: WalkScene) -> None:
    """It proves that an image that can't be read is told of, as lost too, and that the next one goes on."""
    made = node(box=list(scene.boxes[0]))
    broken = color(scene, 0)
    broken.encoding = "unheard-of"
    made.callbacks["image"](broken)
    assert "unheard-of" in made.warnings[0]
    made.callbacks["image"](color(scene, 0))
    assert [each.data for each in made.published["status"]] == ["lost", "tracked"]


def test_a_camera_that_restarts_with_another_size(node: Callable[..., Any], scene: WalkScene) -> None:
    """It proves that the status is lost from then on, whichever comes first, the new images or their
    camera_info, and that another start is taken.
    """
    made = node(box=list(scene.boxes[0]), use_depth=True)
    both, calibrate = made.callbacks["image+depth"], made.callbacks["camera_info"]
    status = made.published["status"]
    calibrate(info(scene))
    for index in range(4):
        calibrate(info(scene))  # the same one, with each image
        both(color(scene, index), depth(scene, index))
    pixels = scene.frames[4].color
    assert pixels is not None
    halves = [np.ascontiguousarray(each[::2, ::2]) for each in (pixels, millimeters(scene, 4))]
    small = image(halves[0], "bgr8", 4), image(halves[1], "16UC1", 4)
    both(*small)
    assert [each.data for each in status] == ["tracked"] * 4 + ["lost"]
    camera = info(scene)
    camera.p = [value / 2 for value in camera.p]
    camera.width, camera.height = camera.width // 2, camera.height // 2
    calibrate(camera)
    both(*small)  # the box was one of the larger image
    assert [each.data for each in status[4:]] == ["lost"] * 2
    x, y, width, height = (round(side / 2) for side in scene.boxes[4])
    made.callbacks["start"](SimpleNamespace(x_offset=x, y_offset=y, width=width, height=height))
    both(*small)
    assert status[-1].data == "tracked"
    point = made.published["pose"][-1].pose.pose.position
    assert [point.x, point.y, point.z] == pytest.approx(scene.positions[4], abs=0.3)
    calibrate(info(scene))  # back to the first size, told before the images come
    assert status[-1].data == "lost"


def test_without_ros_it_says_what_is_missing() -> None:
    """It proves that the program ends with one line outside of ROS."""
    command = [sys.executable, str(EXAMPLE)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "source its setup.bash" in done.stderr
    assert len(done.stderr.splitlines()) == 1
