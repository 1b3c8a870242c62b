"""python -m spherecloud: the command `spherecloud`, from the wheel where it carries one, else the installed one."""
from __future__ import annotations

import os
import pathlib
import shutil
import sys


def command() -> str | None:
    packaged = pathlib.Path(__file__).parent / "bin" / "spherecloud"
    return str(packaged) if os.access(packaged, os.X_OK) else shutil.which("spherecloud")


def main() -> None:
    found = command()
    if found is None:
        sys.exit("python -m spherecloud: the command `spherecloud` is neither in this package nor in PATH; "
                 "install Debian's spherecloud-tools, or build it as docs/install.md says")
    os.execv(found, [found, *sys.argv[1:]])


if __name__ == "__main__":
    main()
