# SPDX-License-Identifier: MIT
"""The base class of the package's trackers: construction, copying and pickling."""

import difflib
import inspect
from abc import ABC, abstractmethod
from dataclasses import fields, replace
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from tricue import kernels as kernel_sets
from tricue.camera.frame import Frame, FrameLike
from tricue.camera.rig import Intrinsics, StereoRig
from tricue.track.base import validation
from tricue.track.base.params import Params
from tricue.track.base.track import Track
from tricue.track.base.traits import Traits

P = TypeVar("P", bound=Params)
S = TypeVar("S")
Scalar = TypeVar("Scalar", bound=np.generic)
CAMERA_KEYWORDS = ("intrinsics", "rig")


class TrackerBase(ABC, Generic[P, S]):
    """The parameters, the kernels and the state of a tracker.

    The state is immutable: ``init`` and ``update`` replace it as their last step. So an error or Ctrl-C
    leaves the tracker unchanged, and copies are independent.
    """

    traits: ClassVar[Traits]
    Params: ClassVar[type[Any]]
    rig: StereoRig | None = None
    intrinsics: Intrinsics | None = None

    def __init__(
        self, params: P | None, seed: int, kernels: kernel_sets.Name, values: dict[str, Any]
    ) -> None:
        self._check_names(values)
        self.params: P = validation.parameters(self.Params, params, values)
        self.seed = validation.seed(seed)
        self.kernels = kernels
        self._state: S | None = None
        self._derive()

    def _keep(self, state: S, frame: FrameLike) -> Track:
        """The track of a state, which replaces the previous state unless making the track fails.

        The track gets the frame's pose, or else the camera's.
        """
        track = self._track(state)
        pose = frame.pose if isinstance(frame, Frame) else None
        if pose is None and (camera := self.rig or self.intrinsics) is not None:
            pose = camera.pose
        if pose is not None:
            track = replace(track, pose=pose)
        self._state = state
        return track

    @classmethod
    def _check_names(cls, values: dict[str, Any]) -> None:
        """TypeError for a keyword that is neither an argument of the constructor nor a parameter.

        Former names of parameters are accepted.
        """
        parameters = fields(cls.Params)
        known = {name for f in parameters for name in (f.name, f.metadata.get("was"))}
        for name in values:
            if name not in known:
                hint = cls._hint(name, [f.name for f in parameters])
                raise TypeError(f"{name}: unknown parameter of {cls.Params.__name__}; {hint}")

    @classmethod
    def _hint(cls, name: str, parameters: list[str]) -> str:
        """A hint: what to give instead of an unknown keyword."""
        if name in CAMERA_KEYWORDS:
            taken = " or ".join(f"{each}=" for each in CAMERA_KEYWORDS if each in cls.traits.camera)
            return f"{cls.__name__} takes {taken or 'no camera'}"
        signature = inspect.signature(cls).parameters.values()
        own = [each.name for each in signature if each.kind is inspect.Parameter.KEYWORD_ONLY]
        near = difflib.get_close_matches(name, own + parameters, n=3)
        if near:
            return f"did you mean {' or '.join(near)}?"
        table = f"{cls.__name__}.Params.describe()"
        return f"expected one of {', '.join(own)}, or a parameter, which {table} lists"

    @abstractmethod
    def _track(self, state: S) -> Track:
        """The track of a state."""

    def _derive(self) -> None:
        """Create the derived attributes, named in ``_derived``, which are neither copied nor pickled."""
        self._k = kernel_sets.load(self.kernels)

    _derived: ClassVar[tuple[str, ...]] = ("_k",)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name not in self._derived}

    def __setstate__(self, values: dict[str, Any]) -> None:
        self.__dict__.update(values)
        self._derive()


def read_only(array: NDArray[Scalar]) -> NDArray[Scalar]:
    """A read-only view of an array, for arrays of the immutable state."""
    view: NDArray[Scalar] = array.view()
    view.flags.writeable = False
    return view
