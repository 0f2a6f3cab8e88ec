# SPDX-License-Identifier: MIT
"""The front of a head as a surface of heights and albedos, part by part, with random measures.

All lengths are in mm. x goes to the image's right and y down from the point between the eyes; heights go
toward the viewer. Ranges of measures are those of adults and children, scaled to one distance of the eyes.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from tricue.arrays import Flags, Floats

from tools.face_model.painting import (
    Random,
    any_color,
    bell,
    disc,
    hair_color,
    line,
    noise,
    ramp,
    skin_color,
)

STEP = 2.5  # of the grid
X, Y = np.meshgrid(np.arange(-100, 100 + STEP, STEP), np.arange(-135, 135 + STEP, STEP))
SIDE = np.abs(X)  # distance from the middle
MIDDLE = -5.0  # y of the head's largest width

EYE = 28, 36  # half of the eyes' distance
BROW = 14, 25  # above the eyes
NOSE, MOUTH, CHIN = (40, 54), (64, 80), (102, 127)  # below the eyes
CROWN = 103, 122  # above the eyes
HIGH_HAIRLINE, LOW_HAIRLINE = (28, 92), (8, 35)  # above the eyes
HALF_WIDTH = 64, 82
DEPTH = 72, 98  # of the skull in front of the ears
IRIS = 6.3  # radius


class Measures(NamedTuple):
    """Where the parts of one face are."""

    eye: float  # x
    brow: float  # y, like the others
    nose: float
    mouth: float
    chin: float
    hairline: float
    crown: float
    half_width: float


class Head:
    """A head's front: heights, albedo (linear RGB), and which points of the grid belong to it."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.measures = _measures(rng)
        self.skin = skin_color(rng)
        self.bald = rng.uniform() < 0.1
        self.hair = self.skin * 0.9 if self.bald else hair_color(rng)
        self.albedo = np.tile(self.skin, (*X.shape, 1))
        self.height, self.mask = _skull(rng, self.measures)

    def raise_by(self, height: Floats | float) -> None:
        """Raise the surface."""
        self.height = self.height + height

    def paint(self, opacity: Floats, color: ArrayLike) -> None:
        """Cover the surface with a color."""
        self.albedo += opacity[..., np.newaxis] * (np.asarray(color) - self.albedo)


def random_head(rng: Random) -> Head:
    """A head of random shape, skin, hair and age."""
    head = Head(rng)
    for part in (_sockets, _cheeks, _nose, _lips, _eyes, _brows, _beard):
        part(head)
    if not head.bald:
        _hair(head)
    if rng.uniform() < 0.08:
        _hat(head)
    if rng.uniform() < 0.25:
        _glasses(head)
    return head


def _measures(rng: Random) -> Measures:
    high = rng.uniform() < 0.72
    return Measures(
        eye=rng.uniform(*EYE),
        brow=-rng.uniform(*BROW),
        nose=rng.uniform(*NOSE),
        mouth=rng.uniform(*MOUTH),
        chin=rng.uniform(*CHIN),
        hairline=-rng.uniform(*(HIGH_HAIRLINE if high else LOW_HAIRLINE)),
        crown=-rng.uniform(*CROWN),
        half_width=rng.uniform(*HALF_WIDTH),
    )


def _skull(rng: Random, at: Measures) -> tuple[Floats, Flags]:
    """A superellipsoid that tapers toward the chin; its heights, and where it is."""
    width = at.half_width * (1 - rng.uniform(0.05, 0.30) * ramp(Y, 25, at.chin))
    length = np.where(Y > MIDDLE, at.chin - MIDDLE, MIDDLE - at.crown)
    radius = (SIDE / width) ** rng.uniform(2.0, 2.8) + (np.abs(Y - MIDDLE) / length) ** 2.2
    return rng.uniform(*DEPTH) * np.maximum(1 - radius, 0) ** (1 / 2.2), radius < 1


