# SPDX-License-Identifier: MIT
"""The program: its arguments, its help, its streams, and its errors in one line."""

import json
import os
import re
import subprocess
import sys
import warnings
from functools import partial
from pathlib import Path

import cv2
import numpy as np
import pytest
import tricue
from tricue.cli.program import COMMANDS, _one_line_warnings, main
from tricue.doctor.install import install_extra

from tests.cli.track_commands import read_csv, tricue_command


def test_parameters_come_from_a_file(sequence: Path, drift_tracker: str, tmp_path: Path) -> None:
    """It proves that a TOML file sets parameters and --set overrides it."""
    (tmp_path / "p.toml").write_text("step = 3\n")
    for extra, step in (((), 3.0), (("--set", "step=4"), 4.0)):
        command = ["track", str(sequence), "--tracker", drift_tracker, "--params", str(tmp_path / "p.toml")]
        assert main([*command, "--json", str(tmp_path / "o.json"), *extra]) == 0
        assert json.loads((tmp_path / "o.json").read_text())["params"] == {"step": step}


def test_the_box_goes_before_the_truth(sequence: Path, drift_tracker: str, tmp_path: Path) -> None:
    """It proves that --box starts the tracker where it says, also left of the image."""
    path = tmp_path / "o.csv"
    assert (
        main(["track", str(sequence), "--tracker", drift_tracker, "--box=-3,4,20.5,30", "--csv", str(path)])
        == 0
    )
    row = read_csv(path)[0]
    assert [float(row[key]) for key in ("x", "y", "width", "height")] == [-3, 4, 20.5, 30]


@pytest.mark.parametrize(("box", "compared"), [("14,20,20,20", True), ("50,30,20,20", False)])
def test_another_target_is_not_compared_with_the_truth(
    sequence: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str], box: str, compared: bool
) -> None:
    """It proves that true boxes judge a target that starts on them, and no other one, which is told."""
    assert main(["track", str(sequence), "--tracker", drift_tracker, "--box", box]) == 0
    printed = capsys.readouterr().out
    assert ("against the true boxes: AUC" in printed) is compared
    assert ("not compared with the true boxes" in printed) is not compared


