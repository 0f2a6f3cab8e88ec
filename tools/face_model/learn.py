# SPDX-License-Identifier: MIT
"""Learns the detector's template and votes from pictures of faces, and of what it takes for faces.

Scenes have millions of windows, and hardly any resembles a face. So the detector is learned in rounds: what
it finds in further scenes are the windows that it learns from next. It sees pictures by its own functions.

A face is as likely as its mirror image, so the model is symmetric: it knows the features of both sides of a
face only together. Therefore no picture has to be learned from twice.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray
from tricue.arrays import Floats, Image, Plane
from tricue.track.head_detection.face_detection import (
    COARSE,
    FINE,
    MIRRORED,
    WINDOW,
    FaceChannels,
    Pixels,
    Vote,
    cells,
    channels_of,
    match,
    skin,
    votes,
)

from tools.face_model.painting import Random
from tools.face_model.portraits import MARGIN

SIDES = COARSE, FINE
TEMPLATE_SHAPE = len(MIRRORED), WINDOW // COARSE, WINDOW // COARSE
COARSE_FEATURES = int(np.prod(TEMPLATE_SHAPE))

RANDOM_WINDOWS = 8  # of a scene
SCALES = 1.0, 0.7, 0.45  # of a scene, in which windows are mined
MINED = 5  # windows of a scene at one scale, at most
MIN_MINED_MATCH, MIN_MINED_SCORE = -2.5, -0.5
MIN_DISTANCE = 3  # pixels between mined windows
MATCH_BONUS = 2.0  # of the template's score when windows are mined by the lower one of it and the votes' sum
EXAMINED = 150  # windows that match best, of which the votes choose

NEWTON_STEPS, RIDGE, WEIGHT = 8, 15.0, 16000  # of the logistic regression; weight of all windows
GRAIN = 0.05  # to which the template is rounded
VOTES, FIRST_VOTES = 600, 200  # of the model; of those before, which only mine
RATE = 0.3  # of what a vote would best be: many small steps depend less on chance
BINS, SAMPLE, FEATURES = 20, 5000, 900  # thresholds, windows and features that a vote is chosen from
VOTE_GRAIN, THRESHOLD_DIGITS = 0.005, 2
SCORE_DIGITS = 6  # so that equal sums of votes are equal in any order of summation
SHRINKAGE = 0.02  # of votes that few windows are concerned by


class Model(NamedTuple):
    """What the detector knows of faces; without votes, only the template counts."""

    template: Plane
    bias: float
    votes: Sequence[Vote] = ()
    vote_bias: float = 0.0

    def matches(self, channels: FaceChannels) -> Plane:
        """How well all windows match the template."""
        return match(channels, self.template, self.bias)

    def scores(self, channels: FaceChannels, matches: Plane, y: Pixels, x: Pixels) -> Floats:
        """The scores of the windows that start at these pixels."""
        if not self.votes:
            return np.asarray(matches[y, x], np.float64)
        voted = votes(channels, y, x, self.votes, self.vote_bias)
        return np.asarray(np.minimum(matches[y, x] + MATCH_BONUS, np.round(voted, SCORE_DIGITS)))


def learn(portraits: Sequence[Image], scenes: Sequence[Image], rng: Random) -> Model:
    """The model after five rounds, of which each mines a part of the scenes by what was learned before."""
    faces = np.concatenate([features(channels_of(image), [MARGIN], [MARGIN]) for image in portraits])
    easy = [*_random_windows(scenes[: len(scenes) // 3], rng), *_turned(portraits[: len(portraits) // 4])]
    hard = [*_displaced(portraits[: len(portraits) // 5])]
    first, second, third, fourth, fifth = (scenes[part::5] for part in range(5))

    for part in (first, second):
        model = _template(faces, np.concatenate([*easy, *hard]))
        hard += _mine(part, model)
    model = _template(faces, np.concatenate([*easy, *hard]))
    hard += _mine(third, model)
    for part in (fourth, fifth):
        model = _with_votes(model, faces, np.concatenate(hard), FIRST_VOTES, rng)
        hard += _mine(part, model)
    others = np.concatenate(hard)
    return _with_votes(_template(faces, others), faces, others, VOTES, rng)


def features(channels: FaceChannels, y: Iterable[int], x: Iterable[int]) -> NDArray[np.float16]:
    """All coarse and then all fine cells of the windows that start at these pixels, a row for a window."""
    at_y, at_x = (np.asarray([*at], np.intp)[:, np.newaxis, np.newaxis] for at in (y, x))
    found = []
    for side in SIDES:
        offsets = np.arange(0, WINDOW, side)
        rows, columns = at_y + offsets[:, np.newaxis], at_x + offsets
        for channel, plane in enumerate(channels.planes):
            values = channels.relative(channel, cells(plane, side)[rows, columns], at_y, at_x)
            found.append(values.reshape(-1, len(offsets) ** 2))
    return np.concatenate(found, axis=1).astype(np.float16)


def _mirror() -> Pixels:
    """Which feature of the mirrored window each feature is."""
    order, start = [], 0
    for side in SIDES:
        count = WINDOW // side
        places = np.arange(count * count).reshape(count, count)[:, ::-1]
        order += [start + channel * count * count + places.ravel() for channel in MIRRORED]
        start += len(MIRRORED) * count * count
    return np.concatenate(order)


MIRROR = _mirror()


def _feature(index: int) -> tuple[int, int, int, int]:
    """Side of the cell, channel, row and column of a feature."""
    side = COARSE if index < COARSE_FEATURES else FINE
    count = WINDOW // side
    channel, place = divmod(index - COARSE_FEATURES * (side == FINE), count * count)
    return side, channel, *divmod(place, count)


def _random_windows(scenes: Sequence[Image], rng: Random) -> Iterator[NDArray[np.float16]]:
    for image in scenes:
        reduced = _resized(image, rng.uniform(0.35, 1))
        yield features(channels_of(reduced), *rng.integers(0, len(reduced) - WINDOW, (2, RANDOM_WINDOWS)))


def _turned(portraits: Sequence[Image]) -> Iterator[NDArray[np.float16]]:
    """Faces upside down and on the side."""
    for image in portraits:
        for turned in (image[::-1], image.transpose(1, 0, 2)):
            yield features(channels_of(np.ascontiguousarray(turned)), [MARGIN], [MARGIN])


def _displaced(portraits: Sequence[Image]) -> Iterator[NDArray[np.float16]]:
    """Windows beside faces."""
    for image in portraits:
        yield features(channels_of(image), [0, 2 * MARGIN, MARGIN, MARGIN], [MARGIN, MARGIN, 0, 2 * MARGIN])


def _mine(scenes: Sequence[Image], model: Model) -> list[NDArray[np.float16]]:
    """The windows that the model likes best, of all windows and of those that could be skin."""
    found = []
    for image in scenes:
        for scale in SCALES:
            reduced = _resized(image, scale)
            channels = channels_of(reduced)
            matches = model.matches(channels)
            for allowed in (np.ones_like(matches, bool), skin(reduced)):
                y, x = np.nonzero(allowed & (matches > MIN_MINED_MATCH))
                if len(y):
                    best = np.argsort(-matches[y, x], kind="stable")[:EXAMINED]
                    y, x = y[best], x[best]
                    chosen = _best_apart(model.scores(channels, matches, y, x), y, x, bool(model.votes))
                    found.append(features(channels, y[chosen], x[chosen]))
    return found


def _best_apart(scores: Floats, y: Pixels, x: Pixels, voted: bool) -> list[int]:
    """Indices of the windows with the best scores that don't lie on each other."""
    chosen: list[int] = []
    for index in np.argsort(-scores, kind="stable").tolist():
        if len(chosen) == MINED or (voted and scores[index] < MIN_MINED_SCORE):
            break
        distance = np.maximum(np.abs(y[chosen] - y[index]), np.abs(x[chosen] - x[index]))
        if (distance >= MIN_DISTANCE).all():
            chosen.append(index)
    return chosen


