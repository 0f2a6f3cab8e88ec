# SPDX-License-Identifier: MIT
"""``tricue track`` with several boxes."""

import csv
import json
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue.cli.program import main
from tricue.draw.targets import target_color

BOXES = ["--box", "20,20,24,32", "--box", "90,60,24,32", "--box", "120,10,24,32"]


@pytest.fixture(scope="module")
def images(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Eight images of three textured things that move by a pixel a frame over noise, 160x120."""
    folder = tmp_path_factory.mktemp("three") / "img"
    folder.mkdir()
    rng = np.random.default_rng(0)
    ground = cv2.resize(rng.integers(0, 256, (15, 20, 3), np.uint8), (160, 120))
    things = [
        cv2.resize(rng.integers(0, 256, (6, 4, 3), np.uint8), (24, 32), interpolation=cv2.INTER_CUBIC)
        for _ in range(3)
    ]
    for index in range(8):
        image = ground.copy()
        for (x, y), thing in zip([(20, 20), (90, 60), (120, 10)], things, strict=True):
            image[y : y + 32, x - index : x - index + 24] = thing
        cv2.imwrite(str(folder / f"{index}.png"), image)
    return folder


def rows(path: Path) -> list[dict[str, str]]:
    """The file's rows by column."""
    return list(csv.DictReader(path.read_text().splitlines()))


def test_all_targets_are_written(images: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Files have each target of each frame by its id, the report a line for each, the video all colors."""
    out = {name: tmp_path / f"o.{name}" for name in ("csv", "json", "avi", "txt", "coco")}
    files = ["--csv", out["csv"], "--json", out["json"], "--output", out["avi"]]
    files += ["--mot", out["txt"], "--coco", out["coco"]]
    assert main(["track", str(images), *BOXES, *map(str, files)]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].endswith(": 8 frames")
    assert printed[1:4] == [f"target {n}: 8 tracked, 0 occluded, 0 lost" for n in (1, 2, 3)]
    found = rows(out["csv"])
    assert list(found[0])[:4] == ["frame", "id", "time_s", "status"]
    assert [(row["frame"], row["id"]) for row in found] == [
        (str(f), str(n)) for f in range(8) for n in (1, 2, 3)
    ]
    for number, left in ((1, 20), (2, 90), (3, 120)):
        places = [float(row["x"]) for row in found if row["id"] == str(number)]
        assert places == pytest.approx(left - np.arange(8), abs=1.5)
    tracks = json.loads(out["json"].read_text())["tracks"]
    assert [[str(track[name]) for name in ("frame", "id", "x")] for track in tracks] == [
        [row[name] for name in ("frame", "id", "x")] for row in found
    ]
    assert len(out["txt"].read_text().splitlines()) == 24
    assert len(json.loads(out["coco"].read_text())["annotations"]) == 24
    capture = cv2.VideoCapture(str(out["avi"]))
    picture = capture.read()[1].astype(int)
    scale = picture.shape[0] // 120
    for number, (x, y) in enumerate([(20, 36), (90, 76), (120, 26)], 1):
        drawn = picture[y * scale - 8 : y * scale + 8, x * scale - 2 : x * scale + 3]
        assert np.abs(drawn - target_color(number)).sum(-1).min() < 90


def test_each_is_as_alone(images: Path, tmp_path: Path) -> None:
    """A target's rows are those of a run on its box, which has no ids; with workers they are the same."""
    path = tmp_path / "o.csv"
    assert main(["track", str(images), *BOXES, "--csv", str(path), "--workers", "2"]) == 0
    several = rows(path)
    for number in (1, 2, 3):
        assert main(["track", str(images), *BOXES[2 * number - 2 : 2 * number], "--csv", str(path)]) == 0
        alone = rows(path)
        assert "id" not in alone[0]
        assert [{"id": str(number), **row} for row in alone] == [
            row for row in several if row["id"] == str(number)
        ]


def test_parameters_are_for_all(images: Path, tmp_path: Path) -> None:
    """--tracker, --set and --seed hold for each target, and are told of in the JSON."""
    path = tmp_path / "o.json"
    command = ["track", str(images), *BOXES, "--tracker", "color-particle", "--set", "particles=50"]
    assert main([*command, "--seed", "3", "--json", str(path)]) == 0
    content = json.loads(path.read_text())
    assert (content["tracker"], content["seed"], content["params"]["particles"]) == ("color-particle", 3, 50)
    assert len(content["tracks"]) == 24
    assert content["targets"] == [
        {"id": number, "name": f"Target {number}", "tracker": "color-particle"} for number in (1, 2, 3)
    ]


@pytest.mark.parametrize(
    ("extra", "error"),
    [
        (["--plot", "o.png"], "tricue track: --plot: expected one --box, got 3"),
        (["--workers", "0"], "tricue track: argument --workers: expected a whole number above 0, got '0'"),
        (
            ["--box", "5:900,900,10,10"],
            "tricue track: --box 5:900,900,10,10: expected a part inside the image of 160x120 pixels",
        ),
        (["--box", "5:9,9,1,10"], "tricue track: --box 5:9,9,1,10: expected at least 2 pixels of width"),
        (
            ["--box", "8:9,9,10,10", "--csv", "o.csv"],
            "tricue track: --box 8:...: expected a frame from 0 to 7",
        ),
        (["--mot", "o.txt", "--coco", "o.txt"], "o.txt: expected a file for each output, got this one twice"),
    ],
)
def test_errors_are_one_line(
    extra: list[str],
    error: str,
    images: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """They say what is wrong, with exit code 2."""
    if extra[0] == "--plot":
        pytest.importorskip("matplotlib")
    monkeypatch.chdir(tmp_path)
    try:
        code = main(["track", str(images), *BOXES, *extra])
    except SystemExit as stop:
        code = stop.code  # type: ignore[assignment]
    assert code == 2
    assert error in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


class Picky:
    """A third party's, which doesn't start on a narrow box."""

    def init(self, image: object, box: tuple[float, ...]) -> None:
        if box[2] < 20:
            raise ValueError("too narrow")
        self.box = box

    def update(self, image: object) -> object:
        return self.box


def test_a_start_that_fails_names_its_frame_and_box(images: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It proves that what no check can know before is told by the frame and the box."""
    words = ["--tracker", f"{__name__}:Picky", "--box", "20,20,24,32", "--box", "3:90,60,12,32"]
    assert main(["track", str(images), *words]) == 2
    assert "frame 3, --box 90,60,12,32: " in capsys.readouterr().err
