# SPDX-License-Identifier: MIT
"""Rows for docs/benchmarks.md of two trackers that run at once, in threads and in processes."""

import multiprocessing
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from time import perf_counter

import numpy as np

from benchmarks.tracker_rows import ours, scene

PAIR_ROUNDS = 30


def pair_rows() -> Iterator[str]:
    """A line per number of particles: two trackers at once, in threads and in processes, and one alone."""
    scene()  # cached before processes are forked
    context = multiprocessing.get_context("fork")
    with (
        ThreadPoolExecutor(1) as alone,
        ThreadPoolExecutor(2) as threads,
        ProcessPoolExecutor(2, context) as processes,
    ):
        for particles in (100, 300, 1000):
            pools = ((alone, 1), (threads, 2), (processes, 2))
            rounds = [[rate_in(pool, count, particles) for pool, count in pools] for _ in range(PAIR_ROUNDS)]
            one, *two = np.max(rounds, axis=0)
            ratios = [f"{each:,.0f} | {each / one:.2f}" for each in two]
            yield f"| {particles} | {one:,.0f} | " + " | ".join(ratios) + " |"


def rate_in(pool: Executor, count: int, particles: int) -> float:
    """Updates/s of so many trackers, each in a worker of the pool."""
    start = perf_counter()
    updates = sum(pool.map(follow, range(count), count * [particles]))
    return updates / (perf_counter() - start)


def follow(seed: int, particles: int) -> int:
    """Track three times through the scene; returns the number of updates."""
    tracker = ours(particles=particles, seed=seed)()
    tracker.init(scene().frames[0], scene().boxes[0])
    for frame in 3 * scene().frames:
        tracker.update(frame)
    return 3 * len(scene().frames)
