"""What a frame is made of."""
from __future__ import annotations

import ctypes
import dataclasses
import typing

from . import _interface
from ._calls import check, configure, nanoseconds, of_type, whole
from ._library import interface
from .cameras import Camera
from .enums import Format, PriorPart
from .images import AMPLITUDE, COLOR, Array, Image, Slot, depth_kinds
from .poses import Rigid, numbers

Vector = typing.Sequence[float]


@dataclasses.dataclass(frozen=True)
class Prior:
    """What is known of a pose before its frame is looked at.  Three parts, each of which may be missing:

    `camera_from_map`, where the camera should be, with `rotation_sigma_rad` and `translation_sigma_m` (1 sigma an axis).
    `up_camera` and `up_map`, the vertical in both frames, of any usual length, with `up_sigma_rad`.
    `odometry_from_camera`, dead reckoning at color_time_ns in a frame of its own, with the sigmas of a step.

    `map_id` is the map whose frame the first two are in.  docs/localizer.md.
    """

    map_id: int = 0
    camera_from_map: Rigid | None = None
    rotation_sigma_rad: float = 0.0
    translation_sigma_m: float = 0.0
    up_camera: Vector | None = None
    up_map: Vector | None = None
    up_sigma_rad: float = 0.0
    odometry_from_camera: Rigid | None = None
    odometry_rotation_sigma_rad: float = 0.0
    odometry_translation_sigma_m: float = 0.0

    def parts(self) -> PriorPart:
        """Which parts are there."""
        up = self.up_map if self.up_camera is None else self.up_camera
        said = {PriorPart.POSE: self.camera_from_map, PriorPart.UP: up, PriorPart.ODOMETRY: self.odometry_from_camera}
        return PriorPart(sum(part for part, value in said.items() if value is not None))

    def raw(self) -> _interface.sphc_localizer_prior:
        up = [numbers(v, 3, "up") if v is not None else (0.0,) * 3 for v in (self.up_camera, self.up_map)]
        return _interface.sphc_localizer_prior(
            ctypes.sizeof(_interface.sphc_localizer_prior), self.parts(), whole(self.map_id, "map_id"), 0,
            _raw(self.camera_from_map, "camera_from_map"), self.rotation_sigma_rad, self.translation_sigma_m,
            up[0], up[1], self.up_sigma_rad, _raw(self.odometry_from_camera, "odometry_from_camera"),
            self.odometry_rotation_sigma_rad, self.odometry_translation_sigma_m)


def _raw(pose: Rigid | None, name: str) -> _interface.sphc_rigid:
    return (of_type(pose, Rigid, name, "; Rigid.from_matrix makes one") if pose is not None else Rigid()).raw()


@dataclasses.dataclass(frozen=True)
class RigCamera:
    """A camera of a rig beside the colour camera: grey or colour, of any model and size, looking anywhere."""

    camera: Camera
    color_from_camera: Rigid
    row_time_ns: int = 0  # of a rolling shutter

    def raw(self) -> _interface.sphc_localizer_camera:
        return _interface.sphc_localizer_camera(
            ctypes.sizeof(_interface.sphc_localizer_camera), 0, of_type(self.camera, Camera, "camera").raw(),
            of_type(self.color_from_camera, Rigid, "color_from_camera").raw(), nanoseconds(self.row_time_ns, "row_time_ns"))