def _resized(image: Image, scale: float) -> Image:
    resized = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    return np.asarray(resized, np.uint8)


def _template(faces: NDArray[np.float16], others: NDArray[np.float16]) -> Model:
    """The symmetric template by ridge logistic regression, in which faces weigh as much as all others."""
    windows = np.concatenate([faces, others])[:, :COARSE_FEATURES].astype(np.float32)
    mirror = MIRROR[:COARSE_FEATURES]
    one_side = np.nonzero(np.arange(COARSE_FEATURES) <= mirror)[0]
    means = (windows[:, one_side] + windows[:, mirror[one_side]]) / 2
    means = np.concatenate([means, np.ones((len(means), 1), np.float32)], axis=1)
    is_face = np.arange(len(means)) < len(faces)
    share = np.where(is_face, 0.5 / len(faces), 0.5 / len(others)) * WEIGHT
    ridge = np.append(np.full(len(one_side), RIDGE), 1e-3)
    weights = np.zeros(len(ridge))
    for _ in range(NEWTON_STEPS):
        chance = 1 / (1 + np.exp(-np.clip(means @ weights, -30, 30)))
        curvature = (share * np.maximum(chance * (1 - chance), 1e-4)).astype(np.float32)
        hessian = (means * curvature[:, np.newaxis]).T @ means + np.diag(ridge)
        weights -= np.linalg.solve(hessian, means.T @ (share * (chance - is_face)) + ridge * weights)
    template = np.zeros(COARSE_FEATURES)
    template[one_side] = weights[:-1] / 2
    template[mirror[one_side]] += weights[:-1] / 2
    rounded = np.rint(template / GRAIN) * GRAIN
    return Model(rounded.reshape(TEMPLATE_SHAPE).astype(np.float32), round(float(weights[-1]), 2))


