#!/usr/bin/env python3
"""Makes a short recording of the simulated headset and a map of it, and hands both to openni2_poses.

    openni2.py --spherecloud BIN --poses BIN
"""
import argparse
import pathlib
import tempfile

from private_key import private_key
from recordings import ran


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
            result = ran(command)
        print(result.stdout, end="")


if __name__ == "__main__":
    main()
