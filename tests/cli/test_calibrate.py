# SPDX-License-Identifier: MIT
"""``tricue calibrate``: what it writes is what trackers read, and bad input is named and leaves no file."""

import os
import re
import threading
from pathlib import Path

import cv2
import numpy as np
import pytest
from tricue import ColorParticleTracker, StereoHeadTracker, reference
from tricue.cli import main
from tricue.scenes import StereoScene, head, static_head

ColorParams, HeadParams = ColorParticleTracker.Params, StereoHeadTracker.Params
SKIN, HAIR, REST = (110, 140, 190), (20, 25, 30), (200, 90, 40)
SIZE = (24, 32)


def write_masks(folder: Path, color: tuple[int, int, int], count: int = 3) -> Path:
    """Noisy images of ``color`` on the left half and another one on the right, with masks of the left."""
    rng = np.random.default_rng(count)
    mask = np.zeros(SIZE, np.uint8)
    mask[:, :16] = 255
    for name in ("image", "mask"):
        (folder / name).mkdir(parents=True)
    for index in range(count):
        image = np.where(mask[..., None] > 0, color, REST) + rng.normal(0, 3, (*SIZE, 3))
        cv2.imwrite(str(folder / "image" / f"{index}.png"), np.clip(image, 0, 255).astype(np.uint8))
        cv2.imwrite(str(folder / "mask" / f"{index}.png"), mask)
    return folder


def write_pair(scene: StereoScene, folder: Path) -> Path:
    """A recording with left/, right/, the first true box, and the rig."""
    for index, frame in enumerate(scene.frames):
        for side, image in (("left", frame.color), ("right", frame.right)):
            (folder / side).mkdir(parents=True, exist_ok=True)
            assert image is not None
            cv2.imwrite(str(folder / side / f"{index:04}.png"), image)
    camera = scene.rig.intrinsics
    values = {name: getattr(camera, name) for name in ("fx", "fy", "cx", "cy", "width", "height")}
    lines = [f"{name} = {value}" for name, value in {**values, "baseline": scene.rig.baseline}.items()]
    (folder / "rig.toml").write_text("\n".join(lines))
    return folder


@pytest.fixture(scope="module")
def still() -> StereoScene:
    """A head at rest at 1.2 m."""
    return static_head(2, 24, distance=1.2)


