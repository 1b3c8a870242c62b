"""Pictures of what the localizer found, with matplotlib: pip install spherecloud[views]."""
from __future__ import annotations

import typing

import numpy as np
import numpy.typing as npt

from ._overlays import KINDS, as_rgb, best_kinds
from .images import Array, Image
from .poses import Rigid

try:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection
except ImportError as fault:
    raise ImportError("spherecloud.views draws with matplotlib: pip install spherecloud[views]") from fault


def draw_observations(axes: Axes, image: Array | Image, observations: npt.NDArray[np.void], camera: int = 0) -> None:
    """A frame's keypoints over its image, each at the size it was found at.

    `image`: (height, width) or (height, width, 3), red first, or an Image.  `observations`: those of
    Localizer.observations().  `camera`: whose image it is, 0 the colour camera.
    """
    pixels = as_rgb(image)
    height, width = pixels.shape[:2]
    axes.imshow(pixels, cmap="gray", extent=(0, width, height, 0))  # pixels begin at 0, and their centres are at 0.5
    seen = observations[observations["camera"] == camera]
    best = best_kinds(seen)
    for index, (_, color, name) in enumerate(KINDS):
        kept = seen[best == index]
        size = (axes.figure.dpi / 72 * kept["scale_px"]).clip(4) ** 2
        axes.scatter(kept["x_px"], kept["y_px"], s=size, facecolors="none", edgecolors=color)
        axes.plot([], [], "o", color=color, markerfacecolor="none", label=f"{len(kept)} {name}")
    axes.set(xlim=(0, width), ylim=(height, 0), xlabel="x [px]", ylabel="y [px]")
    _legend_below(axes)


def draw_trajectory(axes: Axes, poses: typing.Iterable[Rigid | None], up_map: npt.ArrayLike = (0, -1, 0),
                    view_m: float = 0.1) -> None:
    """A walk seen from above: the camera's centres, and where it looked, of poses camera_from_map in their order.

    None, of a frame without a pose, breaks the line.  `up_map`: upwards in the map's frame.  `view_m`: length of the
    line along which a camera looks.
    """
    up = np.asarray(up_map, float) / np.linalg.norm(up_map)
    aside = np.eye(3)[np.argmin(np.abs(up))]
    right = aside - (aside @ up) * up
    right /= np.linalg.norm(right)
    ground = np.stack([right, np.cross(up, right)])  # right and forward, of somebody who looks down
    walk = [pose.inverse() if pose is not None else None for pose in poses]
    centres = np.array([ground @ pose.t_m if pose else (np.nan, np.nan) for pose in walk]).reshape(-1, 2)
    ahead = np.array([ground @ (pose @ (0, 0, view_m)) if pose else (np.nan, np.nan) for pose in walk]).reshape(-1, 2)
    axes.plot(centres[:, 0], centres[:, 1], ".-", color="tab:blue", label=f"{sum(map(bool, walk))} of {len(walk)} frames")
    axes.add_collection(LineCollection(list(np.stack([centres, ahead], 1)), colors="tab:orange", linewidths=1, label="looks along"))
    axes.autoscale()
    axes.set_aspect("equal", adjustable="datalim")
    axes.set(xlabel="right [m]", ylabel="forward [m]")
    _legend_below(axes)


def _legend_below(axes: Axes) -> None:
    """Where it hides nothing."""
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4, frameon=False, fontsize="small")
