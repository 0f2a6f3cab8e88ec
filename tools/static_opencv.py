# SPDX-License-Identifier: MIT
"""OpenCV's core and imgproc as static libraries, and Eigen's headers, for systems without them.

    python tools/static_opencv.py PREFIX                     downloads, builds, installs into PREFIX
    python tools/static_opencv.py PREFIX --opencv FOLDER     from sources that are there already

cibuildwheel runs this before it builds wheels (pyproject.toml); ``-DTRICUE_OPENCV_PREFIX=PREFIX`` tells CMake
where they are. OpenCV has the version and the SIMD dispatch of Debian 12, and needs no other library. The
build needs CMake, a C++ compiler, and, except on Windows, Ninja.
"""

import argparse
import hashlib
import platform
import subprocess
import sys
import tarfile
import tempfile
import urllib.request
from pathlib import Path
from typing import NamedTuple


class Source(NamedTuple):
    """An archive of sources."""

    url: str
    sha256: str


OPENCV = Source(
    "https://github.com/opencv/opencv/archive/refs/tags/4.6.0.tar.gz",
    "1ec1cba65f9f20fe5a41fda1586e01c70ea0c9a6d7b67c9e13edf0cfe2239277",
)
EIGEN = Source(
    "https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.gz",
    "8586084f71f9bde545ee7fa6d00288b264a2b7ac3607b974e54d13e7162c1c72",
)
SWITCHES = {
    "BUILD_LIST": "core,imgproc",
    "BUILD_SHARED_LIBS": "OFF",
    "CMAKE_BUILD_TYPE": "Release",
    "CMAKE_POSITION_INDEPENDENT_CODE": "ON",
    "BUILD_WITH_STATIC_CRT": "OFF",  # the dynamic C runtime, like Python's
    "OPENCV_GENERATE_PKGCONFIG": "OFF",
    "OPENCV_CONFIG_INSTALL_PATH": "opencv",  # the same path on every system
    "OPENCV_SKIP_CMAKE_ROOT_CONFIG": "ON",
    "ENABLE_PRECOMPILED_HEADERS": "OFF",
    # Threads are useless: the extension uses one.
    **{f"WITH_{library}": "OFF" for library in ("PTHREADS_PF", "TBB", "OPENMP", "GCD", "CONCURRENCY")},
    **{f"WITH_{library}": "OFF" for library in ("OPENCL", "IPP", "ITT", "LAPACK", "EIGEN", "CAROTENE")},
    **{f"WITH_{library}": "OFF" for library in ("OPENGL", "VA", "VA_INTEL", "VULKAN", "CUDA", "PROTOBUF")},
    **{f"BUILD_{part}": "OFF" for part in ("TESTS", "PERF_TESTS", "EXAMPLES", "DOCS", "JAVA", "ITT")},
    **{f"BUILD_opencv_{part}": "OFF" for part in ("apps", "python3", "python2", "java", "js")},
    "BUILD_ZLIB": "ON",
}
EIGEN_SWITCHES = {"EIGEN_BUILD_DOC": "OFF", "BUILD_TESTING": "OFF", "EIGEN_BUILD_PKGCONFIG": "OFF"}
# As in Debian: the baseline's instructions, and newer ones if the processor has them.
X86 = {"CPU_BASELINE": "SSE2", "CPU_DISPATCH": "SSE4_1,SSE4_2,AVX,AVX2,AVX512_SKX"}
HARDENING = "-fstack-protector-strong -D_FORTIFY_SOURCE=2"


def fetch(source: Source, folder: Path) -> Path:
    """Download, check and unpack sources; returns their folder."""
    with urllib.request.urlopen(source.url) as answer:
        content = answer.read()
    digest = hashlib.sha256(content).hexdigest()
    if digest != source.sha256:
        sys.exit(f"{source.url}: expected the SHA-256 {source.sha256}, got {digest}")
    archive = folder / "archive.tar.gz"
    archive.write_bytes(content)
    unpacked = folder / digest[:8]
    with tarfile.open(archive) as packed:
        packed.extractall(unpacked, filter="data")
    (root,) = unpacked.iterdir()
    return root


def opencv_switches() -> dict[str, str]:
    """The CMake options of OpenCV for this machine."""
    switches = dict(SWITCHES)
    if platform.machine().lower() in {"x86_64", "amd64"}:
        switches |= X86
    if sys.platform == "linux":
        switches |= {"CMAKE_C_FLAGS": HARDENING, "CMAKE_CXX_FLAGS": HARDENING}
    return switches


def install(sources: Path, work: Path, definitions: dict[str, str]) -> None:
    """Build and install a project by CMake. On Windows its default generator finds the compiler."""
    generator = [] if sys.platform == "win32" else ["-G", "Ninja"]
    switches = [f"-D{name}={value}" for name, value in definitions.items()]
    subprocess.run(["cmake", "-S", str(sources), "-B", str(work), *generator, *switches], check=True)
    subprocess.run(["cmake", "--build", str(work), "--config", "Release", "--target", "install"], check=True)


def main() -> None:
    """Build OpenCV, and put Eigen's headers beside it."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("prefix", type=Path, metavar="PREFIX")
    parser.add_argument("--opencv", type=Path, metavar="FOLDER", help="OpenCV's sources (default: download)")
    parser.add_argument("--eigen", type=Path, metavar="FOLDER", help="Eigen's sources (default: download)")
    options = parser.parse_args()
    common = {
        "CMAKE_INSTALL_PREFIX": options.prefix.resolve().as_posix(),
        "CMAKE_POLICY_VERSION_MINIMUM": "3.5",  # CMake 4 refuses their older files without it
    }
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for project, source, sources, switches in (
            ("opencv", OPENCV, options.opencv, opencv_switches()),
            ("eigen", EIGEN, options.eigen, EIGEN_SWITCHES),
        ):
            install(sources or fetch(source, folder), folder / project, switches | common)


if __name__ == "__main__":
    main()
