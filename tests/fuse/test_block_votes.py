# SPDX-License-Identifier: MIT
"""The votes on the blocks of the target window."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal
from numpy.typing import NDArray
from tricue import _core, reference
from tricue.kernels import Kernels

from tests.kernel_arguments import with_argument

OTHER, TARGET, OCCLUDED = 0, 1, 2
NAMES = ("states", "votes", "against", "core", "trusted", "without_pixels")
SEEN = ("pixels", "targets", "measured", "mean", "similar")
LIMITS, RULES = (12.0, 2.0, 15.0), (0.25, 3, 4, 8, 20)
Blocks = dict[str, NDArray[Any]]
PIXELS = 40


def arguments(blocks: Blocks) -> tuple[Any, ...]:
    """Of the kernel, for blocks and what a frame measures in them."""
    return tuple(blocks[name] for name in NAMES), tuple(blocks[name] for name in SEEN), LIMITS, RULES


def case(seed: int = 0, count: int = 200, **changes: Any) -> Blocks:
    """Blocks in any state, of which some are outside the image, and what a frame measures in them."""
    rng = np.random.default_rng(seed)
    pixels = rng.choice(np.array([0, 5, PIXELS]), count)
    counts = [(rng.random(count) ** 2 * (pixels + 1)).astype(np.int64) for _ in range(3)]
    mean = np.where(counts[1] > 0, rng.uniform(0, 20, count), np.nan)
    return {
        "states": rng.integers(0, 3, count),
        "votes": rng.integers(0, 5, count),
        "against": rng.integers(0, 9, count),
        "core": rng.random(count) < 0.5,
        "trusted": rng.integers(0, 4, count),
        "without_pixels": rng.integers(0, 25, count),
        "pixels": pixels,
        "targets": counts[0],
        "measured": counts[1],
        "mean": mean,
        "similar": counts[2],
        **changes,
    }


def one(state: int, core: bool = True, **changes: Any) -> Blocks:
    """A single block inside the image without votes, in which nothing is measured."""
    start = {
        **{name: np.zeros(1, np.int64) for name in (*NAMES, *SEEN)},
        "states": np.array([state]),
        "core": np.array([core]),
        "mean": np.array([np.nan]),
    }
    arrays = {name: np.array([value]) for name, value in changes.items()}
    return {**start, "pixels": np.array([PIXELS]), **arrays}


def after_frames(kernels: Kernels, blocks: Blocks, frames: int) -> list[int]:
    """The block's state after each of so many frames that measure the same."""
    states = []
    for _ in range(frames):
        blocks = {**blocks, **dict(zip(NAMES, kernels.block_votes(*arguments(blocks)), strict=True))}
        states.append(int(blocks["states"][0]))
    return states


@given(st.integers(0, 2**32), st.integers(0, 300))
def test_twin_gives_the_same(seed: int, count: int) -> None:
    """Native and reference agree on any blocks: they compare and count."""
    each = arguments(case(seed, count))
    for ours, theirs in zip(_core.block_votes(*each), reference.block_votes(*each), strict=True):
        assert_array_equal(ours, theirs, strict=True)


def test_each_by_itself(kernels: Kernels) -> None:
    """A block's votes are the same in any company, and the arguments stay as they are."""
    blocks, untouched = case(), case()
    together = kernels.block_votes(*arguments(blocks))
    for i in range(len(blocks["states"])):
        alone = kernels.block_votes(*arguments({name: value[[i]] for name, value in blocks.items()}))
        for all_of_them, its in zip(together, alone, strict=True):
            assert all_of_them[i] == its[0]
    for name, value in blocks.items():
        assert_array_equal(value, untouched[name])


