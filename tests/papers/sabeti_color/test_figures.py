# SPDX-License-Identifier: MIT
"""What the figures say of themselves."""

import numpy as np
import pytest
from tricue.papers.sabeti_color import figures
from tricue.papers.sabeti_color.curves import ColorCurve
from tricue.scenes import face_over_clutter

figure = pytest.importorskip("matplotlib.figure", reason="figures need matplotlib: pip install tricue[demo]")


@pytest.mark.parametrize(("runs", "said"), [(1, "frame (1 run per model)"), (2, "frame (2 runs per model)")])
def test_the_number_of_runs_is_told(runs, said):
    """In the singular for one."""
    scene = face_over_clutter(seed=0, frames=8)
    boxes, ones = np.array(scene.boxes, float), np.ones(8)
    curves = [
        ColorCurve("m", "s", seed, overlaps=ones, errors=ones, boxes=boxes, visible=ones, steps=ones)
        for seed in range(runs)
    ]
    drawn = figure.Figure()
    figures.error_curves(drawn, curves, {"s": scene})
    assert said in {text.get_text() for text in drawn.findobj(lambda each: hasattr(each, "get_text"))}