def _with_votes(
    model: Model, faces: NDArray[np.float16], others: NDArray[np.float16], count: int, rng: Random
) -> Model:
    """The model with votes by gentle boosting: each is fitted to the windows that those before get wrong.

    A vote counts how many of a pair of mirrored cells exceed a threshold, by weighted least squares.
    """
    windows = np.concatenate([faces, others])
    truth = np.where(np.arange(len(windows)) < len(faces), 1.0, -1.0)
    share = np.where(truth > 0, 0.5 / len(faces), 0.5 / len(others))
    thresholds = _thresholds(windows)
    levels = np.stack(
        [np.searchsorted(*each) for each in zip(thresholds.T, windows.T.astype(np.float32), strict=True)],
        axis=1,
    ).astype(np.uint8)
    total, bias, chosen = np.zeros(len(windows)), 0.0, []
    for _ in range(count):
        weight = share * np.exp(-np.clip(truth * total, -15, 15))
        weight /= weight.sum()
        feature, level = _best_threshold(levels, truth, weight, rng)
        exceeding = (levels[:, [feature, MIRROR[feature]]] > level).sum(axis=1)
        slope, middle = _line_fit(exceeding, truth, weight)
        vote = round(round(RATE * slope / VOTE_GRAIN) * VOTE_GRAIN, 3)
        bias += RATE * middle
        total += RATE * middle + vote * exceeding
        chosen.append((*_feature(feature), float(thresholds[level, feature]), vote))
    return model._replace(votes=chosen, vote_bias=round(bias, 2))


def _thresholds(windows: NDArray[np.float16]) -> Floats:
    """(BINS - 1, features) quantiles, rounded, alike for mirrored features."""
    quantiles = np.quantile(windows[::5].astype(np.float32), np.arange(1, BINS) / BINS, axis=0)
    return np.round((quantiles + quantiles[:, MIRROR]) / 2, THRESHOLD_DIGITS)


def _best_threshold(levels: NDArray[np.uint8], truth: Floats, weight: Floats, rng: Random) -> tuple[int, int]:
    """The feature and its level beyond which faces differ most, among some windows and features.

    Windows are drawn by their weights, and half of them mirrored.
    """
    windows = rng.choice(len(levels), SAMPLE, p=weight)
    some = rng.choice(levels.shape[1], FEATURES, replace=False)
    half = SAMPLE // 2
    sample = np.concatenate([levels[windows[:half]][:, some], levels[windows[half:]][:, MIRROR[some]]])
    place = (sample + BINS * np.arange(FEATURES)).ravel()
    size = FEATURES * BINS
    count = np.bincount(place, minlength=size).reshape(FEATURES, BINS).cumsum(axis=1) / SAMPLE
    truths = np.bincount(place, np.repeat(truth[windows], FEATURES), size)
    below = truths.reshape(FEATURES, BINS).cumsum(axis=1) / SAMPLE
    gain = below**2 / (count + 0.01) + (below[:, -1:] - below) ** 2 / (1 - count + 0.01)
    best, level = divmod(int(gain[:, :-1].argmax()), BINS - 1)
    return int(some[best]), level


def _line_fit(x: NDArray[np.int_], y: Floats, weight: Floats) -> tuple[float, float]:
    """The slope of the least-squares line, and its value at 0."""
    mean_x, mean_y = weight @ x, weight @ y
    slope = (weight @ (x * y) - mean_x * mean_y) / (weight @ (x * x) - mean_x**2 + SHRINKAGE)
    return float(slope), float(mean_y - slope * mean_x)
