# SPDX-License-Identifier: MIT
"""The parameters of the depth particle tracker: what is refused, that they come back from a file, and that
the paper's own forms run.
"""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import tricue
from tricue import DepthParticleTracker, Status, Track
from tricue.scenes import DepthScene

Params = DepthParticleTracker.Params
FIELDS = {field.name: field for field in dataclasses.fields(Params)}

REFUSED: dict[str, tuple[Any, ...]] = {
    "particles": (1, 0, -5, 100_001),
    "near": (0, -1.0, 8.0, 9.0),
    "far": (0, -1.0),
    "resolution": (15, 0, -1),
    "rate": (0, -15.0),
    "floor": (),
    "floor_clear": (-0.1,),
    "edges": (),
    "edge_gap": (-0.1,),
    "edge_slope": (-0.1,),
    "max_gap_share": (-0.1, 1.1),
    "gap_passes": (-1, 17),
    "levels": (7, 0, 4097),
    "bandwidth": (0, -0.1),
    "prominence": (-0.1, 1.1),
    "min_area": (0, -0.1),
    "aspect": ((0, 5), (-1, 5), (5.0, 1.0), (1.0,), (1.0, 2.0, 3.0)),
    "human_height": ((0, 2), (-1, 2), (2.2, 0.9), (1.0,)),
    "max_fill": (0, -0.1, 1.1),
    "histogram": ("Relative", "", "both"),
    "likelihood": ("square", ""),
    "sharpness": (0, -1.0),
    "histogram_reach": (0, -0.5),
    "bins": (3, 0, 4097),
    "grid": ((1, 10), (14, 65), (14,), (14, 10, 3)),
    "contrast": (-0.1,),
    "margin": (1.0, 0.5),
    "measurement": (-0.1,),
    "object_share": (-0.1, 1.0),
    "max_speed": (0, -1.0),
    "velocity_rate": (-0.1, 1.1),
    "position_noise": (-0.1,),
    "size_noise": (0, -0.1),
    "size_rate": (-0.1, 1.1),
    "learning_rate": (-0.1, 1.1),
    "occluder_margin": (0, -0.1),
    "max_covered": (-0.1, 1.1),
    "min_visible_share": (-0.1, 1.1),
    "likelihood_drop": (-0.1,),
    "lost_after": (-0.1,),
}

PRINTED: dict[str, Any] = {
    "histogram": "absolute",
    "likelihood": "linear",
    "contrast": 0,
    "measurement": 0,
    "floor": False,
    "edges": False,
}


def assert_sane(tracks: list[Track]) -> None:
    """Finite boxes with an area, scores in [0, 1], finite positions, positive definite covariances."""
    for track in tracks:
        assert np.isfinite(track.box).all()
        assert min(track.box.width, track.box.height) > 0
        assert 0 <= track.score <= 1
        assert np.isfinite(track.position).all()
        assert np.linalg.eigvalsh(track.covariance).min() > 0


def test_every_field_has_its_bad_values():
    """The table above names every field there is: a new one must be tried too."""
    assert set(REFUSED) == set(FIELDS)


@pytest.mark.parametrize(
    ("name", "value"), [(name, value) for name, values in REFUSED.items() for value in values]
)
def test_values_out_of_range_are_named(name, value):
    """A value out of range is a ValueError that begins with the field's name and shows the value."""
    with pytest.raises(ValueError, match=f"^{name}: expected"):
        DepthParticleTracker(**{name: value})


@pytest.mark.parametrize("name", FIELDS)
@pytest.mark.parametrize("value", [..., "many", float("nan"), b"1", [None, None]], ids=repr)
def test_values_of_another_kind_are_named(name, value):
    """Whatever isn't a value of the field's type, NaN included, is an error that begins with its name."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        DepthParticleTracker(**{name: value})


@pytest.mark.parametrize("name", [n for n, f in FIELDS.items() if not isinstance(f.default, bool)])
def test_true_is_no_number(name):
    """True is no number, and no pair or word."""
    with pytest.raises((TypeError, ValueError), match=f"^{name}: expected"):
        DepthParticleTracker(**{name: True})


@pytest.mark.parametrize("name", [n for n, f in FIELDS.items() if isinstance(f.default, float)])
def test_numbers_are_finite(name):
    """An infinite number is a ValueError that begins with the field's name, whatever its range."""
    for value in (float("inf"), -float("inf")):
        with pytest.raises(ValueError, match=f"^{name}: expected"):
            DepthParticleTracker(**{name: value})


