# SPDX-License-Identifier: MIT
"""``tricue open``: what the command hands to the server."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray
from tricue import Frame, FusedTracker, Intrinsics, StereoRig
from tricue.app import serve
from tricue.cli.program import main
from tricue.data.open_source import open_source
from tricue.data.source import Source

TOML = "fx = 100.0\nfy = 100.0\ncx = 39.5\ncy = 29.5\nwidth = 80\nheight = 60\n"


class Handed:
    """What serve_project was called with."""

    source: Source
    place: Path
    keywords: Mapping[str, Any]


@pytest.fixture
def handed(monkeypatch: pytest.MonkeyPatch) -> Handed:
    """The server's arguments instead of the server."""
    found = Handed()

    def note(source: Source, place: Path, **keywords: Any) -> None:
        found.source, found.place, found.keywords = source, place, keywords

    monkeypatch.setattr(serve, "serve_project", note)
    return found


def write_images(folder: Path, dtype: type = np.uint8, value: int = 90) -> Path:
    """Three images, gray-valued color or depth."""
    folder.mkdir(parents=True)
    shape = (60, 80, 3) if dtype is np.uint8 else (60, 80)
    for at in range(3):
        cv2.imwrite(str(folder / f"{at}.png"), np.full(shape, value, dtype))
    return folder


def test_color_needs_no_calibration(tmp_path: Path, handed: Handed) -> None:
    """Options go through; nothing is known of the camera, and nothing is warned of."""
    folder = write_images(tmp_path / "images")
    assert main(["open", str(folder), "--fps", "10", "--port", "9000", "--no-browser", "--seed", "3"]) == 0
    assert (handed.place, handed.source.fps, list(handed.source.channels)) == (folder, 10, ["color"])
    given = {name: handed.keywords[name] for name in ("port", "browser", "cameras", "tracker", "seed")}
    assert given == {"port": 9000, "browser": False, "cameras": {}, "tracker": "", "seed": 3}


def test_browser_and_port_are_left_to_the_server(tmp_path: Path, handed: Handed) -> None:
    """Without options a browser opens, at whatever port is free."""
    assert main(["open", str(write_images(tmp_path / "images")), "--tracker", "color-particle"]) == 0
    assert (handed.keywords["port"], handed.keywords["browser"]) == (None, True)
    assert handed.keywords["tracker"] == "color-particle"


def test_stereo_pair_has_its_rig(tmp_path: Path, handed: Handed) -> None:
    """Positions in meters come from the calibration."""
    for side in ("left", "right"):
        write_images(tmp_path / "pair" / side)
    file = tmp_path / "stereo.toml"
    file.write_text(TOML + "baseline = 0.1\n")
    assert main(["open", str(tmp_path / "pair"), "--calibration", str(file)]) == 0
    rig = handed.keywords["cameras"]["rig"]
    assert isinstance(rig, StereoRig)
    assert rig.baseline == 0.1


