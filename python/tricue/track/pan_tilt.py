# SPDX-License-Identifier: MIT
"""A controller that keeps a tracked target in the middle of the image, after Okada, Shirai and Miura (1996),
section 6: tracks become commands for a pan-tilt head.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tricue.camera.frame import as_seconds
from tricue.camera.numbers import MAX_ANGLE, finite, positive, warn_of_degrees
from tricue.camera.rig import Intrinsics
from tricue.track.base import validation
from tricue.track.base.track import Status, Track

Angles = tuple[float, float]  # pan, tilt
Waiting = tuple[tuple[float, np.ndarray], ...]  # seconds, and pan and tilt speeds, of commands

MAX_SPEED = 4 * math.pi  # rad/s, two turns a second; no common head is faster
MAX_DEAD_BAND = math.radians(validation.DEFAULT_FIELD_OF_VIEW / 2)  # farther aside, a target is out of sight


class PanTiltCommand(NamedTuple):
    """A command for the head, as speeds, rad/s, or as angles, radians; pan is positive to the right, tilt
    upwards.
    """

    pan_speed: float
    """Radians per second."""
    tilt_speed: float
    pan: float
    """Radians: the angle that this speed reaches one frame after it takes effect."""
    tilt: float


class PanTilt:
    """Turns a camera on a pan-tilt head so that the target stays in the middle of its image.

    The command is proportional to the target's angle from the optical axis, plus the target's own angular
    velocity, so that the camera doesn't lag behind a target that moves steadily. While the target is
    OCCLUDED, or TRACKED with a score of 0, the camera follows the target's last velocity; while it is LOST,
    the camera stands still.

        camera_head = tricue.PanTilt(camera)
        track = tracker.update(frame)
        command = camera_head.command(track, pan, tilt, timestamp=frame.timestamp)
        motors.drive(command.pan_speed, command.tilt_speed)

    The axes are assumed to meet at the camera's center: pan about the vertical, positive to the right, then
    tilt, positive upwards. With ``intrinsics`` the target is in the direction of the box's center, without
    them in that of the track's ``position``.

    gain: 1/s; an error of 1 rad makes a speed of so many rad/s. If the latency is e seconds longer than
    given, the head swings above a gain of about 1 / (2 e). If frames are farther apart than 1 / gain, the
    speed corrects the error by the next frame.
    velocity_gain: how much of the target's velocity is fed forward, 0 to 1. velocity_time: seconds over which
    that velocity is averaged. latency: seconds from a frame to when its command moves the head, over which
    both are extrapolated. dead_band: radians; a smaller error on an axis is ignored. max_speed: rad/s.
    max_acceleration: rad/s²; a tracker by flow needs image motion that changes slowly. pan_limits,
    tilt_limits: radians; the head brakes before them. rate: frames/s without timestamps.

    TypeError and ValueError name the argument that is wrong. Warns (UserWarning) of angles and speeds so
    large that they look like degrees.
    """

    def __init__(
        self,
        intrinsics: Intrinsics | None = None,
        *,
        gain: float = 4.0,
        velocity_gain: float = 1.0,
        velocity_time: float = 0.3,
        latency: float = 0.0,
        dead_band: float = 0.0,
        max_speed: float = 2.0,
        max_acceleration: float = 2.0,
        pan_limits: Angles = (-math.pi, math.pi),
        tilt_limits: Angles = (-math.pi / 2, math.pi / 2),
        rate: float = 15.0,
    ) -> None:
        self.intrinsics = validation.intrinsics(intrinsics)
        self.gain = positive(gain, "gain", "1/s")
        self.velocity_gain = _share(velocity_gain, "velocity_gain")
        self.velocity_time = _at_least_zero(velocity_time, "velocity_time", "seconds")
        self.latency = _at_least_zero(latency, "latency", "seconds")
        self.dead_band = _at_least_zero(dead_band, "dead_band", "radians")
        self.max_speed = positive(max_speed, "max_speed", "rad/s")
        self.max_acceleration = positive(max_acceleration, "max_acceleration", "rad/s²")
        self.limits = _limits(pan_limits, "pan_limits"), _limits(tilt_limits, "tilt_limits")
        self.rate = positive(rate, "rate", "frames/s")
        for value, largest, name, unit in (
            (max(map(abs, self.limits[0])), MAX_ANGLE, "pan_limits", "radians"),
            (max(map(abs, self.limits[1])), MAX_ANGLE, "tilt_limits", "radians"),
            (self.max_speed, MAX_SPEED, "max_speed", "rad/s"),
            (self.dead_band, MAX_DEAD_BAND, "dead_band", "radians"),
        ):
            if value > largest:
                warn_of_degrees(value, name, unit)
        self.reset()

    def reset(self) -> None:
        """Forget the target and the last command."""
        self._target: np.ndarray | None = None  # pan, tilt of its direction
        self._velocity = np.zeros(2)  # of that direction, rad/s
        self._seen: float | None = None  # when
        self._now: float | None = None
        self._last = PanTiltCommand(0.0, 0.0, 0.0, 0.0)
        self._waiting: Waiting = ()  # commands up to the last but one

    def command(
        self,
        track: Track,
        pan: float | None = None,
        tilt: float | None = None,
        *,
        timestamp: float | None = None,
    ) -> PanTiltCommand:
        """The command after a frame with this track.

        pan, tilt: the head's angles when the frame was taken, radians; without them all commands are assumed
        to be carried out, after the latency. timestamp: of the frame, seconds. ValueError for a track without
        a position if there are no intrinsics, and for numbers that aren't finite; TypeError for anything
        but a track, such as None before tracking starts. An error leaves the controller as it was. Warns
        (UserWarning) of a timestamp so large that it looks like milliseconds or a smaller unit, and of an
        angle beyond the limits that looks like degrees.
        """
        if not isinstance(track, Track):
            raise TypeError(f"track: expected a tricue.Track, got {track!r:.80}")
        now = None if timestamp is None else as_seconds(timestamp)
        interval = validation.elapsed(self._now, now, self.rate)
        waiting = self._commands_under_way(interval)
        turn = sum((seconds * speeds for seconds, speeds in waiting), np.zeros(2))  # until this command
        assumed = np.array(self._last[2:]) - turn
        given = (assumed[0] if pan is None else pan), (assumed[1] if tilt is None else tilt)
        angles = np.array([finite(given[0], "pan", "radians"), finite(given[1], "tilt", "radians")])
        for angle, limits, name in zip(angles.tolist(), self.limits, ("pan", "tilt"), strict=True):
            if abs(angle) > max(MAX_ANGLE, *map(abs, limits)):
                warn_of_degrees(angle, name, "radians")
        # Everything that may raise an error comes before any change.
        seen = track.status is Status.TRACKED and bool(track.score)
        direction = self._direction(track, angles) if seen else None
        self._now = (self._now or 0.0) + interval if now is None else now
        self._waiting = waiting
        if direction is not None:
            self._measure(direction, interval)
            speeds = self._speeds(angles + turn, interval)
        elif track.status is Status.LOST:
            self._target, self._velocity = None, np.zeros(2)
            speeds = np.zeros(2)
        else:
            speeds = self.velocity_gain * self._velocity
        return self._limited(speeds, angles + turn, interval)

    def _commands_under_way(self, interval: float) -> "Waiting":
        """The commands that move the head from this frame until its own command does, newest first.

        For how many seconds each does so, and its speeds.
        """
        waiting, left = [], self.latency
        for seconds, speeds in ((interval, np.array(self._last[:2])), *self._waiting):
            if left <= 0:
                break
            waiting.append((min(seconds, left), speeds))
            left -= seconds
        return tuple(waiting)

    def _direction(self, track: Track, angles: np.ndarray) -> np.ndarray:
        """Pan and tilt at which the target would be in the middle of the image."""
        x, y, z = self._ray(track)
        pan, tilt = angles
        up_z, down = z * math.cos(tilt) + y * math.sin(tilt), y * math.cos(tilt) - z * math.sin(tilt)
        aside, ahead = x * math.cos(pan) + up_z * math.sin(pan), up_z * math.cos(pan) - x * math.sin(pan)
        return np.array([math.atan2(aside, ahead), math.atan2(-down, math.hypot(aside, ahead))])

    def _ray(self, track: Track) -> tuple[float, float, float]:
        """Towards the target, in the camera's frame: right, down, forward."""
        camera = self.intrinsics
        if camera is not None:
            x, y = _finite_numbers(track.box.center, "box")
            return (x - 0.5 - camera.cx) / camera.fx, (y - 0.5 - camera.cy) / camera.fy, 1.0
        if track.position is None:
            raise ValueError("track: expected a position, as there are no intrinsics, got None")
        x, y, z = _finite_numbers(track.position.tolist(), "position")
        return x, y, z

    def _measure(self, direction: np.ndarray, interval: float) -> None:
        """Take the target's direction, and average its velocity over ``velocity_time``.

        interval: seconds since the previous frame. It is used if time hasn't increased since the target was
        last seen.
        """
        assert self._now is not None
        if self._target is not None and self._seen is not None:
            seconds = self._now - self._seen
            if seconds < validation.MIN_FRAME_INTERVAL:
                seconds = interval
            weight = 1 - math.exp(-seconds / self.velocity_time) if self.velocity_time else 1.0
            self._velocity += weight * (_wrapped(direction - self._target) / seconds - self._velocity)
        self._target, self._seen = direction, self._now

    def _speeds(self, angles: np.ndarray, interval: float) -> np.ndarray:
        """Feed-forward plus proportional, at the time when the command moves the head.

        angles: of the head at that time. interval: seconds to the next frame; in this time the error is
        corrected at most once.
        """
        assert self._target is not None
        velocity = self.velocity_gain * self._velocity
        error = _wrapped(self._target + self.latency * velocity - angles)
        outside = np.sign(error) * np.maximum(np.abs(error) - self.dead_band, 0.0)
        return np.asarray(velocity + min(self.gain, 1 / interval) * outside)

    def _limited(self, speeds: np.ndarray, angles: np.ndarray, interval: float) -> PanTiltCommand:
        """The command for these speeds, within the limits of speed and of angles.

        angles: of the head when the command moves it. Outside its limits it is brought back as fast as those
        of acceleration and speed allow.
        """
        low, high = np.transpose(self.limits)
        before, change = np.array(self._last[:2]), self.max_acceleration * interval
        smooth = np.clip(speeds, before - change, before + change).clip(-self.max_speed, self.max_speed)
        left, right = (_speed_that_stops(room, change, interval) for room in (angles - low, high - angles))
        within = np.clip(smooth, -left, right)
        slowest = np.where(angles > high, np.minimum(before, 0) - change, -np.inf)
        fastest = np.where(angles < low, np.maximum(before, 0) + change, np.inf)
        allowed = np.clip(within, slowest, fastest).clip(-self.max_speed, self.max_speed)
        reached = angles + allowed * interval
        self._last = PanTiltCommand(*allowed.tolist(), *reached.tolist())
        return self._last


