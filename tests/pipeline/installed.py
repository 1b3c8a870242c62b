#!/usr/bin/env python3
"""The command as it is installed: its own networks, and what it says of a map that is none.

    installed.py --prefix FOLDER
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

sys.dont_write_bytecode = True
from recordings import ran


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--prefix", required=True, help="an installation; it is copied, since networks are taken out of it")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder).resolve()
        prefix, walk, room = folder / "prefix", folder / "walk", folder / "room.sphc"
        shutil.copytree(arguments.prefix, prefix, symlinks=True)
        tool, networks = prefix / "bin" / "spherecloud", prefix / "share" / "spherecloud" / "networks"
        ran([tool, "simulate", "--frames", 6, "--rate", 6, "--out", walk])
        ran([tool, "build", "--recording", walk, "--map", room])
        for command in (["info", walk], ["inspect", walk], ["audit", walk], ["localize", "--recording", walk, "--map", walk],
                        ["live", "--device", "replay:%s" % walk, "--map", walk]):
            told = ran([tool, *command], accepted=(1,)).stderr
            if "%s is a folder; give the map file" % walk not in told:
                sys.exit("a folder in the map's place is not named by %s: %s" % (command[0], told))
        told = ran([tool, "info", "/dev/null"], accepted=(1,)).stderr
        if "/dev/null is a device or a pipe; give the map file" not in told:
            sys.exit("a device in the map's place is not named: %s" % told)

        audit = [tool, "audit", room, "--quick", "--truth", folder / "spherecloud.ledger"]
        ran(audit, accepted=(0, 4))  # 4: so few points may break a limit

        # Its own networks: with one missing it names the place.
        (networks / "co_occurrence.json").unlink()
        told = ran(audit, accepted=(1,)).stderr
        if str(networks) not in told:
            sys.exit("with %s damaged the command says: %s" % (networks, told))
        # Without any it says what was not measured, and does not pass.
        shutil.rmtree(networks)
        found = json.loads(ran([*audit, "--json"], accepted=(4, 5)).stdout)
        if found["not_measured"] != ["real_or_fake.auc", "inversion.of_papers", "inversion.of_papers_fine"]:
            sys.exit("without networks it misses %s" % found["not_measured"])


if __name__ == "__main__":
    main()
