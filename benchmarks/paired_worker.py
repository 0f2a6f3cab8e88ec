# SPDX-License-Identifier: MIT
"""Tracks a case of benchmarks/paired.py with the tricue on the path; prints each update's minimum time.

It uses only what all versions since 0.1.0 have.
"""

import json
import sys
from time import perf_counter

import numpy as np
import tricue

RUNS = 3

data = np.load(sys.argv[1])
about = json.loads(str(data["about"]))
channels = [name for name in ("color", "depth", "right") if name in data]
arrays = {name: data[name] for name in channels}
frames = [
    tricue.Frame(
        timestamp=None if np.isnan(time) else float(time), **{name: arrays[name][i] for name in channels}
    )
    for i, time in enumerate(data["times"])
]
lens = about["camera"]
camera = {}
if lens:
    *numbers, width, height = lens[:6]
    intrinsics = tricue.Intrinsics(*numbers, int(width), int(height))
    camera = {"rig": tricue.StereoRig(intrinsics, lens[6])} if lens[6:] else {"intrinsics": intrinsics}
runs = []
for _ in range(RUNS):
    tracker = tricue.create(about["tracker"], seed=0, **camera)
    tracker.init(frames[0], tuple(data["box"].tolist()))
    seconds = []
    for frame in frames[1:]:
        start = perf_counter()
        tracker.update(frame)
        seconds.append(perf_counter() - start)
    runs.append(seconds)
print(json.dumps(np.min(runs, axis=0).tolist()))
