"""What can go wrong."""
from __future__ import annotations

from .enums import Status


class Error(Exception):
    """A call failed.  `status` says what kind of failure it is; `message` names cause and cure.

    Branch on the status alone, since the text may change.  SPHC_NOT_LOCALIZED is an answer and never an Error.
    """

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(status, message)
        self.status, self.message = status, message

    def __str__(self) -> str:
        return f"{self.message} [SPHC_{self.status.name}]"


class LibraryError(ImportError):
    """The library spherecloud is missing, or it is not one that this package can use."""
