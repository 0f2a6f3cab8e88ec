# SPDX-License-Identifier: MIT
"""The attributes: what is measured in each frame, in which unit, and from which value a frame has them.

OTB is Wu, Lim, Yang 2013 and 2015; LaSOT is Fan et al. 2019; UAV123 is Mueller, Smith, Ghanem 2016. Their
definitions are used where they have a number. Where they rely on an annotator's judgment, the measurement is
ours; docs/evaluation.md says how well it agrees with the published labels.
"""

from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

ANY, FEW, MOST = 0.0, 0.05, 0.5
"""Shares of the frames above which a sequence has an attribute: any frame, as in OTB; more than a few, since
measurements from images are sometimes wrong; or most.
"""

Source = Literal["truth", "images", "depth"]


class Attribute(NamedTuple):
    """key: its name in tables. title: its name in reports. meaning: of a frame's value. limit, way: a frame
    has the attribute if its value is "above" or "below" the limit, or "outside" [1/limit, limit]. needs: what
    it is measured from. share: a sequence has it if more than this share of the frames in which it is known
    has it. source: of the definition.
    """

    key: str
    title: str
    meaning: str
    unit: str
    way: Literal["above", "below", "outside"]
    limit: float
    needs: Source
    share: float
    source: str

    def flags(self, values: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which frames have it, (M,) from (M,); False where unknown."""
        if self.way == "below":
            return np.asarray(values < self.limit)
        if self.way == "above":
            return np.asarray(values > self.limit)
        return np.asarray((values > self.limit) | (values < 1 / self.limit))

    @property
    def rule(self) -> str:
        """The condition as text."""
        unit = f" {self.unit}" if self.unit else ""
        if self.way == "outside":
            return f"outside 1/{self.limit:g} to {self.limit:g}{unit}"
        return f"{self.way} {self.limit:g}{unit}"


ATTRIBUTES = (
    Attribute(
        "absent",
        "absent",
        "1 where the truth says that the target isn't visible: hidden as a whole, or out of view",
        "",
        "above",
        0.5,
        "truth",
        ANY,
        "LaSOT's full occlusion and out of view, which a true box can't tell apart",
    ),
    Attribute(
        "occlusion",
        "occlusion",
        "share of the box's inner half that is nearer than the target by a tenth of its distance or more;"
        " the target's distance is the median of the same part over the five frames before and after",
        "",
        "above",
        0.25,
        "depth",
        FEW,
        "ours; OTB's and LaSOT's are annotated",
    ),
    Attribute(
        "scale",
        "scale change",
        "area of the true box, relative to the first one's",
        "times",
        "outside",
        2.0,
        "truth",
        ANY,
        "OTB, LaSOT",
    ),
    Attribute(
        "aspect",
        "aspect change",
        "width over height of the true box, relative to the first one's",
        "times",
        "outside",
        2.0,
        "truth",
        ANY,
        "UAV123, LaSOT",
    ),
    Attribute(
        "fast",
        "fast motion",
        "distance of the true box's center from that in the frame before",
        "px",
        "above",
        20.0,
        "truth",
        ANY,
        "OTB, UAV123",
    ),
    Attribute(
        "blur",
        "blur",
        "variance of the Laplacian in the box over the variance of gray there, relative to the 90th"
        " percentile over twelve frames before and after",
        "times",
        "below",
        0.4,
        "images",
        FEW,
        "ours, after Pech-Pacheco et al. 2000; OTB's and LaSOT's are annotated",
    ),
    Attribute(
        "light",
        "light change",
        "mean gray value relative to the first frame's, in the box or within twice its size: the one that has"
        " changed less, 1 if one rose and the other fell",
        "times",
        "outside",
        1.3,
        "images",
        FEW,
        "ours; OTB's and LaSOT's are annotated",
    ),
    Attribute(
        "low_rate",
        "low rate",
        "frames a second, where files say it",
        "1/s",
        "below",
        15.5,
        "truth",
        ANY,
        "ours",
    ),
    Attribute(
        "low_resolution",
        "low resolution",
        "area of the true box",
        "px²",
        "below",
        400.0,
        "truth",
        ANY,
        "OTB, UAV123; LaSOT has 1000",
    ),
    Attribute(
        "out_of_view",
        "out of view",
        "share of the true box that is outside the image; 1 if it ends at the image's edge where true boxes"
        " are clipped",
        "",
        "above",
        0.05,
        "truth",
        ANY,
        "OTB's definition, which is annotated there",
    ),
    Attribute(
        "look_alike",
        "look-alike",
        "likeness of the place most like the box, within 2.5 sizes and without overlap: the lower of the"
        " correlation of the pixels and the intersection of the color histograms",
        "",
        "above",
        0.55,
        "images",
        FEW,
        "ours; UAV123's similar object is annotated",
    ),
    Attribute(
        "clutter",
        "background clutter",
        "Bhattacharyya coefficient of the colors in the box and around it, within twice its size",
        "",
        "above",
        0.8,
        "images",
        MOST,
        "ours; OTB's and LaSOT's are annotated",
    ),
    Attribute(
        "camera",
        "camera motion",
        "shift of the whole image since the frame before, by phase correlation, relative to its diagonal",
        "",
        "above",
        0.01,
        "images",
        FEW,
        "ours; LaSOT's and UAV123's are annotated",
    ),
)
BY_KEY = {each.key: each for each in ATTRIBUTES}
