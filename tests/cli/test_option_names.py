# SPDX-License-Identifier: MIT
"""The library's messages name its arguments; the command line names options in their place."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from tricue.cli.option_names import ADVICE, by_options, naming_options
from tricue.cli.program import main

PACKAGE = Path(tricue.__file__).parent
OF_COMMANDS = {"app/commands.py", "evaluation/report/setup.py", "papers/sabeti_color/skin_threshold.py"}
"""Files that write a command line for the user to run."""


def texts(file: Path) -> Iterator[str]:
    """The strings of a file's code, without its docstrings."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    alone = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in alone:
            yield node.value


def test_no_message_of_the_library_names_an_option() -> None:
    """Options are those of other programs, or in a command line for the user to run."""
    named = {
        (path, text)
        for file in PACKAGE.rglob("*.py")
        if (path := file.relative_to(PACKAGE).as_posix()) not in OF_COMMANDS
        and path.split("/")[0] not in ("cli", "doctor")
        for text in texts(file)
        if re.search(r"--[a-z]", text)
    }
    assert named == {("data/recordings/recording.py", ": expected unpacked files; zstd -d --rm ")}


@pytest.mark.parametrize("advice", ADVICE)
def test_what_messages_advise_is_still_in_the_library(advice: str) -> None:
    """Another wording there would leave the command line without its options."""
    files = (file for file in PACKAGE.rglob("*.py") if "cli" not in file.relative_to(PACKAGE).parts)
    told = by_options(advice)
    assert any(advice in text for file in files for text in texts(file))
    assert "--" in told
    assert by_options(told) == told


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ("depth_scale: expected meters", "--depth-scale: expected meters"),
        ("a: expected depth_scale, the meters", "a: expected --depth-scale, the meters"),
        (
            "depth: its median is 9 m; pass depth_scale=0.001",
            "depth: its median is 9 m; pass --depth-scale 0.001",
        ),
        ("depth_scale=1 tells their unit; until", "--depth-scale 1 tells their unit; until"),
        ("frame 3: no answer within 4 s (time_limit)", "frame 3: no answer within 4 s (--time-limit)"),
        ("topics: expected one of the images /a", "--topics: expected one of the images /a"),
        (f"none; topics={ {'color': '/a'} } reads", "none; --topics color=/a reads"),
        (f"topics={ {'color': '/a', 'right': '/b'} }: no", "--topics color=/a,right=/b: no"),
        ("topics chosen: depth=/d; topics= chooses", "topics chosen: depth=/d; --topics chooses"),
        ("right=b.mp4: expected color", "--right b.mp4: expected color"),
        ("a: expected color beside depth=d, found", "a: expected color beside --depth d, found"),
        ("fps=15: expected with images", "--fps 15: expected with images"),
        ("port=80: the port is in use", "--port 80: the port is in use"),
        (
            "baseline: 60 m is wide; is it in meters?",
            "baseline: 60 m is wide; is the calibration in meters (--unit)?",
        ),
        ("depth: expected as many images", "depth: expected as many images"),
        ("/data/depth_scale/a.png: no", "/data/depth_scale/a.png: no"),
        ("my-depth_scale.toml: no", "my-depth_scale.toml: no"),
    ],
)
def test_arguments_are_told_as_options(message: str, told: str) -> None:
    """What isn't an argument, such as a folder's name, stays; a second time changes nothing."""
    assert by_options(message) == told
    assert by_options(told) == told


def test_arguments_of_one_command() -> None:
    """A command's own arguments are named where a message begins with one."""
    with pytest.raises(ValueError, match=r"^--set: expected a parameter$"), naming_options(settings="--set"):
        raise ValueError("settings: expected a parameter")
    assert by_options("settings: expected a parameter") == "settings: expected a parameter"


@pytest.mark.filterwarnings("default")
def test_a_wrong_unit_names_the_option(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The warning of depth in a wrong unit names the option that mends it, not Python's argument."""
    for index in range(3):
        cv2.imwrite(str(tmp_path / f"{index}.png"), np.full((96, 128), 3000 + 10 * index, np.uint16))
    options = ["--depth-scale", "1", "--tracker", "flow-depth", "--set", "cues=disparity"]
    main(["track", str(tmp_path), "--box", "40,30,24,24", *options])
    warning = capsys.readouterr().err
    assert "warning: depth: its median is " in warning
    assert "which looks like millimeters; pass --depth-scale 0.001\n" in warning