def _speed_that_stops(room: np.ndarray, change: float, interval: float) -> np.ndarray:
    """The largest speed that ends within some room, radians, if each frame is slower by ``change``.

    From n + f times ``change``, 0 <= f < 1, the head moves by (n + 1) (n / 2 + f) times ``change`` times
    ``interval``. A negative room takes a negative speed, which is back inside in one frame.
    """
    steps = room / (change * interval)
    n = np.floor((np.sqrt(1 + 8 * np.maximum(steps, 0)) - 1) / 2)
    return np.asarray(change * (n / 2 + steps / (n + 1)))


def _wrapped(angle: np.ndarray) -> np.ndarray:
    """Angles in [-pi, pi)."""
    return np.asarray((angle + math.pi) % (2 * math.pi) - math.pi)


def _finite_numbers(values: Sequence[float], name: str) -> Sequence[float]:
    if not all(map(math.isfinite, values)):  # of a third party's track
        raise ValueError(f"track: expected a {name} of finite numbers, got {values}")
    return values


def _share(value: float, name: str) -> float:
    if not 0 <= finite(value, name, "a share") <= 1:
        raise ValueError(f"{name}: expected a share, 0 to 1, got {value!r}")
    return float(value)


def _at_least_zero(value: float, name: str, unit: str) -> float:
    if finite(value, name, unit) < 0:
        raise ValueError(f"{name}: expected {unit}, 0 or more, got {value!r}")
    return float(value)


def _limits(value: Angles, name: str) -> Angles:
    message = f"{name}: expected a lower limit and a higher one, radians, got {value!r:.80}"
    try:
        first, second = value
    except (TypeError, ValueError) as error:  # no sequence, or one of another length
        raise type(error)(message) from None
    low, high = finite(first, name, "radians"), finite(second, name, "radians")
    if not low < high:
        raise ValueError(message)
    return low, high
