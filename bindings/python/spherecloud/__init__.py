"""Where a headset is, from a colour and a depth image and a map that holds no 3D geometry.

    from spherecloud import Camera, Frame, Localizer, Map, Rig

    rig = Rig(Camera.pinhole(640, 480, 500, 500, 320, 240), Camera.pinhole(320, 240, 200, 200, 160, 120))
    with Map.open("room.sphc") as map, Localizer(rig, map) as localizer:
        result = localizer.process(Frame(color, depth, color_time_ns, depth_time_ns))
        if result.pose:
            print(result.pose.matrix())

`target_from_source` everywhere; camera axes are OpenCV's; metres, nanoseconds, radians and pixels.
"""
from ._answers import KEYPOINT, OBSERVATION
from ._interface import SPHC_CAMERAS_MAX as CAMERAS_MAX
from ._interface import SPHC_DEPTH_CAMERAS_MAX as DEPTH_CAMERAS_MAX
from ._interface import SPHC_MAP_NONE as MAP_NONE
from ._interface import SPHC_MAPS_MAX as MAPS_MAX
from ._interface import VERSION as __version__
from ._library import load, version
from .alignment import Aligned, Aligner
from .cameras import Camera, Rig
from .enums import (AlignedPixel, Band, CameraModel, Convention, Cut, Event, Fault, Format, Hint, LogLevel, Mode,
                    ObservationFlag, Outcome, Parameter, PriorPart, State, Status)
from .errors import Error, LibraryError
from .features import FeatureArrays, Features
from .frames import DepthView, Frame, Prior, RigCamera, RigDepthCamera, View
from .images import Image
from .localizer import Localizer, to_logging
from .maps import Map, MapInfo, extractor_id
from .poses import Rigid, make_world, read_camera, read_map, write_camera, write_map
from .recordings import RecordedFrame, Recording
from .results import DepthBias, Hypothesis, MemoryPiece, ParameterRange, Prediction, Result, parameter_range

__all__ = [
    "Aligned", "AlignedPixel", "Aligner", "Band", "CAMERAS_MAX", "Camera", "CameraModel", "Convention", "Cut",
    "DEPTH_CAMERAS_MAX", "DepthBias", "DepthView", "Error", "Event", "Fault", "FeatureArrays", "Features", "Format", "Frame", "Hint", "Hypothesis",
    "Image", "KEYPOINT", "LibraryError", "Localizer", "LogLevel", "MAPS_MAX", "MAP_NONE", "Map", "MapInfo",
    "MemoryPiece", "Mode", "OBSERVATION", "ObservationFlag", "Outcome", "Parameter", "ParameterRange",
    "Prediction", "Prior", "PriorPart", "RecordedFrame", "Recording", "Result", "Rig", "RigCamera", "RigDepthCamera", "Rigid", "State", "Status", "View",
    "__version__", "extractor_id", "load", "make_world", "parameter_range", "read_camera", "read_map",
    "to_logging", "version", "write_camera", "write_map",
]
