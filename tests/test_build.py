# SPDX-License-Identifier: MIT
"""Building, packing and loading the extension."""

import importlib.metadata
import re
import shutil
import subprocess
import sys
import tarfile
from pathlib import Path

import numpy as np
import pytest
import tricue
from tricue import _core

ROOT = Path(__file__).parents[1]


def python(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run another Python in a folder."""
    command = [sys.executable, "-W", "error", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.mark.parametrize("order", [("cv2", "tricue"), ("tricue", "cv2")], ids="-".join)
def test_shares_the_process_with_cv2(order: tuple[str, str], tmp_path: Path) -> None:
    """The extension, with its own OpenCV core, and pip's cv2 work side by side, whichever is loaded first."""
    code = f"""
import {order[0]}, {order[1]}, numpy
from tricue import _core
image = numpy.zeros((60, 80, 3), numpy.uint8)
cv2.rectangle(image, (10, 20), (29, 49), (80, 120, 200), -1)
plane = numpy.random.default_rng(0).random((32, 32), numpy.float32)
label = numpy.ascontiguousarray(numpy.fft.rfft2(plane), numpy.complex64)
nothing = numpy.zeros((1, 32, 17), numpy.complex64), numpy.zeros((32, 17), numpy.float32)
learned, _ = _core.correlation_train(plane[None], label, *nothing, 1.0)
theirs = cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT)[:, :17]
energy = (theirs**2).sum(axis=2)
assert numpy.allclose(learned[0], energy, rtol=1e-4, atol=1e-4)
blobs = _core.skin_blobs(image, numpy.array([80, 120, 200], numpy.uint8), 0.5, 1)
count, _, boxes, _ = cv2.connectedComponentsWithStats(image[..., 2])
assert count == 2 and len(blobs) == 1 and list(blobs[0, :5]) == list(boxes[1]), (blobs, boxes)
"""
    run = python("-c", code, folder=tmp_path)
    assert run.returncode == 0, run.stderr


def test_links_only_what_it_uses() -> None:
    """Of OpenCV the extension needs core and imgproc: modules for windows would clash with pip's cv2."""
    if shutil.which("readelf") is None:
        pytest.skip("needs readelf from binutils")
    output = subprocess.run(
        ["readelf", "-d", _core.__file__], capture_output=True, text=True, check=True
    ).stdout
    assert re.findall(r"NEEDED.*\[libopencv_(\w+)\.", output) == ["imgproc", "core"]


def test_is_hardened() -> None:
    """The extension has full RELRO, no executable stack and stack canaries, as SECURITY.md says."""
    if shutil.which("readelf") is None or "sanitized" in _core.__file__:
        pytest.skip("needs readelf from binutils, and a build for users")

    def read(*options: str) -> str:
        return subprocess.run(
            ["readelf", "-W", *options, _core.__file__], capture_output=True, text=True, check=True
        ).stdout

    headers, symbols = read("-l", "-d"), read("--dyn-syms")
    assert "GNU_RELRO" in headers
    assert re.search(r"FLAGS.*(BIND_)?NOW", headers)
    assert re.search(r"GNU_STACK .* RW +0x", headers)
    assert "__stack_chk_fail" in symbols


def test_starts_no_thread(tmp_path: Path) -> None:
    """What OpenCV does for the extension, Fourier transforms and imgproc, runs on the caller's thread."""
    code = """
import os, numpy
from tricue import _core, imgproc
cells = numpy.ones((64, 128, 128), numpy.float32)
filters = numpy.ones((2, 64, 128, 65), numpy.complex64)
before = len(os.listdir("/proc/self/task"))
_core.correlation_response(cells, filters)
imgproc.warp_perspective(numpy.ones((2000, 2000, 3), numpy.float32), numpy.eye(3), 2000, 2000)
after = len(os.listdir("/proc/self/task"))
assert before == after, (before, after)
"""
    if not Path("/proc/self/task").is_dir():
        pytest.skip("needs Linux's /proc")
    run = python("-c", code, folder=tmp_path)
    assert run.returncode == 0, run.stderr


@pytest.mark.parametrize(
    ("definition", "package"),
    [
        ("CMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON", "libeigen3-dev"),
        ("OPENCV_CORE=", "libopencv-core-dev"),
        ("OPENCV_IMGPROC=", "libopencv-imgproc-dev"),
        ("CMAKE_DISABLE_FIND_PACKAGE_Python=ON", "python3-dev"),
        ("CMAKE_CXX_COMPILER=", "g++"),
    ],
)
def test_missing_package_is_named(definition: str, package: str, tmp_path: Path) -> None:
    """Where a system package is missing, the build stops with one line that says what to install."""
    if shutil.which("cmake") is None:
        pytest.skip("needs CMake: pip install tricue[dev]")
    command = ["cmake", "-S", str(ROOT), "-B", str(tmp_path), f"-D{definition}"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    lines = [line.strip() for line in run.stderr.splitlines() if "apt-get" in line]
    assert run.returncode != 0
    assert len(lines) == 1
    assert re.fullmatch(rf"tricue needs .*: apt-get install {re.escape(package)}", lines[0])


def test_source_distribution_is_whole(tmp_path: Path) -> None:
    """The sdist holds every file that it is built and tested from, and nothing that was built."""
    pytest.importorskip("scikit_build_core", reason="needs scikit-build-core: pip install tricue[dev]")
    code = f"import scikit_build_core.build as b; b.build_sdist({str(tmp_path)!r})"
    run = python("-c", code, folder=ROOT)
    assert run.returncode == 0, run.stderr
    (archive,) = tmp_path.glob("*.tar.gz")
    with tarfile.open(archive) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    trees = [ROOT / tree for tree in ("cpp", "python", "tests", "benchmarks", "tools")]
    files = [
        file for tree in trees for file in tree.rglob("*") if file.suffix in {".py", ".pyi", ".cpp", ".hpp"}
    ]
    wanted = {str(file.relative_to(ROOT)) for file in files}
    wanted |= {
        "CMakeLists.txt",
        "pyproject.toml",
        "README.md",
        "LICENSE",
        "Makefile",
        "python/tricue/py.typed",
    }
    assert wanted <= names
    assert not [name for name in names if re.search(r"__pycache__|\.so$|\.pyc$|^build/|^\.venv|^demo/", name)]


def test_version_stands_in_one_place() -> None:
    """The package knows its version from its metadata, which has it from pyproject.toml."""
    written = re.search(r'^version = "(.+)"$', (ROOT / "pyproject.toml").read_text(), re.MULTILINE)
    assert written is not None
    assert tricue.__version__ == importlib.metadata.version("tricue") == written[1]
    assert "VERSION" not in (ROOT / "CMakeLists.txt").read_text().partition("project(")[2].partition(")")[0]


@pytest.mark.skipif(np.lib.NumpyVersion(np.__version__) < "2.0.0", reason="NumPy 1 has no numpy.bool")
def test_stubs_have_not_drifted() -> None:
    """The stub says what the bindings say; `make stubs` writes it anew."""
    pytest.importorskip("pybind11_stubgen", reason="needs pybind11-stubgen: pip install tricue[dev]")
    run = python("tools/stubs.py", "--check", folder=ROOT)
    assert run.returncode == 0, run.stdout + run.stderr


def test_typed() -> None:
    """The installed package tells type checkers that it is typed, and brings the extension's stub."""
    package = Path(tricue.__file__).parent
    assert (package / "py.typed").exists()
    assert (package / "_core.pyi").read_text() == (ROOT / "python/tricue/_core.pyi").read_text()
