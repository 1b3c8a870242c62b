"""The shared library: where it is, and whether it is one that this package can use."""
from __future__ import annotations

import ctypes
import os
import pathlib
import sys
import threading

from . import _interface
from .enums import Status
from .errors import Error, LibraryError

VARIABLE = "SPHERECLOUD_LIBRARY"
PACKAGED = pathlib.Path(__file__).parent / "lib"  # of a wheel that carries the library
# In a wheel, and as the system's loader knows it.
FILE, INSTALLED = {
    "win32": ("spherecloud.dll", "spherecloud.dll"),
    "darwin": ("libspherecloud.dylib", f"libspherecloud.{_interface.SPHC_ABI}.dylib"),
}.get(sys.platform, ("libspherecloud.so", f"libspherecloud.so.{_interface.SPHC_ABI}"))

_loaded: _interface.Interface | None = None
_path = ""
_lock = threading.Lock()


def places(explicit: str | None = None) -> list[str]:
    """Where the library is looked for, in order.  A place that somebody names is the only one."""
    named = explicit or os.environ.get(VARIABLE)
    return [named] if named else [str(PACKAGED / FILE), INSTALLED]


def _opened(place: str) -> ctypes.CDLL:
    if pathlib.Path(place).parent == PACKAGED:  # what the library needs lies beside it
        for needed in sorted(PACKAGED.glob("*.so*")):
            if needed.name != FILE:
                ctypes.CDLL(str(needed), mode=ctypes.RTLD_GLOBAL)
    return ctypes.CDLL(place)


def _checked(library: ctypes.CDLL, place: str) -> _interface.Interface:
    """The library's functions, if it is of this ABI."""
    try:
        library.sphc_abi.restype, library.sphc_version_string.restype = ctypes.c_uint32, ctypes.c_char_p
        abi, version = library.sphc_abi(), library.sphc_version_string().decode()
    except AttributeError as fault:
        raise LibraryError(f"{place} is not the library spherecloud: {fault}; name another in {VARIABLE}") from None
    if abi != _interface.SPHC_ABI:
        raise LibraryError(f"{place} has version {version} and ABI {abi}, and this package is for version {_interface.VERSION} and ABI "
                           f"{_interface.SPHC_ABI}; install the package and the library of one release")
    try:
        return _interface.Interface(library)
    except AttributeError as fault:
        raise LibraryError(f"{place} of version {version} is older than this package: {fault}; update the library") from None


def load(path: str | os.PathLike[str] | None = None) -> _interface.Interface:
    """Loads the library: from `path`; else as SPHERECLOUD_LIBRARY says; else from the wheel; else the installed one.

    The first use of the package does this by itself.  Call it before, to name a path.  LibraryError: there is none,
    or it is not one that this package can use.  Error(E_STATE): another one is loaded already.
    """
    global _loaded, _path
    explicit = os.fspath(path) if path is not None else None
    with _lock:
        if _loaded is not None:
            if explicit is not None and explicit != _path:
                raise Error(Status.E_STATE, f"the library was loaded from {_path} already; load {explicit} before anything "
                                            "else of spherecloud")
            return _loaded
        tried = []
        for place in places(explicit):
            try:
                library = _opened(place)
            except OSError as fault:
                tried.append(f"  {place}: {fault}")
                continue
            _loaded, _path = _checked(library, place), place
            return _loaded
    raise LibraryError("the library spherecloud was not found; looked at\n" + "\n".join(tried) +
                       f"\nInstall it, or set {VARIABLE} to the path of {FILE}, or install a wheel that carries it.")


def interface() -> _interface.Interface:
    """The functions of the library, which is loaded at the first call."""
    return _loaded or load()


def path() -> str:
    """Where the library was loaded from."""
    load()
    return _path


def version() -> str:
    """The version of the library, "major.minor.patch"."""
    text: bytes = interface().sphc_version_string()
    return text.decode()
