# SPDX-License-Identifier: MIT
"""Runs a tracker on a rendered target for about a second: is it right and reproducible, and how fast?"""

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.probe import ProbeAnswer, probe

SECTION = "Self test"
MAX_ERROR = 3.0
"""Error of the center, pixels, on a noise-free target that moves by two pixels per frame."""
MAX_DIFFERENCE = 1e-6
"""Pixels between native and reference kernels, which add float64 numbers in a different order."""
_TRACK = """
import time
import numpy, tricue
from tricue.camera.frame import Frame
from tricue.track.base import registry

rng = numpy.random.default_rng(0)
ground = rng.integers(20, 60, (120, 160, 3), dtype=numpy.uint8)
patch = numpy.kron(rng.integers(90, 255, (8, 8, 3)), numpy.ones((5, 5, 1))) // [4, 4, 1]

def render(index):
    image = ground.copy()
    image[40:80, 30 + 2 * index:70 + 2 * index] = patch
    return Frame(image)

def follow(kernels, frames):
    tracker = registry.create("color-particle", kernels=kernels)
    tracks = [tracker.init(frames[0], (30, 40, 40, 40))]
    tracks += [tracker.update(frame) for frame in frames[1:]]
    return numpy.array([track.box for track in tracks])

frames = [render(index) for index in range(30)]
native, again, reference = follow("native", frames), follow("native", frames), follow("reference", frames[:5])
true = 50 + 2.0 * numpy.arange(len(frames))
updates, started = 0, time.perf_counter()
while time.perf_counter() - started < 1:
    follow("native", frames)
    updates += len(frames) - 1
report(
    speed=updates / (time.perf_counter() - started),
    same=native.tobytes() == again.tobytes(),
    difference=float(numpy.abs(native[:5] - reference).max()),
    off=float(numpy.abs(native[:, 0] + native[:, 2] / 2 - true).max()),
)
"""


def find_self_test() -> list[Finding]:
    """The finding of the self test."""
    return [judge(probe(_TRACK))]


def judge(answer: ProbeAnswer) -> Finding:
    """The finding from the test's numbers."""
    name = "color-particle"
    if answer.error:
        return Finding(SECTION, name, Verdict.FAILED, answer.error)
    values, wrong = answer.values, []
    if not values["same"]:
        wrong.append("two runs from one seed differ")
    if not values["difference"] <= MAX_DIFFERENCE:
        wrong.append(f"native and reference kernels differ by {values['difference']:.2g} px")
    if not values["off"] <= MAX_ERROR:
        wrong.append(f"the target is missed by {values['off']:.1f} px")
    if wrong:
        return Finding(SECTION, name, Verdict.FAILED, ", ".join(wrong))
    text = (
        f"{values['speed']:,.0f} updates/s on 160x120; two runs are the same bit for bit, "
        f"native and reference kernels differ by {values['difference']:.1g} px"
    )
    return Finding(SECTION, name, Verdict.OK, text)
