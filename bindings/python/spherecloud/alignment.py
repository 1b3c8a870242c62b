"""A whole depth image, seen from the colour camera."""
from __future__ import annotations

import ctypes
import dataclasses
import threading
import types

import numpy as np
import numpy.typing as npt

from . import _interface
from ._calls import Owned, aligned, check, closed, configure, of_type
from ._library import interface
from .cameras import Rig
from .enums import Format, Status
from .errors import Error
from .images import Array, Image, Slot, depth_kinds

_PLANES = (("depth", np.dtype(np.uint16)), ("mask", np.dtype(np.uint8)), ("confidence", np.dtype(np.uint8)))


@dataclasses.dataclass
class Aligned:
    """Images of the colour camera's size.  One that is None is not made.

    `depth`: uint16 z in the colour camera's frame, in units of aligned_unit_m; 0: none.  `mask`: uint8 values of
    AlignedPixel.  `confidence`: uint8, 255 exact, 128 an error of 1 %, 0 no depth.
    """

    depth: npt.NDArray[np.uint16] | None = None
    mask: npt.NDArray[np.uint8] | None = None
    confidence: npt.NDArray[np.uint8] | None = None


class Aligner:
    """Aligns depth images.  One call at a time: others wait.  Parameters that are None have the library's defaults."""

    def __init__(self, rig: Rig, *, depth_format: Format = Format.DEPTH16, depth_min_m: float | None = None,
                 depth_max_m: float | None = None, depth_sigma_m: float | None = None,
                 depth_sigma_per_m2: float | None = None, aligned_unit_m: float = 0.0) -> None:
        """Takes its memory once, here.  `aligned_unit_m`: metres per unit of what comes out; 0: that of the rig.
        Error(E_ARGUMENT): the rig or a parameter cannot be used; the message names it."""
        config, message = _interface.sphc_aligner_config(), _interface.sphc_message()
        check(interface().sphc_aligner_config_init(config, ctypes.sizeof(config)), "sphc_aligner_config_init")
        given = {"depth_min_m": depth_min_m, "depth_max_m": depth_max_m, "depth_sigma_m": depth_sigma_m,
                 "depth_sigma_per_m2": depth_sigma_per_m2}
        configure(config, given)
        config.rig, config.aligned_unit_m = of_type(rig, Rig, "rig").raw(), aligned_unit_m
        config.depth_format = of_type(depth_format, Format, "depth_format")
        need = _interface.sphc_memory()
        check(interface().sphc_aligner_memory(config, need, message), message)
        memory = aligned(need.state_bytes, need.alignment)
        made = Owned(interface().sphc_aligner_fini, memory)
        check(interface().sphc_aligner_init(memory.ctypes.data, memory.size, config, ctypes.byref(made.pointer), message),
              message)
        self._owned: Owned | None = made
        # A handler of a signal runs within a call of its own thread, and may close.
        self._turn, self._shape = threading.RLock(), (rig.color_camera.height, rig.color_camera.width)
        self._image = _interface.sphc_image()
        self._slot = Slot(self._image, depth_kinds(depth_format), "depth")

    def process(self, depth: Array | Image, out: Aligned | None = None) -> Aligned:
        """Aligns one depth image, which is borrowed for the call.

        `out`: where the result goes, such as that of an earlier call; None makes new images.  Error(E_IMAGE): an image
        does not fit; the aligner can go on with the next.
        """
        if out is None:
            out = Aligned(*(np.empty(self._shape, kind) for _, kind in _PLANES))
        raw = _interface.sphc_aligned(struct_size=ctypes.sizeof(_interface.sphc_aligned))
        for name, kind in _PLANES:
            self._lend(raw, name, kind, getattr(out, name))
        with self._turn:
            self._slot.put(depth)
            owned = self._owned
            if owned is None:
                raise closed("aligner")
            status = interface().sphc_aligner_process(owned.pointer, self._image, raw)
            if status < 0:
                check(status, interface().sphc_aligner_message(owned.pointer).decode())
        return out

    def _lend(self, raw: _interface.sphc_aligned, name: str, kind: np.dtype[np.generic], plane: Array | None) -> None:
        if plane is None:
            return
        of_type(plane, np.ndarray, f"out.{name}")
        rows = plane.strides[0] if plane.ndim == 2 else 0
        if (plane.shape != self._shape or plane.dtype != kind or plane.strides[1] != kind.itemsize
                or not self._shape[1] * kind.itemsize <= rows < 2**32 or not plane.flags.aligned or not plane.flags.writeable):
            raise Error(Status.E_IMAGE, f"out.{name}: {self._shape} of {kind}, writable and with pixels side by side, is "
                                        f"needed; the array is {plane.shape} of {plane.dtype} with strides {plane.strides}")
        setattr(raw, name, plane.ctypes.data)
        setattr(raw, f"{name}_stride_bytes", rows)

    def close(self) -> None:
        """Ends the aligner, after the call that may be running.  May be called twice."""
        with self._turn:
            if self._owned is not None:
                self._owned.end()
            self._owned = None

    def __enter__(self) -> Aligner:
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None,
                 trace: types.TracebackType | None) -> None:
        self.close()
