"""Maps."""
from __future__ import annotations

import ctypes
import os
import types

import numpy as np

from . import _interface
from ._answers import MapInfoFields
from ._calls import Owned, aligned, check, closed, whole
from ._library import interface
from .poses import Floats


class MapInfo(MapInfoFields):
    """What a map file says of itself."""

    __slots__ = ()


class Map:
    """A map file in memory, checked as a whole.  Any thread may read it at any time.

    Map.open(path) or Map(bytes) makes one.  A localizer that has the map keeps it in memory, so close() never takes
    anything away from under it.
    """

    def __init__(self, file: bytes | bytearray | memoryview) -> None:
        """Copies the bytes of a map file.  Errors: E_MAP_FORMAT, E_MAP_VERSION, E_MAP_CHECKSUM, E_MAP_EXTRACTOR."""
        try:
            content = np.frombuffer(file, np.uint8) if len(file) else np.empty(0, np.uint8)
        except TypeError:
            raise TypeError(f"file is the bytes of a map, not {type(file).__name__}; Map.open(path) reads one") from None
        need, message = _interface.sphc_memory(), _interface.sphc_message()
        check(interface().sphc_map_memory(need), "sphc_map_memory")
        kept = aligned(content.size, need.alignment)
        kept[:] = content
        memory = aligned(need.state_bytes, need.alignment)
        made = Owned(interface().sphc_map_fini, memory, kept)
        check(interface().sphc_map_init(memory.ctypes.data, memory.size, kept.ctypes.data, kept.size,
                                        ctypes.byref(made.pointer), message), message)
        self._owned: Owned | None = made

    @classmethod
    def open(cls, path: str | os.PathLike[str]) -> Map:
        """Reads a map file.  OSError where it cannot be read; the errors of Map otherwise."""
        with open(path, "rb") as stream:
            return cls(stream.read())

    def owned(self) -> Owned:
        if self._owned is None:
            raise closed("map")
        return self._owned

    def info(self) -> MapInfo:
        """Version, points, extractor, size, name and band."""
        raw = _interface.sphc_map_info(struct_size=ctypes.sizeof(_interface.sphc_map_info))
        owned = self.owned()  # for the whole call: another thread may close the map
        check(interface().sphc_map_get_info(owned.pointer, raw), "sphc_map_get_info")
        return MapInfo(raw)

    def direction(self, point_index: int) -> Floats:
        """Unit direction of a point from the sphere centre, in the map's frame.  IndexError where there is none."""
        owned, made = self.owned(), (ctypes.c_double * 3)()
        index = whole(point_index, "point_index", 64, signed=True)
        if not 0 <= index < 2**32 or interface().sphc_map_direction(owned.pointer, index, made) < 0:
            raise IndexError(f"the map has points 0 to {self.info().point_count - 1}, not {point_index}")
        return np.array(made)

    def close(self) -> None:
        """Ends the map for this program; localizers that have it keep it until they let it go.  May be called twice."""
        self._owned = None

    def __enter__(self) -> Map:
        self.owned()
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None,
                 trace: types.TracebackType | None) -> None:
        self.close()


def extractor_id() -> int:
    """The id of the library's keypoint extractor, which must be that of a map."""
    made: int = interface().sphc_extractor_id()
    return made
