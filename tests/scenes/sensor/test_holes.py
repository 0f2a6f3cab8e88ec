# SPDX-License-Identifier: MIT
import numpy as np
import pytest
from tricue.camera.rig import Intrinsics
from tricue.scenes.sensor.holes import HoleField, HoleShares

CAMERA = Intrinsics.from_fov(160, 120, 60.0)
SHARES = HoleShares(dark=0.3, medium=0.05, bright=0.0, shiny=0.8, edge=0.5, reach=1, grain=2.0)
FLAT, NOTHING = np.full((120, 160), 1.5), np.zeros((120, 160), bool)


def mean_share(depth, gray, shiny, part, shares=SHARES):
    """Of the holes in a part of the image, over some scenes."""
    fields = [HoleField((120, 160), shares, np.random.default_rng(seed)) for seed in range(12)]
    return np.mean([field.next_holes(depth, gray, shiny, CAMERA)[part].mean() for field in fields])


@pytest.mark.parametrize(("level", "share"), [(20, 0.3), (120, 0.05), (240, 0.0)])
def test_shares_are_those_of_the_brightness(level, share):
    """Of dark, medium and bright surfaces the told share is lost."""
    gray = np.full(FLAT.shape, 120, np.uint8)
    part = np.s_[:, 40:120]
    gray[part] = level
    assert mean_share(FLAT, gray, NOTHING, part) == pytest.approx(share, abs=0.04)


def test_shiny_things_are_lost_whatever_their_brightness():
    """A bright thing that is shiny has the share of shiny ones."""
    gray, shiny = np.full(FLAT.shape, 240, np.uint8), NOTHING.copy()
    shiny[:, 40:120] = True
    assert mean_share(FLAT, gray, shiny, shiny) == pytest.approx(0.8, abs=0.05)
    assert mean_share(FLAT, gray, shiny, ~shiny) == 0


def test_edges_are_lost_up_to_their_reach():
    """Beside a step the share is that of edges; two pixels away there is none."""
    depth, gray = FLAT.copy(), np.full(FLAT.shape, 240, np.uint8)
    depth[:, 80:] = 2.5
    assert mean_share(depth, gray, NOTHING, np.s_[:, 78:82]) == pytest.approx(0.5, abs=0.1)
    assert mean_share(depth, gray, NOTHING, np.s_[:, :77]) == 0


def test_what_is_seen_aslant_is_lost():
    """A floor 10 cm below the camera is lost where its depth grows by 12 per meter; a frontal wall isn't."""
    below = np.maximum((np.arange(120) - CAMERA.cy) / CAMERA.fy, 1e-3)
    depth = np.tile((0.1 / below)[:, None], (1, 160)).clip(0, 20)
    gray = np.full(depth.shape, 240, np.uint8)
    slope = 1 / below  # depth per meter in the image of a floor
    far, near = (slope > 15) & (depth[:, 0] < 15), slope < 3
    no_edges = SHARES._replace(edge=0.0)
    assert mean_share(depth, gray, NOTHING, far, no_edges) > 0.9
    assert mean_share(depth, gray, NOTHING, near, no_edges) < 0.02


def test_patches_last():
    """Most holes of a frame are holes of the next one, and after some frames others too."""
    gray = np.full(FLAT.shape, 20, np.uint8)
    field = HoleField((120, 160), SHARES, np.random.default_rng(0))
    first, second = (field.next_holes(FLAT, gray, NOTHING, CAMERA) for _ in range(2))
    assert 0.5 < second[first].mean() < 0.95
    assert second.mean() == pytest.approx(0.3, abs=0.001)
