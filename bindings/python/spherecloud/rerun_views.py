"""Frames and what the localizer found in them, in the viewer of rerun.io: pip install spherecloud[rerun].

    rerun.init("room", spawn=True)
    log_rig(rig)
    for recorded in Recording("walk.raw"):
        result = localizer.process(recorded.frame)
        log_frame(recorded.frame, rig, result, localizer.observations())

Entities are below `path`, which is the colour camera in the map: `path`/color and `path`/depth.  Time is the timeline
"frame_time", that of the frame.
"""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ._overlays import KINDS, as_rgb, best_kinds
from .cameras import Camera, Rig
from .enums import Format, Status
from .errors import Error
from .frames import Frame
from .images import Array, Image
from .poses import Rigid
from .results import Result

try:
    import rerun
except ImportError as fault:
    raise ImportError("spherecloud.rerun_views shows frames with rerun: pip install spherecloud[rerun]") from fault


def log_rig(rig: Rig, path: str = "headset") -> None:
    """The cameras, once.  Their distortion is not shown."""
    rerun.log(f"{path}/color", _pinhole(rig.color_camera), static=True)
    rerun.log(f"{path}/depth", _transform(rig.color_from_depth), _pinhole(rig.depth_camera), static=True)


def log_frame(frame: Frame, rig: Rig, result: Result | None = None, observations: npt.NDArray[np.void] | None = None,
              path: str = "headset") -> None:
    """A frame's images; where it has a pose, that of the colour camera in the map; and the keypoints of
    Localizer.observations() in the colour of what became of them.

    A frame without a pose stays where the last one was.  Error(E_UNSUPPORTED): the colour image is neither grey nor RGB, BGR
    or RGBA, or the depth image is none of DEPTH16.
    """
    color = rerun.Image(as_rgb(frame.color)) if frame.color is not None else None
    depth = _depth(frame.depth, rig) if frame.depth is not None else None
    rerun.set_time("frame_time", duration=frame.color_time_ns / 1e9)
    if color is not None:
        rerun.log(f"{path}/color/image", color)
    if depth is not None:
        rerun.log(f"{path}/depth/image", depth)
    if result is not None and result.pose is not None:
        rerun.log(path, _transform(result.pose.inverse()))
    if observations is not None:
        _log_observations(f"{path}/color/image/keypoints", observations[observations["camera"] == 0])


def log_walk(poses: list[Rigid | None], path: str = "walk") -> None:
    """The way of the colour camera in the map, of poses camera_from_map; None, of a frame without a pose, breaks the line."""
    strips: list[list[tuple[float, ...]]] = [[]]
    for pose in poses:
        if pose is None:
            strips.append([])
        else:
            strips[-1].append(pose.inverse().t_m)
    rerun.log(path, rerun.LineStrips3D([strip for strip in strips if len(strip) > 1]), static=True)


def _log_observations(path: str, seen: npt.NDArray[np.void]) -> None:
    colors = np.array([int(color[1:] + "ff", 16) for _, color, _ in KINDS], np.uint32)
    pixels = np.stack([seen["x_px"], seen["y_px"]], 1)
    rerun.log(path, rerun.Points2D(pixels, radii=seen["scale_px"], colors=colors[best_kinds(seen)]))


def _pinhole(camera: Camera) -> rerun.Pinhole:
    fx, fy, cx, cy = camera.params[:4]
    return rerun.Pinhole(image_from_camera=np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), resolution=[camera.width, camera.height])


def _transform(parent_from_child: Rigid) -> rerun.Transform3D:
    return rerun.Transform3D(translation=parent_from_child.t_m, mat3x3=parent_from_child.rotation())


def _depth(image: Array | Image, rig: Rig) -> rerun.DepthImage:
    array, format = (image.data, image.format) if isinstance(image, Image) else (image, Format.DEPTH16)
    if format != Format.DEPTH16 or array.dtype != np.uint16:
        raise Error(Status.E_UNSUPPORTED, f"the depth image is {format.name} of {array.dtype}, and this shows DEPTH16 of uint16 "
                                          "alone; convert it, or log it yourself")
    return rerun.DepthImage(array, meter=1 / rig.depth_unit_m)
