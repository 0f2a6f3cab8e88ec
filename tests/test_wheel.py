# SPDX-License-Identifier: MIT
"""What makes wheels and releases; `make wheel` checks a whole wheel."""

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from types import ModuleType

import pytest
from tricue import _core

ROOT = Path(__file__).parents[1]
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
NAME = "tricue-0.1.0-cp311-cp311-manylinux_2_34_x86_64.whl"


@pytest.fixture
def check_wheel(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/check_wheel.py."""
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    return pytest.importorskip("check_wheel")


@pytest.fixture
def release_notes(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """tools/release_notes.py."""
    monkeypatch.syspath_prepend(str(ROOT / "tools"))
    return pytest.importorskip("release_notes")


def pack(path: Path, *names: str) -> Path:
    """A wheel with empty files, but for the extension, which is this build's."""
    with zipfile.ZipFile(path, "w") as packed:
        for name in names:
            content = Path(_core.__file__).read_bytes() if name.startswith("tricue/_core.c") else b""
            packed.writestr(name, content)
    return path


WHOLE = [
    "tricue/_core.cpython-311-x86_64-linux-gnu.so",
    "tricue/_core.pyi",
    "tricue/py.typed",
    "tricue-0.1.0.dist-info/licenses/LICENSE",
    "tricue-0.1.0.dist-info/licenses/THIRD_PARTY.txt",
]


def test_a_build_for_this_machine_is_no_wheel_for_others(check_wheel: ModuleType, tmp_path: Path) -> None:
    """The check names the system's OpenCV, which an ordinary build needs, and finds nothing else in it."""
    if shutil.which("readelf") is None or "sanitized" in _core.__file__:
        pytest.skip("needs readelf from binutils, and a build for users")
    problems = check_wheel.static_problems(pack(tmp_path / NAME, *WHOLE))
    assert len(problems) == 1
    assert re.search(r"_core\S+: needs libopencv_imgproc\.so\.\d+, libopencv_core\.so\.\d+$", problems[0])


def test_what_is_wrong_with_a_wheel_is_named(
    check_wheel: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Size, tag, files that don't belong there and files that are missing each have their line."""
    monkeypatch.setattr(check_wheel, "MAX_BYTES", 10)
    names = [
        "tricue/__init__.py",
        "tricue/__pycache__/a.pyc",
        "tests/test_a.py",
        "tricue.libs/liblapack-1.so.3",
    ]
    wheel = pack(tmp_path / "tricue-0.1.0-cp311-cp311-linux_x86_64.whl", *names[:3])
    problems = "\n".join(check_wheel.static_problems(wheel))
    assert "expected fewer than 10 bytes" in problems
    assert "expected a tag manylinux" in problems
    assert "unexpected file tricue/__pycache__/a.pyc" in problems
    assert "unexpected file tests/test_a.py" in problems
    assert "expected one extension" in problems
    assert "tricue/py.typed is missing" in problems
    assert "no license text" in problems
    assert "unexpected file tricue.libs/liblapack-1.so.3" in check_wheel.content_problems(names)


@pytest.mark.parametrize("name", ["libstdc++.so.6", "libstdc++.so.6.0.30", "ld-linux-x86-64.so.2"])
def test_the_system_s_libraries_are_known_by_name_and_by_file(check_wheel: ModuleType, name: str) -> None:
    """The extension needs the name; the process has loaded the file."""
    assert check_wheel.ALLOWED.fullmatch(name)
    assert not check_wheel.ALLOWED.fullmatch("libopencv_core.so.406")


def test_exports_its_init_alone(check_wheel: ModuleType) -> None:
    """No other library can meet what is linked into the extension."""
    if shutil.which("readelf") is None or "sanitized" in _core.__file__:
        pytest.skip("needs readelf from binutils, and a build for users")
    assert check_wheel.exported(Path(_core.__file__)) == {"PyInit__core"}


def test_stands_for_every_library_that_a_wheel_lacks() -> None:
    """What Debian's static OpenCV asks of LAPACK, BLAS, GLX and zlib is just what has a stand-in."""
    archives = [
        file for name in ("core", "imgproc") for file in Path("/usr/lib").glob(f"*/libopencv_{name}.a")
    ]
    if len(archives) != 2 or shutil.which("nm") is None:
        pytest.skip("needs libopencv-imgproc-dev and binutils")
    listed = subprocess.run(["nm", "-u", *archives], capture_output=True, text=True, check=True).stdout
    asked = set(re.findall(r"U ([sdcz]\w+_|cblas_\w+|glX\w+|gz\w+)$", listed, re.MULTILINE)) - {"cvFree_"}
    source = (ROOT / "python/bindings/unused_libraries.cpp").read_text()
    lapack = re.findall(r"^TRICUE_UNUSED_LAPACK\((\w+)\)", source, re.MULTILINE)
    others = re.findall(r"^TRICUE_UNUSED\((\w+)\)", source, re.MULTILINE)
    assert asked == {f"{kind}{routine}_" for routine in lapack for kind in "sd"} | set(others)


CHANGELOG = "# Changes\n\n## Unreleased\n\n## 0.2.0\n\n- New.\n\n## 0.1.0\n\n- Old.\n"


def test_notes_are_the_changelog_s_section(release_notes: ModuleType) -> None:
    """A release's page says what the changelog says of it."""
    assert release_notes.notes("v0.2.0", 'version = "0.2.0"\n', CHANGELOG) == "- New.\n"


@pytest.mark.parametrize(
    ("tag", "version", "changelog", "message"),
    [
        ("0.2.0", "0.2.0", CHANGELOG, "expected a tag like v0.2.0, got 0.2.0"),
        ("v0.2.0", "0.1.0", CHANGELOG, "pyproject.toml: expected version 0.2.0, got 0.1.0"),
        ("v0.3.0", "0.3.0", CHANGELOG, "expected a section ## 0.3.0"),
        (
            "v0.2.0",
            "0.2.0",
            CHANGELOG.replace("Unreleased\n", "Unreleased\n\n- More.\n"),
            "under ## Unreleased",
        ),
    ],
)
def test_a_tag_that_fits_nothing_is_refused(
    release_notes: ModuleType, tag: str, version: str, changelog: str, message: str
) -> None:
    """No release has another version, or other changes, than the files say."""
    with pytest.raises(ValueError, match=re.escape(message)):
        release_notes.notes(tag, f'version = "{version}"\n', changelog)


def test_notes_of_today_s_tag_end_with_a_line() -> None:
    """The program, too, refuses in one line, with exit code 1."""
    command = [sys.executable, "tools/release_notes.py", "v99.0.0"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 1
    assert len(run.stderr.splitlines()) == 1


def test_help_on_notes_is_no_tag() -> None:
    """The program explains itself, with exit code 0."""
    command = [sys.executable, "tools/release_notes.py", "--help"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert "its section of CHANGELOG.md" in run.stdout


@pytest.mark.parametrize("workflow", WORKFLOWS, ids=lambda file: file.stem)
def test_actions_are_pinned(workflow: Path) -> None:
    """Actions are named by commits, their versions beside; jobs may read unless they say otherwise."""
    text = workflow.read_text(encoding="utf-8")
    uses = re.findall(r"uses: (.+)", text)
    assert uses
    for use in uses:
        assert re.fullmatch(r"[\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+|\./\.github/workflows/\w+\.yml", use), (
            use
        )
    assert "\npermissions:\n  contents: read\n" in text


def test_there_are_workflows() -> None:
    """Tests, wheels and releases each have one."""
    assert {"test", "wheels", "release"} <= {file.stem for file in WORKFLOWS}


def test_workflows_build_for_the_pythons_that_are_supported() -> None:
    """cibuildwheel begins with the oldest supported Python, and has one version everywhere."""
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    oldest = re.search(r'requires-python = ">=3\.(\d+)"', project)
    build = re.search(r'build = "cp3(\d)\{([\d,]+)\}-\*"', project)
    assert oldest is not None
    assert build is not None
    assert build[1] + build[2].split(",")[0] == oldest[1]
    pins = {pin for file in WORKFLOWS for pin in re.findall(r"cibuildwheel==(\S+)", file.read_text())}
    assert len(pins) == 1


def test_workflows_follow_their_schema() -> None:
    """The host would take them."""
    pytest.importorskip("check_jsonschema", reason="needs check-jsonschema: pip install tricue[dev]")
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.github-workflows"]
    run = subprocess.run([*command, *WORKFLOWS], capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stdout
