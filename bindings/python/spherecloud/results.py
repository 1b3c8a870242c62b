"""What the localizer answers."""
from __future__ import annotations

import ctypes
import typing

from . import _interface
from ._answer import DepthBias
from ._answers import HypothesisFields, ParameterRangeFields, PredictionFields, ResultFields
from ._calls import real, whole
from ._library import interface
from .enums import Outcome, Parameter, Status
from .errors import Error
from .poses import Rigid

__all__ = ["DepthBias", "Hypothesis", "MemoryPiece", "ParameterRange", "Prediction", "Result", "parameter_range"]


_LOCALIZED = int(Outcome.LOCALIZED)  # as a number, which is found faster than a member of an enum


class Result(ResultFields):
    """Where the colour camera was in a frame, or why that is not known.

    Fields are read when they are asked for.  Arrays are views of the result's own memory.
    """

    __slots__ = ()

    @property
    def localized(self) -> bool:
        """There is a pose."""
        return self._raw.outcome == _LOCALIZED

    @property
    def pose(self) -> Rigid | None:
        """camera_from_map; None where there is no pose."""
        return self.camera_from_map if self.localized else None

    def confidence_within(self, translation_m: float, rotation_rad: float) -> float:
        """Probability that the camera is within so many metres and radians of the pose; 0 where there is no pose.
        docs/confidence.md."""
        bounds = real(translation_m, "translation_m"), real(rotation_rad, "rotation_rad")
        made: float = interface().sphc_localizer_result_confidence(self._raw, *bounds)
        return made


class Prediction(PredictionFields):
    """Where the colour camera is at a time of the caller's."""

    __slots__ = ()

    @property
    def known(self) -> bool:
        """There is a pose."""
        return self._raw.map_id != _interface.SPHC_MAP_NONE

    @property
    def pose(self) -> Rigid | None:
        """camera_from_map; None where nothing is known."""
        return self.camera_from_map if self.known else None


class Hypothesis(HypothesisFields):
    """A pose that the last frame may have."""

    __slots__ = ()


class ParameterRange(ParameterRangeFields):
    """What a parameter is where it was not set, and may be set to."""

    __slots__ = ()


class MemoryPiece(typing.NamedTuple):
    """A named piece of a localizer's memory; `scratch` is used only inside a call."""

    name: str
    bytes: int
    scratch: bool


def parameter_range(parameter: Parameter) -> ParameterRange:
    """Error(E_UNSUPPORTED): the library does not know the parameter."""
    raw = _interface.sphc_localizer_parameter_range()
    raw.struct_size = ctypes.sizeof(raw)
    number = whole(parameter, "parameter", signed=True)
    status = Status(interface().sphc_localizer_get_parameter_range(number, raw))
    if status < 0:
        raise Error(status, f"the library has no parameter {number}")
    return ParameterRange(raw)
