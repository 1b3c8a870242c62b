#!/usr/bin/env python3
"""The command as it is installed: it audits by the networks that came with it.

    installed.py --build FOLDER
"""
import argparse
import pathlib
import shutil
import subprocess
import sys
import tempfile


def run(command, accepted=(0,)):
    result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
    if result.returncode not in accepted:
        sys.exit("ended with %d: %s\n%s%s" % (result.returncode, " ".join(map(str, command)), result.stdout,
                                              result.stderr))
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True, help="build tree, with everything built")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder).resolve()
        prefix, walk, room = folder / "prefix", folder / "walk", folder / "room.sphc"
        run(["cmake", "--install", arguments.build, "--prefix", prefix])
        tool, networks = prefix / "bin" / "spherecloud", prefix / "share" / "spherecloud" / "networks"
        run([tool, "simulate", "--frames", 6, "--rate", 6, "--out", walk])
        run([tool, "build", "--recording", walk, "--map", room])
        audit = [tool, "audit", room, "--quick", "--truth", folder / "spherecloud.ledger"]
        run(audit, accepted=(0, 4))  # 4: so few points may break a limit

        # Its own networks, not those of the source: with one missing it names the place.
        (networks / "co_occurrence.json").unlink()
        told = run(audit, accepted=(1,)).stderr
        if str(networks) not in told:
            sys.exit("with %s damaged the command says: %s" % (networks, told))
        # Without any it takes those of the source it was built from.
        shutil.rmtree(networks)
        run(audit, accepted=(0, 4))


if __name__ == "__main__":
    main()
