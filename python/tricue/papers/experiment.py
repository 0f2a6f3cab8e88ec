# SPDX-License-Identifier: MIT
"""An experiment: models, scenes from many seeds, and functions that measure and write their curves."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, NamedTuple, TypeVar

from tricue.draw import figures
from tricue.evaluation.one_pass import AnyTracker

S = TypeVar("S")  # a scene
C = TypeVar("C")  # a curve: what one model did in one scene

Maker = Callable[..., AnyTracker]
"""Makes a tracker; called with ``seed=``, and with ``intrinsics=`` or ``rig=`` if the scene has one."""

Models = Mapping[str, Maker]
"""The function that makes each model's tracker."""

Scenes = Mapping[str, Callable[..., S]]
"""The function that makes each scene, called with ``seed=``."""


class Case(NamedTuple):
    """One run: the names of the model and of the scene, and the seed of both."""

    model: str
    scene: str
    seed: int


@dataclass(frozen=True, slots=True)
class Report:
    """The summary of an experiment, and its files."""

    summary: str
    figure: Path
    table: Path


@dataclass(frozen=True)  # slots and type parameters don't work together in Python 3.11
class Experiment(Generic[S, C]):
    """Models, scenes, and functions that measure a run, summarize curves, write and draw them."""

    models: Models
    scenes: Scenes[S]
    measure: Callable[[Case, Maker, S], C]
    """Runs one model in one scene; a module-level function, so that another process can import it."""
    summarize: Callable[[Sequence[C]], str]
    write_csv: Callable[[Path, Iterable[C]], None]
    draw: figures.Draw[C, S]
    max_seeds: Mapping[str, int] = field(default_factory=dict)
    """Limits on the number of seeds for slow scenes."""