@dataclasses.dataclass(frozen=True)
class RigDepthCamera:
    """A depth camera of a rig beside the one in the rig.  What is None has the library's default
    (sphc_localizer_depth_camera_init).

    `unit_m`: metres per unit of its image.  What is measured below `min_m` or above `max_m` is ignored, as is what its
    amplitudes say is below `amplitude_min`.  Noise, 1 sigma: sigma_m + sigma_per_m2 z^2.

    How it is off against the depth camera in the rig: z of that one = z + offset + slope (z - depth_mid_m).
    `offset_sigma_m` and `slope_sigma` are 1 sigma of what is unknown of it before the first frame; it is learnt where
    both measure what the colour camera sees.  Both 0: they measure alike.
    """

    camera: Camera
    color_from_depth: Rigid
    format: Format = Format.DEPTH16
    unit_m: float | None = None
    min_m: float | None = None
    max_m: float | None = None
    sigma_m: float | None = None
    sigma_per_m2: float | None = None
    offset_sigma_m: float | None = None
    slope_sigma: float | None = None
    amplitude_min: int | None = None

    def raw(self) -> _interface.sphc_localizer_depth_camera:
        raw = _interface.sphc_localizer_depth_camera()
        status = interface().sphc_localizer_depth_camera_init(raw, ctypes.sizeof(raw))
        check(status, "sphc_localizer_depth_camera_init")
        raw.camera = of_type(self.camera, Camera, "camera").raw()
        raw.color_from_depth = of_type(self.color_from_depth, Rigid, "color_from_depth").raw()
        of_type(self.format, Format, "format")
        configure(raw, {field.name: getattr(self, field.name) for field in dataclasses.fields(self)[2:]})
        return raw


@dataclasses.dataclass(frozen=True)
class View:
    """The image of a further camera, mid-exposure at time_ns.  None: the camera has none in this frame.  `camera` and
    `color_from_camera`: as they are in this frame; None: as in the config."""

    image: Array | Image | None
    time_ns: int
    camera: Camera | None = None
    color_from_camera: Rigid | None = None


@dataclasses.dataclass(frozen=True)
class DepthView:
    """The image of a further depth camera, mid-exposure at time_ns.  None: the camera has none in this frame.
    `amplitude`: its own light, where the camera has amplitude_min.  `camera` and `color_from_depth`: as they are in this
    frame; None: as in the config."""

    depth: Array | Image | None
    time_ns: int
    amplitude: Array | Image | None = None
    camera: Camera | None = None
    color_from_depth: Rigid | None = None


@dataclasses.dataclass
class Frame:
    """A colour and a depth image taken at about the same time.  Images are numpy arrays, or an Image where the array does
    not say its format; they are read in place, and nothing of them is kept after a call.

    Times are mid-exposure; the pose is that of the colour camera at color_time_ns.  `sequence` comes back in the result.
    `deadline_us`: the frame is to be answered so long after the call began; 0: none.  `amplitude`: the ToF sensor's own
    light, where the localizer has amplitude_min.  `views`: one for each further camera of the localizer, in its order.
    `depth_views`: the same of its further depth cameras.  `color_camera`, `color_from_depth` and `depth_camera`: as they
    are in this frame; None: as in the rig.
    """

    color: Array | Image | None
    depth: Array | Image | None
    color_time_ns: int
    depth_time_ns: int
    sequence: int = 0
    prior: Prior | None = None
    deadline_us: int = 0
    amplitude: Array | Image | None = None
    views: typing.Sequence[View] = ()
    color_camera: Camera | None = None
    color_from_depth: Rigid | None = None
    depth_camera: Camera | None = None
    depth_views: typing.Sequence[DepthView] = ()


_WORDS, _HALF = 1 << 32, 1 << 63


def _refuse_numbers(frame: Frame) -> None:
    """ValueError for the number that its field cannot hold, TypeError for what is none."""
    whole(frame.sequence, "sequence")
    whole(frame.deadline_us, "deadline_us")
    nanoseconds(frame.color_time_ns, "color_time_ns")
    nanoseconds(frame.depth_time_ns, "depth_time_ns")


