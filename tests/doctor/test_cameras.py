# SPDX-License-Identifier: MIT
"""Cameras as doctor sees them."""

import os

import pytest
from tricue.doctor import cameras
from tricue.doctor.finding import Verdict
from tricue.doctor.probe import ProbeAnswer


@pytest.fixture
def system(tmp_path, monkeypatch):
    """``system(video0="Webcam", ...)``: devices with their names."""
    monkeypatch.setattr(cameras, "DEVICES", tmp_path / "dev")
    monkeypatch.setattr(cameras, "ABOUT", tmp_path / "sys")
    monkeypatch.setattr(cameras, "installed", lambda package: "")

    def make(**names: str) -> None:
        for device, name in names.items():
            (tmp_path / "sys" / device).mkdir(parents=True)
            (tmp_path / "sys" / device / "name").write_text(f"{name}\n")
            (tmp_path / "dev").mkdir(exist_ok=True)
            (tmp_path / "dev" / device).touch()

    return make


def test_none(system):
    """It is told, and nothing is wrong."""
    (found,) = cameras.find_cameras()
    assert (found.verdict, found.text) == (Verdict.ABSENT, "none in /dev")


def test_devices_are_named_in_the_order_of_their_numbers(system, tmp_path):
    """2 comes before 10, and what isn't a number is no camera."""
    system(video10="Second", video2="First", **{"video-codec": "none"})
    found = cameras.find_cameras()
    assert [(each.name, each.text) for each in found] == [
        (str(tmp_path / "dev" / "video2"), "First"),
        (str(tmp_path / "dev" / "video10"), "Second"),
    ]


def test_one_that_may_not_be_opened(system, tmp_path, monkeypatch):
    """The group that helps is named."""
    system(video0="Webcam")
    monkeypatch.setattr(os, "access", lambda *_: False)
    (found,) = cameras.find_cameras()
    assert found.verdict is Verdict.WARNING
    assert found.text == "Webcam, which you may not open"
    assert "usermod -aG video" in found.fix


@pytest.mark.parametrize(
    ("answer", "verdict", "text"),
    [
        (ProbeAnswer({"names": ["D435", "D405"]}), Verdict.OK, "D435, D405"),
        (ProbeAnswer({"names": []}), Verdict.ABSENT, "none found"),
        (ProbeAnswer({}, "RuntimeError: no backend"), Verdict.BROKEN, "RuntimeError: no backend"),
    ],
)
def test_depth_cameras_are_asked_for_where_their_library_is(system, monkeypatch, answer, verdict, text):
    """What the library lists, or its error."""
    monkeypatch.setattr(cameras, "installed", lambda package: "2.5" if package == "pyrealsense2" else "")
    monkeypatch.setattr(cameras, "probe", lambda code: answer)
    _, found = cameras.find_cameras()
    assert (found.name, found.verdict, found.text) == ("RealSense", verdict, text)
