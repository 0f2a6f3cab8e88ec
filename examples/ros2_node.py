# SPDX-License-Identifier: MIT
r"""A ROS 2 node that follows a target: image (and depth, camera_info) in; pose, detection and status out.

    python examples/ros2_node.py --ros-args -r image:=/camera/image_raw -p box:="[128.0, 79.0, 64.0, 78.0]"
    python examples/ros2_node.py --ros-args -r image:=/camera/color/image_raw -p use_depth:=true \
        -r depth:=/camera/aligned_depth_to_color/image_raw -r camera_info:=/camera/color/camera_info

It starts on the parameter ``box``, and restarts on each sensor_msgs/RegionOfInterest on ``start``. Depth has
to be registered to the image. After an image that can't be read the status is "lost"; a camera that changes
its size or calibration ends the track until another ``start``. ``pose`` is in the frame of the image's
header: x right, y down, z forward, meters; only its position is known. Needs rclpy, sensor_msgs,
geometry_msgs, vision_msgs, std_msgs and message_filters.
"""

import sys
from typing import Any

import tricue
from tricue.data.recordings.images import to_color, to_depth
from tricue.data.recordings.messages import to_image

try:
    import message_filters
    import rclpy
    from geometry_msgs.msg import PoseWithCovarianceStamped
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import CameraInfo, Image, RegionOfInterest
    from std_msgs.msg import String
    from vision_msgs.msg import Detection2D, ObjectHypothesisWithPose
except ImportError as error:
    sys.exit(f"{error}: this node runs in ROS 2; source its setup.bash first")

MAX_DIFFERENCE = 0.02  # seconds between an image and its depth
UNKNOWN = 1e6  # rad², of the orientation


class TargetNode(Node):
    """One target; everything happens in the callback of the images."""

    def __init__(self) -> None:
        super().__init__("tricue")
        self.box = list(self.declare_parameter("box", [0.0, 0.0, 0.0, 0.0]).value)
        use_depth = self.declare_parameter("use_depth", False).value
        self.tracker: tricue.FusedTracker | None = None
        self.camera: tricue.Intrinsics | None = None
        self.pose = self.create_publisher(PoseWithCovarianceStamped, "pose", 10)
        self.detection = self.create_publisher(Detection2D, "detection", 10)
        self.status = self.create_publisher(String, "status", 10)
        self.create_subscription(RegionOfInterest, "start", self.start, 10)
        self.create_subscription(CameraInfo, "camera_info", self.calibrate, qos_profile_sensor_data)
        quality = {"qos_profile": qos_profile_sensor_data}
        self.images = message_filters.Subscriber(self, Image, "image", **quality)
        if use_depth:
            depths = message_filters.Subscriber(self, Image, "depth", **quality)
            both = [self.images, depths]
            self.pairs = message_filters.ApproximateTimeSynchronizer(both, 10, MAX_DIFFERENCE)
        (self.pairs if use_depth else self.images).registerCallback(self.follow)

    def calibrate(self, info: Any) -> None:
        """Take the camera from P (rectified images). A changed camera ends the track: its box is invalid."""
        p = info.p
        if p[0] <= 0 or not info.width:
            return  # not calibrated
        camera = tricue.Intrinsics(p[0], p[5], p[2], p[6], info.width, info.height)
        if self.camera not in (None, camera) and self.tracker is not None:
            self.tracker, self.box = None, [0.0, 0.0, 0.0, 0.0]
            self.status.publish(String(data=str(tricue.Status.LOST)))
        self.camera = camera

    def start(self, region: Any) -> None:
        """Start again on this box, in the next image."""
        self.box = [float(n) for n in (region.x_offset, region.y_offset, region.width, region.height)]
        self.tracker = None

    def follow(self, image: Any, depth: Any = None) -> None:
        """Track a frame and publish the result. After an error, which is logged, it is lost."""
        if self.box[2] <= 0 or (depth is not None and self.camera is None):
            return  # nothing to start on, or no camera yet
        seconds = image.header.stamp.sec + 1e-9 * image.header.stamp.nanosec
        try:
            meters = None if depth is None else to_depth(to_image(depth))
            frame = tricue.Frame(to_color(to_image(image)), depth=meters, timestamp=seconds)
            if self.tracker is None:
                tracker = tricue.FusedTracker(intrinsics=self.camera)
                track, self.tracker = tracker.init(frame, self.box), tracker
            else:
                track = self.tracker.update(frame)
        except ValueError as error:
            self.get_logger().warning(str(error), throttle_duration_sec=1.0)
            self.status.publish(String(data=str(tricue.Status.LOST)))
            return
        self.publish(track, image.header)

    def publish(self, track: tricue.Track, header: Any) -> None:
        """The status always; the detection unless the target is lost; the pose if depth was measured."""
        self.status.publish(String(data=str(track.status)))
        if track.status is tricue.Status.LOST:
            return
        found, hypothesis = Detection2D(header=header), ObjectHypothesisWithPose()
        hypothesis.hypothesis.class_id, hypothesis.hypothesis.score = "target", float(track.score)
        found.bbox.center.position.x, found.bbox.center.position.y = track.box.center
        found.bbox.size_x, found.bbox.size_y = track.box.width, track.box.height
        found.results.append(hypothesis)
        self.detection.publish(found)
        if track.position is None or track.covariance is None or self.camera is None:
            return
        pose = PoseWithCovarianceStamped(header=header)
        point = pose.pose.pose.position
        point.x, point.y, point.z = track.position.tolist()
        covariance = [0.0] * 36
        for row in range(3):
            covariance[6 * row : 6 * row + 3] = track.covariance[row].tolist()
            covariance[7 * row + 21] = UNKNOWN
        pose.pose.covariance = covariance
        self.pose.publish(pose)


def main() -> None:
    """Run until Ctrl-C."""
    rclpy.init()
    node = TargetNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