def _sockets(head: Head) -> None:
    """The eyes' sockets under the brows' ridge, and the eyeballs in them; sometimes dark or made up."""
    rng, at = head.rng, head.measures
    socket = bell(SIDE, Y, (at.eye - 2, 0), (rng.uniform(12, 16), rng.uniform(8, 11)))
    head.raise_by(-rng.uniform(5, 12) * socket)
    head.raise_by(rng.uniform(1, 6) * bell(SIDE, Y, (at.eye - 2, at.brow), (20, 7)))
    head.raise_by(rng.uniform(3, 6) * bell(SIDE, Y, (at.eye, 1), (9, 6)))


def _cheeks(head: Head) -> None:
    """Cheekbones, the chin's bulge, and a blush."""
    rng, at = head.rng, head.measures
    head.raise_by(rng.uniform(2, 7) * bell(SIDE, Y, (45, rng.uniform(25, 35)), (18, 14)))
    head.raise_by(rng.uniform(3, 8) * bell(X, Y, (0, at.chin - 12), (16, 9)))
    head.paint(rng.uniform(0, 0.3) * bell(SIDE, Y, (42, 35), (18, 15)), head.skin * [1, 0.8, 0.8])


def _nose(head: Head) -> None:
    """A ridge that rises and widens from between the eyes to the tip, wings, nostrils, and their shadow."""
    rng, at = head.rng, head.measures
    above_base = 1 - ramp(Y, at.nose - 4, at.nose + 5)
    width = rng.uniform(6, 8) + rng.uniform(2, 4) * ramp(Y, 5, at.nose - 5)
    ridge = rng.uniform(12, 20) * ramp(Y, -12, at.nose - 8) + 3 * ramp(Y, -20, -5)
    head.raise_by(ridge * above_base * np.exp(-0.5 * (X / width) ** 2))
    head.raise_by(rng.uniform(4, 8) * bell(SIDE, Y, (13, at.nose - 5), (5, 6)))
    head.paint(rng.uniform(0.4, 1) * bell(SIDE, Y, (8, at.nose + 2), (4, 2.5)), head.skin * 0.1)
    head.paint(rng.uniform(0.1, 0.5) * bell(X, Y, (0, at.nose + 4), (18, 4)), head.skin * 0.4)


def _lips(head: Head) -> None:
    """Both lips and the fold below; when smiling, they bend and may show teeth."""
    rng, at = head.rng, head.measures
    fullness, half = rng.uniform(3, 6), rng.uniform(20, 30)
    head.raise_by(fullness * bell(X, Y, (0, at.mouth - 4), (20, 4)))
    head.raise_by(fullness * bell(X, Y, (0, at.mouth + 6), (18, 4.5)))
    head.raise_by(-2 * bell(X, Y, (0, at.mouth + 1), (22, 2)))
    head.raise_by(-rng.uniform(2, 4) * bell(X, Y, (0, at.mouth + 17), (18, 6)))
    smiles = rng.uniform() < 0.4
    bend = rng.uniform(0.3, 1) if smiles else 0.0
    y = Y - at.mouth - 1 + bend * (X**2 / 80 - 2)
    lips = disc(X, y, (half, rng.uniform(6, 9)), 0.25)
    head.paint(rng.uniform(0.3, 0.9) * lips, head.skin * [0.85, 0.5, 0.5] * rng.uniform(0.6, 1))
    if rng.uniform() < (0.7 if smiles else 0.1):
        teeth = disc(X, y, (half - 4, rng.uniform(2.5, 5)), 0.25)
        head.paint(0.9 * teeth, np.array([0.6, 0.55, 0.5]) * rng.uniform(0.5, 1))
    else:
        closed = line(y + 1 + rng.uniform(-1, 1) * X**2 / 300, 1.6) * (half > SIDE)
        head.paint(rng.uniform(0.5, 1) * closed, head.skin * 0.15)


def _eyes(head: Head) -> None:
    """White, iris and lashes of eyes that are more or less open and look to a side; dark skin around."""
    rng, at = head.rng, head.measures
    opening = rng.uniform(2.2, 6)
    x = SIDE - at.eye
    head.paint(disc(x, Y, (13, opening), 1 / 3), np.array([0.55, 0.52, 0.5]) * rng.uniform(0.5, 1))
    toward_center = np.hypot(X - np.sign(X) * at.eye - rng.uniform(-3, 3), Y)
    iris = ramp(-toward_center, -IRIS - 1.5, -IRIS + 1.5) * (np.abs(Y) < opening + 1)
    head.paint(rng.uniform(0.8, 1) * iris, np.array([0.04, 0.03, 0.025]) * rng.uniform(0.2, 2))
    lashes = line(Y + opening - x**2 / 60, 1.8) * (np.abs(x) < 15)
    head.paint(rng.uniform(0.3, 0.9) * lashes, head.skin * 0.12)
    around = bell(x, Y, (0, 0), (rng.uniform(12, 17), rng.uniform(7, 12)))
    head.paint(rng.uniform(0, 0.45) * around, head.skin * 0.45)


