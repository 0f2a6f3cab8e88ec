# SPDX-License-Identifier: MIT
"""Checks each video encoder by writing a few frames and reading them again."""

from concurrent.futures import Executor

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.install import install_extra
from tricue.doctor.probe import ProbeAnswer, probe

SECTION = "Video encoders"
FRAMES = 10
_WRITE = """
import os, pathlib, tempfile
os.environ.setdefault("OPENCV_LOG_LEVEL", "SILENT")
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
import cv2, numpy
from tricue.draw.video_encoders import {encoder}
with tempfile.TemporaryDirectory(prefix="tricue-") as folder:
    path = pathlib.Path(folder) / "video{suffix}"
    encoder = {encoder}(path, 25.0, (64, 48))
    for index in range({frames}):
        encoder.write(numpy.full((48, 64, 3), 20 * index, numpy.uint8))
    encoder.close()
    video, count = cv2.VideoCapture(str(path)), 0
    while video.read()[0]:
        count += 1
    video.release()
    report(count=count)
"""
ENCODERS = {
    "H.264 in .mp4": ("PyAVEncoder", ".mp4"),
    "VP9 in .webm": ("PyAVEncoder", ".webm"),
    "VP8 in .webm": ("OpenCVEncoder", ".webm"),
    "MJPG in .avi": ("OpenCVEncoder", ".avi"),
}
LIBRARIES = {"PyAVEncoder": "PyAV", "OpenCVEncoder": "cv2"}


def find_encoders(pool: Executor) -> list[Finding]:
    """A finding for each encoder that tricue writes videos with."""
    answers = {
        name: pool.submit(probe, _WRITE.format(encoder=encoder, suffix=suffix, frames=FRAMES))
        for name, (encoder, suffix) in ENCODERS.items()
    }
    return [_judge(name, answer.result()) for name, answer in answers.items()]


def _judge(name: str, answer: ProbeAnswer) -> Finding:
    encoder, _ = ENCODERS[name]
    library = LIBRARIES[encoder]
    if "No module named 'av'" in answer.error:
        return Finding(SECTION, name, Verdict.ABSENT, "needs PyAV", install_extra("video"))
    if answer.error:
        return Finding(SECTION, name, Verdict.BROKEN, f"by {library}: {answer.error}")
    if answer.values["count"] != FRAMES:
        text = f"by {library}: of {FRAMES} frames written {answer.values['count']} can be read"
        return Finding(SECTION, name, Verdict.BROKEN, text)
    return Finding(SECTION, name, Verdict.OK, f"by {library}")
