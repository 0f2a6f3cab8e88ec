# SPDX-License-Identifier: MIT
"""That the pan-tilt controller keeps a target in the middle of the image."""

import math

import numpy as np
import pytest
from tricue import Box, Intrinsics, PanTilt, Pose, Status, Track
from tricue.track.pan_tilt import PanTiltCommand

CAMERA = Intrinsics.from_fov(160, 120, 32.0)
STEP = 1 / 15
TRACKED, OCCLUDED, LOST = Status.TRACKED, Status.OCCLUDED, Status.LOST


def track_at(x: float, y: float, status: Status = TRACKED, score: float = 1.0) -> Track:
    """A track whose box has its center at (x, y) times the focal length beside the principal point."""
    u, v = CAMERA.cx + 0.5 + x * CAMERA.fx, CAMERA.cy + 0.5 + y * CAMERA.fy
    return Track(Box(u - 10, v - 20, 20, 40), score, status)


def track_of(direction: np.ndarray, angles: np.ndarray) -> Track:
    """The track of a target in a direction, seen by a head at these angles; both pan, tilt."""
    pan, tilt = direction
    ray = np.array([math.sin(pan) * math.cos(tilt), -math.sin(tilt), math.cos(pan) * math.cos(tilt)])
    x, y, z = Pose.from_pan_tilt(*angles).inverse.to_world(ray)
    return track_at(x / z, y / z)


def follow(
    head: PanTilt, path: np.ndarray, latency: int = 0, *, by_angles: bool = False, encoders: bool = True
) -> np.ndarray:
    """(M, 2) by which the camera looks beside a target on a path (M, 2) of pan and tilt; commands move the
    head ``latency`` frames later. by_angles: whether it takes angles. encoders: whether it tells its own.
    """
    angles, errors = np.zeros(2), []
    waiting: list[PanTiltCommand | None] = [None] * latency
    for index, direction in enumerate(path):
        errors.append(direction - angles)
        told = angles if encoders else ()
        waiting.append(head.command(track_of(direction, angles), *told, timestamp=index * STEP))
        command = waiting.pop(0)
        if command is not None:
            speeds = np.array([command.pan_speed, command.tilt_speed])
            angles = np.array([command.pan, command.tilt]) if by_angles else angles + STEP * speeds
    return np.array(errors)


@pytest.mark.parametrize(
    ("x", "y", "pan", "tilt"), [(0.1, 0, 1, 0), (-0.1, 0, -1, 0), (0, 0.1, 0, -1), (0, -0.1, 0, 1)]
)
def test_it_turns_to_the_target(x, y, pan, tilt):
    """A target to the right, left, below or above makes the head turn there, by gain times the angle."""
    command = PanTilt(CAMERA, gain=2.0, max_acceleration=100).command(track_at(x, y), 0.0, 0.0)
    speeds = np.array([command.pan_speed, command.tilt_speed])
    np.testing.assert_allclose(speeds, 2 * math.atan(0.1) * np.array([pan, tilt]), atol=1e-12)
    np.testing.assert_allclose([command.pan, command.tilt], STEP * speeds)


@pytest.mark.parametrize("target", [(0.5, 0.2), (-0.8, -0.3)])
def test_it_settles_on_a_target_that_stands(target):
    """From both sides, also where pan and tilt are large and depend on one another."""
    errors = follow(PanTilt(CAMERA), np.tile(target, (90, 1)))
    assert np.abs(errors[-1]).max() < math.radians(0.05)


def test_a_steady_target_is_not_followed_late():
    """With its velocity fed forward, a target at 0.2 rad/s is looked at to within 0.1 degrees; without, the
    head is late by velocity over gain.
    """
    path = np.stack([0.2 * STEP * np.arange(120), np.full(120, 0.1)], axis=1)
    fed, alone = (follow(PanTilt(CAMERA, gain=2.0, velocity_gain=each), path) for each in (1.0, 0.0))
    assert np.abs(fed[-15:, 0]).max() < math.radians(0.1)
    np.testing.assert_allclose(alone[-15:, 0], 0.2 / 2.0, rtol=0.15)


@pytest.mark.parametrize("latency", [0, 1, 3])
@pytest.mark.parametrize("by_angles", [False, True], ids=["speeds", "angles"])
@pytest.mark.parametrize("encoders", [True, False], ids=["encoders", "none"])
def test_a_late_head_is_not_late_either(latency, by_angles, encoders):
    """Told the latency, a steady target is looked at all the same, by a head that takes speeds or angles."""
    path = np.stack([0.2 * STEP * np.arange(120), np.full(120, 0.1)], axis=1)
    head = PanTilt(CAMERA, gain=2.0, latency=latency * STEP)
    errors = follow(head, path, latency, by_angles=by_angles, encoders=encoders)
    assert np.abs(errors[-15:]).max() < math.radians(0.1)


