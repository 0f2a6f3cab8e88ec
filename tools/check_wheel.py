# SPDX-License-Identifier: MIT
"""Checks that a wheel works on machines with nothing but Python: the last step of `make wheel`.

    python tools/check_wheel.py dist/*.whl                       all, with this Python
    python tools/check_wheel.py --pythons python3.10 python3.12 -- dist/*.whl
    python tools/check_wheel.py --static dist/*.whl              reads the files, runs nothing

First the file itself is checked: its size and content, what the extension exports and needs, and its
hardening. Then the wheel is installed in a bare virtual environment, with the system's OpenCV, LAPACK, TBB,
X11 and GL hidden. It tracks a target with each version of cv2, loaded before and after tricue, and on older
processors, emulated by qemu-user if that is installed. Every run must give the same bits.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
MAX_BYTES = 6_000_000
# System libraries that manylinux allows.
ALLOWED = re.compile(r"(ld-linux[-\w]*|libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so(\.\d+)+")
BROUGHT = re.compile(r"libtbb-\w+\.so[.\d]*")
HIDDEN = re.compile(r"lib(opencv_|lapack|blas|cblas|openblas|gfortran|quadmath|tbb|X11|xcb|GL|EGL|OpenGL)")
SYSTEM_LIBRARIES = ("/usr/lib", "/usr/lib64", "/usr/local/lib")


class Beside(NamedTuple):
    """A cv2 to load with the extension, the NumPy that it needs, and the newest Python that both support."""

    cv2: str
    numpy: str
    newest: tuple[int, int]


CV2 = [
    Beside("4.8.*", "<2", (3, 12)),
    Beside("4.10.*", ">=1.24", (3, 99)),
    Beside("4.14.*", ">=1.24", (3, 99)),
    Beside("5.0.*", ">=1.24", (3, 99)),
]
# Processors of x86-64's levels 1, 2 and 3; the machine itself may have level 4.
PROCESSORS = ["qemu64", "Nehalem", "Haswell"]


# --- The content of the file ---


def static_problems(wheel: Path) -> list[str]:
    """What is wrong with a wheel's file."""
    problems = []
    if wheel.stat().st_size >= MAX_BYTES:
        problems.append(f"expected fewer than {MAX_BYTES:,} bytes, got {wheel.stat().st_size:,}")
    if not re.search(r"-manylinux_2_\d+_\w+\.whl$", wheel.name):
        problems.append("expected a tag manylinux_2_..., which auditwheel repair gives")
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(wheel) as packed:
        names = [name for name in packed.namelist() if not name.endswith("/")]
        packed.extractall(folder)
        problems += content_problems(names)
        for name in names:
            if re.search(r"\.so[.\d]*$", name):
                problems += [f"{name}: {problem}" for problem in library_problems(Path(folder, name))]
    return problems


def content_problems(names: list[str]) -> list[str]:
    """The files that are missing in a wheel, or unexpected."""
    problems = []
    own = re.compile(r"tricue/(?!.*__pycache__).*\.(py|pyi|so|html|js|css|svg|typed)$")
    for name in names:
        library = Path(name).parent.name == "tricue.libs" and BROUGHT.fullmatch(Path(name).name)
        if not (own.match(name) or library or re.match(r"tricue-[^/]+\.dist-info/", name)):
            problems.append(f"unexpected file {name}")
    if len([name for name in names if re.match(r"tricue/_core\..*\.so$", name)]) != 1:
        problems.append("expected one extension, tricue/_core")
    files = ("tricue/py.typed", "tricue/_core.pyi")
    problems += [f"{wanted} is missing" for wanted in files if wanted not in names]
    for text in ("LICENSE", "THIRD_PARTY.txt"):
        if not any(re.match(rf"tricue-[^/]+\.dist-info/.*/{re.escape(text)}$", name) for name in names):
            problems.append(f"no license text {text}")
    return problems


def readelf(library: Path, *options: str) -> str:
    """The output of binutils' readelf."""
    command = ["readelf", "-W", *options, str(library)]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def exported(library: Path) -> set[str]:
    """The names that other libraries can link to."""
    rows = [line.split() for line in readelf(library, "--dyn-syms").splitlines()]
    symbols = [row for row in rows if len(row) >= 8 and re.fullmatch(r"\d+:", row[0])]
    return {row[7].partition("@")[0] for row in symbols if row[4] != "LOCAL" and row[6] != "UND"}


