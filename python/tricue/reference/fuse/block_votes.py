# SPDX-License-Identifier: MIT
"""The votes on the blocks of the target window (Okada, Shirai, Miura 1996, section 4.4 and figure 7)."""

import numpy as np
from numpy.typing import NDArray

from tricue.reference.base.arrays import Flags, Floats
from tricue.reference.base.checks import refuse
from tricue.reference.fuse.block_counts import MIN_MEASURED_SHARE

Counts = NDArray[np.int64]

Votes = tuple[Counts, Counts, Counts, Flags, Counts, Counts]
Seen = tuple[Counts, Counts, Counts, Floats, Counts]

MAX_FRAMES = 2**31 - 1
OTHER, TARGET, OCCLUDED = 0, 1, 2
TRUSTED_FRAMES = 3


def block_votes(
    blocks: Votes, seen: Seen, limits: tuple[float, float, float], rules: tuple[float, int, int, int, int]
) -> Votes:
    """Applies one rule after the other to all blocks at once."""
    _require_arguments(blocks, seen)
    states, votes, against, core, trusted, without_pixels = blocks
    pixels, targets, measured, mean, similar = seen
    target_disparity, tolerance, occluder = limits
    min_share, to_add, to_remove, to_release, max_without_pixels = rules
    inside = pixels > 0
    has_mean = (measured >= MIN_MEASURED_SHARE * pixels) & inside
    found = (targets >= min_share * pixels) & inside
    same_depth = (similar >= min_share * pixels) & inside
    hidden = (mean > occluder) & has_mean & ~found
    similar_mean = (np.abs(mean - target_disparity) <= tolerance) & has_mean
    target, occluded = states == TARGET, states == OCCLUDED

    without_pixels = np.where(found, 0, without_pixels + (same_depth & ~hidden))
    core = core & (without_pixels < max_without_pixels)
    votes = np.where(found | (same_depth & core), votes + 1, np.maximum(votes - inside, 0))
    away = ~found & ~same_depth & ~hidden & has_mean
    against = np.where(
        away & (target | (occluded & ~similar_mean)),
        against + 1,
        np.where(target & (found | same_depth), 0, against),
    )
    after = states.copy()
    after[(states == OTHER) & (votes >= to_add)] = TARGET
    after[target & hidden] = OCCLUDED
    after[occluded & (against >= to_release)] = OTHER
    after[occluded & similar_mean] = TARGET
    after[target & ((against >= to_remove) | (without_pixels >= max_without_pixels))] = OTHER
    votes = np.where((after == OTHER) & (target | occluded), 0, np.minimum(votes, to_add))
    against = np.where(after == states, against, 0)
    trusted = np.where(found, TRUSTED_FRAMES, np.where(hidden, trusted, np.maximum(trusted - 1, 0)))
    return after, votes, against, core, trusted, without_pixels


def _require_arguments(blocks: Votes, seen: Seen) -> None:
    states, votes, against, core, trusted, without_pixels = blocks
    pixels, targets, measured, mean, similar = seen
    frames = {"votes": votes, "against": against, "trusted": trusted, "without_pixels": without_pixels}
    others = {"core": core, "pixels": pixels, "targets": targets, "measured": measured, "mean": mean}
    for name, numbers in {**frames, **others, "similar": similar}.items():
        if len(numbers) != len(states):
            refuse(name, f"{len(states)} numbers", len(numbers))
    for name, counts in frames.items():
        for count in counts:
            if not 0 <= count <= MAX_FRAMES:
                refuse(name, f"0 to {MAX_FRAMES} frames", count)
    for state in states:
        if state not in (OTHER, TARGET, OCCLUDED):
            refuse("states", "0, 1 or 2", state)
