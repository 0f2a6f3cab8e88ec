# SPDX-License-Identifier: MIT
"""The law of the tree: a kernel is header, source, twin, binding, stub, test and benchmark of one name."""

import ast
from pathlib import Path

import pytest
from tricue import _core, reference

ROOT = Path(__file__).parents[1]
TWINS = ROOT / "python" / "tricue" / "reference"
AREAS = ("camera", "cues", "fuse")


def names_under(folder: Path, suffix: str, prefix: str = "") -> list[Path]:
    """Paths without suffix, relative to the folder, of the files in it that are named like a kernel's."""
    files = (file for area in AREAS for file in (folder / area).rglob(f"{prefix}*{suffix}"))
    return sorted(file.relative_to(folder).with_suffix("") for file in files if file.stem != "__init__")


def functions(file: Path) -> set[str]:
    """Names of the functions that a Python file or stub defines."""
    return {node.name for node in ast.parse(file.read_text()).body if isinstance(node, ast.FunctionDef)}


SOURCES = set(names_under(ROOT / "cpp", ".cpp"))
# Under camera lie also the types that kernels share, headers without a source.
KERNELS = [path for path in names_under(ROOT / "cpp", ".hpp") if path.parts[0] != "camera" or path in SOURCES]
STUB = functions(ROOT / "python" / "tricue" / "_core.pyi")


def missing_parts(kernel: Path) -> list[str]:
    """What the law asks for and the tree lacks."""
    name, twin = kernel.name, (TWINS / kernel).with_suffix(".py")
    files = [
        Path("cpp", kernel).with_suffix(".cpp"),
        twin.relative_to(ROOT),
        Path("tests", kernel.parent, f"test_{name}.py"),
        Path("benchmarks", kernel.parent, f"bench_{name}.py"),
    ]
    facts = {
        f"function {name} in its twin": twin.exists() and name in functions(twin),
        f"tricue._core.{name}": callable(getattr(_core, name, None)),
        f"tricue.reference.{name}": name in reference.__all__ and callable(getattr(reference, name, None)),
        f"{name} in _core.pyi (make stubs)": name in STUB,
    }
    return [str(f) for f in files if not (ROOT / f).exists()] + [
        what for what, true in facts.items() if not true
    ]


@pytest.mark.parametrize("kernel", KERNELS, ids=str)
def test_kernel_is_whole(kernel: Path) -> None:
    """A kernel's header comes with source, twin, binding, stub, test and benchmark, each of its name."""
    missing = missing_parts(kernel)
    assert not missing, f"{kernel} lacks: " + ", ".join(missing)


@pytest.mark.parametrize(
    ("folder", "suffix", "prefix"),
    [("cpp", ".cpp", ""), ("python/tricue/reference", ".py", ""), ("benchmarks", ".py", "bench_")],
)
def test_nothing_is_orphaned(folder: str, suffix: str, prefix: str) -> None:
    """No source, twin or benchmark is left of a kernel that has no header any more."""
    found = {
        path.with_name(path.name.removeprefix(prefix)) for path in names_under(ROOT / folder, suffix, prefix)
    }
    assert found <= set(KERNELS), f"without header in cpp: {sorted(found - set(KERNELS))}"


def test_everything_bound_is_a_kernel() -> None:
    """The extension and the twins export kernels only, and both the same."""
    bound = {name for name in dir(_core) if not name.startswith("_")}
    assert bound == set(reference.__all__) == {kernel.name for kernel in KERNELS}


@pytest.mark.parametrize("twin", names_under(TWINS, ".py"), ids=str)
def test_twin_does_without_opencv(twin: Path) -> None:
    """A twin computes by itself what it is the reference of: no cv2, no native kernel."""
    nodes = list(ast.walk(ast.parse((TWINS / twin).with_suffix(".py").read_text())))
    imported = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    imported |= {node.module for node in nodes if isinstance(node, ast.ImportFrom) and node.module}
    assert all(name.split(".")[0] in {"numpy", "collections"} or "reference" in name for name in imported)


def test_files_carry_their_license() -> None:
    """Every source file begins with one SPDX line."""
    sources = [
        file
        for tree in ("cpp", "python", "tests", "benchmarks", "tools")
        for file in (ROOT / tree).rglob("*")
    ]
    texts = [file for file in sources if file.suffix in {".py", ".pyi", ".cpp", ".hpp"}]
    assert not [file for file in texts if "SPDX-License-Identifier: MIT" not in file.read_text()[:80]]