def library_problems(library: Path) -> list[str]:
    """What is wrong with the extension, or with a library in the wheel."""
    problems = []
    dynamic, headers = readelf(library, "-d"), readelf(library, "-l")
    needed = re.findall(r"NEEDED.*\[(.+)\]", dynamic)
    if foreign := [name for name in needed if not ALLOWED.fullmatch(name) and not BROUGHT.fullmatch(name)]:
        problems.append(f"needs {', '.join(foreign)}")
    if not re.search(r"GNU_STACK .* RW +0x", headers):
        problems.append("has an executable stack")
    if "GNU_RELRO" not in headers or not re.search(r"FLAGS.*\bNOW\b", dynamic):
        problems.append("isn't relocated before it runs (full RELRO)")
    if library.name.startswith("_core"):
        if "__stack_chk_fail" not in readelf(library, "--dyn-syms"):
            problems.append("has no stack protector")
        if (names := exported(library)) != {"PyInit__core"}:
            problems.append(f"exports {len(names)} symbols, such as {', '.join(sorted(names)[:3])}")
    return problems


# --- Running it ---

# Tracks a textured target that swings over noise; prints which libraries were loaded, the smallest
# overlap with the truth, and a hash of all boxes. Argument: cv2 or tricue, whichever is loaded first.
PROBE = r"""
import hashlib, importlib.util, json, re, sys
import numpy as np

def libraries():
    with open("/proc/self/maps") as maps:
        return set(re.findall(r"(/\S+\.so[.\d]*)$", maps.read(), re.M))

def load_extension():
    folder = importlib.util.find_spec("tricue").submodule_search_locations[0]
    (spec,) = [importlib.util.spec_from_file_location("tricue._core", path)
               for path in __import__("glob").glob(folder + "/_core.*.so")]
    before = libraries()
    sys.modules["tricue._core"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sys.modules["tricue._core"])
    return sorted(libraries() - before)

if sys.argv[1] == "cv2":
    import cv2
    loaded = load_extension()
else:
    loaded = load_extension()
    import cv2
import tricue
from tricue import imgproc

rng = np.random.default_rng(7)
background = rng.integers(60, 160, (20, 27, 3)).astype(np.uint8).repeat(12, 0).repeat(12, 1)[:, :320]
texture = rng.integers(0, 256, (8, 6, 3)).astype(np.uint8).repeat(6, 0).repeat(6, 1)
texture[..., 2] |= 128
height, width = texture.shape[:2]
overlaps, digest = [], hashlib.sha256()
for name in ("fused", "color-particle"):
    for index in range(24):
        x, y = int(140 + 90 * np.sin(index / 9)), int(90 + 40 * np.cos(index / 7))
        frame = background.copy()
        frame[y:y + height, x:x + width] = texture
        box = (x, y, width, height)
        if index == 0:
            tracker = tricue.create(name)
            track = tracker.init(frame, box=box)
        else:
            track = tracker.update(frame)
        found = np.array([*track.box], float)
        digest.update(found.tobytes())
        left, top = np.maximum(found[:2], box[:2])
        right, bottom = np.minimum(found[:2] + found[2:], np.add(box[:2], box[2:]))
        shared = max(right - left, 0) * max(bottom - top, 0)
        overlaps.append(shared / (found[2] * found[3] + width * height - shared))
    digest.update(b"next")
plane = rng.random((80, 96), np.float32)
assert np.allclose(imgproc.warp_perspective(plane, np.eye(3), 80, 96), plane, atol=1e-3)
assert np.allclose(imgproc.gaussian_blur(plane, 0.05), plane, atol=1e-3)
theirs = cv2.dft(plane, flags=cv2.DFT_COMPLEX_OUTPUT)
assert np.allclose(theirs[..., 0] + 1j * theirs[..., 1], np.fft.fft2(plane), atol=1e-2)
print(json.dumps({"loaded": loaded, "overlap": float(min(overlaps)), "bits": digest.hexdigest()}))
"""
MIN_OVERLAP = 0.5


def version_of(python: str) -> tuple[int, int]:
    """The version of a Python."""
    code = "import sys; print(*sys.version_info[:2])"
    run = subprocess.run([python, "-c", code], check=True, capture_output=True, text=True)
    major, minor = run.stdout.split()
    return int(major), int(minor)