@pytest.mark.parametrize(("near", "far"), [(3.0, 3.0), (3.0, 2.0), (8.0, 8.0)])
def test_near_is_under_far(near, far):
    """A range that is empty or upside down is refused by the name of its lower end."""
    with pytest.raises(ValueError, match=r"^near: expected under far, .*got"):
        DepthParticleTracker(near=near, far=far)


@pytest.mark.parametrize("values", [{"bandwidth": 9.0}, {"near": 7.95}], ids=str)
def test_a_bandwidth_above_the_range_is_named(values):
    """A kernel wider than the range of depths is refused where it is set, not at the first frame."""
    with pytest.raises(ValueError, match=r"^bandwidth: expected"):
        DepthParticleTracker(**values)


def test_unknown_names_are_errors():
    """A misspelt parameter is a TypeError that proposes the right one."""
    with pytest.raises(TypeError, match=r"^aspects: unknown parameter of .*did you mean aspect"):
        DepthParticleTracker(aspects=(1, 2))


def test_params_and_keywords_are_the_same(passing: DepthScene, pass_by):
    """Parameters by params=, by keywords and through create() give one track; both ways at once are an
    error.
    """
    assert pass_by(params=Params(particles=50)) == pass_by(particles=50)
    tracker = tricue.create("depth-particle", seed=3, particles=50, intrinsics=passing.intrinsics)
    assert isinstance(tracker, DepthParticleTracker)
    assert (tracker.seed, tracker.params) == (3, Params(particles=50))
    assert tracker.intrinsics == passing.intrinsics
    with pytest.raises(TypeError, match=r"^params: expected alone, got also particles"):
        DepthParticleTracker(params=Params(), particles=50)
    for other in ({}, tricue.ColorParticleTracker.Params()):
        with pytest.raises(TypeError, match=r"^params: expected DepthParticleParams, got "):
            DepthParticleTracker(params=other)


@pytest.mark.parametrize(
    ("seed", "error"), [(-1, ValueError), (None, TypeError), ("a", TypeError), (0.5, TypeError)]
)
def test_seeds_are_whole_numbers(seed, error):
    """A seed that is no whole number from 0 up is named: None, which would mean chance, too."""
    with pytest.raises(error, match=r"^seed: expected"):
        DepthParticleTracker(seed=seed)
    assert DepthParticleTracker(seed=np.int64(5)).seed == 5


@pytest.mark.parametrize("name", ["", "cuda", None, []])
def test_kernels_are_native_or_reference(name):
    """Another set of kernels is a ValueError that names both."""
    with pytest.raises(ValueError, match=r"^kernels: expected 'native' or 'reference'"):
        DepthParticleTracker(kernels=name)


@pytest.mark.parametrize(
    "params",
    [Params(), Params(**PRINTED), Params(particles=7, grid=(5, 9), aspect=(1.5, 4), near=0.1, far=20)],
)
def test_a_file_brings_them_back(params, tmp_path: Path):
    """Parameters written to TOML and read again are equal, pairs and truth values too."""
    params.to_toml(tmp_path / "params.toml")
    assert Params.from_toml(tmp_path / "params.toml") == params


def test_a_file_is_checked_as_keywords_are(tmp_path: Path):
    """Checks that need two parameters hold for files, and their errors name the file."""
    (tmp_path / "params.toml").write_text("near = 3\nfar = 2\n")
    with pytest.raises(ValueError, match=r"params.toml: near: expected under far"):
        Params.from_toml(tmp_path / "params.toml")


def test_every_parameter_says_its_unit_and_source():
    """Each field has a unit and a source, and its default passes its own check."""
    assert all(field.metadata["unit"] and field.metadata["source"] for field in FIELDS.values())
    assert Params(**{name: field.default for name, field in FIELDS.items()}) == Params()