@pytest.mark.parametrize("gap", [0.2, 0.5, 1.0])
def test_a_longer_interval_is_no_farther_way(gap):
    """A head that is told angles turns to a target that stands at once after a gap, and not beyond."""
    head = PanTilt(CAMERA, max_acceleration=100)
    for index in range(3):
        command = head.command(track_at(math.tan(0.2), 0), 0.0, 0.0, timestamp=index * gap)
    assert command.pan == pytest.approx(min(4.0 * gap, 1) * 0.2)


@pytest.mark.parametrize("rate", [1.5, 2.0, 3.0, 5.0])
def test_it_settles_at_low_frame_rates(rate):
    """Angles that are told two to five times a second lead to the target without swinging about it."""
    head, pan, seen = PanTilt(CAMERA), 0.0, []
    for index in range(20):
        target = track_of(np.array([0.2, 0.0]), np.array([pan, 0.0]))
        pan = head.command(target, pan, 0.0, timestamp=index / rate).pan
        seen.append(pan)
    assert max(seen) <= 0.2 + 1e-9
    assert seen[-1] == pytest.approx(0.2, abs=1e-3)


def test_latency_is_extrapolated():
    """A head that moves two frames late swings about the target less where that is known."""
    path = np.tile([0.3, 0.0], (60, 1))
    known, unknown = (
        np.abs(follow(PanTilt(CAMERA, gain=5.0, latency=each, max_acceleration=50), path, 2)[20:]).max()
        for each in (2 * STEP, 0.0)
    )
    assert known < 0.5 * unknown


@pytest.mark.parametrize("gain", [2.0, 4.0, 10.0])
def test_a_known_latency_makes_no_head_swing(gain):
    """Commands that haven't moved the head yet aren't given again, so that no gain is too high."""
    path = np.tile([0.3, -0.2], (60, 1))
    errors = follow(PanTilt(CAMERA, gain=gain, latency=3 * STEP, max_acceleration=50), path, 3)
    assert (errors * [1, -1]).min() > -1e-9
    assert np.abs(errors[-1]).max() < math.radians(0.1)


def moving(head: PanTilt) -> float:
    """Let the head follow a target at 0.2 rad/s for a while; its speed then."""
    path = np.stack([0.2 * STEP * np.arange(60), np.zeros(60)], axis=1)
    follow(head, path)
    return 0.2


@pytest.mark.parametrize("timestamp", [59 * STEP, 58 * STEP, 0.0])
def test_times_that_do_not_increase_count_as_a_frame(timestamp):
    """A target that moves on as before is as fast as before, also in a frame of the same time or before."""
    head = PanTilt(CAMERA, velocity_time=0.0)
    speed = moving(head)
    head.command(track_of(np.array([0.2 * 60 * STEP, 0.0]), np.zeros(2)), 0.0, 0.0, timestamp=timestamp)
    hidden = head.command(track_at(0.0, 0.0, OCCLUDED), 0.0, 0.0)
    assert hidden.pan_speed == pytest.approx(speed, rel=0.02)


def test_a_target_that_was_hidden_for_long_has_its_mean_velocity():
    """The time since it was last seen counts, however long, not that since the frame before."""
    head = PanTilt(CAMERA, velocity_time=0.0, max_acceleration=100)
    head.command(track_at(0.0, 0.0), 0.0, 0.0, timestamp=0.0)
    head.command(track_at(0.0, 0.0, OCCLUDED), 0.0, 0.0, timestamp=3.9)
    head.command(track_of(np.array([0.4, 0.0]), np.zeros(2)), 0.0, 0.0, timestamp=4.0)
    assert head.command(track_at(0.0, 0.0, OCCLUDED), 0.0, 0.0).pan_speed == pytest.approx(0.1)


@pytest.mark.parametrize("track", [track_at(0.2, 0.1, OCCLUDED), track_at(0.2, 0.1, score=0.0)])
def test_it_moves_on_while_the_target_is_hidden(track):
    """A predicted box isn't turned to; the head goes on as the target last did."""
    head = PanTilt(CAMERA)
    speed = moving(head)
    for _ in range(5):
        command = head.command(track, 0.0, 0.0)
        assert command.pan_speed == pytest.approx(speed, rel=0.02)
        assert command.tilt_speed == pytest.approx(0, abs=0.01)


def test_it_stands_while_the_target_is_lost():
    """The head slows down to a stop, and forgets how the target moved."""
    head = PanTilt(CAMERA)
    moving(head)
    commands = [head.command(track_at(0.2, 0.1, LOST), 0.0, 0.0) for _ in range(5)]
    assert commands[-1][:2] == (0.0, 0.0)
    assert head.command(track_at(0.0, 0.0), 0.0, 0.0).pan_speed == 0.0
    assert head.command(track_at(0.0, 0.0, OCCLUDED), 0.0, 0.0).pan_speed == 0.0


