"""Rigid transforms, and poses as other systems state them."""
from __future__ import annotations

import ctypes
import dataclasses
import math
import struct
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from ._calls import check, of_type, whole
from ._library import interface
from .enums import Convention

Floats = npt.NDArray[np.float64]


def numbers(values: typing.Iterable[float], count: int, what: str) -> tuple[float, ...]:
    try:
        made = tuple(float(value) for value in values)
    except (TypeError, ValueError):
        raise TypeError(f"{what} has {count} numbers, and is {values!r}") from None
    if len(made) != count:
        raise ValueError(f"{what} has {count} numbers, not {len(made)}")
    return made


_UNPACK = struct.Struct("7d").unpack_from  # of a sphc_rigid


@dataclasses.dataclass(frozen=True)
class Rigid:
    """A rigid transform, named target_from_source everywhere: x_target = R(q) x_source + t.

    `q_wxyz` is a unit quaternion, real part first; `t_m` is in metres.  Without arguments it is the identity.
    """

    q_wxyz: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0)
    t_m: tuple[float, ...] = (0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        object.__setattr__(self, "q_wxyz", numbers(self.q_wxyz, 4, "q_wxyz"))
        object.__setattr__(self, "t_m", numbers(self.t_m, 3, "t_m"))

    @staticmethod
    def of(raw: _interface.sphc_rigid) -> Rigid:
        made = Rigid.__new__(Rigid)  # not by __init__, which checks what people give
        numbers = _UNPACK(raw)
        made.__dict__.update(q_wxyz=numbers[:4], t_m=numbers[4:])
        return made

    def raw(self) -> _interface.sphc_rigid:
        return _interface.sphc_rigid(self.q_wxyz, self.t_m)

    @staticmethod
    def from_matrix(target_from_source: npt.ArrayLike) -> Rigid:
        """Of a 4 x 4 (or 3 x 4) matrix whose rotation has no scale and no mirror; ValueError otherwise."""
        matrix = np.asarray(target_from_source, np.float64)
        if matrix.shape not in ((4, 4), (3, 4)):
            raise ValueError(f"a rigid transform is a matrix of 4 x 4 or 3 x 4, not {matrix.shape}")
        r = matrix[:3, :3]
        if not np.allclose(r @ r.T, np.eye(3), atol=1e-6) or np.linalg.det(r) < 0:
            raise ValueError("the first 3 rows and columns are no rotation: they scale, shear or mirror")
        # Of each part of the quaternion its product with the largest one, which no rounding can hurt.
        products = np.array([[1 + r[0, 0] + r[1, 1] + r[2, 2], r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]],
                             [r[2, 1] - r[1, 2], 1 + r[0, 0] - r[1, 1] - r[2, 2], r[1, 0] + r[0, 1], r[0, 2] + r[2, 0]],
                             [r[0, 2] - r[2, 0], r[1, 0] + r[0, 1], 1 - r[0, 0] + r[1, 1] - r[2, 2], r[2, 1] + r[1, 2]],
                             [r[1, 0] - r[0, 1], r[0, 2] + r[2, 0], r[2, 1] + r[1, 2], 1 - r[0, 0] - r[1, 1] + r[2, 2]]])
        row = products[np.argmax(np.diag(products))]
        return Rigid(tuple(row / np.linalg.norm(row)), tuple(matrix[:3, 3]))

    def rotation(self) -> Floats:
        """The 3 x 3 rotation matrix.  The quaternion is normalised, as by the library, and one of zeros is the identity."""
        length = math.hypot(*self.q_wxyz) or 1.0
        w, x, y, z = (part / length for part in self.q_wxyz)
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    def matrix(self) -> Floats:
        """The 4 x 4 matrix, for homogeneous points in columns."""
        made = np.eye(4)
        made[:3, :3], made[:3, 3] = self.rotation(), self.t_m
        return made

    def inverse(self) -> Rigid:
        """source_from_target."""
        made = _interface.sphc_rigid()
        interface().sphc_rigid_inverse(self.raw(), made)
        return Rigid.of(made)

    @typing.overload
    def __matmul__(self, other: Rigid) -> Rigid: ...

    @typing.overload
    def __matmul__(self, other: npt.ArrayLike) -> Floats: ...

    def __matmul__(self, other: Rigid | npt.ArrayLike) -> Rigid | Floats:
        """c_from_b @ b_from_a is c_from_a.  With points (..., 3) in metres: the points in the target frame."""
        if isinstance(other, Rigid):
            made = _interface.sphc_rigid()
            interface().sphc_rigid_compose(self.raw(), other.raw(), made)
            return Rigid.of(made)
        moved: Floats = np.asarray(other, np.float64) @ self.rotation().T + np.asarray(self.t_m)
        return moved


# ---- conventions ----

_Seven = ctypes.c_double * 7
_Three = ctypes.c_double * 3


def _number(convention: Convention) -> int:
    return whole(convention, "convention", signed=True)


def _raw(world_from_map: Rigid | None) -> _interface.sphc_rigid | None:
    return of_type(world_from_map, Rigid, "world_from_map").raw() if world_from_map is not None else None


def make_world(convention: Convention, up_map: typing.Iterable[float]) -> Rigid:
    """world_from_map of a gravity-aligned world with the map's origin.

    `up_map` is upwards in the map's frame, of any length but 0.  docs/frames.md.  Error(E_ARGUMENT): not finite, or 0.
    """
    made, message = _interface.sphc_rigid(), _interface.sphc_message()
    up = _Three(*numbers(up_map, 3, "up_map"))
    check(interface().sphc_convention_make_world(_number(convention), up, made, message), message)
    return Rigid.of(made)


def write_camera(convention: Convention, camera_from_map: Rigid, world_from_map: Rigid | None = None) -> Floats:
    """A camera's pose as seven numbers in the convention's order.

    None is the map's own frame, for COLMAP and TUM alone.  Error(E_ARGUMENT): not finite, or beyond a limit.
    """
    pose, message = _Seven(), _interface.sphc_message()
    camera = of_type(camera_from_map, Rigid, "camera_from_map").raw()
    check(interface().sphc_convention_write_camera(_number(convention), _raw(world_from_map), camera, pose, message), message)
    return np.array(pose)


def read_camera(convention: Convention, pose: typing.Iterable[float], world_from_map: Rigid | None = None) -> Rigid:
    """camera_from_map of seven numbers in the convention's order.  Errors as of write_camera."""
    made, message = _interface.sphc_rigid(), _interface.sphc_message()
    seven = _Seven(*numbers(pose, 7, "pose"))
    check(interface().sphc_convention_read_camera(_number(convention), _raw(world_from_map), seven, made, message), message)
    return Rigid.of(made)


def write_map(convention: Convention, world_from_map: Rigid) -> Floats:
    """The map's pose in the other system's world, as seven numbers in its order.  Errors as of write_camera."""
    pose, message = _Seven(), _interface.sphc_message()
    world = of_type(world_from_map, Rigid, "world_from_map").raw()
    check(interface().sphc_convention_write_map(_number(convention), world, pose, message), message)
    return np.array(pose)


def read_map(convention: Convention, pose: typing.Iterable[float]) -> Rigid:
    """world_from_map of seven numbers in the convention's order.  Errors as of write_camera."""
    made, message = _interface.sphc_rigid(), _interface.sphc_message()
    seven = _Seven(*numbers(pose, 7, "pose"))
    check(interface().sphc_convention_read_map(_number(convention), seven, made, message), message)
    return Rigid.of(made)
