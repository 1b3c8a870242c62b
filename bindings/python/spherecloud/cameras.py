"""Cameras and rigs."""
from __future__ import annotations

import ctypes
import dataclasses
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from ._calls import check, of_type, whole
from ._library import interface
from .enums import CameraModel, Status
from .errors import Error
from .poses import Floats, Rigid


@dataclasses.dataclass(frozen=True)
class Camera:
    """Intrinsics, in pixels of an image of width x height.

    `params` are those of the model, as in OpenCV: fx fy cx cy, then the distortion.  The centre of the top-left pixel
    is (0.5, 0.5): add 0.5 to a principal point of OpenCV.
    """

    model: CameraModel
    width: int
    height: int
    params: tuple[float, ...]

    def __post_init__(self) -> None:
        object.__setattr__(self, "params", tuple(float(value) for value in self.params))
        if len(self.params) > 12:
            raise ValueError(f"a camera has at most 12 parameters, not {len(self.params)}")

    @staticmethod
    def pinhole(width: int, height: int, fx: float, fy: float, cx: float, cy: float) -> Camera:
        """A camera without distortion."""
        return Camera(CameraModel.PINHOLE, width, height, (fx, fy, cx, cy))

    def raw(self) -> _interface.sphc_camera:
        return _interface.sphc_camera(whole(self.model, "model", signed=True), whole(self.width, "width"),
                                      whole(self.height, "height"), len(self.params), self.params)

    def check(self) -> None:
        """Error(E_ARGUMENT) if the camera cannot be used; the message names field, cause and cure."""
        message = _interface.sphc_message()
        check(interface().sphc_camera_check(self.raw(), message), message)

    def project(self, points_m: npt.ArrayLike) -> Floats:
        """Pixels (..., 2) of points (..., 3) in camera coordinates.

        A point that is not in front of the camera, more than about 89 degrees off the axis (83 for the Brown models) or
        beyond its distortion is an Error(OUTSIDE) where it is the only one, and NaN among several.  Error(E_ARGUMENT): the camera fails its check, or a number is not finite.
        """
        return self._each(points_m, 3, 2, interface().sphc_camera_project, "the camera does not see this point")

    def unproject(self, pixels_px: npt.ArrayLike) -> Floats:
        """Unit bearings (..., 3) in camera coordinates of pixels (..., 2).  Failures as of project."""
        return self._each(pixels_px, 2, 3, interface().sphc_camera_unproject, "no bearing projects to this pixel")

    def _each(self, given: npt.ArrayLike, source: int, target: int, call: typing.Callable[..., int],
              why: str) -> Floats:
        inputs = np.asarray(given, np.float64)
        if inputs.shape[-1:] != (source,):
            raise ValueError(f"the last dimension is {source}, and the shape {inputs.shape}")
        raw, read, made = self.raw(), (ctypes.c_double * source)(), (ctypes.c_double * target)()
        outputs = np.full((inputs.size // source, target), np.nan)
        for index, row in enumerate(inputs.reshape(-1, source)):
            read[:] = row.tolist()
            status = call(raw, read, made)
            check(status, f"the camera cannot be used, or a number is not finite: {row.tolist()}")
            if status == Status.OK:
                outputs[index] = made[:]
            elif inputs.ndim == 1:
                raise Error(Status.OUTSIDE, f"{why}: {row.tolist()}")
        return outputs.reshape((*inputs.shape[:-1], target))


@dataclasses.dataclass(frozen=True)
class Rig:
    """The colour and the depth camera of a headset.  The identity with equal cameras: the depth image is registered to
    the colour image already.  `depth_unit_m`: metres per unit of the depth image."""

    color_camera: Camera
    depth_camera: Camera
    color_from_depth: Rigid = Rigid()
    depth_unit_m: float = 0.001

    def raw(self) -> _interface.sphc_rig:
        return _interface.sphc_rig(of_type(self.color_camera, Camera, "color_camera").raw(),
                                   of_type(self.depth_camera, Camera, "depth_camera").raw(),
                                   of_type(self.color_from_depth, Rigid, "color_from_depth").raw(), self.depth_unit_m)

    def check(self) -> None:
        """Error(E_ARGUMENT) if the rig cannot be used; the message names field, cause and cure."""
        message = _interface.sphc_message()
        check(interface().sphc_rig_check(self.raw(), message), message)
