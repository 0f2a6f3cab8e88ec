# SPDX-License-Identifier: MIT
"""Cameras that the system sees, without opening any."""

import os
from collections.abc import Iterable
from pathlib import Path

from tricue.doctor.finding import Finding, Verdict
from tricue.doctor.probe import probe
from tricue.doctor.requirements import installed

SECTION = "Cameras"
DEVICES, ABOUT = Path("/dev"), Path("/sys/class/video4linux")
_LIST_REALSENSE = """
import pyrealsense2
devices = pyrealsense2.context().query_devices()
report(names=[device.get_info(pyrealsense2.camera_info.name) for device in devices])
"""
_LIST_OAK = """
import depthai
report(names=[str(device.name) for device in depthai.Device.getAllAvailableDevices()])
"""
_LIBRARIES = {
    "RealSense": ("pyrealsense2", _LIST_REALSENSE),
    "OAK": ("depthai", _LIST_OAK),
}


def find_cameras() -> list[Finding]:
    """Findings on video devices, and on RealSense and OAK cameras if their libraries are installed."""
    found = [_device(path, ABOUT) for path in _devices(DEVICES)]
    if not found:
        found = [Finding(SECTION, "video devices", Verdict.ABSENT, "none in /dev")]
    for name, (package, code) in _LIBRARIES.items():
        if installed(package):
            found.append(_listed(name, code))
    return found


def _devices(folder: Path) -> Iterable[Path]:
    numbered = [path for path in folder.glob("video*") if path.name.removeprefix("video").isdecimal()]
    return sorted(numbered, key=lambda path: int(path.name.removeprefix("video")))


def _device(path: Path, about: Path) -> Finding:
    try:
        name = (about / path.name / "name").read_text(encoding="utf-8", errors="replace").strip()
    except OSError:
        name = "unnamed"
    if os.access(path, os.R_OK | os.W_OK):
        return Finding(SECTION, str(path), Verdict.OK, name)
    fix = "sudo usermod -aG video $USER, then log in again"
    return Finding(SECTION, str(path), Verdict.WARNING, f"{name}, which you may not open", fix)


def _listed(name: str, code: str) -> Finding:
    answer = probe(code)
    if answer.error:
        return Finding(SECTION, name, Verdict.BROKEN, answer.error)
    names = answer.values["names"]
    return Finding(SECTION, name, Verdict.OK if names else Verdict.ABSENT, ", ".join(names) or "none found")
