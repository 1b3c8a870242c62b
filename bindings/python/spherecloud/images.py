"""Arrays of numpy as images of the library, without a copy."""
from __future__ import annotations

import ctypes
import dataclasses
import functools
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from ._calls import of_type, whole
from ._library import interface
from .enums import Format, Status
from .errors import Error

Array = npt.NDArray[typing.Any]

Kind = typing.Tuple[np.dtype[typing.Any], int]  # the type of an element, and channels, or 0 where there are two dimensions

_BYTE, _WORD, _FLOAT = np.dtype(np.uint8), np.dtype(np.uint16), np.dtype(np.float32)

# What an array is where nobody says more.
COLOR: dict[Kind, Format] = {(_BYTE, 0): Format.GRAY8, (_BYTE, 3): Format.RGB8, (_BYTE, 4): Format.RGBA8,
                             (_WORD, 0): Format.GRAY16}
AMPLITUDE: dict[Kind, Format] = {(_BYTE, 0): Format.GRAY8, (_WORD, 0): Format.GRAY16}


def depth_kinds(format: Format) -> dict[Kind, Format]:
    """Whatever an array of depth is, it is meant to be of the config's format."""
    return {(element, 0): format for element in (_WORD, _FLOAT, _BYTE)}


@dataclasses.dataclass(frozen=True)
class Image:
    """An array and the format of its pixels, where the array alone does not say it: Image(frame, Format.BGR8).

    Shapes: (height, width) for one value a pixel; (height, width, channels) for RGB8, BGR8, RGBA8, BGRA8, and with 2
    channels YUYV and UYVY; (height, bytes of a row) of uint8 for the formats that end in P, which need `width` too.
    uint8, uint16 for values of more than 8 bits, float32 for DEPTH_F32 and RANGE_F32.  Rows may lie apart, pixels not.
    """

    data: Array
    format: Format
    width: int | None = None


@functools.lru_cache(maxsize=None)
def layout(format: Format) -> tuple[np.dtype[typing.Any], int, int]:
    """(type of an element, channels or 0, bytes of a pixel or 0 where pixels share bytes)"""
    pixel: int = interface().sphc_format_bytes(format)
    if format.name.endswith("F32"):
        return _FLOAT, 0, pixel
    if pixel == 2 and format not in (Format.YUYV, Format.UYVY):
        return _WORD, 0, pixel
    return _BYTE, pixel if pixel > 1 else 0, pixel


_addressof: typing.Callable[[typing.Any], int] = ctypes.addressof
_lent: typing.Callable[[typing.Any], typing.Any] = ctypes.c_char.from_buffer


class Slot:
    """A struct of the library that images are put into, one after the other.  What lies as the one before is checked
    once."""

    def __init__(self, raw: _interface.sphc_image, kinds: dict[Kind, Format], what: str) -> None:
        self._raw, self._kinds, self._what = raw, kinds, what
        self._lies: object = None

    def put(self, image: Array | Image | None) -> None:
        """Where the image lies.  The caller keeps the array alive while the struct is used.  None: there is no image."""
        if image is None:
            self._raw.data = None
            return
        if isinstance(image, np.ndarray):
            array, format, width = image, None, None
        elif isinstance(image, Image) and isinstance(image.data, np.ndarray):
            array, format, width = image.data, image.format, image.width
        else:
            given = f"an Image of {type(image.data).__name__}" if isinstance(image, Image) else type(image).__name__
            raise TypeError(f"{self._what}: an image is a numpy array or an Image of one, not {given}; numpy.asarray may make one")
        lies = (array.__class__, array.shape, array.strides, array.dtype, format, width)
        if lies != self._lies:
            self._lies = None  # until it is described
            self._describe(array, self._format(array) if format is None else format, width)
            self._lies = lies
        try:  # a third of the time of the other way, but not for rows that lie apart, nor for what is read-only
            address = _addressof(_lent(array))
        except (TypeError, ValueError, BufferError):
            address = array.__array_interface__["data"][0]
        self._raw.data = address

    def _describe(self, array: Array, format: Format, width: int | None) -> None:
        """Size, stride and format of the struct, if the library can read such an array."""
        if isinstance(array, np.ma.MaskedArray):
            raise self._refuse("its mask would not be looked at; array.filled(0) is an image without what is masked")
        if not array.size:
            raise self._refuse(f"an array {array.shape} has no pixels; give the image of the camera")
        element, channels, pixel = layout(of_type(format, Format, "the format of an Image"))
        shape, strides, size = array.shape, array.strides, element.itemsize
        if array.dtype != element or len(shape) != (3 if channels else 2) or (channels and shape[2] != channels):
            wanted = f"(height, width{f', {channels}' if channels else ''}) of {element}"
            cure = "; depth_format=Format.DEPTH_F32 takes metres" if array.dtype == _FLOAT and not channels else ""
            raise self._refuse(f"{format.name} is {wanted}; the array is {shape} of {array.dtype}{cure}")
        row = shape[1] * (pixel or 1)
        if strides[-1] != size or (channels and strides[1] != pixel):
            raise self._refuse(f"the pixels of a row must lie side by side, and the strides are {strides}; "
                               "numpy.ascontiguousarray makes them so")
        if not row <= strides[0] < 2**32:
            raise self._refuse(f"rows must follow each other downwards, apart or side by side, and the strides are {strides}; "
                               "numpy.ascontiguousarray makes them so")
        if pixel and width not in (None, shape[1]):
            raise self._refuse(f"the array is {shape[1]} pixels wide, not {width}; give Image a width only of formats whose pixels "
                               "share bytes")
        if not pixel and (width is None or not 0 < interface().sphc_format_row_bytes(format, width) <= row):
            raise self._refuse(f"pixels of {format.name} share bytes, and {row} bytes a row do not say how many: give Image "
                               f"a width that fits them, not {width}")
        raw = self._raw
        raw.width, raw.height, raw.stride_bytes, raw.format = whole(width or shape[1], "width"), shape[0], strides[0], format

    def _format(self, array: Array) -> Format:
        found = self._kinds.get((array.dtype, array.shape[2] if array.ndim == 3 else 0))
        if found is None or array.ndim not in (2, 3):
            known = ", ".join(f"(height, width{f', {c}' if c else ''}) of {element}" for element, c in self._kinds)
            raise self._refuse(f"an array {array.shape} of {array.dtype} is none of {known}; convert it "
                               "(array.astype), or say its format: Image(array, format)")
        return found

    def _refuse(self, why: str) -> Error:
        return Error(Status.E_IMAGE, f"{self._what}: {why}")
