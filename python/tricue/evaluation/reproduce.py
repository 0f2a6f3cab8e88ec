# SPDX-License-Identifier: MIT
"""The papers' experiments, run again: error curves over many seeds, as a figure, a CSV and a table."""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

import tricue
from tricue.evaluation import figures, metrics
from tricue.evaluation.curves import Curve, summarize, write_csv
from tricue.evaluation.one_pass import Contender
from tricue.evaluation.one_pass import run as run_once
from tricue.scenes import BACKGROUNDS, Scene, face_over_clutter, light_change

Models = Mapping[str, Callable[..., Contender]]
"""How to make each model's tracker, called with ``seed=``."""

Scenes = Mapping[str, Callable[..., Scene]]
"""How to make each scene, called with ``seed=``."""

Task = tuple[str, Callable[..., Scene], int]
"""A scene's name, how to make it, and the seed."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """Which models run on which scenes, and how the figure is drawn."""

    models: Models
    scenes: Scenes
    draw: figures.Draw


@dataclass(frozen=True, slots=True)
class Report:
    """What an experiment found, and where it is written."""

    summary: str
    figure: Path
    table: Path


def _particles(observation: str, **parameters: Any) -> Callable[..., Contender]:
    return partial(tricue.create, "color-particle", observation=observation, particles=100, **parameters)


def _alone(observation: str, likelihood: str = "exponential") -> Callable[..., Contender]:
    """An observation model without the color contrast that the tracker adds to each by default."""
    return _particles(observation, likelihood=likelihood, color_weight=0.0)


DEFAULT = {"spatial ranks, color (default)": _particles("rank-spatial")}

EXPERIMENTS = {
    "sabeti-fig1": Experiment(
        models={
            **DEFAULT,
            "spatial ranks": _alone("rank-spatial"),
            "rank sections": _alone("rank-sections"),
            "rank sections, linear (18)": _alone("rank-sections", "linear"),
            "16-bin histogram": _alone("histogram"),
            "look-up table": _alone("lookup"),
            "Gaussian": _alone("gaussian"),
            "region": _alone("region"),
        },
        scenes={name: partial(face_over_clutter, background=name) for name in BACKGROUNDS},
        draw=figures.error_curves,
    ),
    "sabeti-fig2": Experiment(
        models={
            **DEFAULT,
            "spatial ranks": _alone("rank-spatial"),
            "16-bin histogram": _alone("histogram"),
            "rank sections, linear (18)": _alone("rank-sections", "linear"),
        },
        scenes={"light change": light_change},
        draw=figures.overlap_curves,
    ),
}


def run(
    name: str,
    seeds: int = 20,
    output: Path = Path(),
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
    models: Models | None = None,
) -> Report:
    """Run an experiment and write ``output/NAME.png`` and ``output/NAME.csv``, a line per frame.

    Every model runs on every scene from ``seeds`` seeds. ``progress(done, total)`` is called after each
    scene, ``jobs`` scenes run at once. ``models`` takes the place of the paper's. ValueError for an unknown
    name, ImportError that names the extra where scikit-image or matplotlib is missing.
    """
    if name not in EXPERIMENTS:
        raise ValueError(f"experiment: expected one of {', '.join(EXPERIMENTS)}, got {name!r}")
    if seeds < 1 or jobs < 1:
        raise ValueError(f"seeds, jobs: expected 1 or more, got {seeds}, {jobs}")
    experiment = EXPERIMENTS[name]
    figures.require()
    curves = list(_all_curves(models or experiment.models, experiment.scenes, seeds, jobs, progress))
    output.mkdir(parents=True, exist_ok=True)
    report = Report(summarize(curves), output / f"{name}.png", output / f"{name}.csv")
    write_csv(report.table, curves)
    scenes = {scene: make(seed=0) for scene, make in experiment.scenes.items()}
    figures.save(experiment.draw, curves, scenes, report.figure)
    return report


def _all_curves(
    models: Models,
    scenes: Scenes,
    seeds: int,
    jobs: int,
    progress: Callable[[int, int], None] | None,
) -> Iterator[Curve]:
    tasks = [(scene, make, seed) for seed in range(seeds) for scene, make in scenes.items()]
    for done, curves in enumerate(_mapped(partial(_curves, models), tasks, jobs), start=1):
        if progress:
            progress(done, len(tasks))
        yield from curves


def _mapped(work: Callable[[Task], list[Curve]], tasks: list[Task], jobs: int) -> Iterator[list[Curve]]:
    if jobs == 1:
        yield from map(work, tasks)
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from pool.map(work, tasks)


def _curves(models: Models, task: Task) -> list[Curve]:
    """Every model on one scene, which is made once."""
    name, make, seed = task
    scene = make(seed=seed)
    truth = np.array(scene.boxes)
    curves = []
    for model, tracker in models.items():
        boxes = run_once(tracker(seed=seed), scene.frames, scene.boxes[0]).boxes
        errors, overlaps = metrics.center_errors(boxes, truth), metrics.overlaps(boxes, truth)
        curves.append(Curve(model, name, seed, errors, overlaps, boxes))
    return curves