def test_a_dead_band_leaves_small_errors():
    """Errors within it make no command, larger ones what is beyond."""
    head = PanTilt(CAMERA, dead_band=0.05, gain=1.0, max_acceleration=100)
    assert head.command(track_at(0.04, -0.04), 0.0, 0.0)[:2] == (0.0, 0.0)
    head.reset()
    assert head.command(track_at(0.1, 0), 0.0, 0.0).pan_speed == pytest.approx(math.atan(0.1) - 0.05)


def test_limits_hold():
    """Speed, change of speed and angles stay within their limits."""
    head = PanTilt(CAMERA, gain=50, max_speed=0.5, max_acceleration=3.0, pan_limits=(-0.1, 0.1))
    commands, pan = [], 0.0
    for _ in range(30):
        commands.append(head.command(track_at(0.25, 0.0), pan, 0.0))
        pan = commands[-1].pan
    speeds = np.array([0.0, *(command.pan_speed for command in commands)])
    assert speeds.max() == pytest.approx(0.5)
    assert np.diff(speeds).max() <= 3.0 * STEP + 1e-12
    assert max(command.pan for command in commands) == pytest.approx(0.1)
    assert speeds[-1] == pytest.approx(0)


@pytest.mark.parametrize("latency", [0, 1, 3])
@pytest.mark.parametrize("speed", [0.3, 1.0, 1.7])
def test_it_brakes_before_its_limits(latency, speed):
    """A target that goes on beyond them is followed up to them, and no harder than to anywhere else."""
    path = np.stack([np.minimum(speed * STEP * np.arange(90), 1.2), np.zeros(90)], axis=1)
    head = PanTilt(CAMERA, latency=latency * STEP, max_speed=1.5, pan_limits=(-0.4, 0.4))
    pan = path[:, 0] - follow(head, path, latency)[:, 0]
    assert pan.max() <= 0.4 + 1e-9
    assert pan[-1] == pytest.approx(0.4)
    assert np.abs(np.diff(pan, 2)).max() <= 2.0 * STEP**2 + 1e-9


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("moving", [False, True])
def test_a_head_outside_of_its_angles_is_brought_back(side, moving):
    """Its angle is what its speed reaches, which grows within the limits of acceleration and speed."""
    head = PanTilt(CAMERA, pan_limits=(-1.0, 1.0), max_acceleration=3.0)
    if moving:
        for _ in range(5):  # at some speed
            head.command(track_at(0.3 * side, 0), 0.0, 0.0)
    angle, speed = 1.5 * side, 0.0
    for _ in range(60):
        command = head.command(track_at(0.3 * side, 0), angle, 0.0)
        assert command.pan == pytest.approx(angle + STEP * command.pan_speed)
        if abs(angle) > 1.0:
            assert command.pan_speed * side < 0
            assert abs(command.pan_speed) <= abs(speed) + 3.0 * STEP + 1e-9
        angle, speed = command.pan, command.pan_speed
    assert angle == pytest.approx(side)


def test_without_encoders_commands_count_as_done():
    """Without the head's angles, they are those that were last commanded."""
    head = PanTilt(CAMERA, gain=1.0)
    first = head.command(track_at(0.1, 0.0))
    assert head.command(track_at(0.1, 0.0)).pan > first.pan > 0


def test_a_position_does_without_intrinsics():
    """A track in meters needs no camera; one without a position does."""
    ahead = Track(Box(0, 0, 5, 5), 1.0, TRACKED, np.array([0.2, 0.0, 2.0]))
    command = PanTilt(gain=2.0, max_acceleration=100).command(ahead, 0.0, 0.0)
    assert command.pan_speed == pytest.approx(2 * math.atan(0.1))
    with pytest.raises(ValueError, match="track: expected a position"):
        PanTilt().command(track_at(0, 0), 0.0, 0.0)


def test_a_track_without_position_changes_nothing():
    """The next command is as if there had been none such, its time included."""
    ahead = Track(Box(0, 0, 5, 5), 1.0, TRACKED, np.array([0.2, 0.0, 2.0]))
    heads = PanTilt(), PanTilt()
    for head in heads:
        head.command(ahead, 0.0, 0.0, timestamp=0.0)
    with pytest.raises(ValueError, match="track: expected a position"):
        heads[0].command(track_at(0, 0), 0.0, 0.0, timestamp=0.9)
    first, second = (head.command(ahead, 0.01, 0.0, timestamp=1.0) for head in heads)
    assert first == second


