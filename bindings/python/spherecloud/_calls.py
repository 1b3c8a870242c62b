"""How the library is called: failures become errors, memory is aligned, and calls take turns."""
from __future__ import annotations

import contextlib
import ctypes
import operator
import threading
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from .enums import Status
from .errors import Error

Bytes = npt.NDArray[np.uint8]
Kind = typing.TypeVar("Kind")


def check(status: int, message: _interface.sphc_message | str) -> None:
    """Raises the failure of a call; what is not below 0 is an answer."""
    if status < 0:
        text = message if isinstance(message, str) else message.text.decode(errors="replace")
        known = Status(status)
        raise Error(known, text or known.name)


def whole(value: typing.SupportsIndex, name: str, bits: int = 32, signed: bool = False) -> int:
    """The integer, if a field of so many bits holds it; ctypes would cut it.  ValueError, TypeError otherwise."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is a whole number, not {type(value).__name__}") from None
    lowest, beyond = (-(1 << bits - 1), 1 << bits - 1) if signed else (0, 1 << bits)
    if not lowest <= number < beyond:
        raise ValueError(f"{name} is {number}; it must be {lowest} to {beyond - 1}")
    return number


def nanoseconds(value: typing.SupportsIndex, name: str) -> int:
    return whole(value, name, 64, signed=True)


def real(value: float, name: str) -> float:
    """The number; TypeError for what is none, also for the text of one."""
    try:
        return ctypes.c_double(value).value
    except TypeError:
        raise TypeError(f"{name} is a number, not {type(value).__name__}") from None


def configure(config: typing.Any, given: typing.Mapping[str, typing.Any]) -> None:
    """Sets what is not None.  ValueError where a field cannot hold its integer, TypeError where it holds no such thing."""
    for name, value in given.items():
        if value is None:
            continue
        try:
            setattr(config, name, value)
        except TypeError as error:
            raise TypeError(f"{name} is {value!r}: {error}") from None
        if hasattr(value, "__index__") and getattr(config, name) != value:
            raise ValueError(f"{name} is {value}, which is beyond its field of the library")


def of_type(value: typing.Any, kind: type[Kind], name: str, cure: str = "") -> Kind:
    """The value, if it is of the type; TypeError otherwise."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} is a {kind.__name__}, not {type(value).__name__}{cure}")
    return value


def aligned(size: int, alignment: int) -> Bytes:
    """`size` bytes at a multiple of `alignment`."""
    block = np.empty(size + alignment, np.uint8)
    start = -block.ctypes.data % alignment
    return block[start:start + size]


class Owned:
    """An instance of the library in memory of its own; it ends when nobody has it any more, or by `end`."""

    def __init__(self, fini: typing.Any, *memory: Bytes) -> None:
        self.pointer = ctypes.c_void_p()
        self.keeps: dict[object, object] = {}  # what the instance borrows
        self._fini, self._memory = fini, memory

    def end(self) -> None:
        if self.pointer.value:
            self._fini(ctypes.byref(self.pointer))

    __del__ = end


class SharedTurn:
    """Lets several threads in that read, or one that writes."""

    def __init__(self, of: str) -> None:
        self._of, self._changed, self._writing, self._inside = of, threading.Condition(), False, list[int]()

    def reading(self) -> typing.ContextManager[None]:
        return self._turn(writes=False)

    def writing(self) -> typing.ContextManager[None]:
        return self._turn(writes=True)

    @contextlib.contextmanager
    def _turn(self, writes: bool) -> typing.Iterator[None]:
        thread = threading.get_ident()
        with self._changed:
            if thread in self._inside:
                raise Error(Status.E_STATE, f"the {self._of} are in a call of this thread; do not call them from callbacks")
            self._changed.wait_for(lambda: not (self._writing or (writes and self._inside)))
            self._inside.append(thread)
            self._writing = writes
        try:
            yield
        finally:
            with self._changed:
                self._inside.remove(thread)
                self._writing = False
                self._changed.notify_all()


def closed(what: str, verb: str = "is") -> Error:
    """What a call on an object gets that was closed."""
    return Error(Status.E_STATE, f"the {what} {verb} closed; make a new one")
