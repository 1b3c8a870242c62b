"""What all answers of the library share."""
from __future__ import annotations

import ctypes
import dataclasses
import typing

import numpy as np
import numpy.typing as npt

from . import _interface


def floats(array: ctypes.Array[ctypes.c_double]) -> npt.NDArray[np.float64]:
    """A view of an array of the library's struct."""
    return np.frombuffer(memoryview(array), np.float64)


class Answer:
    """A struct of the library, whose parts are made into objects of Python when they are asked for."""

    __slots__ = ("_raw",)
    FIELDS: tuple[str, ...] = ()
    _raw: ctypes.Structure

    def __init__(self, raw: ctypes.Structure) -> None:
        self._raw = raw

    def as_dict(self) -> dict[str, typing.Any]:
        """All fields by name."""
        return {name: getattr(self, name) for name in self.FIELDS}

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self.as_dict().items())})"

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and bytes(self._raw) == bytes(other._raw) if isinstance(other, Answer) else False

    __hash__ = None  # type: ignore[assignment]


@dataclasses.dataclass(frozen=True)
class DepthBias:
    """How a depth sensor is off: true z = z + offset_m + slope (z - mid_m); its noise is noise_scale times that of
    the config.  Sigmas are 1 sigma; correlation is that of offset and slope.  docs/localizer.md."""

    mid_m: float
    offset_m: float
    slope: float
    offset_sigma_m: float
    slope_sigma: float
    correlation: float
    noise_scale: float

    @staticmethod
    def of(raw: _interface.sphc_depth_bias) -> DepthBias:
        return DepthBias(*(getattr(raw, field.name) for field in dataclasses.fields(DepthBias)))

    def raw(self) -> _interface.sphc_depth_bias:
        return _interface.sphc_depth_bias(*dataclasses.astuple(self))
