# SPDX-License-Identifier: MIT
"""The laws of the tree: where a kernel's parts stand, and which folder may import which."""

import ast
import re
from collections import Counter
from pathlib import Path

import pytest
from tricue import _core, arrays, reference
from tricue.reference.base import arrays as twin_arrays

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "python" / "tricue"
TWINS = PACKAGE / "reference"
KERNELS = sorted(name for name in dir(_core) if not name.startswith("_"))
HELPERS = {"base", "detail"}
"""Folders whose files serve kernels and are none."""
TRACKERS = {"color_particle", "depth_particle", "flow_depth", "fused", "stereo_head"}
UPPER = {"track", "evaluation", "papers", "scenes", "draw", "export", "app", "cli"}
PARTS = {
    "arrays",
    "camera",
    "data",
    "errors",
    "former_names",
    "imgproc",
    "kernels",
    "reference",
    "rerun",
    "_core",
}
NOTEBOOK = "notebook"
"""The folder of what ``_repr_html_`` methods return, which these alone import."""
FORBIDDEN = {
    "camera": UPPER | {"data"},
    "data": UPPER,
    "reference": UPPER | {"camera", "data"},
    "track": UPPER - {"track"} | {"data"},
    "scenes": UPPER - {"scenes"},
    "draw": UPPER - {"draw", "track"} | {"data"},
    "export": UPPER - {"export", "track"} | {"data"},
    "evaluation": {"papers", "scenes", "app", "cli"},
    NOTEBOOK: UPPER - {"track", "draw", "evaluation"} | {"data"},
    "papers": {"app", "cli"},
    "app": {"papers", "cli"},
    "doctor": UPPER | PARTS,
}
"""What of the package a folder may not import: a frame goes camera, data, track, then to those who use it."""


def functions(file: Path) -> set[str]:
    """Names of the functions that a Python file or stub defines."""
    return {node.name for node in ast.parse(file.read_text()).body if isinstance(node, ast.FunctionDef)}


def files_of(folder: Path, suffix: str, prefix: str = "") -> dict[str, Path]:
    """The places, relative to the folder, of the files in it that are named like a kernel's, by kernel."""
    found = [file.relative_to(folder) for file in folder.rglob(f"{prefix}*{suffix}")]
    return {
        file.stem.removeprefix(prefix): file.parent
        for file in found
        if not HELPERS & set(file.parts) and file.stem != "__init__"
    }


HEADERS = files_of(ROOT / "cpp", ".hpp")
STUB = functions(PACKAGE / "_core.pyi")


@pytest.mark.parametrize("name", KERNELS)
def test_kernel_is_whole(name: str) -> None:
    """What is exported has header, source, twin, stub, test and benchmark of its name, in like folders."""
    place = HEADERS.get(name)
    assert place is not None, f"{name}: no header in cpp, outside base/ and detail/"
    twin = TWINS / place / f"{name}.py"
    parts = {
        "source": ROOT / "cpp" / place / f"{name}.cpp",
        "twin": twin,
        "test": ROOT / "tests" / place / f"test_{name}.py",
        "benchmark": ROOT / "benchmarks" / place / f"bench_{name}.py",
    }
    missing = [f"{part} {file.relative_to(ROOT)}" for part, file in parts.items() if not file.exists()]
    missing += [f"function {name} in its twin"] * (twin.exists() and name not in functions(twin))
    missing += ["export of its twin"] * (name not in reference.__all__)
    missing += ["stub (make stubs)"] * (name not in STUB)
    assert not missing, f"{name} lacks: " + ", ".join(missing)


@pytest.mark.parametrize("name", KERNELS)
def test_kernel_runs_without_the_gil(name: str) -> None:
    """What a kernel's binding calls goes through `unlocked`: trackers in other threads run meanwhile."""
    bindings = "\n".join(file.read_text() for file in (ROOT / "python" / "bindings").glob("*.cpp"))
    function = re.search(rf'm\.def\("{name}", (\w+),', bindings)
    assert function is not None
    body = re.search(rf"^[^\n]*\b{function[1]}\(.*?^}}$", bindings, re.MULTILINE | re.DOTALL)
    assert body is not None
    assert "unlocked(" in body[0]


@pytest.mark.parametrize(
    ("folder", "suffix", "prefix"),
    [
        ("cpp", ".hpp", ""),
        ("cpp", ".cpp", ""),
        ("python/tricue/reference", ".py", ""),
        ("benchmarks", ".py", "bench_"),
    ],
)
def test_nothing_is_orphaned(folder: str, suffix: str, prefix: str) -> None:
    """No header, source, twin or benchmark is left of a kernel that isn't exported any more."""
    found = files_of(ROOT / folder, suffix, prefix)
    of_kernels = {name for name, place in found.items() if place.parts[:1] != ("track",)}
    assert of_kernels <= set(KERNELS), f"not exported: {sorted(of_kernels - set(KERNELS))}"