@pytest.mark.parametrize("name", [*PRINTED, "all"])
def test_the_printed_form_runs(name, pass_by):
    """Each choice of the paper, and all of them at once, gives sane tracks that differ from the usual, and
    begin TRACKED.
    """
    tracks = pass_by(**(PRINTED if name == "all" else {name: PRINTED[name]}))
    assert_sane(tracks)
    assert tracks[0].status is Status.TRACKED
    assert tracks != pass_by()


@pytest.mark.parametrize("name", ["likelihood", "contrast", "measurement", "edges"])
def test_one_choice_of_the_paper_still_follows(name, walkers, follow):
    """With one of the paper's milder choices alone a walker is on the whole still followed: the choice is an
    ablation, not a fault.
    """
    scene = walkers[0]
    tracker = DepthParticleTracker(intrinsics=scene.intrinsics, **{name: PRINTED[name]})
    tracks = follow(tracker, scene.frames, scene.boxes[0])
    overlaps = [track.box.iou(box) for track, box in zip(tracks, scene.boxes, strict=True)]
    assert np.mean(overlaps) > 0.5


@pytest.mark.parametrize(
    "extreme",
    [
        {"particles": 2},
        {"grid": (2, 2)},
        {"grid": (64, 64)},
        {"near": 1e-9},
        {"far": 1e4},
        {"near": 2.4, "far": 5.0},
        {"resolution": 16},
        {"resolution": 10**9},
        {"rate": 1e-9},
        {"rate": 1e9},
        {"floor_clear": 0},
        {"floor_clear": 0.8},
        {"edge_gap": 0, "edge_slope": 0},
        {"edge_gap": 1e9, "edge_slope": 1e9},
        {"max_gap_share": 0, "gap_passes": 16},
        {"max_gap_share": 1, "gap_passes": 0},
        {"levels": 8, "bins": 4},
        {"levels": 4096, "bins": 4096},
        {"bandwidth": 1e-9},
        {"bandwidth": 1e-9, "prominence": 0, "levels": 4096},
        {"prominence": 1},
        {"min_area": 1e-9},
        {"min_area": 1e9},
        {"sharpness": 1e9, "contrast": 1e9, "measurement": 1e9},
        {"sharpness": 1e-9, "contrast": 0, "measurement": 0},
        {"histogram_reach": 1e-6},
        {"histogram_reach": 1e6},
        {"margin": 1e6},
        {"margin": 1.0001},
        {"object_share": 0},
        {"object_share": 0.999},
        {"max_speed": 1e9, "position_noise": 100.0, "velocity_rate": 1},
        {"max_speed": 1e-9, "position_noise": 0, "velocity_rate": 0},
        {"size_noise": 1e-9, "size_rate": 0},
        {"size_noise": 10.0, "size_rate": 1},
        {"learning_rate": 1},
        {"learning_rate": 0},
        {"learning_rate": 1, "histogram": "absolute"},
        {"occluder_margin": 1e-9, "max_covered": 0},
        {"occluder_margin": 1e9, "max_covered": 1},
        {"min_visible_share": 0, "likelihood_drop": 1e9},
        {"min_visible_share": 1, "likelihood_drop": 0},
        {"lost_after": 0},
        {"lost_after": 1e9},
    ],
    ids=str,
)
def test_extremes_give_finite_tracks(extreme, passing: DepthScene, pass_by):
    """Whatever the ranges allow gives sane tracks over 36 frames with an occlusion, and over ten without a
    measurement.
    """
    assert_sane(pass_by(**extreme))
    tracker = DepthParticleTracker(intrinsics=passing.intrinsics, **extreme)
    tracker.init(passing.frames[0], passing.boxes[0])
    nothing = tricue.Frame(depth=np.full_like(passing.frames[0].depth, np.nan))
    assert_sane([tracker.update(nothing) for _ in range(10)])
    assert_sane([tracker.update(tricue.Frame(depth=frame.depth)) for frame in passing.frames[:3]])
