# SPDX-License-Identifier: MIT
"""TraX programs as trackers: our own server, and programs that don't behave."""

import sys
from contextlib import closing

import cv2
import numpy as np
import pytest
from tricue.camera.box import Box
from tricue.camera.frame import Frame
from tricue.evaluation.dataset import find_entries
from tricue.evaluation.foreign.spec import foreign_spec
from tricue.evaluation.tasks import RESTARTS, Task, perform
from tricue.evaluation.toolkits.trax_client import TraxProgram, command_words
from tricue.evaluation.tracker_spec import TrackerSpec

pytest.importorskip("trax")

SERVER = f"trax:{sys.executable} -m tricue.cli.trax"
DECIMALS = 6e-5  # pixels: half of the protocol's fourth decimal, and half a step of float32 below 256
LIMIT = 120.0  # seconds, on a busy machine


@pytest.fixture
def there(folders):
    """The patrol, as a data set's entry."""
    return next(entry for entry in find_entries(folders) if entry.name == "there")


def test_our_server_as_a_program(there):
    """It proves that a program's boxes and scores are those of the tracker in it, and that it has times."""
    spec = foreign_spec(f"ours={SERVER} --tracker color-particle --seed 0", {}, LIMIT)
    assert (spec.name, [set(each.names) for each in spec.traits.channels]) == ("ours", [{"color"}])
    record, ours = perform(Task(spec, there)), perform(Task(TrackerSpec("color-particle"), there))
    np.testing.assert_allclose(record.run.boxes, ours.run.boxes, rtol=0, atol=DECIMALS)
    np.testing.assert_allclose(record.run.scores, ours.run.scores, atol=1e-6)
    assert record.error == ""
    assert record.run.seconds.shape == (19,)
    assert (record.run.seconds > 0).all()


def test_a_program_that_wants_depth_runs_where_there_is_depth(there):
    """It proves that the channels are those that the program says."""
    spec = foreign_spec(f"{SERVER} --tracker depth-particle", {}, LIMIT)
    assert spec.unsupported_reason(there.open()) == "no depth"


def test_restarts_start_the_program_anew(there):
    """It proves that a run with restarts works; a program in which nothing is lost is started once."""
    spec = foreign_spec(f"{SERVER} --tracker color-particle", {}, LIMIT)
    record = perform(Task(spec, there, kind=RESTARTS))
    assert (record.starts, record.error) == ((0,), "")


@pytest.mark.parametrize(
    ("command", "message"),
    [
        ("/nowhere/program", "/nowhere/program: No such file or directory"),
        (f"{sys.executable} -c 'print(1)'", "doesn't speak TraX"),
        (f"{SERVER.removeprefix('trax:')} --tracker nobody", "doesn't speak TraX"),
        ("'", "No closing quotation"),
    ],
)
def test_programs_that_are_none(command, message):
    """It proves that what can't be run, or doesn't answer as it should, is told before the evaluation."""
    with pytest.raises(ValueError, match=message) as caught:
        foreign_spec(f"trax:{command}", {}, LIMIT)
    assert "\n" not in str(caught.value)


def test_a_program_that_ends(there, tmp_path):
    """It proves that the run of a program that dies on the way says so, and is lost from there on."""
    script = tmp_path / "dies.py"
    script.write_text(
        "import os, sys, trax\n"
        "server = trax.Server(['rectangle'], ['path'], ['color'], 'dies')\n"
        "for index in range(4):\n"
        "    request = server.wait()\n"
        "    if index == 3: os._exit(7)\n"
        "    if request.objects: region = request.objects[0][0]\n"
        "    server.status([(region, {})])\n"
    )
    record = perform(Task(foreign_spec(f"trax:{sys.executable} {script}", {}, LIMIT), there))
    assert record.error.startswith("frame 3: ")
    assert "exit code 7" in record.error
    assert np.isfinite(record.run.boxes[:3]).all()
    assert np.isnan(record.run.boxes[3:]).all()


@pytest.mark.parametrize(("confidence", "score"), [("nan", 1), ("-inf", 1), ("high", 1), ("-7.5", -7.5)])
def test_confidences_are_any_finite_numbers(there, tmp_path, confidence, score):
    """It proves that a confidence which is no finite number counts as none, and ends no run."""
    script = tmp_path / "says.py"
    script.write_text(
        "import trax\n"
        "server = trax.Server(['rectangle'], ['path'], ['color'], 'says')\n"
        "while (request := server.wait()).type != trax.TraxStatus.QUIT:\n"
        "    if request.objects: region = request.objects[0][0]\n"
        f"    server.status([(region, {{'confidence': '{confidence}'}})])\n"
    )
    record = perform(Task(foreign_spec(f"trax:{sys.executable} {script}", {}, LIMIT), there))
    assert record.error == ""
    np.testing.assert_array_equal(record.run.scores, score)


def test_depth_goes_in_millimeters(tmp_path):
    """It proves that what wasn't measured, or doesn't fit, is 0 for the program, and never far away."""
    script, seen = tmp_path / "sees.py", tmp_path / "seen.png"
    script.write_text(
        "import shutil, trax\n"
        "server = trax.Server(['rectangle'], ['path'], ['depth'], 'sees')\n"
        "while (request := server.wait()).type != trax.TraxStatus.QUIT:\n"
        "    if request.objects: region = request.objects[0][0]\n"
        f"    shutil.copy(request.image['depth'].path(), {str(seen)!r})\n"
        "    server.status([(region, {})])\n"
    )
    depth = np.array([[1.2344] * 5 + [65.535, 70.0, np.inf, np.nan, -1.0]], np.float32)
    program = TraxProgram(f"{sys.executable} {script}")
    with closing(program):
        program.init(Frame(depth=depth), Box(0, 0, 1, 1))
    assert cv2.imread(str(seen), cv2.IMREAD_UNCHANGED).tolist() == [[1234] * 5 + [65535, 0, 0, 0, 0]]


def test_an_image_that_cannot_be_written_is_an_error(tmp_path, monkeypatch):
    """It proves that a program isn't asked about the image before, which would still be there."""
    script = tmp_path / "waits.py"
    script.write_text("import trax; trax.Server(['rectangle'], ['path'], ['color'], 'waits').wait()\n")
    monkeypatch.setattr(cv2, "imwrite", lambda *_: False)
    program = TraxProgram(f"{sys.executable} {script}")
    with closing(program), pytest.raises(OSError, match=r"color\.bmp: can't be written"):
        program.init(Frame(np.zeros((4, 4, 3), np.uint8)), Box(0, 0, 1, 1))


def test_words_of_a_command():
    """It proves that they are read as a shell reads them; none is refused."""
    assert command_words("a 'b c' --d=1,2") == ["a", "b c", "--d=1,2"]
    with pytest.raises(ValueError, match="expected a command"):
        command_words(" ")