def test_both_sets_of_kernels_are_the_same() -> None:
    """The extension and the twins export the same names."""
    assert set(KERNELS) == set(reference.__all__)


def test_helpers_stand_beside_their_users() -> None:
    """A helper in detail/ serves its own folder; one that several folders include is in base/."""
    for file in [*(ROOT / "cpp").rglob("*.?pp")]:
        here = file.relative_to(ROOT / "cpp").parent
        home = here.parent if here.name == "detail" else here
        for included in re.findall(r'#include "(.+)/detail/', file.read_text()):
            assert Path(included) == home, f"{file.relative_to(ROOT)} includes a detail of {included}"


COMPILER_ONLY = r"__attribute__|gnu::|vector_size|__builtin|__AVX|immintrin|_mm\d|_Pragma|#pragma (?!once)"


def test_only_simd_hpp_knows_the_processor() -> None:
    """Attributes, vector types and intrinsics are named in base/simd.hpp and its source alone."""
    sources = [file for file in (ROOT / "cpp").rglob("*.?pp") if file.stem != "simd"]
    wrong = {file.relative_to(ROOT) for file in sources if re.search(COMPILER_ONLY, file.read_text())}
    assert not wrong, sorted(wrong)


@pytest.mark.parametrize("twin", sorted(TWINS.rglob("*.py")), ids=lambda file: file.stem)
def test_twin_does_without_opencv(twin: Path) -> None:
    """A twin computes by itself what it is the reference of: no cv2, no native kernel."""
    nodes = list(ast.walk(ast.parse(twin.read_text())))
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    imported |= {node.module or "." for node in nodes if isinstance(node, ast.ImportFrom)}
    if twin == TWINS / "__init__.py":  # which is no twin: it appends the native kernels' contracts
        imported.remove("tricue")
    assert all(
        name.split(".")[0] in {"numpy", "collections", "math", "typing"} or "reference" in name
        for name in imported
    )


