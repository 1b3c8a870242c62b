"""What pictures show of a frame, whoever draws them."""
from __future__ import annotations

import numpy as np
import numpy.typing as npt

from .enums import Format, ObservationFlag, Status
from .errors import Error
from .images import Array, Image

# What became of a keypoint, the least first: its flags, colour, and name.
KINDS = ((ObservationFlag(0), "#999999", "keypoint"), (ObservationFlag.LIFTED, "#1f77b4", "with depth"),
         (ObservationFlag.MATCHED, "#ff7f0e", "matched"), (ObservationFlag.INLIER, "#2ca02c", "inlier"))


def best_kinds(observations: npt.NDArray[np.void]) -> npt.NDArray[np.int64]:
    """Of each keypoint the last of KINDS that holds."""
    return np.array([max(index for index, (flag, _, _) in enumerate(KINDS) if not flag or flags & flag)
                     for flags in observations["flags"]], np.int64)


def as_rgb(image: Array | Image) -> Array:
    """The pixels, grey or with red first.  Error(E_UNSUPPORTED): they are of another format."""
    if not isinstance(image, Image):
        return image
    if image.format not in (Format.GRAY8, Format.RGB8, Format.BGR8, Format.RGBA8):
        raise Error(Status.E_UNSUPPORTED, f"an image of {image.format.name} is not shown; give an array of grey, RGB or RGBA")
    return image.data[..., ::-1] if image.format == Format.BGR8 else image.data