def test_votes_in_a_row_make_a_target(kernels: Kernels) -> None:
    """Three frames with target pixels in a fourth of a block make it the target's; fewer pixels never do."""
    assert after_frames(kernels, one(OTHER, targets=PIXELS // 4), 4) == [OTHER, OTHER, TARGET, TARGET]
    assert after_frames(kernels, one(OTHER, targets=PIXELS // 4 - 1), 4) == [OTHER] * 4


def test_another_disparity_ends_a_target(kernels: Kernels) -> None:
    """Four frames at another disparity end a target block; with few disparities none does."""
    away = one(TARGET, measured=PIXELS // 5, mean=4.0)
    assert after_frames(kernels, away, 5) == [TARGET] * 3 + [OTHER] * 2
    assert after_frames(kernels, {**away, "measured": np.array([PIXELS // 5 - 1])}, 9) == [TARGET] * 9


def test_depth_alone_keeps_a_core_block_for_a_while(kernels: Kernels) -> None:
    """At the target's disparity a core block lives 20 frames without target pixels; only it is voted in."""
    same = {"measured": PIXELS, "mean": 12.0, "similar": PIXELS}
    states = after_frames(kernels, one(TARGET, **same), 21)
    assert states == [TARGET] * 19 + [OTHER] * 2
    assert after_frames(kernels, one(OTHER, **same), 4)[-1] == TARGET
    assert after_frames(kernels, one(OTHER, core=False, **same), 4)[-1] == OTHER


def test_an_occlusion_ends_at_the_targets_disparity(kernels: Kernels) -> None:
    """What is nearer hides a target block; it is back at a similar disparity, and gone after long without."""
    assert after_frames(kernels, one(TARGET, measured=PIXELS, mean=15.1), 2) == [OCCLUDED] * 2
    assert after_frames(kernels, one(TARGET, measured=PIXELS, mean=15.0), 2) == [TARGET] * 2
    assert after_frames(kernels, one(OCCLUDED, measured=PIXELS, mean=14.0), 1) == [TARGET]
    behind = after_frames(kernels, one(OCCLUDED, measured=PIXELS, mean=4.0), 9)
    assert behind == [OCCLUDED] * 7 + [OTHER] * 2


def test_outside_the_image_nothing_changes(kernels: Kernels) -> None:
    """A block without pixels in the image keeps its state and its votes."""
    start = one(TARGET, pixels=0, votes=2, against=3)
    states, votes, against, *_ = kernels.block_votes(*arguments(start))
    assert (states[0], votes[0], against[0]) == (TARGET, 2, 3)


BAD: list[tuple[str, Any, str]] = [
    *((name, np.zeros(3, np.int64), f"{name}: expected 2 numbers, got 3") for name in ("votes", "similar")),
    ("core", np.zeros(1, np.bool_), "core: expected 2 numbers, got 1"),
    ("mean", np.zeros(0), "mean: expected 2 numbers, got 0"),
    *(
        (name, np.array([0, number]), f"{name}: expected 0 to 2147483647 frames, got {number}")
        for name, number in (
            ("votes", 2**31),
            ("against", 2**63 - 1),
            ("trusted", -(2**63)),
            ("without_pixels", -1),
        )
    ),
    ("states", np.array([0, 3]), "states: expected 0, 1 or 2, got 3"),
    ("states", np.array([-1, 0]), "states: expected 0, 1 or 2, got -1"),
]


@pytest.mark.parametrize(("name", "value", "message"), BAD)
def test_refuses(kernels: Kernels, name: str, value: Any, message: str) -> None:
    """Sizes that differ, and states that there aren't, are named."""
    with pytest.raises(ValueError, match=message):
        kernels.block_votes(*arguments(case(count=2, **{name: value})))


def test_native_refuses_bytes_that_are_no_bool() -> None:
    """A mask of 0 and 2 viewed as bool, which NumPy takes for True and C++ not always, is named."""
    core = np.array([0, 2], np.uint8).view(np.bool_)
    with pytest.raises(ValueError, match="core: expected bool of bytes 0 and 1, got others"):
        _core.block_votes(*arguments(case(count=2, core=core)))


def test_native_refuses_other_types() -> None:
    """Another type is named, not converted."""
    with pytest.raises(TypeError, match=r"votes: expected int64 \(N,\), got float64"):
        _core.block_votes(*arguments(case(count=2, votes=np.zeros(2))))


def test_native_refuses_more_frames_than_there_are() -> None:
    """A number of frames of more than 64 bits is named, and so is one that isn't an integer."""
    each = arguments(case(count=2))
    with pytest.raises(ValueError, match="rules: expected integers of at most 64 bits in it"):
        _core.block_votes(*with_argument(each, (3, 1), 2**63))
    with pytest.raises(TypeError, match="rules: expected an integer in it, got float"):
        _core.block_votes(*with_argument(each, (3, 1), 3.0))
