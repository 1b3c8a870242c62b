"""Options of the scripts that measure simulated rooms, and the folder that they work in."""
import argparse
import contextlib
import pathlib
import tempfile


def parser_of(script, results, rooms):
    """`script`: what it does, in words; `results`: the file that it writes; `rooms`: how many there are."""
    parser = argparse.ArgumentParser(description=script, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True, help="the command")
    parser.add_argument("--results", type=pathlib.Path, default=results, help="the file to write [%s]" % results.name)
    parser.add_argument("--rooms", type=int, default=rooms, choices=range(1, rooms + 1), metavar="N", help="how many [%d]" % rooms)
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="where recordings and maps are kept")
    return parser


@contextlib.contextmanager
def folder_of(keep):
    """`keep`, or one that is gone afterwards."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        yield folder
