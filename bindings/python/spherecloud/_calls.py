"""How the library is called: failures become errors, memory is aligned, and calls take turns."""
from __future__ import annotations

import contextlib
import ctypes
import threading
import typing

import numpy as np
import numpy.typing as npt

from . import _interface
from .enums import Status
from .errors import Error

Bytes = npt.NDArray[np.uint8]


def check(status: int, message: _interface.sphc_message | str) -> None:
    """Raises the failure of a call; what is not below 0 is an answer."""
    if status < 0:
        text = message if isinstance(message, str) else message.text.decode(errors="replace")
        known = Status(status)
        raise Error(known, text or known.name)


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


def closed(what: str) -> Error:
    """What a call on an object gets that was closed."""
    return Error(Status.E_STATE, f"the {what} is closed; make a new one")