@pytest.mark.parametrize("color", [True, False])
def test_depth_has_its_camera(tmp_path: Path, handed: Handed, color: bool) -> None:
    """With color or alone, by a file or by the angles of view."""
    depth = write_images(tmp_path / "depth", np.uint16, 2000)
    place = [str(write_images(tmp_path / "color")), "--depth", str(depth)] if color else [str(depth)]
    file = tmp_path / "camera.toml"
    file.write_text(TOML)
    for camera in (["--calibration", str(file)], ["--fov", "43.6"]):
        assert main(["open", *place, "--depth-scale", "0.001", *camera]) == 0
        found = handed.keywords["cameras"]["intrinsics"]
        assert isinstance(found, Intrinsics)
        assert found.fx == pytest.approx(100, rel=0.01)
        assert "depth" in handed.source.channels


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["missing.mp4"], "missing.mp4: there is no such file or folder"),
        (["."], "expected"),
        (["images", "--fov", "60,50,40"], "argument --fov: expected one angle or two"),
        (["images", "--port", "x"], "argument --port: invalid int value: 'x'"),
        (["images", "--tracker", "nope"], "argument --tracker: expected one of"),
    ],
)
def test_bad_input_is_one_line(
    arguments: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """Exit code 2, and a line that names what is wrong."""
    monkeypatch.chdir(tmp_path)
    if arguments[0] == "images":
        write_images(tmp_path / "images")
    try:
        code = main(["open", "--no-browser", *arguments])
    except SystemExit as ended:
        code = int(ended.code or 0)
    error = capsys.readouterr().err
    assert code == 2
    assert message in error
    assert error.count("\n") == 1


@pytest.mark.parametrize("place", ["0", "/dev/video3", "rtsp://user:secret@host/a", "realsense:", "oak:7"])
def test_a_camera_gets_a_page_of_its_own(place: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The server of cameras gets the name, without a password, and opens nothing before its page is there."""
    from tricue.app.live import serve as live_serve

    found: list[Any] = []
    monkeypatch.setattr(live_serve, "serve_camera", lambda *given, **named: found.append((given, named)))
    assert main(["open", place, "--port", "9000", "--tracker", "fused", "--no-browser"]) == 0
    (((_, name), named),) = found
    assert "secret" not in name
    assert name.removeprefix("camera ").startswith(place.split("//", maxsplit=1)[0])
    assert (named["port"], named["browser"], named["tracker"]) == (9000, False, "fused")


def test_a_camera_is_opened_with_its_calibration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """What opens the camera knows --fov, and says what is to be said on the terminal."""
    from tricue.app.live import serve as live_serve
    from tricue.cli import open as command

    images = write_images(tmp_path / "images")
    monkeypatch.setattr(command, "open_input", lambda _: open_source(images))
    found: list[Any] = []
    monkeypatch.setattr(live_serve, "serve_camera", lambda open_, *_, **__: found.append(open_()))
    assert main(["open", "0", "--fov", "60"]) == 0
    (opened,) = found
    assert isinstance(opened.cameras["intrinsics"], Intrinsics)
    assert opened.source.name == "images"
    capsys.readouterr()


@pytest.mark.filterwarnings("ignore:depth. its median is about 3000 m")
@pytest.mark.parametrize(
    ("color", "depth", "told"),
    [
        (
            None,
            np.full((60, 80), 3000.0),
            "millimeters; --depth-scale 0.001 tells their unit; end tricue open",
        ),
        (
            np.full((120, 160, 3), 90, np.uint8),
            np.full((60, 80), 3.0),
            "--calibration FILE in TOML, with the tables depth and color, registers it; end tricue open",
        ),
    ],
)
def test_the_page_tells_options(
    tmp_path: Path, handed: Handed, color: Any, depth: NDArray[np.float64], told: str
) -> None:
    """An error of a tracker names the options to start with again; in Python it names arguments."""
    assert main(["open", str(write_images(tmp_path / "images"))]) == 0
    with pytest.raises(ValueError, match=r"^frame.depth: expected") as raised:
        FusedTracker().init(Frame(color, depth), (20, 20, 20, 20))
    shown = handed.keywords["word"](f"Target 1, fused, frame 0: {raised.value}")
    assert shown.startswith("Target 1, fused, frame 0: frame.depth: expected ")
    assert shown.endswith(f"{told} and start it again with that")
    assert handed.keywords["word"]("Target 1: bad frame 7") == "Target 1: bad frame 7"


def test_topics_of_a_recording(tmp_path: Path, handed: Handed) -> None:
    """--topics chooses what is shown."""
    from tests.data.recordings.written import color, raw, write_bag1

    sent = [raw(name, at * 10**8, color(9), "bgr8") for at in range(1, 5) for name in ("/a", "/b")]
    bag = write_bag1(tmp_path / "a.bag", sent)
    assert main(["open", str(bag), "--topics", "color=/b"]) == 0
    assert handed.source.channels["color"].joint.chosen == {"color": "/b"}  # type: ignore[attr-defined]
