# SPDX-License-Identifier: MIT
"""``python -m tricue.cli.trax``, spoken to by hand: what stands here is TraX, as the VOT toolkit sends it."""

import math
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import cv2
import numpy as np
import pytest
import tricue
from tricue import Box, Frame, Status, Track
from tricue.doctor.install import install_extra
from tricue.evaluation.toolkits import trax_server
from tricue.evaluation.toolkits.trax_server import (
    EMPTY_BOX,
    TraxReply,
    TraxSession,
    TraxTracker,
    bounding_box,
    select_channels,
    widen_box,
)
from tricue.scenes import WalkScene, overtaking

trax = pytest.importorskip("trax")

FRAMES = 5
SPOKEN = 5.8e-5  # pixels: half of the protocol's fourth decimal, and half a step of float32 below 256
COMMAND = [sys.executable, "-m", "tricue.cli.trax"]
STATE = re.compile(r'@@TRAX:state "([-\d.,]+)" "confidence=([\d.e-]+)" *')


@pytest.fixture(scope="module")
def scene() -> WalkScene:
    """A walker before a color and depth camera."""
    return overtaking(seed=3, frames=FRAMES, depth=True)


@pytest.fixture(scope="module")
def images(scene: WalkScene, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Its images: color/1.png and so on, depth in millimeters in depth/1.png."""
    folder = tmp_path_factory.mktemp("a walk")
    for index, frame in enumerate(scene.frames, 1):
        assert frame.color is not None
        assert frame.depth is not None
        for channel, image in (("color", frame.color), ("depth", np.nan_to_num(1000 * frame.depth))):
            (folder / channel).mkdir(exist_ok=True)
            kind = np.uint8 if channel == "color" else np.uint16
            cv2.imwrite(str(folder / channel / f"{index}.png"), image.astype(kind))
    return folder


def frame_of(images: Path, number: int, *channels: str) -> Frame:
    """The frame as OpenCV reads it, without tricue's readers."""
    color = cv2.imread(str(images / "color" / f"{number}.png"), cv2.IMREAD_COLOR)
    depth = cv2.imread(str(images / "depth" / f"{number}.png"), cv2.IMREAD_UNCHANGED)
    if "depth" not in channels:
        return Frame(color)
    return Frame(color if "color" in channels else None, depth, depth_scale=0.001)


def said(box: Box) -> str:
    """A box in the protocol."""
    return ",".join(f"{number:.4f}" for number in box)


def shown(images: Path, number: int, *channels: str) -> str:
    """The message with a frame's files."""
    files = (f'"file://{images}/{channel}/{number}.png"' for channel in channels)
    return f"@@TRAX:frame {' '.join(files)}"


def transcript(images: Path, box: Box, *channels: str) -> list[str]:
    """What a client sends for the whole sequence."""
    frames = [shown(images, number, *channels) for number in range(1, FRAMES + 1)]
    return [f'@@TRAX:initialize "{said(box)}"', *frames, "@@TRAX:quit"]


@dataclass(frozen=True)
class Talk:
    """What came back: the lines of the protocol, the rest, and the exit code."""

    lines: list[str]
    error: str
    code: int

    @property
    def states(self) -> list[tuple[tuple[float, ...], float]]:
        """Boxes and confidences."""
        found = (STATE.fullmatch(line) for line in self.lines)
        return [(tuple(map(float, match[1].split(","))), float(match[2])) for match in found if match]


def talk(
    lines: list[str], *arguments: str, command: list[str] = COMMAND, env: dict[str, str] | None = None
) -> Talk:
    """Send all lines, close standard input, and wait for the end."""
    text = "".join(f"{line}\n" for line in lines)
    done = subprocess.run(
        [*command, *arguments],
        input=text,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
        env=None if env is None else {"PATH": "", **env},
    )
    return Talk(done.stdout.splitlines(), done.stderr, done.returncode)


@pytest.mark.parametrize(
    ("tracker", "settings", "channels"),
    [
        ("color-particle", {"particles": 50}, ("color",)),
        ("depth-particle", {"particles": 50}, ("depth",)),
        ("fused", {}, ("color",)),
        ("flow-depth", {}, ("color", "depth")),
        ("flow-depth", {"cues": ("flow",)}, ("color",)),
        ("flow-depth", {"cues": ("disparity",)}, ("depth",)),
    ],
)
def test_answers_are_the_tracker_s(
    images: Path, scene: WalkScene, tracker: str, settings: dict[str, object], channels: tuple[str, ...]
) -> None:
    """It proves that each tracker asks for the channels it needs, and that its boxes and scores are sent, to
    the protocol's four decimals, with nothing else on standard output.
    """
    box = Box(*(round(number, 4) for number in scene.boxes[0]))
    texts = [f"{name}={','.join(v) if isinstance(v, tuple) else v}" for name, v in settings.items()]
    options = ["--tracker", tracker, "--seed", "5", *(word for text in texts for word in ("--set", text))]
    done = talk(transcript(images, box, *channels), *options)
    assert (done.code, done.error) == (0, "")
    assert f'"trax.channels={"".join(f"{name};" for name in channels)}"' in done.lines[0]
    assert all(
        f'"{word}"' in done.lines[0] for word in ("trax.version=4", "vot=python", "trax.region=rectangle;")
    )
    own = tricue.create(tracker, seed=5, **settings)
    tracks = [own.init(frame_of(images, 1, *channels), box)]
    tracks += [own.update(frame_of(images, number, *channels)) for number in range(2, FRAMES + 1)]
    assert len(done.states) == FRAMES == sum(line.startswith("@@TRAX:state") for line in done.lines)
    assert all(line.startswith("@@TRAX:") for line in done.lines)
    boxes, confidences = zip(*done.states, strict=True)
    np.testing.assert_allclose(boxes, [track.box for track in tracks], rtol=0, atol=SPOKEN)
    np.testing.assert_allclose(confidences, [track.score for track in tracks], rtol=1e-12)


def test_the_environment_says_the_same(images: Path, scene: WalkScene, tmp_path: Path) -> None:
    """It proves that TRICUE_* stand for the options, and that the command line goes before them."""
    (tmp_path / "p.toml").write_text("particles = 40\n")
    messages = transcript(images, scene.boxes[0], "depth")
    written = {
        "TRICUE_TRACKER": "depth-particle",
        "TRICUE_SET": "near=0.6 far=9",
        "TRICUE_PARAMS": str(tmp_path / "p.toml"),
        "TRICUE_SEED": "3",
    }
    options = ["--tracker", "depth-particle", "--params", str(tmp_path / "p.toml"), "--seed", "3"]
    settings = ["--set", "near=0.6", "--set", "far=9"]
    first = talk(messages, env=written)
    assert len(first.states) == FRAMES
    assert first.states == talk(messages, *options, *settings).states
    other = {**written, "TRICUE_TRACKER": "stereo-head", "TRICUE_SEED": "8", "TRICUE_SET": "near=0.9 far=9"}
    assert first.states == talk(messages, *options, *settings[:2], env=other).states


BAD_FRAMES = [
    ("color/9.png", "depth/2.png", "no such file"),
    ("broken.png", "depth/2.png", "can't be read as one"),
    ("color/2.png", "color/2.png", "expected depth, 16 bits of one channel, got uint8"),
    ("color/2.png", "small.png", "frame.depth: expected shape (120, 160), got (60, 80)"),
]


@pytest.mark.parametrize(("color", "depth", "reason"), BAD_FRAMES)
def test_a_bad_frame_ends_with_its_reason(
    images: Path, scene: WalkScene, color: str, depth: str, reason: str
) -> None:
    """It proves that the client is told which file is wrong and why, and the user in a line."""
    (images / "broken.png").write_bytes(b"no picture")
    cv2.imwrite(str(images / "small.png"), np.full((60, 80), 2000, np.uint16))
    first = transcript(images, scene.boxes[0], "color", "depth")[:2]
    done = talk(
        [*first, f'@@TRAX:frame "file://{images}/{color}" "file://{images}/{depth}"'],
        "--tracker",
        "flow-depth",
    )
    assert done.code == 2
    assert [line.split(" ")[0] for line in done.lines] == ["@@TRAX:hello", "@@TRAX:state", "@@TRAX:quit"]
    named = depth if "depth" in reason else color
    for text in (done.lines[-1], done.error):
        assert reason in text
        assert str(images / named) in text
    assert done.error.count("\n") == 1


@pytest.mark.parametrize("kept", [0, 1, 2, 3])
def test_a_client_that_goes_away_ends_it(images: Path, scene: WalkScene, kept: int) -> None:
    """It proves that a closed standard input ends the process, also where the library alone would hang."""
    done = talk(transcript(images, scene.boxes[0], "color")[:kept])
    assert (done.code, done.error) == (0, "")
    assert len(done.states) == max(0, kept - 1)


def test_what_is_not_the_protocol_is_an_error() -> None:
    """It proves that a broken message ends the process in a line, without a traceback."""
    done = talk(['@@TRAX:initialize "1,2,3,4"', "@@TRAX:frame"])
    assert done.code == 2
    assert done.error.startswith("python -m tricue.cli.trax: the client's messages can't be read: ")
    assert done.error.count("\n") == 1


def test_messages_out_of_order_are_refused(images: Path) -> None:
    """It proves that a frame before initialize is an error with a reason."""
    done = talk([shown(images, 1, "color")])
    assert "expected initialize before the next frame" in done.lines[-1]
    assert done.code == 2


@pytest.mark.parametrize("second", ["at once", "later"])
def test_another_target_is_refused(images: Path, second: str) -> None:
    """It proves that a client with several targets is told that ours is one, whenever it names them."""
    start = '@@TRAX:initialize "20,30,30,60"'
    later = [shown(images, 1, "color"), start] if second == "later" else [start]
    done = talk([start, *later, shown(images, 2, "color")])
    assert "expected one target in all" in done.lines[-1]
    assert done.code == 2


@pytest.mark.parametrize(
    ("box", "answer"),
    [
        ("500,20,30,40", (500, 20, 30, 40)),
        ("-50,-50,10,10", (-50, -50, 10, 10)),
        ("80,-9,0,0", (80, -9, 0, 0)),
        ("nan,nan,nan,nan", (0, 0, 0, 0)),  # a region without a place
    ],
)
def test_a_hopeless_start_is_borne(images: Path, box: str, answer: tuple[float, ...]) -> None:
    """It proves that where a tracker can't start, the box itself is answered, finite, with confidence 0."""
    shows = [shown(images, number, "depth") for number in (1, 2, 3)]
    done = talk([f'@@TRAX:initialize "{box}"', *shows, "@@TRAX:quit"], "--tracker", "depth-particle")
    assert done.code == 0
    assert done.states == [(answer, 0)] * 3
    assert "not started, the answer is the box itself: box: expected" in done.error


@pytest.mark.parametrize("size", ["0,0", "1,0.5", "0,40"])
def test_a_thin_box_is_started_on(images: Path, size: str) -> None:
    """It proves that a box without area, but inside, is tracked from two pixels on."""
    shows = [shown(images, number, "color") for number in (1, 2)]
    done = talk([f'@@TRAX:initialize "80,60,{size}"', *shows, "@@TRAX:quit"])
    assert (done.code, done.error) == (0, "")
    assert all(min(box[2:]) > 0 for box, _ in done.states)


@pytest.mark.parametrize("region", ["20,30,50,30,50,90,20,90", "20,30,30,60"])
def test_a_polygon_is_the_box_round_it(images: Path, region: str) -> None:
    """It proves that polygons start the tracker on their bounds."""
    messages = [f'@@TRAX:initialize "{region}"', shown(images, 1, "color"), "@@TRAX:quit"]
    assert talk(messages).states[0][0] == (20, 30, 30, 60)


def test_a_mask_is_the_box_round_it() -> None:
    """It proves that the box of a mask is that of its pixels, where its offset puts them."""
    mask = np.zeros((40, 50), np.uint8)
    mask[10:20, 5:30] = 1
    assert bounding_box(trax.Mask.create(mask, x=7, y=3)) == Box(12, 13, 25, 10)


@pytest.mark.parametrize(
    ("box", "expected"),
    [
        (Box(10, 20, 0, 0), Box(9, 19, 2, 2)),
        (Box(10, 20, 1, 30), Box(9.5, 20, 2, 30)),
        (Box(10.1, 20.2, 2, 30.3), Box(10.1, 20.2, 2, 30.3)),
    ],
)
def test_thin_boxes_are_widened(box: Box, expected: Box) -> None:
    """It proves that a box gets two pixels round its center, and others not a bit of change."""
    assert widen_box(box) == expected


class Scripted:
    """A tracker that says what it is told to say."""

    def __init__(self, *tracks: Track) -> None:
        self.tracks = list(tracks)

    def init(self, frame: Frame, box: Box) -> Track:
        return Track(box, 0.5, Status.TRACKED)

    def update(self, frame: Frame) -> Track:
        return self.tracks.pop(0)


def test_answers_are_finite_and_confidences_in_range() -> None:
    """It proves that no NaN is sent, at which the toolkit would stop, and confidences are in [0, 1]."""
    lost = Status.LOST
    tracks = [
        Track(Box(4, 5, 6, 7), -0.25, lost),
        Track(Box(math.nan, 5, 6, 7), 0.7, lost),
        Track(Box(8, 5, 6, 7), math.nan, lost),
        Track(Box(9, 5, 6, 7), 1.5, Status.TRACKED),
    ]
    session, frame = TraxSession(lambda _: Scripted(*tracks)), Frame(np.zeros((9, 9, 3), np.uint8))  # type: ignore[arg-type,return-value]
    with pytest.raises(RuntimeError, match="expected initialize"):
        session.follow(frame)
    assert session.start(frame, Box(1, 2, 3, 4)) == TraxReply(Box(1, 2, 3, 4), 0.5)
    assert [session.follow(frame) for _ in tracks] == [
        TraxReply(Box(4, 5, 6, 7), 0.0),
        TraxReply(Box(4, 5, 6, 7), 0.0),
        TraxReply(Box(8, 5, 6, 7), 0.0),
        TraxReply(Box(9, 5, 6, 7), 1.0),
    ]


def test_a_session_survives_a_start_but_no_bad_frame(images: Path) -> None:
    """It proves that only what is wrong with the box is borne; a frame without its channel is an error."""
    session = TraxSession(TraxTracker("depth-particle").create)
    with pytest.warns(UserWarning, match="not started"):
        assert session.start(frame_of(images, 1, "depth"), Box(900, 9, 9, 9)).confidence == 0
    with pytest.warns(UserWarning, match="not started"):
        assert session.start(frame_of(images, 1, "depth"), Box(*[math.nan] * 4)) == TraxReply(EMPTY_BOX, 0)
    with pytest.raises(ValueError, match="channel depth"):
        session.start(frame_of(images, 1), Box(20, 20, 30, 30))


def test_an_error_of_any_class_names_the_files(images: Path) -> None:
    """It proves that the reason reaches the client, also of a class that isn't made from a text alone."""

    class Broken:
        def follow(self, frame: Frame) -> TraxReply:
            raise UnicodeDecodeError("utf-8", b"x", 0, 1, "invalid start byte")

    image = SimpleNamespace(path=lambda: str(images / "color" / "1.png"))
    request: Any = SimpleNamespace(image={"color": image}, objects=(), type="frame")
    with pytest.raises(RuntimeError, match=r"1\.png: .*invalid start byte"):
        trax_server._reply(request, Broken())  # type: ignore[arg-type]


def test_a_tracker_that_prints_stays_off_the_protocol(images: Path, scene: WalkScene) -> None:
    """It proves that what anybody prints while a tracker runs goes to standard error."""
    code = """
import sys, tricue.track.color_particle.tracker as module
from tricue.cli.trax import main
update = module.ColorParticleTracker.update
def loud(self, frame):
    print("hear, hear")
    return update(self, frame)
module.ColorParticleTracker.update = loud
sys.exit(main([]))
"""
    done = talk(transcript(images, scene.boxes[0], "color"), command=[sys.executable, "-c", code])
    assert done.code == 0
    assert all(line.startswith("@@TRAX:") for line in done.lines)
    assert done.error.count("hear, hear") == FRAMES - 1


def test_a_missing_extra_is_named() -> None:
    """It proves that without vot-trax one line says what installs it."""
    code = "import sys; sys.modules['trax'] = None; from tricue.cli.trax import main; sys.exit(main([]))"
    done = talk([], command=[sys.executable, "-c", code])
    assert (done.code, done.lines) == (2, [])
    needed = f"the TraX protocol needs the extra vot: {install_extra('vot')}"
    assert done.error == f"python -m tricue.cli.trax: {needed}\n"


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--tracker", "stereo-head"], "stereo-head: needs the right image of a stereo pair"),
        (["--tracker", "magic"], "argument --tracker: expected one of 'color-particle'"),
        (["--set", "particles"], "--set: expected name=value"),
        (["--set", "particles=0"], "particles: expected at least"),
        (["--set", "particle=5"], "particle: unknown parameter"),
        (["--params", "nofile.toml"], "nofile.toml: No such file"),
        (["--seed", "x"], "argument --seed: expected a whole number"),
        (["--calibration", "camera.toml"], "calibration: color-particle takes no camera's intrinsics"),
        (["--tracker", "flow-depth", "--calibration", "none.toml"], "none.toml: there is no such file"),
    ],
)
def test_bad_options_are_one_line(
    options: list[str], message: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that a mistake is told before the protocol begins, in one line, with exit code 2."""
    from tricue.cli.trax import main

    for name in ("TRACKER", "SET", "PARAMS", "SEED", "CALIBRATION"):
        monkeypatch.delenv(f"TRICUE_{name}", raising=False)
    try:
        code = main(options)
    except SystemExit as stop:  # argparse's own way out
        code = int(str(stop.code))
    printed = capsys.readouterr()
    assert (code, printed.out) == (2, "")
    assert message in printed.err
    assert printed.err.count("\n") == 1


def test_a_calibration_is_that_of_the_camera(images: Path, scene: WalkScene, tmp_path: Path) -> None:
    """It proves that depth trackers get the camera of the file, and that one of another size is refused."""
    camera = scene.rig.intrinsics
    names = ("fx", "fy", "cx", "cy", "width", "height")
    (tmp_path / "c.toml").write_text("".join(f"{name} = {getattr(camera, name)}\n" for name in names))
    for tracker in ("depth-particle", "flow-depth", "fused"):
        served = TraxTracker(tracker, calibration=tmp_path / "c.toml")
        frame = frame_of(images, 1, "color", "depth")
        made = served.create(frame)
        assert made.intrinsics == camera  # type: ignore[attr-defined]
        half = Frame(np.zeros((60, 80, 3), np.uint8), np.ones((60, 80), np.float32))
        with pytest.raises(ValueError, match="got one for 160x120"):
            served.create(half)


def test_channels_by_default() -> None:
    """It proves what each tracker needs of VOT without further parameters."""
    assert select_channels("color-particle") == ("color",)
    assert select_channels("depth-particle") == ("depth",)
    assert select_channels("flow-depth") == ("color", "depth")
    assert select_channels("fused") == ("color",)
    with pytest.raises(ValueError, match="right image"):
        select_channels("stereo-head")
