"""What a colour image shows, between the two halves of a frame."""
from __future__ import annotations

import ctypes
import dataclasses
import types
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from ._answers import KEYPOINT
from ._calls import Owned, SharedTurn, aligned, check, closed, whole
from ._library import interface
from .enums import Format, Status
from .errors import Error
from .frames import Frame, FrameStruct


@dataclasses.dataclass
class FeatureArrays:
    """Keypoints, the strongest response first, and what describes each.

    `keypoints`: (count,) of KEYPOINT, in pixels and radians.  `descriptors`: (count, 128) of uint8, as docs/features.md
    says.  `cameras`: (count,) of uint8, 0 the colour camera, i the further camera i - 1; None: all of the colour camera.
    `extractor`: the id of what described them; extractor_id() is the library's.
    """

    keypoints: npt.NDArray[np.void]
    descriptors: npt.NDArray[np.uint8]
    cameras: npt.NDArray[np.uint8] | None
    extractor: int


class Features:
    """Localizer.make_features() makes one.  Several localizers may locate the same features at the same time; other
    calls wait for their turn."""

    def __init__(self, config: _interface.sphc_localizer_config) -> None:
        need, message = _interface.sphc_memory(), _interface.sphc_message()
        check(interface().sphc_features_memory(config, need, message), message)
        memory = aligned(need.state_bytes, need.alignment)
        made = Owned(interface().sphc_features_fini, memory)
        check(interface().sphc_features_init(memory.ctypes.data, memory.size, config, ctypes.byref(made.pointer), message),
              message)
        self._owned: Owned | None = made
        self.turn = SharedTurn("features")

    def owned(self) -> Owned:
        if self._owned is None:
            raise closed("features", "are")
        return self._owned

    def check(self, status: int) -> None:
        """Raises a failure with the features' own message; inside a turn."""
        if status < 0:
            check(status, interface().sphc_features_message(self.owned().pointer).decode(errors="replace"))

    def set(self, frame: Frame, arrays: FeatureArrays) -> None:
        """Puts in what other hardware has found.  Of the frame `color` and its time are read, and all is copied.

        Errors: E_ARGUMENT, a keypoint is not finite, beyond the limits or stronger than the one before it; E_CAPACITY,
        more than max_keypoints; E_MAP_EXTRACTOR; E_IMAGE.  The features then stay what they were.
        """
        keypoints = _rows(arrays.keypoints, (), KEYPOINT, "keypoints")
        described = (_interface.SPHC_DESCRIPTOR_BYTES,)
        descriptors = _rows(arrays.descriptors, described, np.dtype(np.uint8), "descriptors")
        cameras = None if arrays.cameras is None else _rows(arrays.cameras, (), np.dtype(np.uint8), "cameras")
        if len(descriptors) != len(keypoints) or (cameras is not None and len(cameras) != len(keypoints)):
            raise Error(Status.E_ARGUMENT, f"{len(keypoints)} keypoints have {len(descriptors)} descriptors; every keypoint "
                                           "needs a descriptor, and a camera where cameras are given")
        raw = _interface.sphc_features_arrays(
            ctypes.sizeof(_interface.sphc_features_arrays), whole(arrays.extractor, "extractor"), len(keypoints), KEYPOINT.itemsize,
            _interface.SPHC_DESCRIPTOR_BYTES, 0, keypoints.ctypes.data, descriptors.ctypes.data,
            cameras.ctypes.data if cameras is not None else None)
        slot = FrameStruct(Format.DEPTH16)
        alive = slot.fill(dataclasses.replace(frame, depth=None))
        with self.turn.writing():
            self.check(interface().sphc_features_set(self.owned().pointer, slot.raw, raw))
        del alive

    def arrays(self) -> FeatureArrays:
        """A copy of what they are.  Error(E_STATE): they are of no frame yet."""
        raw = _interface.sphc_features_arrays(struct_size=ctypes.sizeof(_interface.sphc_features_arrays))
        with self.turn.reading():
            status = interface().sphc_features_get(self.owned().pointer, raw)
            check(status, "the features are of no frame yet; extract or set them first")
            return FeatureArrays(
                _copied(raw.keypoints, raw.count, raw.keypoint_stride_bytes, KEYPOINT, ()),
                _copied(raw.descriptors, raw.count, raw.descriptor_stride_bytes, np.dtype(np.uint8), (128,)),
                _copied(raw.cameras, raw.count, 1, np.dtype(np.uint8), ()) if raw.cameras else None, raw.extractor)

    def close(self) -> None:
        """Ends the features, after the call that may be running.  May be called twice."""
        with self.turn.writing():
            if self._owned is not None:
                self._owned.end()
            self._owned = None

    def __enter__(self) -> Features:
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None,
                 trace: types.TracebackType | None) -> None:
        self.close()


def _rows(array: npt.NDArray[typing.Any], row: tuple[int, ...], kind: np.dtype[typing.Any],
          what: str) -> npt.NDArray[typing.Any]:
    """The array, packed; a copy only where its rows do not lie one behind the other."""
    if not isinstance(array, np.ndarray) or array.dtype != kind or array.shape[1:] != row or array.ndim != 1 + len(row):
        given = f"{array.shape} of {array.dtype}" if isinstance(array, np.ndarray) else type(array).__name__
        raise Error(Status.E_ARGUMENT, f"{what}: (count{''.join(f', {n}' for n in row)}) of {kind} is needed, not {given}")
    return np.require(array, requirements=["C", "A"])


def _copied(address: int | None, count: int, stride: int, kind: np.dtype[typing.Any],
            row: tuple[int, ...]) -> npt.NDArray[typing.Any]:
    if not count or not address:
        return np.empty((0, *row), kind)
    length = stride * (count - 1) + kind.itemsize * int(np.prod(row, dtype=np.int64))
    lent = memoryview((ctypes.c_uint8 * length).from_address(address))
    inner = (kind.itemsize,) if row else ()
    return np.ndarray((count, *row), kind, lent, strides=(stride, *inner)).copy()