class FrameStruct:
    """A struct that frames are put into, one after the other.  `depth_formats`: of the further depth cameras."""

    def __init__(self, depth_format: Format, depth_formats: typing.Sequence[Format] = ()) -> None:
        self.raw = _interface.sphc_localizer_frame(struct_size=ctypes.sizeof(_interface.sphc_localizer_frame))
        self._color = Slot(self.raw.color, COLOR, "color")
        self._depth = Slot(self.raw.depth, depth_kinds(depth_format), "depth")
        self._amplitude = Slot(self.raw.amplitude, AMPLITUDE, "amplitude")
        self._depth_kinds = [depth_kinds(format) for format in depth_formats]
        self._plain = True  # nothing but two images was in the last frame

    def fill(self, frame: Frame) -> list[object]:
        """Returns what must stay alive until the call is over."""
        raw, color, depth = self.raw, of_type(frame, Frame, "frame").color, frame.depth
        sequence, deadline_us, color_ns, depth_ns = frame.sequence, frame.deadline_us, frame.color_time_ns, frame.depth_time_ns
        try:
            if not (0 <= sequence < _WORDS and 0 <= deadline_us < _WORDS and -_HALF <= color_ns < _HALF and -_HALF <= depth_ns < _HALF):
                _refuse_numbers(frame)
            raw.sequence, raw.deadline_us, raw.color_time_ns, raw.depth_time_ns = sequence, deadline_us, color_ns, depth_ns
        except TypeError:
            _refuse_numbers(frame)
            raise
        self._color.put(color)
        self._depth.put(depth)
        told: list[object] = [color, depth]
        plain = (frame.prior is None and frame.amplitude is None and not frame.views and frame.color_camera is None
                 and frame.color_from_depth is None and frame.depth_camera is None and not frame.depth_views)
        if not (plain and self._plain):
            self._fill_the_rest(frame, told)
            self._plain = plain
        return told

    def _fill_the_rest(self, frame: Frame, told: list[object]) -> None:
        raw, amplitude, views, depth_views = self.raw, frame.amplitude, frame.views, frame.depth_views
        self._plain = False
        self._amplitude.put(amplitude)
        told.append(amplitude)
        raw.prior = _address(frame.prior, Prior, told)
        raw.color_camera = _address(frame.color_camera, Camera, told)
        raw.color_from_depth = _address(frame.color_from_depth, Rigid, told)
        raw.depth_camera = _address(frame.depth_camera, Camera, told)
        raw.views, raw.view_count = self._views(views, told) if views else None, len(views)
        raw.depth_views = self._depth_views(depth_views, told) if depth_views else None
        raw.depth_view_count = len(depth_views)

    def _views(self, given: typing.Sequence[View], told: list[object]) -> int:
        for view in given:
            of_type(view, View, "a view")
        views = (_interface.sphc_localizer_view * len(given))()
        told.extend([views, *(view.image for view in given)])
        for raw, view in zip(views, given):
            raw.struct_size, raw.time_ns = ctypes.sizeof(raw), nanoseconds(view.time_ns, "view.time_ns")
            Slot(raw.image, COLOR, "view").put(view.image)
            raw.camera = _address(view.camera, Camera, told)
            raw.color_from_camera = _address(view.color_from_camera, Rigid, told)
        return ctypes.addressof(views)

    def _depth_views(self, given: typing.Sequence[DepthView], told: list[object]) -> int:
        for view in given:
            of_type(view, DepthView, "a depth view")
        views = (_interface.sphc_localizer_depth_view * len(given))()
        told.extend([views, *(view.depth for view in given), *(view.amplitude for view in given)])
        # Of more views than cameras the library says that they are too many, before it looks at one.
        for raw, view, kinds in zip(views, given, self._depth_kinds):
            raw.struct_size, raw.time_ns = ctypes.sizeof(raw), nanoseconds(view.time_ns, "depth view.time_ns")
            Slot(raw.depth, kinds, "depth view").put(view.depth)
            Slot(raw.amplitude, AMPLITUDE, "amplitude of a depth view").put(view.amplitude)
            raw.camera = _address(view.camera, Camera, told)
            raw.color_from_depth = _address(view.color_from_depth, Rigid, told)
        return ctypes.addressof(views)


def _address(value: Prior | Camera | Rigid | None, kind: type[Prior] | type[Camera] | type[Rigid],
             told: list[object]) -> int | None:
    if value is None:
        return None
    made = of_type(value, kind, f"what the frame says of a {kind.__name__}").raw()
    told.append(made)
    return ctypes.addressof(made)
