#!/usr/bin/env python3
"""Installs a build once for the tests of this folder, and moves the installation away from where it was installed to.

    install.py --build BUILD --prefix PREFIX
"""
import argparse
import shutil
import subprocess
from pathlib import Path

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, required=True)
    parser.add_argument("--prefix", type=Path, required=True)
    options = parser.parse_args()
    before = options.prefix.with_name("before")
    shutil.rmtree(options.prefix, ignore_errors=True)
    shutil.rmtree(before, ignore_errors=True)
    subprocess.run(["cmake", "--install", options.build, "--prefix", before], check=True)
    before.rename(options.prefix)