def _brows(head: Head) -> None:
    """Arched, and as thick and dark as it may be."""
    rng, at = head.rng, head.measures
    arch = at.brow + (SIDE - at.eye) ** 2 / rng.uniform(60, 160)
    ends = ramp(SIDE, 8, 14) * (1 - ramp(SIDE, 50, 58))
    head.paint(rng.uniform(0.25, 0.95) * line(Y - arch, rng.uniform(2.5, 4.5)) * ends, head.hair)


def _beard(head: Head) -> None:
    """Of three men in ten people, a full or a chin beard, of a day or of years."""
    rng, at = head.rng, head.measures
    if rng.uniform() > 0.3:
        return
    below_nose = ramp(Y, at.nose + 6, at.nose + 14) * (1 - disc(X, Y - at.mouth - 1, (25, 8), 0.25))
    beard = np.maximum(below_nose * (SIDE < 70), ramp(SIDE, 50, 60) * ramp(Y, -5, 10))
    if rng.uniform() < 0.3:
        beard = beard * (SIDE < 33)
    head.paint(rng.uniform(0.3, 0.95) * beard, head.hair)


def _hair(head: Head) -> None:
    """Above the hairline, parted or not, and beside the face; with strands."""
    rng, at = head.rng, head.measures
    inward = at.half_width * rng.uniform(0.78, 1.02)
    line_y = at.hairline + rng.uniform(-0.3, 1) * (SIDE / 40) ** 2 * 10 + 4 * noise(rng, X.shape, 12)
    line_y = line_y + rng.choice([-1, 0, 1]) * rng.uniform(0, 0.3) * X
    on_top = 1 - ramp(Y, line_y - 5, line_y + 5)
    beside = ramp(SIDE + 3 * noise(rng, X.shape, 10), inward - 4, inward + 4)
    start = rng.uniform(-15, 120)
    hair = np.maximum(on_top, beside * (1 - ramp(Y, start, start + 70)))
    head.paint(hair, head.hair)
    strands = np.exp(0.35 * noise(rng, X.shape, 4))
    head.albedo[hair > 0.5] *= strands[hair > 0.5, np.newaxis]
    head.raise_by(rng.uniform(2, 10) * hair * head.mask)


def _hat(head: Head) -> None:
    """A cap of any color, and its shadow on the forehead."""
    rng = head.rng
    edge = -rng.uniform(12, 60)
    head.paint(1 - ramp(Y, edge - 3, edge + 3), any_color(rng))
    head.raise_by(rng.uniform(4, 16) * (1 - ramp(Y, edge - 2, edge + 4)) * head.mask)
    end = edge + rng.uniform(10, 40)
    head.paint(
        rng.uniform(0.2, 0.7) * ramp(Y, edge - 2, edge + 4) * (1 - ramp(Y, edge + 4, end)), head.skin * 0.3
    )


def _glasses(head: Head) -> None:
    """Rims and a bridge; one pair in five has dark lenses."""
    rng, at = head.rng, head.measures
    width, height = rng.uniform(19, 25), rng.uniform(13, 20)
    radius = np.hypot((SIDE - at.eye - 1) / width, (Y - 3) / height)
    bridge = (np.abs(Y + 2) < 2) & (at.eye - width + 3 > SIDE)
    rims = np.maximum(line(radius - 1, rng.uniform(0.06, 0.13)), bridge)
    head.paint(rng.uniform(0.5, 1) * rims, np.full(3, rng.uniform(0.01, 0.15)))
    if rng.uniform() < 0.2:
        head.paint((radius < 1) * rng.uniform(0.2, 0.95), np.full(3, 0.02))
