#!/usr/bin/env python3
"""Makes a short recording of the simulated headset and a map of it, and hands both to openni2_poses.

    openni2.py --spherecloud BIN --poses BIN
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

from private_key import private_key


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--poses", required=True)
    tools = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        recording, map_file = pathlib.Path(folder) / "recording", pathlib.Path(folder) / "room.sphc"
        commands = [
            [tools.spherecloud, "simulate", "--out", recording, "--frames", 10, "--rate", 6.25],
            [tools.spherecloud, "build", "--recording", recording, "--step", 3, "--map", map_file, "--eta", 0.5,
             "--key", private_key(folder)],
            [tools.poses, recording, map_file],
        ]
        for command in commands:
            result = subprocess.run([str(part) for part in command], text=True, capture_output=True)
            if result.returncode != 0:
                sys.exit("failed: %s\n%s%s" % (" ".join(map(str, command)), result.stdout, result.stderr))
        print(result.stdout, end="")


if __name__ == "__main__":
    main()
