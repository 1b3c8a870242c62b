"""Raw recordings, frame by frame: docs/recording.md has the format.

    spherecloud convert walk.mcap walk.raw --to raw      also of a folder in the layout of TUM or 7-Scenes

    recording = Recording("walk.raw")
    with Map.open("room.sphc") as map, Localizer(recording.rig, map) as localizer:
        for recorded in recording:
            result = localizer.process(recorded.frame)
"""
from __future__ import annotations

import dataclasses
import os
import pathlib
import struct
import typing
import zlib

import numpy as np

from .cameras import Camera, Rig
from .enums import CameraModel, Format, Status
from .errors import Error
from .frames import Frame
from .images import Array, Image
from .poses import Rigid

_MAGIC, _VERSION = b"SPHC-RAW", 1
_HEADER = struct.Struct("<8s4I 4I12d 4I12d 7d d 2I")
_HEAD = struct.Struct("<2I2q7d2I")  # of a frame
_CHANNELS = {Format.GRAY8: 1, Format.RGB8: 3, Format.BGR8: 3}


@dataclasses.dataclass(frozen=True)
class RecordedFrame:
    """A frame as Localizer.process wants it.  `world_from_camera`: where the colour camera was at color_time_ns, in a world
    of the recording's own; None where the recording does not say."""

    frame: Frame
    world_from_camera: Rigid | None


class Recording(typing.Sequence[RecordedFrame]):
    """A raw recording: a sequence of frames, each of which is read, and checked, when it is asked for.

    `rig`: its cameras.  `color_format`: of all colour images: GRAY8, RGB8 or BGR8.  The file is open during a reading alone.
    Error(E_ARGUMENT): it is no raw recording of this version, or was changed or cut; of a frame, Error(E_DEVICE): it was
    changed, and the others can be read.  OSError: the file cannot be read.
    """

    rig: Rig
    color_format: Format
    _count: int

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._path = pathlib.Path(path)
        with open(self._path, "rb") as file:
            header, size = file.read(_HEADER.size), os.fstat(file.fileno()).st_size
        if len(header) < _HEADER.size or not header.startswith(_MAGIC):
            raise self._refuse("this is no raw recording; `spherecloud convert RECORDING FILE --to raw` makes one")
        if struct.unpack_from("<I", header, len(_MAGIC))[0] != _VERSION:
            raise self._refuse(f"this raw recording is not of version {_VERSION}; convert it with the `spherecloud` of this release")
        fields = _HEADER.unpack(header)
        if zlib.crc32(header[:-4]) != fields[-1]:
            raise self._refuse("the header was changed; convert the recording again")
        self._count, self.color_format = fields[2], Format(fields[3])
        if self.color_format not in _CHANNELS:
            raise self._refuse(f"colour images of {self.color_format.name} are not of version {_VERSION}; convert the recording again")
        self.rig = Rig(_camera(fields[5:21]), _camera(fields[21:37]), _rigid(fields[37:44]), fields[44])
        self._frame_bytes = _HEAD.size + self._depth_bytes + self._color_bytes
        wanted = _HEADER.size + self._count * self._frame_bytes
        if size != wanted:
            raise self._refuse(f"{self._count} frames are {wanted} bytes, and the file has {size}; copy it again")

    def __len__(self) -> int:
        return self._count

    @typing.overload
    def __getitem__(self, index: int) -> RecordedFrame: ...
    @typing.overload
    def __getitem__(self, index: slice) -> list[RecordedFrame]: ...

    def __getitem__(self, index: int | slice) -> RecordedFrame | list[RecordedFrame]:
        if isinstance(index, slice):
            return [self._read(each) for each in range(self._count)[index]]
        return self._read(range(self._count)[index])

    @property
    def _depth_bytes(self) -> int:
        return 2 * self.rig.depth_camera.width * self.rig.depth_camera.height

    @property
    def _color_bytes(self) -> int:
        return _CHANNELS[self.color_format] * self.rig.color_camera.width * self.rig.color_camera.height

    def _read(self, index: int) -> RecordedFrame:
        with open(self._path, "rb") as file:
            file.seek(_HEADER.size + index * self._frame_bytes)
            read = file.read(self._frame_bytes)
        if len(read) != self._frame_bytes:
            raise self._refuse(f"frame {index} is cut; the file became shorter after it was opened", Status.E_DEVICE)
        head = _HEAD.unpack_from(read)
        sequence, has_pose, color_time_ns, depth_time_ns = head[:4]
        if (zlib.crc32(read[_HEAD.size:]), zlib.crc32(read[:_HEAD.size - 4])) != head[-2:]:
            raise self._refuse(f"frame {index} was changed; convert the recording again", Status.E_DEVICE)
        frame = Frame(self._color(read), self._depth(read), color_time_ns, depth_time_ns, sequence)
        return RecordedFrame(frame, _rigid(head[4:11]) if has_pose else None)

    def _depth(self, read: bytes) -> Array:
        camera = self.rig.depth_camera
        return np.frombuffer(read, "<u2", camera.width * camera.height, _HEAD.size).reshape(camera.height, camera.width)

    def _color(self, read: bytes) -> Array | Image:
        camera, channels = self.rig.color_camera, _CHANNELS[self.color_format]
        shape = (camera.height, camera.width) if channels == 1 else (camera.height, camera.width, channels)
        pixels = np.frombuffer(read, np.uint8, self._color_bytes, _HEAD.size + self._depth_bytes).reshape(shape)
        return Image(pixels, Format.BGR8) if self.color_format == Format.BGR8 else pixels

    def _refuse(self, why: str, status: Status = Status.E_ARGUMENT) -> Error:
        return Error(status, f"{self._path}: {why}")


def _camera(fields: tuple[typing.Any, ...]) -> Camera:
    model, width, height, count = fields[:4]
    return Camera(CameraModel(model), width, height, fields[4:4 + count])


def _rigid(fields: tuple[float, ...]) -> Rigid:
    return Rigid(fields[:4], fields[4:])
