# SPDX-License-Identifier: MIT
"""Reproduce the papers' experiments: curves over many seeds, as a figure, a CSV and a table."""

from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from tricue.draw import figures
from tricue.draw.writable import check_writable, naming
from tricue.evaluation.interrupts import end_when_interrupted, interrupts_later
from tricue.papers.experiment import C, Case, Experiment, Maker, Models, Report, S
from tricue.papers.moreno import experiments as moreno
from tricue.papers.okada import experiments as okada
from tricue.papers.sabeti_color import experiments as sabeti_color
from tricue.papers.sabeti_color import skin_threshold
from tricue.papers.sabeti_dark import experiments as sabeti_dark
from tricue.papers.sabeti_depth import experiments as sabeti_depth

SceneTask = tuple[str, Callable[..., S], int]
"""A scene's name, the function that makes it, and the seed."""

EXPERIMENTS: dict[str, Experiment[Any, Any]] = {
    **sabeti_color.EXPERIMENTS,
    **sabeti_depth.EXPERIMENTS,
    **sabeti_dark.EXPERIMENTS,
    **moreno.EXPERIMENTS,
    **okada.EXPERIMENTS,
}
NAMES = (*EXPERIMENTS, skin_threshold.NAME)


def run(
    name: str,
    seeds: int = 20,
    output: Path = Path(),
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
    models: Models | None = None,
    data: Path | None = None,
    rate: float | None = None,
) -> Report:
    """Run an experiment and write ``output/NAME.png`` and ``output/NAME.csv``, a line per frame.

    Every model runs on every scene from ``seeds`` seeds, on slow scenes from fewer. ``jobs`` scenes run at
    once, and ``progress(done, total)`` is called after each. ``models`` replaces the experiment's. ``data``,
    a folder of images, and ``rate``, a false-positive rate, are for "sabeti-roc" alone
    (:mod:`tricue.papers.sabeti_color.skin_threshold`). ValueError for an unknown name, OSError for files that
    can't be written, ImportError that says what to install where scikit-image or matplotlib is missing.
    """
    if name not in NAMES:
        raise ValueError(f"experiment: expected one of {', '.join(NAMES)}, got {name!r}")
    if seeds < 1 or jobs < 1:
        raise ValueError(f"seeds, jobs: expected 1 or more, got {seeds}, {jobs}")
    if name == skin_threshold.NAME:
        chosen = skin_threshold.MAX_FALSE_POSITIVES if rate is None else rate
        return skin_threshold.run(output, data, chosen, seeds, progress)
    for argument, value in (("data", data), ("rate", rate)):
        if value is not None:
            raise ValueError(
                f"{argument}: expected none, as only {skin_threshold.NAME} takes it, got {value}"
            )
    experiment = EXPERIMENTS[name]
    figures.require()
    for suffix in (".png", ".csv"):  # check now, because the curves take hours
        check_writable(output / f"{name}{suffix}")
    output.mkdir(parents=True, exist_ok=True)
    curves = list(_all_curves(experiment, models or experiment.models, seeds, jobs, progress))
    report = Report(experiment.summarize(curves), output / f"{name}.png", output / f"{name}.csv")
    with naming(report.table):
        experiment.write_csv(report.table, curves)
    scenes = {scene: make(seed=0) for scene, make in experiment.scenes.items()}
    figures.save(experiment.draw, curves, scenes, report.figure)
    return report


def _all_curves(
    experiment: Experiment[S, C],
    models: Models,
    seeds: int,
    jobs: int,
    progress: Callable[[int, int], None] | None,
) -> Iterator[C]:
    tasks = [
        (scene, make, seed)
        for seed in range(seeds)
        for scene, make in experiment.scenes.items()
        if seed < experiment.max_seeds.get(scene, seeds)
    ]
    work = partial(_curves, experiment.measure, models)
    for done, curves in enumerate(_mapped(work, tasks, jobs), start=1):
        if progress:
            progress(done, len(tasks))
        yield from curves


def _mapped(
    work: Callable[[SceneTask[S]], list[C]], tasks: list[SceneTask[S]], jobs: int
) -> Iterator[list[C]]:
    if jobs == 1:
        yield from map(work, tasks)
        return
    pool = ProcessPoolExecutor(min(jobs, len(tasks)), get_context("spawn"), end_when_interrupted)
    try:
        with interrupts_later():  # until they have imported everything
            running = [pool.submit(work, task) for task in tasks]
        yield from (each.result() for each in running)
    finally:
        pool.shutdown(cancel_futures=True)


def _curves(
    measure: Callable[[Case, Maker, S], C], models: Mapping[str, Maker], task: SceneTask[S]
) -> list[C]:
    """Measure every model on one scene, which is made once."""
    name, make, seed = task
    scene = make(seed=seed)
    return [measure(Case(model, name, seed), tracker, scene) for model, tracker in models.items()]