def failing(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """The one line of an error."""
    assert main(["calibrate", *arguments]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    line, rest = printed.err.split("\n", 1)
    assert rest == ""
    return line


def test_skin_threshold_parts_skin_from_the_rest(tmp_path, capsys):
    """The threshold parts the two colors of the images, and the tracker reads it; the others are kept."""
    folder, out = write_masks(tmp_path / "skin", SKIN), tmp_path / "out" / "skin.toml"
    (tmp_path / "given.toml").write_text("particles = 60\nskin_threshold = 0.9\n")
    given = ["--params", str(tmp_path / "given.toml")]
    assert main(["calibrate", "skin-threshold", str(folder), *given, "--output", str(out)]) == 0
    assert "3 images, 3 with skin, area under the ROC curve 1.000" in capsys.readouterr().out
    params = ColorParams.from_toml(out)
    assert params.particles == 60
    rest = max(REST) - max(abs(a - b) for a, b in zip(REST, SKIN, strict=True))
    assert rest / 255 - 0.06 < params.skin_threshold < max(SKIN) / 255


def test_a_written_threshold_keeps_out_what_the_curve_kept_out(tmp_path, capsys):
    """Rounded down it would let in the pixels of its own level, here the whole background."""
    image, mask = np.full((*SIZE, 3), (110, 140, 170), np.uint8), np.zeros(SIZE, np.uint8)
    image[:, :16], mask[:, :16] = SKIN, 255
    for name, each in (("image", image), ("mask", mask)):
        (tmp_path / "skin" / name).mkdir(parents=True)
        cv2.imwrite(str(tmp_path / "skin" / name / "0.png"), each)
    out = tmp_path / "skin.toml"
    assert main(["calibrate", "skin-threshold", str(tmp_path / "skin"), "--output", str(out)]) == 0
    printed = re.findall(r"threshold +(\S+),", capsys.readouterr().out)
    for threshold in (ColorParams.from_toml(out).skin_threshold, *map(float, printed)):
        count, *_ = reference.skin_moments(image, np.array(SKIN, np.uint8), threshold, (0, 0, 32, 24), 1)
        assert count == 16 * 24


def test_images_without_skin_are_not_counted(tmp_path, capsys):
    """The curve is of the images that show skin, and the line says of how many."""
    folder = write_masks(tmp_path / "skin", SKIN)
    cv2.imwrite(str(folder / "mask" / "1.png"), np.zeros(SIZE, np.uint8))
    assert main(["calibrate", "skin-threshold", str(folder), "--output", str(tmp_path / "o.toml")]) == 0
    assert "3 images, 2 with skin" in capsys.readouterr().out


def test_head_colors_have_a_mode_of_skin_and_one_of_hair(tmp_path, capsys):
    """Masked skin and hair are in the model in the given shares, the pixels beside the masks are not; the
    tracker searches for it.
    """
    places = {name: write_masks(tmp_path / name, color) for name, color in (("skin", SKIN), ("hair", HAIR))}
    out = tmp_path / "head.toml"
    samples = ["--skin", str(places["skin"]), "--hair", str(places["hair"])]
    assert main(["calibrate", "head-colors", *samples, "--hair-weight", "0.3", "--output", str(out)]) == 0
    assert "bins have a color" in capsys.readouterr().out
    p = HeadParams.from_toml(out)
    assert p.head_colors is not None

    def level(color: tuple[int, int, int]) -> int:
        return sum(color) * p.bins[2] // 766

    weights = {level(SKIN): 0.0, level(HAIR): 0.0}
    for index, weight in p.head_colors:
        weights[index % p.bins[2]] += weight
    assert weights[level(SKIN)] == pytest.approx(0.7, abs=1e-4)
    assert weights[level(HAIR)] == pytest.approx(0.3, abs=1e-4)


def test_samples_may_have_boxes(tmp_path):
    """Boxes in a table do as well as masks, and frames without one don't count."""
    masked, boxed = write_masks(tmp_path / "masked", SKIN), write_masks(tmp_path / "boxed", SKIN) / "image"
    (boxed / "boxes.csv").write_text("frame,x,y,width,height\n0,0,0,16,24\n1,0,0,16,24\n2,0,0,16,24\n")
    hair = write_masks(tmp_path / "hair", HAIR)
    models = []
    for skin in (masked, boxed):
        out = tmp_path / "head.toml"
        assert main(["calibrate", "head-colors", f"--skin={skin}", f"--hair={hair}", f"--output={out}"]) == 0
        models.append(HeadParams.from_toml(out).head_colors)
    assert models[0] == models[1]


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_stereo_noise_of_a_moving_head_is_warned_of(still, tmp_path, capsys):
    """The noise is written, as the user may know better, and a line tells that it isn't a head's at rest."""
    moving = head(0, 24)
    for scene, count in ((moving, 1), (still, 0)):
        folder, out = write_pair(scene, tmp_path / str(count)), tmp_path / "head.toml"
        place = [str(folder), "--box", ",".join(map(str, scene.boxes[0]))]
        calibrated = ["--calibration", str(folder / "rig.toml"), "--output", str(out)]
        assert main(["calibrate", "stereo-noise", *place, *calibrated]) == 0
        assert capsys.readouterr().err.count("the head seems to move") == count


def test_stereo_noise_is_that_of_a_head_at_rest(still, tmp_path, capsys):
    """Noise and drift of a head in steady light are small, its disparity is off by a fraction of a pixel, and
    parameters that were measured before are kept.
    """
    folder, out = write_pair(still, tmp_path / "pair"), tmp_path / "head.toml"
    out.write_text("lost_after = 0.7\n")
    box = ",".join(map(str, still.boxes[0]))
    place = [str(folder), "--box", box, "--calibration", str(folder / "rig.toml"), "--distance", "1.2"]
    assert main(["calibrate", "stereo-noise", *place, "--params", str(out), "--output", str(out)]) == 0
    assert (
        "a head measured in 23 of 23 stereo pairs after the first, which gives the model"
        in capsys.readouterr().out
    )
    p = HeadParams.from_toml(out)
    assert p.lost_after == 0.7
    assert all(0.1 <= value < 4 for value in (*p.color_noise, *p.color_drift))
    assert 0.001 <= p.intersection_noise < 0.1
    assert p.disparity_noise < 3  # the surface is nearer than the center by the head's radius
    text = out.read_text()
    assert text.count("# from tricue calibrate") == 4


def test_a_distance_in_another_unit_is_told(still, tmp_path, capsys):
    """Its difference from what is measured isn't noise; nothing is written."""
    folder, out = write_pair(still, tmp_path / "pair"), tmp_path / "head.toml"
    place = [str(folder), "--box", ",".join(map(str, still.boxes[0])), "--output", str(out)]
    calibration = ["--calibration", str(folder / "rig.toml")]
    for distance in ("nan", "inf", "0", "-1", "1.2m"):
        with pytest.raises(SystemExit):
            main(["calibrate", "stereo-noise", *place, *calibration, f"--distance={distance}"])
        assert f"--distance: expected meters above 0, got '{distance}'" in capsys.readouterr().err
    line = failing(["stereo-noise", *place, *calibration, "--distance", "120"], capsys)
    assert "--distance: expected about 1.1" in line
    assert "m, as the pairs measure, got 120; is the calibration in meters (--unit)" in line
    assert not out.exists()


@pytest.mark.filterwarnings("ignore:the stereo pair's calibration isn't known")
def test_a_distance_needs_a_calibration(still, tmp_path, capsys):
    """The error says so, and doesn't blame the number."""
    folder, out = write_pair(still, tmp_path / "pair"), tmp_path / "head.toml"
    place = [str(folder), "--box", ",".join(map(str, still.boxes[0])), "--output", str(out)]
    line = failing(["stereo-noise", *place, "--distance", "1.2"], capsys)
    assert line.endswith("--distance: expected with the stereo pair's calibration, --calibration FILE")


@pytest.mark.parametrize(
    ("break_it", "message"),
    [
        (lambda at: (at / "mask" / "1.png").unlink(), "1.png: expected a mask of the same name"),
        (
            lambda at: cv2.imwrite(str(at / "mask" / "1.png"), np.zeros((5, 5), np.uint8)),
            "mask/1.png: expected a mask of 32x24 pixels, as 1.png has, got 5x5",
        ),
        (lambda at: (at / "image" / "1.png").write_text("x"), "image/1.png: expected an image"),
        (lambda at: [path.unlink() for path in (at / "image").iterdir()], "image: expected images"),
        (lambda at: (at / "mask").rename(at / "other"), "skin: expected the folders image and mask"),
        (
            lambda at: [cv2.imwrite(str(path), np.zeros(SIZE, np.uint8)) for path in (at / "mask").iterdir()],
            "skin",
        ),
        (lambda at: cv2.imwrite(str(at / "mask" / "1.png"), np.eye(*SIZE)), "mask/1.png: expected white"),
    ],
)
@pytest.mark.parametrize("what", ["skin-threshold", "head-colors"])
def test_bad_samples_are_named_and_nothing_is_written(what, break_it, message, tmp_path, capsys):
    """A missing, unreadable or other mask is named with its file, and there is no output, not even a part."""
    folder = write_masks(tmp_path / "skin", SKIN)
    break_it(folder)
    out = tmp_path / "out" / "params.toml"
    places = [str(folder)] if what == "skin-threshold" else ["--skin", str(folder), "--hair", str(folder)]
    assert message in failing([what, *places, "--output", str(out)], capsys)
    assert not out.parent.exists()


def test_a_folder_that_is_not_there_is_told(tmp_path, capsys):
    """A mistyped name isn't a folder that lacks its folders."""
    nowhere = str(tmp_path / "nowhere")
    line = failing(["skin-threshold", nowhere, "--output", str(tmp_path / "o.toml")], capsys)
    assert line.endswith("nowhere: there is no such folder")


def test_samples_without_masks_or_boxes_are_named(tmp_path, capsys):
    """Images alone say nothing about where the color is."""
    folder = write_masks(tmp_path / "skin", SKIN)
    alone = str(folder / "image")
    line = failing(
        ["head-colors", "--skin", alone, "--hair", str(folder), "--output", str(tmp_path / "o.toml")], capsys
    )
    assert f"{alone}: expected masks, in the folders image and mask, or a table of boxes" in line


def test_a_recording_without_a_head_is_named(still, tmp_path, capsys):
    """A blank recording, too few frames, no box, an image of another size, and a distance without a rig are
    told by the name, and the image by its frame.
    """
    folder, out = write_pair(still, tmp_path / "pair"), tmp_path / "o.toml"
    ending = ["--output", str(out)]
    calibrated = ["--calibration", str(folder / "rig.toml")]
    box = ["--box", ",".join(map(str, still.boxes[0]))]
    assert "pair: expected a box" in failing(["stereo-noise", str(folder), *calibrated, *ending], capsys)
    same = failing(["stereo-noise", str(folder), *calibrated, "--output", str(folder / "rig.toml")], capsys)
    assert "rig.toml: expected a file to write to that isn't read" in same
    cv2.imwrite(str(folder / "left" / "0012.png"), np.zeros((100, 160, 3), np.uint8))
    line = failing(["stereo-noise", str(folder), *box, *calibrated, *ending], capsys)
    assert "pair: frame 12: right: expected the shape of color, (100, 160, 3), got (120, 160, 3)" in line
    cv2.imwrite(str(folder / "right" / "0012.png"), np.zeros((100, 160, 3), np.uint8))
    line = failing(["stereo-noise", str(folder), *box, *calibrated, *ending], capsys)
    assert "pair: frame 12: frame.color: expected the first frame's shape" in line
    for path in sorted(folder.glob("*/*.png"))[::-1]:
        if int(path.stem) > 5:
            path.unlink()
    line = failing(["stereo-noise", str(folder), *box, *calibrated, *ending], capsys)
    assert (
        "pair: frames: expected a head at rest, measured in 10 or more stereo pairs after the first" in line
    )
    assert line.endswith("got 5 of 5")
    for path in folder.glob("*/*.png"):
        cv2.imwrite(str(path), np.zeros((120, 160, 3), np.uint8))
    line = failing(["stereo-noise", str(folder), *box, *calibrated, *ending], capsys)
    assert "pair: box: expected a head with a disparity" in line
    assert not out.exists()


@pytest.mark.parametrize("what", ["skin-threshold", "head-colors"])
@pytest.mark.parametrize("name", ["image/1.png", "mask/1.png"])
def test_samples_are_never_overwritten(what, name, tmp_path, capsys):
    """An output that is an image or a mask, also by another name, is refused, and the file stays as it is."""
    skin, hair = write_masks(tmp_path / "skin", SKIN), write_masks(tmp_path / "hair", HAIR)
    folder = skin if what == "skin-threshold" else hair
    places = [str(skin)] if what == "skin-threshold" else ["--skin", str(skin), "--hair", str(hair)]
    before = (folder / name).read_bytes()
    link = tmp_path / "link.toml"
    link.symlink_to(folder / name)
    for output in (folder / name, link):
        line = failing([what, *places, "--output", str(output)], capsys)
        assert f"{output}: expected a file to write to that isn't read" in line
    assert (folder / name).read_bytes() == before


def test_boxes_of_samples_are_never_overwritten(tmp_path, capsys):
    """The same for the images and boxes of a recording that samples are taken from."""
    hair, folder = write_masks(tmp_path / "hair", HAIR), write_masks(tmp_path / "boxed", SKIN) / "image"
    (folder / "boxes.csv").write_text("frame,x,y,width,height\n0,0,0,16,24\n")
    for name in ("boxes.csv", "0.png"):
        output = str(folder / name)
        line = failing(["head-colors", f"--skin={folder}", f"--hair={hair}", "--output", output], capsys)
        assert f"{name}: expected a file to write to that isn't read" in line


def test_a_stereo_pair_is_never_overwritten(still, tmp_path, capsys):
    """The left images, and those that --right names."""
    folder = write_pair(still, tmp_path / "pair")
    box = ",".join(map(str, still.boxes[0]))
    places = [str(folder / "left"), "--right", str(folder / "right"), "--box", box]
    for output in (folder / "left" / "0003.png", folder / "right" / "0003.png", folder / "right"):
        line = failing(["stereo-noise", *places, "--output", str(output)], capsys)
        assert f"{output}: expected a file to write to that isn't read" in line
    assert cv2.imread(str(folder / "right" / "0003.png")) is not None


@pytest.mark.filterwarnings("default")  # they are to be printed
def test_a_pair_without_a_rig_is_told_of_options_that_there_are(still, tmp_path, capsys):
    """The advice names no option that only ``tricue track`` has, and no tracks, of which there are none."""
    folder = write_pair(still, tmp_path / "pair")
    (folder / "rig.toml").unlink()
    box = ",".join(map(str, still.boxes[0]))
    main(["calibrate", "stereo-noise", str(folder), "--box", box, "--output", str(tmp_path / "o.toml")])
    error = capsys.readouterr().err
    assert error.count("the head's place won't be measured in meters; give --calibration FILE") == 1
    assert "tracks" not in error
    assert "--assume-fov" not in error


def test_links_and_other_files_stay(tmp_path, capsys):
    """A link stays one, nothing else beside the output is touched, and its mode is that of any new file."""
    skin = write_masks(tmp_path / "skin", SKIN)
    (tmp_path / "o.toml.part").write_text("another's")
    (tmp_path / "link.toml").symlink_to("o.toml")
    (tmp_path / "new").touch()
    for _ in range(2):
        assert main(["calibrate", "skin-threshold", str(skin), f"--output={tmp_path / 'link.toml'}"]) == 0
    assert sorted(path.name for path in tmp_path.glob("o*")) == ["o.toml", "o.toml.part"]
    assert (tmp_path / "link.toml").is_symlink()
    assert (tmp_path / "o.toml.part").read_text() == "another's"
    assert (tmp_path / "o.toml").stat().st_mode == (tmp_path / "new").stat().st_mode
    assert "skin_threshold = " in (tmp_path / "o.toml").read_text()
    assert not list(tmp_path.glob(".tricue-*"))


def test_a_pipe_is_written_into(tmp_path):
    """Its reader gets the parameters, and it stays a pipe."""
    skin, pipe, found = write_masks(tmp_path / "skin", SKIN), tmp_path / "pipe", list[str]()
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: found.append(pipe.read_text()), daemon=True)
    reader.start()
    assert main(["calibrate", "skin-threshold", str(skin), "--output", str(pipe)]) == 0
    reader.join(10)
    assert pipe.is_fifo()
    assert found[0].startswith("skin_threshold = ")


@pytest.mark.parametrize(("name", "error"), [("skin", "Is a directory"), ("file/o.toml", "Not a directory")])
def test_what_cannot_be_written_is_told_before_the_measurement(name, error, tmp_path, capsys, monkeypatch):
    """A folder, and a place below a file, are one line of error, and nothing is read for them."""
    skin, out = write_masks(tmp_path / "skin", SKIN), tmp_path / name
    (tmp_path / "file").touch()
    monkeypatch.setattr("tricue.papers.roc.skin_roc", lambda *_: pytest.fail("it was measured"))
    line = failing(["skin-threshold", str(skin), "--output", str(out)], capsys)
    assert line == f"tricue calibrate: {out}: {error}"


def test_all_false_positives_give_a_threshold_that_the_tracker_takes(tmp_path):
    """The lowest threshold of a curve is below the range of the parameter."""
    skin, out = write_masks(tmp_path / "skin", SKIN), tmp_path / "o.toml"
    words = ["skin-threshold", str(skin), "--false-positives", "1", "--output", str(out)]
    assert main(["calibrate", *words]) == 0
    assert ColorParams.from_toml(out).skin_threshold == -1


def test_a_broken_parameter_file_is_named(tmp_path, capsys):
    """Parameters that the tracker doesn't have are refused before anything is measured."""
    folder = write_masks(tmp_path / "skin", SKIN)
    (tmp_path / "given.toml").write_text("hair = 0.5\n")
    arguments = [
        *("skin-threshold", str(folder)),
        *("--params", str(tmp_path / "given.toml"), "--output", str(tmp_path / "o.toml")),
    ]
    assert "given.toml: hair: unknown parameter" in failing(arguments, capsys)


@pytest.mark.parametrize(
    ("command", "option"),
    [
        (["skin-threshold", "skin"], "--false-positives"),
        (["head-colors", "--skin", "skin", "--hair", "hair"], "--hair-weight"),
    ],
)
@pytest.mark.parametrize("text", ["2", "-0.1", "nan", "few"])
def test_a_share_is_from_0_to_1(
    command: list[str], option: str, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """It proves that the option is named, not what it is called inside."""
    with pytest.raises(SystemExit):
        main(["calibrate", *command, f"{option}={text}", "--output", "x.toml"])
    assert f"{option}: expected a share, 0 to 1, got '{text}'" in capsys.readouterr().err


def test_one_camera_is_told_of_the_other_one(still, tmp_path, capsys):
    """Without right images the error says which option gives them, and nothing is written."""
    left, out = str(write_pair(still, tmp_path / "pair") / "left"), tmp_path / "o.toml"
    line = failing(["stereo-noise", left, "--box", "60,30,25,33", "--output", str(out)], capsys)
    assert "left: frame: expected the channel right" in line
    assert line.endswith("give the right camera's images with --right PLACE")
    assert not out.exists()