def install(python: str, wheel: Path, folder: Path) -> Path:
    """Install the wheel alone in a bare environment; returns the environment's Python."""
    subprocess.run([python, "-m", "venv", "--clear", folder / "bare"], check=True)
    inside = folder / "bare" / "bin" / "python"
    pip = [str(inside), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
    subprocess.run([*pip, "--no-deps", "--no-index", str(wheel)], check=True)
    return inside


def folder_beside(inside: Path, beside: Beside, folder: Path) -> Path:
    """A folder with one cv2 and NumPy, which later checks reuse."""
    target = folder / f"cv2-{beside.cv2.rstrip('.*')}"
    if not target.is_dir():
        pip = [str(inside), "-m", "pip", "--disable-pip-version-check", "install", "--quiet"]
        what = [f"opencv-python-headless=={beside.cv2}", f"numpy{beside.numpy}"]
        part = target.with_name(target.name + ".part")  # may be left from an interrupted check
        shutil.rmtree(part, ignore_errors=True)
        subprocess.run([*pip, "--only-binary=:all:", "--target", str(part), *what], check=True)
        part.rename(target)
    return target


def hiding() -> list[str]:
    """The start of a command that hides the system's libraries; empty if that isn't permitted."""
    unshare = ["unshare", "--user", "--map-root-user", "--mount"]
    if not shutil.which("unshare") or subprocess.run([*unshare, "true"], check=False).returncode:
        return []
    files = {
        file.resolve()
        for tree in SYSTEM_LIBRARIES
        for file in Path(tree).rglob("lib*.so*")
        if HIDDEN.match(file.name) and file.is_file()
    }
    hide = 'for file do mount --bind /dev/null "$file" || exit; done'
    script = f"set -- {' '.join(map(str, sorted(files)))}; command=$COMMAND; {hide}; exec $command"
    return [*unshare, "sh", "-c", script]


def probe(command: list[str], beside: Path, first: str, hide: list[str]) -> dict[str, Any]:
    """Run the probe; returns what it prints, or the error."""
    with tempfile.TemporaryDirectory() as folder:
        script = Path(folder, "probe.py")
        script.write_text(PROBE)
        words = [*command, str(script), first]
        environment = {"PYTHONPATH": str(beside), "PATH": os.environ["PATH"], "COMMAND": " ".join(words)}
        run = subprocess.run(
            hide or words, cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
    if run.returncode:
        return {"error": (run.stderr.strip() or f"ended with {run.returncode}").splitlines()[-1]}
    return dict(json.loads(run.stdout))


def runs(inside: Path, version: tuple[int, int], folder: Path) -> Iterator[tuple[str, dict[str, Any]]]:
    """The name and result of each run."""
    hide = hiding()
    if not hide:
        print("  the system's libraries can't be hidden here; what was loaded is checked all the same")
    besides = [beside for beside in CV2 if version <= beside.newest]
    folders = [folder_beside(inside, beside, folder) for beside in besides]
    for beside, at in zip(besides, folders, strict=True):
        for first in ("cv2", "tricue"):
            yield f"cv2 {beside.cv2}, {first} first", probe([str(inside)], at, first, hide)
    qemu = shutil.which("qemu-x86_64-static") or shutil.which("qemu-x86_64")
    # Newer NumPy doesn't support the oldest processors.
    for processor in PROCESSORS if qemu and besides[0].numpy == "<2" else []:
        command = [str(qemu), "-cpu", processor, str(inside)]
        yield f"processor {processor}", probe(command, folders[0], "tricue", [])


def run_problems(python: str, wheel: Path) -> list[str]:
    """What goes wrong when a Python uses the wheel."""
    version = version_of(python)
    folder = ROOT / "build" / "check-wheel" / "{}.{}".format(*version)
    folder.mkdir(parents=True, exist_ok=True)
    inside = install(python, wheel, folder)
    problems, bits = [], set()
    for name, result in runs(inside, version, folder):
        print(f"  {name}: {result.get('error') or result['overlap']}", flush=True)
        if "error" in result:
            problems.append(f"{name}: {result['error']}")
            continue
        bits.add(result["bits"])
        if result["overlap"] < MIN_OVERLAP:
            problems.append(f"{name}: expected overlaps of {MIN_OVERLAP} or more, got {result['overlap']}")
        problems += [
            f"{name}: loads {path}"
            for path in map(Path, result["loaded"])
            if not (path.is_relative_to(folder) or ALLOWED.fullmatch(path.name))
        ]
    if len(bits) > 1:
        problems.append(f"expected the same bits in every run, got {len(bits)} different tracks")
    return problems


def main() -> int:
    """Check each wheel, and print what is wrong; the exit code is 1 if anything is."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("wheels", nargs="+", type=Path, metavar="WHEEL")
    parser.add_argument(
        "--pythons", nargs="+", default=[sys.executable], metavar="PYTHON", help="to run them"
    )
    parser.add_argument("--static", action="store_true", help="read the files, run nothing")
    options = parser.parse_args()
    pythons = {} if options.static else {version_of(python): python for python in options.pythons}
    failed = False
    for wheel in options.wheels:
        print(f"{wheel.name}: {wheel.stat().st_size:,} bytes")
        problems = static_problems(wheel)
        tag = re.search(r"-cp3(\d+)-", wheel.name)
        version = (3, int(tag[1])) if tag else (0, 0)
        if version in pythons:
            problems += run_problems(pythons[version], wheel)
        elif not options.static:
            problems.append("expected one of --pythons to fit its tag")
        print(*(f"  wrong: {problem}" for problem in problems), sep="\n", end="\n" if problems else "")
        failed |= bool(problems)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main())