def imports(file: Path) -> set[str]:
    """The package's own modules that a file of it imports, without "tricue."."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.ImportFrom) and node.module:
            found |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
    return {name.removeprefix("tricue.") for name in found if name.startswith("tricue.")}


MODULES = sorted(PACKAGE.rglob("*.py"))


@pytest.mark.parametrize("folder", FORBIDDEN)
def test_imports_go_one_way(folder: str) -> None:
    """No folder imports one that uses it: camera and data know no tracker, trackers no evaluation."""
    wrong = {
        f"{file.relative_to(PACKAGE)} imports {name}"
        for file in (PACKAGE / folder).rglob("*.py")
        for name in imports(file)
        if name.split(".")[0] in FORBIDDEN[folder]
    }
    assert not wrong, sorted(wrong)


def test_types_of_arrays_are_defined_once() -> None:
    """A module imports them from tricue.arrays, a twin the same from reference/base/arrays.py."""
    names = {name: value for name, value in vars(arrays).items() if name[0].isupper() and name != "NDArray"}
    assert names.items() <= vars(twin_arrays).items()
    alias = re.compile(rf"^({'|'.join(names)}) = ", re.MULTILINE)
    found = {file.relative_to(PACKAGE) for file in MODULES if alias.search(file.read_text())}
    assert found == {Path("arrays.py"), Path("reference/base/arrays.py")}


def test_only_values_in_a_notebook_import_its_pictures() -> None:
    """tricue.notebook is imported in ``_repr_html_`` methods and nowhere else."""
    wrong = []
    for file in MODULES:
        if NOTEBOOK in file.relative_to(PACKAGE).parts or NOTEBOOK not in file.read_text():
            continue
        tree = ast.parse(file.read_text())
        methods = [
            node
            for node in ast.walk(tree)
            if isinstance(node, ast.FunctionDef) and node.name == "_repr_html_"
        ]
        allowed = {id(node) for method in methods for node in ast.walk(method)}
        for node in ast.walk(tree):
            named = isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"tricue.{NOTEBOOK}")
            if named and id(node) not in allowed:
                wrong.append(f"{file.relative_to(PACKAGE)}:{node.lineno}")
    assert not wrong


@pytest.mark.parametrize("tracker", sorted(TRACKERS))
def test_a_tracker_knows_no_other(tracker: str) -> None:
    """What two trackers need is in track/base or a folder of its own."""
    others = {f"track.{other}" for other in TRACKERS - {tracker}}
    wrong = {
        f"{file.relative_to(PACKAGE)} imports {name}"
        for file in (PACKAGE / "track" / tracker).rglob("*.py")
        for name in imports(file)
        if ".".join(name.split(".")[:2]) in others
    }
    assert not wrong, sorted(wrong)


def test_what_trackers_share_knows_none() -> None:
    """track/base, track/depth_objects and track/head_detection import no tracker."""
    shared = [
        *(PACKAGE / "track" / "base").rglob("*.py"),
        *(PACKAGE / "track" / "depth_objects").rglob("*.py"),
        *(PACKAGE / "track" / "head_detection").rglob("*.py"),
    ]
    wrong = {
        f"{file.relative_to(PACKAGE)} imports {name}"
        for file in shared
        for name in imports(file)
        if name.startswith(tuple(f"track.{tracker}" for tracker in TRACKERS))
    }
    assert not wrong, sorted(wrong)


def test_only_the_command_line_parses_arguments() -> None:
    """argparse is imported in cli/ alone."""
    parsers = {file for file in MODULES if re.search(r"(?m)^\s*(import|from) argparse", file.read_text())}
    assert {file.relative_to(PACKAGE).parts[0] for file in parsers} == {"cli"}


CV2_OF_SCENES = {"imwrite", "FileStorage", "FILE_STORAGE_WRITE", "inpaint", "INPAINT_TELEA"}
"""Files, and what every version of cv2 does alike."""
CV2_OF_TRACKERS = {
    "overlay": {"resize", "INTER_NEAREST", "copyMakeBorder", "BORDER_CONSTANT"},  # for the eye
    "heads_in_disparities": {  # of the first frame
        *("resize", "INTER_AREA", "INTER_LINEAR", "copyMakeBorder", "BORDER_REPLICATE"),
        *("matchTemplate", "TM_CCORR", "minMaxLoc"),
    },
    "head_outline": {"Sobel", "CV_32F"},  # of the first frame
    "face_detection": {  # of the first frame
        *("cvtColor", "COLOR_GRAY2BGR", "split", "resize", "INTER_AREA", "INTER_LINEAR", "copyMakeBorder"),
        *("BORDER_REPLICATE", "BORDER_REFLECT", "Sobel", "magnitude", "boxFilter", "filter2D"),
    },
    "picture_observation": {"cvtColor", "COLOR_GRAY2BGR"},
    "depth": {"countNonZero"},
    "depth_trust": {"resize", "INTER_AREA", "absdiff"},  # means, alike in every version
}
"""What trackers' files use of cv2: it measures nothing, or has whole results, alike in every version."""


def names_of_cv2(file: Path) -> set[str]:
    """What a file uses of cv2."""
    nodes = list(ast.walk(ast.parse(file.read_text())))
    assert not [node for node in nodes if isinstance(node, ast.ImportFrom) and node.module == "cv2"], file
    return {
        node.attr
        for node in nodes
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "cv2"
    }


@pytest.mark.parametrize("file", sorted((PACKAGE / "scenes").rglob("*.py")), ids=lambda file: file.stem)
def test_scenes_are_rendered_without_cv2(file: Path) -> None:
    """cv2 resamples otherwise from version to version: what is rendered uses tricue.imgproc instead."""
    assert names_of_cv2(file) <= CV2_OF_SCENES


@pytest.mark.parametrize("file", sorted((PACKAGE / "track").rglob("*.py")), ids=lambda file: file.stem)
def test_trackers_measure_without_cv2(file: Path) -> None:
    """A track doesn't depend on which cv2 is installed: pixels are the kernels' work."""
    assert names_of_cv2(file) <= CV2_OF_TRACKERS.get(file.stem, set())


def test_files_carry_their_license() -> None:
    """Every source file begins with one SPDX line."""
    sources = [
        file
        for tree in ("cpp", "python", "tests", "benchmarks", "tools", "examples")
        for file in (ROOT / tree).rglob("*")
    ]
    texts = [file for file in sources if file.suffix in {".py", ".pyi", ".cpp", ".hpp"}]
    assert not [file for file in texts if "SPDX-License-Identifier: MIT" not in file.read_text()[:80]]


def test_a_class_name_stands_for_one_thing():
    """A name used for two different things becomes two names."""
    classes = Counter(
        node.name
        for file in PACKAGE.rglob("*.py")
        for node in ast.parse(file.read_text()).body
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
    )
    assert [name for name, count in classes.items() if count > 1] == []
