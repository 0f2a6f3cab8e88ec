# SPDX-License-Identifier: MIT
"""Stress scenes, each rendered once, with whatever channels a test asks for."""

from collections.abc import Callable, Sequence

import pytest
from tricue import Frame

CHANNELS = {
    "color": ("color",),
    "rgbd": ("color", "depth"),
    "pair": ("color", "right"),
    "depth": ("depth",),
    "all": ("color", "depth", "right"),
}
ALONE = ("leaving", "lookalike")  # kinds that are drawn without a right image, which takes a while


@pytest.fixture(scope="session")
def drawn(rendered: Callable[..., object]) -> Callable[..., object]:
    """A scene by its kind, seed and channels; "stereo" knows the rig, and all have the same truth."""
    pytest.importorskip("skimage", reason="scenes need scikit-image: pip install tricue[demo]")
    from tricue.scenes.stress.scene import stress_scene

    def scene(kind: str, seed: int = 0, channels: str = "") -> object:
        return rendered(
            stress_scene, kind, seed, channels=channels or ("rgbd" if kind in ALONE else "stereo")
        )

    return scene


@pytest.fixture(scope="session")
def shoot(drawn: Callable[..., object]) -> Callable[..., list[Frame]]:
    """The first frames of a scene, each with the channels of that name, or all of one."""

    def frames(kind: str, names: Sequence[str] | str, seed: int = 0) -> list[Frame]:
        channels = ("rgbd", "rgbd") if kind in ALONE else ("stereo", "depth")
        pairs, depths = (drawn(kind, seed, each).frames for each in channels)
        named = len(pairs) * [names] if isinstance(names, str) else names
        made = []
        for name, pair, depth in zip(named, pairs, depths, strict=False):
            images = {"color": pair.color, "right": pair.right, "depth": depth.depth}
            made.append(Frame(**{each: images[each] for each in CHANNELS[name]}, timestamp=pair.timestamp))
        return made

    return frames
