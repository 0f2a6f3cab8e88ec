# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue import Intrinsics, StereoRig
from tricue.scenes.overtakings.pan import Pan
from tricue.scenes.people.body import Person
from tricue.scenes.people.pedestrian import Outfit, Pedestrian


def walker(coat=False):
    """Somebody 1.8 m tall who walks a meter a second along x."""
    path = np.stack([np.arange(30) / 15, np.full(30, 4.0)], axis=1)
    outfit = Outfit.sample(0.2, coat, np.random.default_rng(0))
    return Pedestrian.walk(Person(1.8, 1.0), outfit, path, 1.1, 15.0)


def test_walkers_walk_on_the_floor():
    """The body goes along the path, its lowest point on the floor in each frame, its legs swinging."""
    person = walker()
    ankles = []
    for index, parts in enumerate(person.parts):
        reach = np.linalg.norm(parts.roots[:, 1], axis=1)
        assert (parts.centers[:, 1] + reach).max() == pytest.approx(1.1)
        assert parts.centers[0, [0, 2]] == pytest.approx([index / 15, 4.0], abs=0.05)
        ankles.append(parts.centers[8, 0] - parts.centers[0, 0])
    assert np.ptp(ankles) > 0.35


def test_a_coat_hides_the_thighs():
    """Seen from the side a coat is wider than the trunk and ends below the knees; nothing else changes."""
    bare, dressed = walker(), walker(coat=True)
    extra = len(dressed.parts[0].centers) - len(bare.parts[0].centers)
    assert extra == 3
    np.testing.assert_array_equal(dressed.parts[3].centers[:-extra], bare.parts[3].centers)
    lowest = (dressed.parts[0].centers[:, 1] + np.linalg.norm(dressed.parts[0].roots[:, 1], axis=1))[-1]
    assert 0.25 < 1.1 - lowest < 0.45
    assert len(dressed.part_textures) == len(dressed.parts[0].centers)


def test_textures_keep_their_level():
    """Seen from farther away each texture is a coarser one, and always of a single level."""
    person = walker()
    near, far = (person.at_detail(depth, 300.0).part_textures for depth in (1.0, 8.0))
    assert {len(map_) for map_ in near + far} == {1}
    assert all(few[0].size < many[0].size for few, many in zip(far, near, strict=True))


def test_a_point_of_the_cloth_stays_on_its_limb():
    """The same point of the unit ball keeps its distance from a limb's joint, however the limb swings."""
    parts = walker().parts
    q = np.array([0.6, -0.64, 0.48])
    for limb in (6, 7, 9, 10):
        ends = [
            np.linalg.norm(build_oriented_body.roots[limb] @ (q - [0, 1, 0])) for build_oriented_body in parts
        ]
        assert np.ptp(ends) < 1e-9


def test_a_pan_shows_places_where_they_were_asked_for():
    """A place on the floor for a column and a depth is at that column and depth in the turned camera."""
    rig = StereoRig(Intrinsics.from_fov(160, 120, 40), 0.12)
    pan = Pan(rig, 1.0, np.array([-0.2, 0.0, 0.3]))
    places = pan.on_floor(np.array([0.1, -0.2, 0.3]), np.array([4.0, 5.0, 6.0]))
    for index, (column, depth) in enumerate(zip((0.1, -0.2, 0.3), (4.0, 5.0, 6.0), strict=True)):
        x, _, z = pan.to_camera(index) @ [places[index, 0], 0, places[index, 1]]
        assert (x / z, z) == pytest.approx((column, depth))
    assert pan.reach == pytest.approx((-0.2 - np.radians(20), 0.3 + np.radians(20)))
