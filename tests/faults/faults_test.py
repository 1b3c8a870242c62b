#!/usr/bin/env python3
"""A command that is careless with its file has every defect that faults.py looks for."""
import argparse
import dataclasses
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
from faults import Server, changed_kinds, measure, some_of
from scenarios import Scenario

EXPECTED = [("write", 1, 28, "neither the old nor the new"), ("write", 2, 28, "exit status 0 without out"),
            ("write", 2, "kill", "neither the old nor the new"), ("write", 1, "torn", "neither the old nor the new"),
            ("write", 1, "short", "neither the old nor the new"), ("open", 1, 5, "exit status 0 without out"),
            ("malloc", 1, 12, "ended by SIGSEGV")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--careless", required=True, type=pathlib.Path)
    parser.add_argument("--library", required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    assert some_of(range(1, 8), 2) == [1, 2, 3, 5, 6, 7] and some_of(range(1, 1001), 50)[-1] == 1000
    assert some_of(range(1, 3), 2) == [1, 2] and some_of([], 50) == [] and some_of(range(3), None) == [0, 1, 2]
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        scenario = Scenario("careless", [], lambda folder: (folder / "out").write_text("old"))
        server = Server(arguments.careless, arguments.library, scenario, folder / "careless")
        assert server.counts["malloc"] == 2 and server.allocations == [1, 2]
        again = Server(arguments.careless, arguments.library, scenario, folder / "known", server.chains)
        assert again.allocations == []
        again.close()
        by_chains = Server(arguments.careless, arguments.library, dataclasses.replace(scenario, by_chains=True), folder / "chains")
        assert by_chains.allocations == [1], "both have one chain of callers"
        by_chains.close()
        for call, at, fault, expected in EXPECTED:
            became, defects = server.judge(call, at, fault)
            assert any(expected in defect for defect in defects), (call, at, fault, became, defects)
        assert server.run("malloc", 0, 0) == 0
        whole = (server.folder / "out").read_bytes()
        for left, told, expected in ((whole, "cannot name /x/out.part out: no; it is whole", []), (whole[:-1], "cannot name /x/out.part out: no; it is whole", ["out.part is left"]),
                                     (whole, "cannot name /x/other.part out: no; it is whole", ["out.part is left"])):
            (server.folder / "out.part").write_bytes(left)
            pathlib.Path(str(server.folder) + ".err").write_text(told)
            assert list(server.defects_of_files(False)) == expected, (left, told)
        rows = list(measure(server, None, ["write"], False))
        kinds = list(changed_kinds({"careless": rows}, {"careless": [["careless", "sync"]]}))
        assert kinds == ["careless makes no call sync any more, or it is not seen", "careless has no row of call write in the ledger"], kinds
        server.counts["write"] = 0
        assert not list(measure(server, None, ["write"], False)), "what is not called has no row"
        server.close()


if __name__ == "__main__":
    main()
