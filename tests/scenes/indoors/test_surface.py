# SPDX-License-Identifier: MIT
"""Smooth bodies: a ball, whose truth is known in closed form, and how two of them melt."""

import numpy as np
import pytest
from tricue.scenes.indoors.surface import Body, Cones, direct_light, open_sky, trace

FOCAL = 300.0


def cones(*balls, blend=1e-4):
    """Balls (x, y, z, radius)."""
    rows = np.array(balls, float)
    points, radii = rows[:, :3], np.repeat(rows[:, 3:], 2, axis=1)
    sides = np.tile([0.0, 0, -1], (len(rows), 1))
    return Cones(points, points + [0, 1e-3, 0], radii, sides, np.zeros(len(rows), np.int64), blend)


def rays(size=120):
    """Unit vectors through the pixels of a square image."""
    v, u = np.mgrid[:size, :size] - (size - 1) / 2
    every = np.stack([u / FOCAL, v / FOCAL, np.ones_like(u)], axis=-1, dtype=np.float32).reshape(-1, 3)
    return every / np.linalg.norm(every, axis=1, keepdims=True)


def test_a_ball_is_hit_where_it_is():
    """Depths are those of the ray's quadratic equation, and normals point away from the center.

    A ray ends half a pixel, 1.7 mm, inside of the ball; along a ray that meets it at 37 degrees that is 2.8.
    """
    center, radius = np.array([0.01, 0.0, 1.0]), 0.1
    body = Body(cones((*center, radius)))
    all_rays = rays()
    hits = trace(body, all_rays, 1 / FOCAL)
    seen = hits.coverage == 1
    along = all_rays[seen] @ center
    depth = along - np.sqrt(radius**2 - (center @ center - along**2) + 1e-9)
    assert seen.sum() > 2000
    inner = along**2 > center @ center - (0.8 * radius) ** 2
    np.testing.assert_allclose(hits.depths[seen][inner], depth[inner], atol=3e-3)
    points = hits.depths[seen, None] * all_rays[seen]
    normals = body.look(points).normals[inner]
    expected = (points - center)[inner]
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    assert (normals * expected).sum(axis=1).min() > 0.999


def test_coverage_is_the_balls_area():
    """The sum of the coverage is the area of the ball's outline, an ellipse, within a few percent."""
    radius, z = 0.1, 1.0
    coverage = trace(Body(cones((0, 0, z, radius))), rays(), 1 / FOCAL).coverage
    outline = FOCAL * radius / np.sqrt(z**2 - radius**2)
    assert coverage.sum() == pytest.approx(np.pi * outline**2, rel=0.03)
    assert 0 < ((coverage > 0) & (coverage < 1)).sum() < 8 * outline


def test_distance_is_a_lower_bound_and_melts_nearby():
    """Away from two balls the distance never exceeds the true one; between them it is less than to each."""
    body = Body(cones((-0.05, 0, 1, 0.045), (0.05, 0, 1, 0.045), blend=0.01))
    points = (
        np.random.default_rng(0).uniform([-0.3, -0.3, 0.7], [0.3, 0.3, 1.3], (5000, 3)).astype(np.float32)
    )
    true = np.min([np.linalg.norm(points - [x, 0, 1], axis=1) for x in (-0.05, 0.05)], axis=0) - 0.045
    assert (body.distance(points) <= true + 2e-3).all()
    assert body.distance(np.array([[0, 0, 1]], np.float32))[0] < 0.005 - 0.005


def test_folds_and_shadows_are_darker():
    """A point between two balls gets less light from everywhere; one behind another less from the lamp."""
    body = Body(cones((-0.05, 0, 1, 0.05), (0.05, 0, 1, 0.05)))
    fold, free = np.array([[0, 0, 0.985]], np.float32), np.array([[-0.1, 0, 1]], np.float32)
    ahead, left = np.array([[0, 0, -1]], np.float32), np.array([[-1, 0, 0]], np.float32)
    assert open_sky(body, fold, ahead)[0] < open_sky(body, free, left)[0] - 0.1
    lamp = np.array([1.0, 0, 0])
    assert direct_light(body, free, left, lamp)[0] < 0.5
    assert direct_light(body, np.array([[0.101, 0, 1]], np.float32), -left, lamp)[0] == 1.0