def test_a_missing_image_is_told(
    sequence: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that true boxes aren't compared with other images' tracks, and that info says so, too."""
    (sequence / "img" / "0004.png").unlink()
    told = (
        f"{sequence}/img: expected images 0000 to 0009, one for each of 10 true boxes, got none with number"
    )
    assert main(["track", str(sequence), "--tracker", drift_tracker]) == 0
    printed = capsys.readouterr().out
    assert f"not compared with the true boxes: {told} 0004\n" in printed
    assert "AUC" not in printed
    assert main(["info", str(sequence)]) == 0
    assert f"{told} 0004\n" in capsys.readouterr().out


BAD = [
    (["track", "nowhere"], "tricue track: nowhere: there is no such file or folder"),
    (["track", "{walk}/img"], "tricue track: .*; give --box x,y,width,height or --detect face"),
    (
        ["track", "{walk}", "--set", "stp=2"],
        "tricue track: stp: unknown parameter of DriftParams; did you mean step?",
    ),
    (["track", "{walk}", "--set", "step=far"], "tricue track: step: expected a number, got 'far'"),
    (["track", "{walk}", "--set", "step"], "tricue track: --set: expected name=value, got 'step'"),
    (["track", "{walk}", "--params", "nofile.toml"], "tricue track: nofile.toml: No such file or directory"),
    (["track", "{walk}", "--output", "o.gif"], "tricue track: o.gif: expected a video file's name"),
    (["track", "{walk}", "--csv", "{walk}/img"], "tricue track: .*img: Is a directory"),
    (["track", "{walk}/img/0001.png"], "tricue track: .*0001.png: .*; give its folder"),
    (["track", "{walk}/groundtruth_rect.txt"], "tricue track: .*_rect.txt: expected a video"),
    (
        ["track", "{walk}", "--box", "1,2,3"],
        r"tricue track: argument --box: expected four numbers .*; see tricue .*",
    ),
    (
        ["track", "{walk}", "--box", "1,2,x,4"],
        "tricue track: argument --box: expected four numbers .*'1,2,x,4'",
    ),
    (
        ["track", "{walk}", "--box", "1,2,-3,4"],
        "tricue track: argument --box: expected width and height above 0",
    ),
    (
        ["track", "{walk}", "--box", "-5,2,3,4"],
        "tricue track: argument --box: expected one argument; one that begins with a minus needs --box=",
    ),
    (["track", "{walk}", "--box", "1,2,nan,4"], "tricue track: argument --box: expected finite numbers"),
    (
        ["track", "{walk}", "--box", "1,2,3,4", "--detect", "face"],
        "tricue track: argument --detect: not allowed",
    ),
    (["track", "{walk}", "--detect", "cat"], "tricue track: argument --detect: invalid choice: 'cat'"),
    (["track", "{walk}", "--kernels", "fast"], "tricue track: argument --kernels: invalid choice: 'fast'"),
    (
        ["track", "{walk}", "--seed", "x"],
        "tricue track: argument --seed: expected a whole number from 0 on, got 'x'",
    ),
    (["track", "{walk}", "--workers", "9" * 23], "tricue track: .*--workers: expected at most 1,000,000"),
    (
        ["track", "{walk}", "--start", "9" * 23],
        "tricue track: .*--start: expected a frame's number, 0 to 1,000",
    ),
    (["track", "{walk}", "--box", f"{'9' * 23}:1,2,3,4"], "tricue track: .*--box: expected a frame's number"),
    (
        ["reproduce", "sabeti-fig2", "--jobs", "0"],
        "tricue reproduce: .*--jobs: expected a whole number above",
    ),
    (["demo", "--seed", "-3"], "tricue demo: argument --seed: expected a whole number from 0 on, got '-3'"),
    (["track"], "tricue track: the following arguments are required: INPUT"),
    (
        ["reproduce", "sabeti-fig9"],
        "tricue reproduce: EXPERIMENT: expected one of .*sabeti-fig1.*, got 'sabeti-fig9'",
    ),
    (["reproduce", "sabeti-fig1", "--rate", "0.1"], "tricue reproduce: --rate: expected none, as only"),
    (["reproduce", "sabeti-fig1", "--data", "a"], "tricue reproduce: --data: expected none, as only"),
    (
        ["reproduce", "sabeti-roc", "--rate", "3"],
        "tricue reproduce: --rate: expected a share, 0 to 1, got 3.0",
    ),
    (["reproduce", "sabeti-fig1", "--seeds", "0"], "tricue reproduce: .*--seeds: expected a whole number"),
    (
        ["track", "{walk}", "--tracker", "fused", "--unit", "0.1"],
        "tricue track: --unit: expected with a stereo pair",
    ),
    (["demo", "magic"], "tricue demo: argument tracker: expected one of .*, got 'magic'"),
    (["info", ""], "tricue info: an argument is empty; is a shell variable unset?"),
    (["evaluate", "{walk}", "--output", ""], "tricue evaluate: an argument is empty"),
    (["track", "{walk}", "--box", "1,2,3,4", "--csv="], "tricue track: argument --csv: it is empty"),
    (["--verbose", "info", "a.mp4"], r"tricue: unrecognized arguments: --verbose; see tricue --help"),
    (["fly"], "tricue: argument COMMAND: invalid choice: 'fly'"),
    ([], "tricue: the following arguments are required: COMMAND"),
]


# With all outputs that are a file, and what else the command needs.
FILES = [
    *(["track", "v.mp4", f"--{name}"] for name in ("output", "csv", "json", "mot", "coco", "plot")),
    ["calibrate", "skin-threshold", "skin", "--output"],
    ["compare", "old", "new", "--report"],
    ["evaluate", "sequences", "--latex"],
]


@pytest.mark.parametrize("words", FILES)
def test_a_folder_is_no_output_file(
    words: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A name that ends in a slash, of a folder that may not exist, is an error that names the option."""
    with pytest.raises(SystemExit, match="2"):
        main([*words, f"{tmp_path}/out/"])
    error = f"tricue {words[0]}.*: argument {words[-1]}: expected a file's name, got the folder '.*/out/'"
    assert re.match(error, capsys.readouterr().err)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_arguments_are_one_line(
    sequence: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    """It proves that each mistake is one line on stderr that says what is wrong, and the exit code is 2."""
    words = [word.format(walk=sequence) for word in arguments]
    words[1:1] = ["--tracker", drift_tracker] if words[:1] == ["track"] else []
    try:
        code = main(words)
    except SystemExit as stop:  # argparse's own way out
        code = int(str(stop.code))
    error = capsys.readouterr().err
    assert code == 2
    assert error.count("\n") == 1
    assert "Traceback" not in error
    assert re.match(message, error), error


def test_demo_writes_a_table_a_video_and_a_plot(
    drift_tracker: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that demo measures a tracker, even a hopeless one, on every scene, and writes its files."""
    pytest.importorskip("skimage")
    pytest.importorskip("matplotlib")
    from tricue import scenes
    from tricue.scenes import BACKGROUNDS

    monkeypatch.setattr(scenes, "face_over_clutter", partial(scenes.face_over_clutter, frames=40))
    assert main(["demo", drift_tracker, "--output", str(tmp_path / "demo")]) == 0
    printed = capsys.readouterr().out
    rows = [line.split() for line in printed.splitlines() if line.split(" ")[0] in BACKGROUNDS]
    assert [row[0] for row in rows] == list(BACKGROUNDS)
    assert all(float(row[1]) > 25 for row in rows)  # it only drifts to the right
    assert cv2.imread(str(tmp_path / "demo" / "drift.png")) is not None
    capture = cv2.VideoCapture(str(tmp_path / "demo" / "drift.mp4"))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 40 * len(BACKGROUNDS)


@pytest.mark.parametrize("extra", ["skimage", "matplotlib"])
def test_a_missing_extra_is_named(
    extra: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that demo without its extra says which command installs it, and leaves nothing behind."""
    for name in [name for name in sys.modules if name.split(".")[0] == extra]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, extra, None)
    assert main(["demo", "--output", str(tmp_path / "demo")]) == 2
    error = capsys.readouterr().err
    assert install_extra("demo") in error
    assert error.count("\n") == 1
    assert not list(tmp_path.glob("demo/*"))


@pytest.mark.parametrize("command", [[], *([name] for name in COMMANDS)])
def test_help_shows_examples(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that every command has a help text, with commands to copy."""
    with pytest.raises(SystemExit) as stop:
        main([*command, "--help"])
    assert stop.value.code == 0
    printed = capsys.readouterr().out
    assert not command or f"examples:\n  tricue {command[0]}" in printed


def test_the_module_is_the_command() -> None:
    """It proves that python -m tricue runs, prints the version, and passes exit codes on."""
    done = subprocess.run(tricue_command("--version"), capture_output=True, text=True, check=True)
    assert done.stdout == f"tricue {tricue.__version__}\n"
    failed = subprocess.run(tricue_command("track", "nowhere"), capture_output=True, text=True, check=False)
    assert (failed.returncode, failed.stdout) == (2, "")
    assert failed.stderr == "tricue track: nowhere: there is no such file or folder\n"


def test_opencv_keeps_quiet(tmp_path: Path) -> None:
    """It proves that OpenCV's and FFmpeg's own messages don't join the one line of an error."""
    (tmp_path / "v.mp4").write_bytes(b"\x00\x00\x00\x18ftypmp42" + bytes(200))
    command = tricue_command("track", str(tmp_path / "v.mp4"), "--box", "1,2,30,40")
    failed = subprocess.run(command, capture_output=True, text=True, check=False)
    assert failed.returncode == 2
    assert failed.stderr.count("\n") == 1


def test_a_closed_pipe_is_silent(sequence: Path) -> None:
    """A reader that stops early, such as head, ends the command without a word, with 141 as a Unix tool."""
    command = tricue_command("info", str(sequence))
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert process.stderr.read() == b""
        assert process.wait(60) == 141


@pytest.mark.skipif(sys.platform == "win32", reason="closes them by a shell")
@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&- >&- 2>&-"])
def test_streams_may_be_closed(sequence: Path, tmp_path: Path, closed: str) -> None:
    """It proves that what a service without standard streams tracks is written, and is no error."""
    table = tmp_path / "t.csv"
    command = tricue_command("track", str(sequence), "--csv", str(table))
    subprocess.run(["sh", "-c", f'exec "$@" {closed}', "sh", *command], check=True, capture_output=True)
    assert len(read_csv(table)) == 10


def test_letters_that_the_terminal_lacks_are_escaped(sequence: Path) -> None:
    """A name with an accent is printed on a terminal that knows only ASCII."""
    folder = sequence.rename(sequence.with_name("caf\xe9"))
    environment = {**os.environ, "PYTHONIOENCODING": "ascii"}
    done = subprocess.run(
        tricue_command("info", str(folder)), capture_output=True, env=environment, check=False
    )
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.startswith(b"caf\\xe9: ")


def test_paths_need_not_be_utf_8(tmp_path: Path) -> None:
    """It proves that images are read from any path; a video whose path OpenCV can't open is named."""
    folder = os.fsencode(tmp_path) + b"/caf\xe9"
    Path(os.fsdecode(folder)).mkdir()
    picture = cv2.imencode(".png", np.full((48, 64, 3), 99, np.uint8))[1].tobytes()
    for name in (b"/1.png", b"/2.png"):
        Path(os.fsdecode(folder + name)).write_bytes(picture)
    command = [sys.executable, "-m", "tricue", "track", folder, "--box", "20,16,16,16"]
    done = subprocess.run(command, capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    Path(os.fsdecode(folder + b".avi")).write_bytes(b"RIFF")
    done = subprocess.run([*command[:4], folder + b".avi", *command[5:]], capture_output=True, check=False)
    assert done.returncode == 2
    assert b"OpenCV opens only videos whose path is UTF-8; rename it" in done.stderr


def test_warnings_are_shown_once_but_for_their_numbers(capsys: pytest.CaptureFixture[str]) -> None:
    """Frames repeat a warning with other numbers; another one, though of the same line of code, is shown."""
    with _one_line_warnings("track"):
        warnings.simplefilter("default")
        for text in ("frame 1 is dark", "frame 2 is dark", "it is 819 m", "it is 810.5 m", "it is 1e+05 m"):
            warnings.warn(text, UserWarning, stacklevel=1)
    told = capsys.readouterr().err.splitlines()
    assert told == [f"tricue track: warning: {text}" for text in ("frame 1 is dark", "it is 819 m")]


def test_the_help_of_the_command_lists_its_options(capsys: pytest.CaptureFixture[str]) -> None:
    """An unknown option is told with the help that has the others in it."""
    with pytest.raises(SystemExit) as end:
        main(["evaluate", "folder", "--only", "walk"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    assert told == "tricue evaluate: unrecognized arguments: --only walk; see tricue evaluate --help\n"


def test_the_names_of_all_images_are_told_in_short(capsys: pytest.CaptureFixture[str]) -> None:
    """A shell makes hundreds of img/*.jpg; the error says to give the folder."""
    with pytest.raises(SystemExit) as end:
        main(["track", *(f"img/{index}.jpg" for index in range(400)), "--box", "1,2,30,40"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    some = "img/1.jpg img/2.jpg img/3.jpg and 396 more; give the folder of several images"
    assert told == f"tricue track: unrecognized arguments: {some}; see tricue track --help\n"


def test_an_interrupt_while_a_command_is_imported_is_a_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Ctrl-C at once after the command's start gives no traceback."""

    def interrupt(_name: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("tricue.cli.program.importlib.import_module", interrupt)
    assert main(["track", "video.mp4"]) == 130
    assert capsys.readouterr().err == "tricue: interrupted\n"
