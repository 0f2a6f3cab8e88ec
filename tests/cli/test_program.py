# SPDX-License-Identifier: MIT
import csv
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


@pytest.fixture
def sequence(tmp_path: Path) -> Path:
    """Ten bright images, the last two black, in OTB's layout; the true box moves 2 px right a frame."""
    folder = tmp_path / "walk"
    (folder / "img").mkdir(parents=True)
    for index in range(10):
        cv2.imwrite(
            str(folder / "img" / f"{index:04}.png"), np.full((60, 80, 3), 200 * (index < 8), np.uint8)
        )
    lines = [f"{6 + 2 * index},11,20,20" for index in range(10)]
    (folder / "groundtruth_rect.txt").write_text("\n".join(lines))
    return folder


def read_csv(path: Path) -> list[dict[str, str]]:
    """The file's rows by column."""
    return list(csv.DictReader(path.read_text().splitlines()))


def test_track_writes_everything(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that track starts on the first true box, follows, scores, and writes all three files."""
    out = {name: tmp_path / f"out.{name}" for name in ("mp4", "csv", "json")}
    files = ["--output", str(out["mp4"]), "--csv", str(out["csv"]), "--json", str(out["json"])]
    assert (
        main(["track", str(sequence), "--tracker", drift_tracker, "--set", "step=2", "--seed", "7", *files])
        == 0
    )
    printed = capsys.readouterr().out
    assert "walk: 10 frames, 8 tracked, 0 occluded, 2 lost" in printed
    assert "AUC 0.952, precision at 20 px 1.000" in printed  # the overlap is 1 above 20 of 21 thresholds
    assert all(f"wrote {path}" in printed for path in out.values())
    rows = read_csv(out["csv"])
    assert [float(row["x"]) for row in rows] == [5 + 2 * index for index in range(10)]
    assert [row["status"] for row in rows] == ["tracked"] * 8 + ["lost"] * 2
    content = json.loads(out["json"].read_text())
    assert content["tricue"] == tricue.__version__
    assert (content["tracker"], content["seed"], content["kernels"]) == (drift_tracker, 7, "native")
    assert content["params"] == {"step": 2.0}
    assert [track["frame"] for track in content["tracks"]] == list(range(10))
    capture = cv2.VideoCapture(str(out["mp4"]))
    assert sum(1 for _ in iter(lambda: capture.read()[0], False)) == 10


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
        "tricue reproduce: experiment: expected one of .*sabeti-fig1.*, got 'sabeti-fig9'",
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
    (["fly"], "tricue: argument COMMAND: invalid choice: 'fly'"),
    ([], "tricue: the following arguments are required: COMMAND"),
]


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


def test_the_input_is_never_overwritten(
    drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an output that is the input itself is refused and the input stays as it is."""
    path = tmp_path / "v.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(3):
        writer.write(np.full((48, 64, 3), 99, np.uint8))
    writer.release()
    before = path.read_bytes()
    assert (
        main(["track", str(path), "--tracker", drift_tracker, "--box", "1,2,8,9", "--output", str(path)]) == 2
    )
    assert "v.avi: expected a file to write to that isn't read" in capsys.readouterr().err
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("option", "name"),
    [
        ("--csv", "img/0002.png"),
        ("--json", "img/0001.png"),
        ("--mot", "groundtruth_rect.txt"),
        ("--csv", "boxes.csv"),
    ],
)
def test_what_is_read_is_never_overwritten(
    option: str, name: str, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a folder's images and true boxes stay; a track that was written before is replaced."""
    (tmp_path / "img").mkdir()
    for number in range(1, 4):
        cv2.imwrite(str(tmp_path / "img" / f"{number:04d}.png"), np.full((48, 64, 3), 99, np.uint8))
    (tmp_path / ("boxes.csv" if name == "boxes.csv" else "groundtruth_rect.txt")).write_text("1,2,8,9\n" * 3)
    before = (tmp_path / name).read_bytes()
    words = ["track", str(tmp_path), "--tracker", drift_tracker, "--box", "1,2,8,9"]
    assert main([*words, option, str(tmp_path / name)]) == 2
    assert f"{name}: expected a file to write to that isn't read" in capsys.readouterr().err
    assert (tmp_path / name).read_bytes() == before
    for _ in range(2):
        assert main([*words, option, str(tmp_path / "track.csv")]) == 0


def test_labels_beside_a_video_are_never_overwritten(
    drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a table of true boxes stays; one that a tracker wrote is no such table."""
    path, table = tmp_path / "v.avi", tmp_path / "v.csv"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10.0, (64, 48))
    for _ in range(3):
        writer.write(np.full((48, 64, 3), 99, np.uint8))
    writer.release()
    words = ["track", str(path), "--tracker", drift_tracker, "--box", "1,2,8,9", "--csv", str(table)]
    for _ in range(2):
        assert main(words) == 0
    table.write_text("frame,x,y,width,height\n0,1,2,8,9\n")
    assert main(words) == 2
    assert "v.csv: expected a file to write to that isn't read" in capsys.readouterr().err
    assert table.read_text() == "frame,x,y,width,height\n0,1,2,8,9\n"


def test_a_damaged_image_leaves_whole_files(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an input broken in the middle is a one-line error, and what came before is kept."""
    (sequence / "img" / "0004.png").write_bytes(b"no picture")
    assert main(["track", str(sequence), "--tracker", drift_tracker, "--json", str(tmp_path / "o.json")]) == 2
    assert "0004.png: expected an image" in capsys.readouterr().err
    assert len(json.loads((tmp_path / "o.json").read_text())["tracks"]) == 4


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


def tricue_command(*arguments: str) -> list[str]:
    """The words that run tricue in another process."""
    return [sys.executable, "-m", "tricue", *arguments]


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


def test_two_outputs_are_not_one_file(
    sequence: Path, drift_tracker: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a file given for two outputs is refused before anything is written."""
    files = ["--csv", str(tmp_path / "out"), "--json", str(tmp_path / "." / "out")]
    assert main(["track", str(sequence), "--tracker", drift_tracker, *files]) == 2
    assert "out: expected a file for each output, got this one twice" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("option", ["--csv", "--json"])
def test_a_full_disk_names_the_file(
    option: str, sequence: Path, drift_tracker: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that an output that can't be written is named, with exit code 2."""
    assert main(["track", str(sequence), "--tracker", drift_tracker, option, "/dev/full"]) == 2
    assert capsys.readouterr().err == "tricue track: /dev/full: No space left on device\n"


@pytest.mark.parametrize(
    ("name", "error"),
    [
        ("out.mp4", "File too large"),
        ("out.avi", "only 0 of 10 frames were written; is the disk full?"),
    ],
)
def test_a_video_that_the_disk_has_no_room_for_is_an_error(
    name: str, error: str, sequence: Path, tmp_path: Path
) -> None:
    """It proves that frames that the encoder couldn't write aren't taken for written."""
    command = tricue_command("track", str(sequence), "--output", str(tmp_path / name))
    limited = ["sh", "-c", 'ulimit -f 1; exec "$@"', "sh", *command]  # a block of 512 bytes
    done = subprocess.run(limited, capture_output=True, text=True, check=False)
    assert (done.returncode, "wrote" in done.stdout) == (2, False)
    assert f"{name}: {error}" in done.stderr


@pytest.mark.filterwarnings("default")
def test_a_video_that_is_cut_off_warns(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that a video of which half is missing is tracked or described as far as it goes, and that
    this is told.
    """
    whole = tmp_path / "whole.avi"
    writer = cv2.VideoWriter(str(whole), cv2.VideoWriter.fourcc(*"MJPG"), 25.0, (64, 48))
    noise = np.random.default_rng(0).integers(0, 256, (40, 48, 64, 3), np.uint8)
    for picture in noise:
        writer.write(picture)
    writer.release()
    for share, told in ((1.0, 0), (0.5, 1)):
        (tmp_path / "v.avi").write_bytes(whole.read_bytes()[: int(share * whole.stat().st_size)])
        assert main(["track", str(tmp_path / "v.avi"), "--box", "20,16,16,16"]) == 0
        assert capsys.readouterr().err.count("of its 40 frames can be decoded; is it cut off?") == told
        assert main(["info", str(tmp_path / "v.avi")]) == 0
        assert capsys.readouterr().err.count("of its 40 frames can be decoded; is it cut off?") == told


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
        for text in ("frame 1 is dark", "frame 2 is dark", "frame 3 has no depth"):
            warnings.warn(text, UserWarning, stacklevel=1)
    told = capsys.readouterr().err.splitlines()
    assert told == [f"tricue track: warning: {text}" for text in ("frame 1 is dark", "frame 3 has no depth")]


def test_the_help_of_the_command_lists_its_options(capsys: pytest.CaptureFixture[str]) -> None:
    """An unknown option is told with the help that has the others in it."""
    with pytest.raises(SystemExit) as end:
        main(["evaluate", "folder", "--only", "walk"])
    assert end.value.code == 2
    told = capsys.readouterr().err
    assert told == "tricue evaluate: unrecognized arguments: --only walk; see tricue evaluate --help\n"
