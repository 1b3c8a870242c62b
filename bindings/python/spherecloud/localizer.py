"""The localizer: a frame in, a pose out."""
from __future__ import annotations

import collections.abc
import ctypes
import logging
import operator
import threading
import time
import types
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from ._answers import OBSERVATION
from ._calls import Owned, aligned, check, closed, configure, nanoseconds, of_type, real, whole
from ._library import interface
from .cameras import Rig
from .enums import Band, Format, LogLevel, Mode, Parameter, Status
from .errors import Error
from .features import Features
from .frames import Frame, FrameStruct, RigCamera, RigDepthCamera
from .maps import Map
from .poses import Rigid
from .results import DepthBias, Hypothesis, MemoryPiece, Prediction, Result

Log = typing.Callable[[LogLevel, str], None]
Clock = typing.Callable[[], int]

_LEVELS = {LogLevel.ERROR: logging.ERROR, LogLevel.WARNING: logging.WARNING, LogLevel.INFO: logging.INFO,
           LogLevel.DEBUG: logging.DEBUG}

# How the library reads the usual clock: `user` is the clock, and no function of Python's lies between.  At the beginning of
# one Python may raise an interrupt, which nothing could catch there.
_USUAL = time.monotonic_ns
_read_usual = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.py_object)(operator.methodcaller("__call__"))


def to_logging(level: LogLevel, text: str) -> None:
    """Where the log goes if nobody says more: Python's logger "spherecloud"."""
    logging.getLogger("spherecloud").log(_LEVELS.get(level, logging.INFO), "%s", text)


class _Callbacks:
    """Functions of Python's for the library.  What they raise, such as an interrupt, comes up after the call."""

    def __init__(self, log: Log | None, clock: Clock | None) -> None:
        for name, call in ("log", log), ("clock", clock):
            if call is not None and not callable(call):
                raise TypeError(f"{name} is a function or None, not {type(call).__name__}")
        self._local = threading.local()  # a fault is of the thread whose call it happened in
        self.inside: list[int] = []  # threads that are in a callback, from which the library must not be entered again

        def say(_: object, level: int, text: bytes, length: int) -> None:
            self._run(lambda: log and log(LogLevel(level), text.decode(errors="replace")), lambda: None)

        def read(_: object) -> int:
            try:
                return operator.index(self._run(clock, _USUAL))
            except BaseException as fault:  # an interrupt, or a clock that gives no whole number
                self.fault = fault
                return _USUAL()

        self.log = _interface.sphc_log_fn(say) if log else _interface.sphc_log_fn()
        self.clock, self.clock_user = _interface.sphc_clock_fn(), id(_USUAL)
        if clock is _USUAL:
            self.clock = ctypes.cast(_read_usual, _interface.sphc_clock_fn)
        elif clock:
            self.clock = _interface.sphc_clock_fn(read)

    @property
    def fault(self) -> BaseException | None:
        """What a callback of this thread raised."""
        return getattr(self._local, "fault", None)

    @fault.setter
    def fault(self, fault: BaseException | None) -> None:
        self._local.fault = fault

    def _run(self, call: typing.Any, otherwise: typing.Callable[[], typing.Any]) -> typing.Any:
        self.inside.append(threading.get_ident())
        try:
            return call()
        except BaseException as fault:
            self.fault = fault
            return otherwise()
        finally:
            self.inside.remove(threading.get_ident())

    def raise_fault(self) -> None:
        fault, self.fault = self.fault, None
        if fault is not None:
            raise fault


