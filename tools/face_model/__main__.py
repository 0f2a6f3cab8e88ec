# SPDX-License-Identifier: MIT
"""Renders faces and scenes, and learns from them what a face looks like.

    python -m tools.face_model [--write] [--montage FILE] [--faces N] [--scenes N]

It prints how many of further faces and scenes the table gets right: the installed one, or with --write the
new one, which it learns and writes to learned_face.py. The same seed gives the same table.
"""

import argparse
import time
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
from tricue.arrays import Image, Plane
from tricue.track.head_detection import learned_face
from tricue.track.head_detection.face_detection import channels_of, skin

from tools.face_model.learn import MATCH_BONUS, Model, learn
from tools.face_model.portraits import MARGIN, portrait
from tools.face_model.scenes import scene
from tools.face_model.table import table

ROOT = Path(__file__).parents[2]
FILE = ROOT / "python" / "tricue" / "track" / "head_detection" / "learned_face.py"
SEED, TEST_SEED = 0, 1
TESTED = 500  # faces, and as many scenes
MIN_SCORE = 1.0  # of a window that counts as a face


def main() -> None:
    """Parse the arguments, and do it."""
    parser = argparse.ArgumentParser(prog="python -m tools.face_model", description=__doc__.split("\n")[0])
    parser.add_argument("--write", action="store_true", help="learn, and write learned_face.py")
    parser.add_argument("--montage", metavar="FILE", help="write a picture of rendered faces and scenes")
    parser.add_argument("--faces", metavar="N", type=int, default=7000, help="to learn from")
    parser.add_argument("--scenes", metavar="N", type=int, default=9000, help="to learn from")
    arguments = parser.parse_args()
    cv2.setNumThreads(1)
    if arguments.montage:
        cv2.imwrite(arguments.montage, montage())
        return
    model = installed()
    if arguments.write:
        start = time.perf_counter()
        model = learn(*rendered(SEED, arguments.faces, arguments.scenes), np.random.default_rng(SEED))
        FILE.write_text(table(model), encoding="utf-8")
        print(f"{FILE.relative_to(ROOT)} written in {time.perf_counter() - start:.0f} s")
    found, false = shares(model, *rendered(TEST_SEED, TESTED, TESTED))
    print(f"faces found: {found:.1%}; scenes with a false face: {false:.1%}")


def installed() -> Model:
    """What learned_face.py holds."""
    return Model(learned_face.TEMPLATE, learned_face.BIAS, learned_face.VOTES, learned_face.VOTE_BIAS)


def rendered(seed: int, faces: int, scenes: int) -> tuple[list[Image], list[Image]]:
    """Portraits and scenes."""
    rng = np.random.default_rng(seed)
    return [portrait(rng) for _ in range(faces)], [scene(rng) for _ in range(scenes)]


def shares(model: Model, portraits: Sequence[Image], scenes: Sequence[Image]) -> tuple[float, float]:
    """The shares of faces found in their windows, and of scenes in which something is taken for a face."""
    found = [_scores(model, image)[MARGIN, MARGIN] > MIN_SCORE for image in portraits]
    false = [np.any((_scores(model, image) > MIN_SCORE) & skin(image)) for image in scenes]
    return float(np.mean(found)), float(np.mean(false))


def _scores(model: Model, image: Image) -> Plane:
    """Of all windows; those that don't match the template keep its score."""
    channels = channels_of(image)
    scores = model.matches(channels)
    y, x = np.nonzero(scores > MIN_SCORE - MATCH_BONUS)
    scores[y, x] = model.scores(channels, scores, y, x)
    return scores


def montage() -> Image:
    """64 portraits, twice as large, over 16 scenes."""
    portraits, scenes = rendered(TEST_SEED, 64, 16)
    twice = np.asarray(portraits).repeat(2, axis=1).repeat(2, axis=2)
    return np.concatenate([_grid(twice, 16), _grid(np.asarray(scenes), 8)])


def _grid(images: Image, columns: int) -> Image:
    _, height, width, _ = images.shape
    rows = images.reshape(-1, columns, height, width, 3)
    return np.asarray(rows.swapaxes(1, 2).reshape(-1, columns * width, 3))


if __name__ == "__main__":
    main()
