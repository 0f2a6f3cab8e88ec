# SPDX-License-Identifier: MIT
"""cv2 as doctor sees it: whole, missing, damaged, twice."""

import sys
from pathlib import Path

import pytest
from tricue.doctor import opencv
from tricue.doctor.finding import Verdict

TRACKERS = ("CSRT", "KCF", "MIL", "MOSSE", "MedianFlow")


def without_cv2() -> list[str]:
    """Python's path without the folders that have a cv2."""
    return [path for path in sys.path if not (Path(path) / "cv2").is_dir()]


@pytest.fixture
def site(tmp_path, monkeypatch):
    """A folder of packages in front of all others: ``site(code, package, version, ...)`` fills it.

    Those of the environment that provide a cv2 aren't seen.
    """
    monkeypatch.syspath_prepend(str(tmp_path))
    kept = opencv.provider_packages

    def make(code: str | None, **packages: str) -> None:
        if code is None:  # a folder without code gives way to any package behind it
            monkeypatch.setattr(sys, "path", [str(tmp_path), *without_cv2()])
        (tmp_path / "cv2").mkdir()
        if code is not None:
            (tmp_path / "cv2" / "__init__.py").write_text(code)
        for name, version in packages.items():
            folder = tmp_path / f"{name}-{version}.dist-info"
            folder.mkdir()
            project = name.replace("_", "-")
            (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {project}\nVersion: {version}\n")
        ours = {name.replace("_", "-") for name in packages}
        monkeypatch.setattr(
            opencv, "provider_packages", lambda: {k: v for k, v in kept().items() if k in ours}
        )

    return make


WHOLE = "__version__ = '4.10.0'\ngetNumThreads = lambda: 1\n"
LEGACY = (
    "class legacy:\n    TrackerMOSSE = TrackerMedianFlow = 1\nTrackerCSRT = TrackerKCF = TrackerMIL = 1\n"
)


def by_name(findings):
    """The findings by name."""
    return {each.name: each for each in findings}


def test_one_whole_package_is_well(site):
    """Version, folder and package are told, and all baselines are there."""
    site(WHOLE + LEGACY, opencv_contrib_python_headless="4.10.0.84")
    found = by_name(opencv.find_opencv())
    assert set(found) == {"cv2", "baselines"}
    assert found["cv2"].verdict is Verdict.OK
    assert found["cv2"].text.startswith("4.10.0, ")
    assert "opencv-contrib-python-headless 4.10.0.84" in found["cv2"].text
    assert found["baselines"].verdict is Verdict.OK
    assert all(name in found["baselines"].text for name in TRACKERS)


def test_missing_baselines_name_the_package_that_has_them(site):
    """And how to exchange it for the one that is there."""
    site(WHOLE + "TrackerMIL = 1\n", opencv_python_headless="4.10.0.84")
    found = by_name(opencv.find_opencv())["baselines"]
    assert found.verdict is Verdict.ABSENT
    assert found.text.startswith("MIL; CSRT, KCF, MOSSE, MedianFlow missing")
    assert "uninstall -y opencv-python-headless" in found.fix
    assert found.fix.endswith("-m pip install opencv-contrib-python-headless")


def test_several_packages_are_told(site):
    """The trap: they share one folder. The one with more trackers is kept."""
    site(
        WHOLE, opencv_python_headless="5.0.0.93", opencv_contrib_python="4.14.0.94", opencv_python="5.0.0.93"
    )
    found = by_name(opencv.find_opencv())["several packages"]
    assert found.verdict is Verdict.WARNING
    assert "share one folder" in found.text
    assert all(
        name in found.fix for name in ("opencv-python-headless", "opencv-contrib-python", "opencv-python")
    )
    assert found.fix.endswith("install opencv-contrib-python==4.14.0.94")


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ("raise ImportError('libGL.so.1: cannot open shared object file')", "libGL.so.1"),
        ("raise RuntimeError('module compiled against ABI version')", "RuntimeError: module compiled"),
        ("raise OSError('broken')", "OSError: broken"),
        ("import os\nos._exit(9)", "ends the process with exit code 9"),
        (None, "an empty folder"),
        (WHOLE.replace("4.10", "4.5"), ">=4.8 is needed"),
    ],
    ids=["ImportError", "RuntimeError", "OSError", "crash", "emptied", "old"],
)
def test_a_cv2_that_does_not_work_is_a_failure(site, code, said):
    """The core needs it. The report says what is wrong, and which command of pip fixes it."""
    site(code, opencv_python_headless="4.10.0.84")
    found = by_name(opencv.find_opencv())["cv2"]
    assert found.verdict is Verdict.FAILED
    assert said in found.text
    assert "-m pip install --" in found.fix
    assert "opencv-python-headless" in found.fix


def test_no_cv2_at_all(monkeypatch):
    """It is told that no package provides one, and which to install."""
    monkeypatch.setattr(sys, "path", without_cv2())
    (found,) = opencv.find_opencv()
    assert found.verdict is Verdict.FAILED
    assert "No module named 'cv2'" in found.text
    assert "no package of it is installed" in found.text
    assert "opencv-python-headless" in found.fix