@pytest.mark.parametrize(
    ("wrong", "error"),
    [
        ({"gain": 0}, ValueError),
        ({"latency": -1}, ValueError),
        ({"max_speed": math.inf}, ValueError),
        ({"dead_band": "small"}, TypeError),
        ({"tilt_limits": (1, -1)}, ValueError),
        ({"pan_limits": 3}, TypeError),
        ({"pan_limits": None}, TypeError),
        ({"pan_limits": (1,)}, ValueError),
        ({"tilt_limits": (-1, 0, 1)}, ValueError),
        ({"tilt_limits": ("low", "high")}, TypeError),
        ({"velocity_gain": 2}, ValueError),
        ({"velocity_gain": -0.1}, ValueError),
        ({"intrinsics": 5}, TypeError),
    ],
)
def test_bad_arguments_are_named(wrong, error):
    """The argument, and what was expected."""
    with pytest.raises(error, match=f"{next(iter(wrong))}: expected"):
        PanTilt(**wrong)


@pytest.mark.parametrize(
    "degrees",
    [{"pan_limits": (-90, 90)}, {"tilt_limits": (-30, 5)}, {"max_speed": 60}, {"dead_band": 1}],
)
def test_degrees_are_told(degrees, recwarn):
    """The same in radians gives no warning, nor do the largest plausible numbers."""
    name, value = next(iter(degrees.items()))
    with pytest.warns(UserWarning, match=rf"^{name}: expected rad.*, which looks like degrees; math.radians"):
        PanTilt(CAMERA, **degrees)
    PanTilt(CAMERA, **{name: np.radians(value).tolist()})
    PanTilt(CAMERA, pan_limits=(-2 * math.pi, 2 * math.pi), max_speed=12.0, dead_band=0.5)
    assert not recwarn


def test_degrees_of_a_head_are_told(recwarn):
    """Its angles are beyond its limits; those of a head that turns several times are within them."""
    with pytest.warns(UserWarning, match=r"^tilt: expected radians, got about -40, which looks like degrees"):
        PanTilt(CAMERA).command(track_at(0, 0), 0.0, -41.0)
    with pytest.warns(UserWarning, match="^pan_limits"):
        head = PanTilt(CAMERA, pan_limits=(-20.0, 20.0))
    head.command(track_at(0, 0), 19.0, 0.0)
    PanTilt(CAMERA).command(track_at(0, 0), 6.0, -6.0)
    assert not recwarn


def test_bad_angles_are_named():
    """NaN is no angle, and no time; the next command is as if there had been none such."""
    head = PanTilt(CAMERA)
    for wrong in ({"pan": math.nan}, {"tilt": math.inf}, {"timestamp": math.nan}, {"timestamp": math.inf}):
        with pytest.raises(ValueError, match=f"{next(iter(wrong))}: expected a finite number"):
            head.command(track_at(9, 0), **{"timestamp": 5.0, **wrong})
    for seconds in (0.0, 0.1):
        assert head.command(track_at(9, 0), timestamp=seconds).pan_speed > 0


@pytest.mark.parametrize("camera", [CAMERA, None], ids=["box", "position"])
def test_tracks_that_are_not_finite_are_named(camera):
    """As a third party's may be; the motors get no NaN, neither then nor later."""
    good, bad = (Track(Box(x, 0, 5, 5), 1.0, TRACKED, np.array([x, 0.0, 2.0])) for x in (0.2, math.nan))
    heads = PanTilt(camera), PanTilt(camera)
    with pytest.raises(ValueError, match=r"track: expected a (box|position) of finite numbers"):
        heads[0].command(bad, timestamp=0.0)
    first, second = (head.command(good, timestamp=1.0) for head in heads)
    assert first == second


def test_a_timestamp_in_milliseconds_is_told():
    """As a frame tells it, at the line that gave it; it is used, as any clock is right."""
    head = PanTilt(CAMERA)
    message = "timestamp: expected seconds, got 1.7e.12, which look like milliseconds; divide by 1000"
    with pytest.warns(UserWarning, match=message) as told:
        command = head.command(track_at(9, 0), timestamp=1.7e12)
    assert told[0].filename == __file__
    assert command.pan_speed > 0


@pytest.mark.parametrize("track", [None, Box(1, 2, 3, 4)])
def test_anything_but_a_track_is_named(track):
    """It proves that None, as before tracking starts, is a TypeError that says so and changes nothing."""
    head, same = PanTilt(CAMERA), PanTilt(CAMERA)
    with pytest.raises(TypeError, match=r"^track: expected a tricue\.Track, got (None|Box)"):
        head.command(track, 0.0, 0.0, timestamp=1.0)
    assert head.command(track_at(0.1, 0), 0.0, 0.0) == same.command(track_at(0.1, 0), 0.0, 0.0)