class Localizer:
    """Finds the colour camera of each frame in the maps.

        with Map.open("room.sphc") as map, Localizer(rig, map) as localizer:
            result = localizer.process(Frame(color, depth, color_time_ns, depth_time_ns))

    Threads: one call at a time, others wait for their turn; extract alone may run beside locate.  Use several localizers
    for several threads: calls run outside of Python's lock.
    """

    def __init__(self, rig: Rig, maps: Map | typing.Mapping[int, Map] | None = None, *, max_keypoints: int | None = None,
                 max_maps: int | None = None, mode: Mode | None = None, seed: int | None = None,
                 depth_min_m: float | None = None, depth_max_m: float | None = None, depth_sigma_m: float | None = None,
                 depth_sigma_per_m2: float | None = None, pixel_sigma_px: float | None = None,
                 map_sigma_m: float | None = None, depth_mid_m: float | None = None,
                 depth_offset_sigma_m: float | None = None, depth_slope_sigma: float | None = None,
                 depth_format: Format = Format.DEPTH16, amplitude_min: int | None = None, color_band: Band | None = None,
                 cameras: typing.Sequence[RigCamera] = (), depth_cameras: typing.Sequence[RigDepthCamera] = (),
                 color_row_time_ns: int | None = None, log: Log | None = to_logging, log_level: LogLevel | None = None,
                 clock: Clock | None = time.monotonic_ns) -> None:
        """Takes its memory once, here.  What is None has the library's default (sphc_localizer_config_init).

        `maps`: a map, whose id is 0, or maps by id.  `cameras` and `depth_cameras`: the further ones of the rig.  `log` is
        called with a level and a line, on the calling thread; None: no log.  `clock` gives monotonic nanoseconds, from
        any thread; None: stage times are 0 and no frame has a deadline.  Neither may call the localizer.
        Error(E_ARGUMENT): the rig or a parameter cannot be used; the message names field, cause and cure.
        """
        by_id: typing.Mapping[int, Map] = {0: maps} if isinstance(maps, Map) else of_type(
            maps or {}, collections.abc.Mapping, "maps",  # type: ignore[type-abstract]
            "; give a Map, or Maps by id")
        given = {"max_keypoints": max_keypoints, "max_maps": max_maps, "mode": mode, "seed": seed,
                 "depth_min_m": depth_min_m, "depth_max_m": depth_max_m, "depth_sigma_m": depth_sigma_m,
                 "depth_sigma_per_m2": depth_sigma_per_m2, "pixel_sigma_px": pixel_sigma_px, "map_sigma_m": map_sigma_m,
                 "depth_mid_m": depth_mid_m, "depth_offset_sigma_m": depth_offset_sigma_m,
                 "depth_slope_sigma": depth_slope_sigma, "amplitude_min": amplitude_min,
                 "depth_format": of_type(depth_format, Format, "depth_format"),
                 "color_band": color_band, "color_row_time_ns": color_row_time_ns, "log_level": log_level}
        self._c, self._callbacks = interface(), _Callbacks(log, clock)
        self._process, self._made_result = self._c.sphc_localizer_process, _interface.sphc_localizer_result.from_buffer_copy
        for name, list_of in ("cameras", cameras), ("depth_cameras", depth_cameras):
            of_type(list_of, collections.abc.Sequence, name, "; give a list")  # type: ignore[type-abstract]
        self._cameras = (_interface.sphc_localizer_camera * len(cameras))(
            *(of_type(camera, RigCamera, "one of cameras").raw() for camera in cameras))
        self._depth_cameras = (_interface.sphc_localizer_depth_camera * len(depth_cameras))(
            *(of_type(camera, RigDepthCamera, "one of depth_cameras").raw() for camera in depth_cameras))
        self._config = self._made_config(rig, given)
        self._extracting, self._locating = threading.RLock(), threading.RLock()
        depth_formats = [camera.format for camera in depth_cameras]
        self._extract_frame, self._locate_frame = (FrameStruct(depth_format, depth_formats) for _ in range(2))
        self._no_result, self._no_prediction = _interface.sphc_localizer_result(), _interface.sphc_localizer_prediction()
        self._c.sphc_localizer_result_init(self._no_result, ctypes.sizeof(self._no_result))
        self._c.sphc_localizer_prediction_init(self._no_prediction, ctypes.sizeof(self._no_prediction))
        self._owned: Owned | None = self._made()
        for map_id, map in by_id.items():
            self.set_map(map_id, map)

    def _made_config(self, rig: Rig, given: dict[str, typing.Any]) -> _interface.sphc_localizer_config:
        config = _interface.sphc_localizer_config()
        check(self._c.sphc_localizer_config_init(config, ctypes.sizeof(config)), "sphc_localizer_config_init")
        configure(config, given)
        config.rig, config.log = of_type(rig, Rig, "rig").raw(), self._callbacks.log
        config.clock, config.clock_user = self._callbacks.clock, self._callbacks.clock_user
        config.cameras = ctypes.addressof(self._cameras) if len(self._cameras) else None
        config.camera_count = len(self._cameras)
        config.depth_cameras = ctypes.addressof(self._depth_cameras) if len(self._depth_cameras) else None
        config.depth_camera_count = len(self._depth_cameras)
        return config

    def _made(self) -> Owned:
        need, message = _interface.sphc_memory(), _interface.sphc_message()
        check(self._c.sphc_localizer_memory(self._config, need, message), message)
        state, scratch = (aligned(size, need.alignment) for size in (need.state_bytes, need.scratch_bytes))
        made = Owned(self._c.sphc_localizer_fini, state, scratch)
        made.keeps["callbacks"] = self._callbacks
        check(self._c.sphc_localizer_init(state.ctypes.data, state.size, scratch.ctypes.data, scratch.size, self._config,
                                          ctypes.byref(made.pointer), message), message)
        return made

    def _alive(self) -> Owned:
        if self._owned is None:
            raise closed("localizer")
        if self._callbacks.inside and threading.get_ident() in self._callbacks.inside:
            raise Error(Status.E_STATE, "the localizer is in a call of this thread; do not call it from its callbacks")
        return self._owned

    def _check(self, status: int) -> None:
        """Raises a failure with the localizer's own message; inside a turn."""
        if self._callbacks.fault is not None:
            self._callbacks.raise_fault()
        if status < 0:
            check(status, self._c.sphc_localizer_message(self._alive().pointer).decode(errors="replace"))

    def _answer(self, status: int, why: str) -> None:
        """The same of a call that leaves the localizer's message as it was."""
        self._callbacks.raise_fault()
        check(status, why)

    # ---- maps ----

    def set_map(self, map_id: int, map: Map) -> None:
        """Gives it a map under an id of the caller's, or replaces the one of this id; between any two frames.

        The localizer keeps the map in memory.  Errors: E_ARGUMENT, its band is not color_band, among others;
        E_CAPACITY, max_maps are there.
        """
        kept = of_type(map, Map, "map", "; Map.open(path) makes one").owned()
        number = whole(map_id, "map_id")
        with self._locating:
            owned = self._alive()
            before = owned.keeps.get(number)
            owned.keeps[number] = kept, before  # both, as an interrupt may come up right after the call
            status = self._c.sphc_localizer_set_map(owned.pointer, number, kept.pointer)
            owned.keeps[number] = kept if status >= 0 else before  # it has the map, whatever a callback raised
            self._check(status)

    def remove_map(self, map_id: int) -> None:
        """Takes a map away, and forgets what was tracked in it.  Error(E_ARGUMENT): there is none of this id."""
        number = whole(map_id, "map_id")
        with self._locating:
            owned = self._alive()
            status = self._c.sphc_localizer_remove_map(owned.pointer, number)
            if status >= 0:
                owned.keeps.pop(number, None)
            self._check(status)

    def set_map_transform(self, map_id: int, common_from_map: Rigid | None, rotation_sigma_rad: float = 0.0,
                          translation_sigma_m: float = 0.0) -> None:
        """Where a map lies in a frame that several maps share, with its errors, 1 sigma an axis.  None: not known."""
        raw = of_type(common_from_map, Rigid, "common_from_map").raw() if common_from_map is not None else None
        number = whole(map_id, "map_id")
        sigmas = real(rotation_sigma_rad, "rotation_sigma_rad"), real(translation_sigma_m, "translation_sigma_m")
        with self._locating:
            self._check(self._c.sphc_localizer_set_map_transform(self._alive().pointer, number, raw, *sigmas))

    @property
    def map_count(self) -> int:
        """How many maps it has."""
        with self._locating:
            count: int = self._c.sphc_localizer_map_count(self._alive().pointer)
            return count

    # ---- frames ----

    def process(self, frame: Frame) -> Result:
        """Where was the colour camera?  result.localized says whether that is known, and result.outcome why not.

        Images are borrowed for the call, in which other threads of Python run.  Errors: E_ARGUMENT, E_IMAGE; the
        localizer can go on with the next frame.
        """
        raw = self._made_result(self._no_result)
        with self._extracting, self._locating:
            owned, slot = self._alive(), self._locate_frame
            alive = slot.fill(frame)
            status = self._process(owned.pointer, slot.raw, raw)
            if status < 0 or self._callbacks.fault is not None:
                self._check(status)
        del alive
        return Result(raw)

    def make_features(self) -> Features:
        """Features of no frame yet, for this localizer and those of the same config."""
        self._alive()
        return Features(self._config)

    def extract(self, frame: Frame, features: Features) -> None:
        """The first half of process: fills the features by `color` and `views` of the frame.  May run beside all calls of
        the localizer but process, extract and close.  Errors: E_ARGUMENT, the features are of another config; E_IMAGE."""
        with self._extracting, features.turn.writing():
            pointer, slot = self._alive().pointer, self._extract_frame
            alive = slot.fill(frame)
            status = self._c.sphc_localizer_extract(pointer, slot.raw, features.owned().pointer)
            self._callbacks.raise_fault()
            features.check(status)
        del alive

    def locate(self, frame: Frame, features: Features) -> Result:
        """The second half of process; `color` and the images of `views` are not looked at.  The same result as of
        process.  Errors: as of process; E_ARGUMENT, the features have another color_time_ns; E_STATE, of no frame yet."""
        raw = self._made_result(self._no_result)
        with self._locating, features.turn.reading():
            pointer, slot = self._alive().pointer, self._locate_frame
            alive = slot.fill(frame)
            self._check(self._c.sphc_localizer_locate(pointer, slot.raw, features.owned().pointer, raw))
        del alive
        return Result(raw)

    def predict(self, time_ns: int) -> Prediction:
        """The pose at a time, in the time of frames: up to a second after the last pose, or up to 100 ms before it (where
        odometry goes on from it: before the last frame). prediction.known says whether there is one."""
        raw, at = _interface.sphc_localizer_prediction.from_buffer_copy(self._no_prediction), nanoseconds(time_ns, "time_ns")
        with self._locating:
            self._answer(self._c.sphc_localizer_predict(self._alive().pointer, at, raw), "sphc_localizer_predict")
        return Prediction(raw)

    def observations(self) -> npt.NDArray[np.void]:
        """What became of each keypoint of the last frame: an array of OBSERVATION; `flags` are ObservationFlag bits."""
        made, count = np.empty(self._config.max_keypoints, OBSERVATION), ctypes.c_uint32()
        raw = (_interface.sphc_localizer_observation * len(made)).from_address(made.ctypes.data)
        with self._locating:
            status = self._c.sphc_localizer_observations(self._alive().pointer, raw, made.itemsize, len(made), count)
            self._answer(status, "sphc_localizer_observations")
        return made[:count.value]

    def hypotheses(self) -> list[Hypothesis]:
        """The poses that the last frame may have, those of most gain first."""
        raw, count = (_interface.sphc_localizer_hypothesis * _interface.SPHC_HYPOTHESES_MAX)(), ctypes.c_uint32()
        size = ctypes.sizeof(_interface.sphc_localizer_hypothesis)
        with self._locating:
            status = self._c.sphc_localizer_hypotheses(self._alive().pointer, raw, size, len(raw), count)
            self._answer(status, "sphc_localizer_hypotheses")
        return [Hypothesis(hypothesis) for hypothesis in raw[:count.value]]

    def reset(self) -> None:
        """Forgets where the camera was, as after a long pause; what was learnt of the depth sensor stays."""
        with self._locating:
            self._c.sphc_localizer_reset(self._alive().pointer)

    # ---- for those who measure, and for the next start ----

    def set_parameter(self, parameter: Parameter, value: float) -> None:
        """From the next frame on.  Errors: E_ARGUMENT, out of parameter_range; E_UNSUPPORTED."""
        number, wanted = whole(parameter, "parameter", signed=True), real(value, "value")
        with self._locating:
            self._check(self._c.sphc_localizer_set_parameter(self._alive().pointer, number, wanted))

    def get_parameter(self, parameter: Parameter) -> float:
        """Error(E_UNSUPPORTED): the library does not know the parameter."""
        value, number = ctypes.c_double(), whole(parameter, "parameter", signed=True)
        with self._locating:
            status = self._c.sphc_localizer_get_parameter(self._alive().pointer, number, value)
            self._answer(status, f"the library knows no parameter {number}")
        return value.value

    def set_depth_bias(self, depth: DepthBias) -> None:
        """What is known of the depth sensor from before, such as result.depth of the last frame.  Learning goes on from
        there.  Error(E_ARGUMENT): it cannot be one of this config."""
        raw = of_type(depth, DepthBias, "depth").raw()
        with self._locating:
            self._check(self._c.sphc_localizer_set_depth_bias(self._alive().pointer, raw))

    def memory_pieces(self) -> list[MemoryPiece]:
        """An account of its memory."""
        self._alive()
        made, raw = list[MemoryPiece](), _interface.sphc_memory_piece()
        while self._c.sphc_localizer_memory_piece(self._config, len(made), raw) == Status.OK:
            made.append(MemoryPiece(raw.name.decode(), raw.bytes, bool(raw.scratch)))
        return made

    # ---- end ----

    def close(self) -> None:
        """Ends the localizer, after the call that may be running, and lets its maps go.  May be called twice."""
        with self._extracting, self._locating:
            if self._owned is not None:
                self._alive().end()
            self._owned = None

    def __enter__(self) -> Localizer:
        self._alive()
        return self

    def __exit__(self, kind: type[BaseException] | None, fault: BaseException | None,
                 trace: types.TracebackType | None) -> None:
        self.close()
