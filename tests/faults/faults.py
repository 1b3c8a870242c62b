#!/usr/bin/env python3
"""What is left of a command's files when a call of the system fails, or the process is killed there?

    faults.py --spherecloud BIN --library fail_call.so              every command; rewrites faults.csv after each, for review
    faults.py --spherecloud BIN --library fail_call.so --quick      a few commands and calls, for the tests
    faults.py ... --only build --show                               one command; each defect with its run

Every call of each kind fails, in a run of its own; of commands with long runs the first allocation of each chain of callers.
After each run a file is the old one or the new one, to the bit; nothing else lies there; the ledger knows the map; stderr says why.
docs/testing.md says more.
"""
import argparse
import collections
import csv
import errno
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
PIPELINE = HERE.parent / "pipeline"
sys.dont_write_bytecode = True
sys.path.insert(1, str(PIPELINE))
from recordings import write_csv
from scenarios import Scenarios

RESULTS = PIPELINE / "faults.csv"
FAULTS = {  # what each call is made to do; a + is a fault that stays
    "malloc": [errno.ENOMEM, "%d+" % errno.ENOMEM],
    "open": [errno.EMFILE, errno.EIO],
    "read": [errno.EIO, errno.EINTR, "short"],
    "write": [errno.ENOSPC, "%d+" % errno.ENOSPC, errno.EINTR, "short", "kill", "torn"],
    "sync": [errno.EIO, "kill"],
    "rename": [errno.EIO, "kill"],
    "close": [errno.EIO, "kill"],
    "mmap": [errno.ENOMEM],
    "truncate": [errno.EIO, "kill"],
    "mkdir": [errno.ENOSPC, "kill"],
    "unlink": [errno.EIO, "kill"],
    "ioctl": [errno.EIO, errno.EINTR],
}
KILLS = ("kill", "torn")
EVERY_COMMAND = "version"  # does what every command does before it begins
UNFINISHED = re.compile(r"\.part(/|$)|\.unfinished$")  # what a killed process may leave
COLUMNS = ["command", "call", "fault", "calls", "tried", "refused", "done", "killed", "defects"]


def fault_name(fault):
    text = str(fault)
    return errno.errorcode[int(text.rstrip("+"))] + (" for good" if text.endswith("+") else "") if text.rstrip("+").isdigit() else text


def firsts(calls):
    """The first of each chain."""
    return {chain: call for call, chain in reversed(sorted(calls))}.values()


def some_of(calls, most):
    """At most `most` from the beginning, evenly between, and from the end; None: all."""
    if most is None or len(calls) <= 2 * most:
        return list(calls)
    middle = calls[most:-most]
    return [*calls[:most], *middle[::-(-len(middle) // most)], *calls[-most:]]


def ledger_text(path):
    """What a ledger says, without the time, and without the checksum over it; a journal is rolled back in a copy."""
    with tempfile.TemporaryDirectory() as scratch:
        copy = pathlib.Path(scratch) / "ledger"
        shutil.copy(path, copy)
        journal = pathlib.Path(str(path) + "-journal")
        if journal.exists():
            shutil.copy(journal, str(copy) + "-journal")
        with sqlite3.connect(copy) as database:
            if database.execute("PRAGMA integrity_check").fetchone() != ("ok",):
                return "damaged"
            has_tables = database.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
            if not has_tables or database.execute("SELECT count(*) FROM place").fetchone() == (0,):
                return None  # nothing was released by it: it is as good as none
            database.execute("UPDATE release SET time_s = 0")
            database.execute("UPDATE checksum SET crc32 = 0")
            return "\n".join(database.iterdump())


def digest(path):
    if path.suffix == ".ledger":
        return ledger_text(path)
    return hashlib.sha256(path.read_bytes()).hexdigest()


def state_of(folder):
    """File and content; a ledger's journal is part of the ledger."""
    files = [path for path in sorted(folder.rglob("*")) if path.is_file() and not path.name.endswith("-journal")]
    contents = {str(path.relative_to(folder)): digest(path) for path in files}
    return {name: content for name, content in contents.items() if content}


def is_whole(path, bytes_of_whole):
    """Of a file that holds a time, a drawn key or a nonce, and so is another one in each run."""
    if path.suffix in (".enc", ".key", ".pub"):
        return path.stat().st_size == bytes_of_whole
    text = path.read_bytes()
    if path.suffix == ".json":
        return isinstance(json.loads(text), (dict, list))
    if path.suffix == ".jsonl":
        return text.endswith(b"\n") and all(json.loads(line) for line in text.splitlines())
    ends = {".html": b"</html>", ".svg": b"</svg>", ".png": b"IEND\xaeB`\x82"}
    return len(text) > 0 and text.rstrip().endswith(ends.get(path.suffix, b""))


LEFT_OUT = re.compile(r"unreadable|left out|cannot be read|not be read|: out of memory")  # frames that a command goes on without, and says so


def notes_of(said):
    return collections.Counter(LEFT_OUT.findall(said))


def released_crcs(ledger):
    with sqlite3.connect("file:%s?mode=ro" % ledger, uri=True) as database:
        return {row[0] for row in database.execute("SELECT crc32 FROM release")}


class Server:
    """A command with its libraries loaded, which runs once for each line."""

    def __init__(self, tool, library, scenario, scratch, of_every_command=frozenset(), of_long_runs=frozenset()):
        self.scenario, self.folder, self.old = scenario, scratch / "run", scratch / "old"
        self.old.mkdir(parents=True)
        scenario.prepare(self.old)
        environment = dict(os.environ, LD_PRELOAD=str(library), PATH="/nonexistent", OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
        command = [str(part) for part in (tool, *scenario.arguments)]
        self.process = subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.before = state_of(self.old)
        self.after, again = self.golden(), self.golden()
        self.bytes = {name: (self.folder / name).stat().st_size for name in again}
        self.usual = notes_of(self.said_all())
        self.varies = {name for name in self.after if self.after[name] != again.get(name)}
        self.counts = {name: int(count) for name, count in (line.split() for line in self.said(".calls").splitlines())}
        allocations = [(int(call), chain) for call, chain in (line.split() for line in self.said(".chains").splitlines())]
        self.chains = {chain for _, chain in allocations}
        known = of_every_command | of_long_runs if scenario.by_chains else of_every_command
        unknown = [(call, chain) for call, chain in allocations if chain not in known]
        self.allocations = sorted(firsts(unknown) if scenario.by_chains else (call for call, _ in unknown))

    def golden(self):
        status = self.run("malloc", 0, 0)
        if status != 0:
            raise SystemExit("%s fails by itself: %s" % (self.scenario.name, self.said(".err")))
        return state_of(self.folder)

    def run(self, call, at, fault, again=False):
        """The status of a fresh run, or of one on what the last left; negative: the signal."""
        if not again:
            shutil.rmtree(self.folder, ignore_errors=True)
            shutil.copytree(self.old, self.folder)
        self.process.stdin.write("%s %s %d %s\n" % (self.folder, call, at, fault))
        self.process.stdin.flush()
        return os.waitstatus_to_exitcode(int(self.process.stdout.readline()))

    def calls(self, kind):
        """Those that fail."""
        return self.allocations if kind == "malloc" else range(1, self.counts[kind] + 1)

    def said(self, ending):
        return pathlib.Path(str(self.folder) + ending).read_text(errors="replace")

    def said_all(self):
        return self.said(".err") + self.said(".out")

    def close(self):
        self.process.stdin.close()
        self.process.wait()

    def is_new(self, name, now):
        return now.get(name) == self.after[name] or (name in self.varies and name in now and is_whole(self.folder / name, self.bytes[name]))

    def is_less(self):
        """Frames could not be read, the command said so and went on without them.  What it says in every run counts for nothing."""
        return bool(notes_of(self.said_all()) - self.usual)

    def is_ended(self):
        """Memory ran out where no exception may be thrown, as in a destructor, and the process ended there, as by a kill."""
        return "not enough memory" in self.said(".err") and not re.search("^spherecloud: ", self.said(".err"), re.MULTILINE)

    def is_told_whole(self, name, content):
        """A recording that could not be given its name, is all there under that of its part, and the message says so."""
        before, part, behind = name.partition(".part")
        is_told = part and re.search(r"cannot name \S*%s .*; it is whole" % re.escape(before + part), self.said(".err"))
        return bool(is_told) and content == self.after.get(before + behind)

    def defects_of_files(self, allows_unfinished):
        now = state_of(self.folder)
        for name, content in now.items():
            if (allows_unfinished and UNFINISHED.search(name)) or self.is_told_whole(name, content):
                continue
            if name not in self.after and name not in self.before:
                yield "%s is left" % name
            elif content != self.before.get(name) and not (name in self.after and (self.is_new(name, now) or self.is_less())):
                yield "%s is neither the old nor the new one" % name
        for name in self.before:
            if name in self.after and name not in now and not name.startswith("report/"):  # pictures of an old one go first
                yield "%s is gone" % name
        for path in self.folder.glob("*.sphc"):
            if zlib.crc32(path.read_bytes()) not in released_crcs(path.parent / "spherecloud.ledger"):
                yield "the ledger does not know %s" % path.name

    def defects_of_message(self, call):
        said = self.said(".err")
        if not said.strip():
            yield "no message"
        if call == "malloc" and "memory" not in said:
            yield "the message does not say that there was no memory: " + said.strip()
        if self.scenario.secret and self.scenario.secret in said.lower() + self.said(".out").lower():
            yield "the message holds the key"

    def defects_of_repeat(self):
        """A run on what a killed one left makes the files, or says by name what stands in its way."""
        status = self.run("rename", 0, 0, again=True)  # the callers of each allocation would take a second
        is_named = self.scenario.is_recording and re.search(r"is there\b", self.said(".err"))
        if status != 0 and not is_named:
            yield "the next run fails: " + self.said(".err").strip()
        if status == 0:
            now = state_of(self.folder)
            yield from ("the next run does not make " + name for name in self.after if not self.is_new(name, now))

    def judge(self, call, at, fault):
        """What became of the run, and what is wrong with it."""
        status = self.run(call, at, fault)
        if status == -signal.SIGKILL and fault in KILLS:
            return "killed", [*self.defects_of_files(True), *self.defects_of_repeat()]
        # Who has no memory any more cannot remove a folder either.
        if status > 0 and call == "malloc" and (self.is_ended() or fault_name(fault).endswith("for good")):
            return "refused", [*self.defects_of_message(call), *self.defects_of_files(True), *self.defects_of_repeat()]
        if status < 0:
            return "crashed", ["ended by " + signal.Signals(-status).name + ": " + self.said(".err").strip()[-200:]]
        defects = list(self.defects_of_files(self.scenario.keeps_cut))
        if status == 0:
            now = state_of(self.folder)
            defects += ["exit status 0 without " + name for name in self.after
                        if not self.is_new(name, now) and not (self.is_less() and name in now)]
            return "done", defects
        return "refused", defects + list(self.defects_of_message(call))


def measure(server, most, kinds, show):
    for call in FAULTS if kinds is None else kinds:
        for fault in FAULTS[call] if server.counts[call] else []:
            row = dict.fromkeys(COLUMNS, 0)
            row.update(command=server.scenario.name, call=call, fault=fault_name(fault), calls=server.counts[call])
            for at in some_of(server.calls(call), most):
                became, defects = server.judge(call, at, fault)
                row["tried"] += 1
                row[became] = row.get(became, 0) + 1
                row["defects"] += bool(defects)
                if defects and show:
                    print("%s: %s %d %s: %s" % (server.scenario.name, call, at, row["fault"], "; ".join(defects)), flush=True)
            yield [row[column] for column in COLUMNS]


def chains_of_every_command(serve):
    server = serve(EVERY_COMMAND)
    server.close()
    shutil.rmtree(server.old.parent)
    return server.chains


def known_rows(path):
    """By command."""
    rows = {}
    if path.exists():
        with path.open(newline="") as file:
            for row in list(csv.reader(file))[1:]:
                rows.setdefault(row[0], []).append(row)
    return rows


def changed_kinds(measured, known):
    """Kinds of calls that commands do not make any more, or make now, so that what is tried is not what the ledger says."""
    for name, rows in measured.items():
        now, before = ({row[1] for row in some} for some in (rows, known.get(name, [])))
        yield from ("%s makes no call %s any more, or it is not seen" % (name, call) for call in sorted(before - now))
        yield from ("%s has no row of call %s in the ledger" % (name, call) for call in sorted(now - before))


def keep(path, measured):
    """Rows of commands that were not measured stay."""
    rows = known_rows(path)
    rows.update(measured)
    write_csv(path, [COLUMNS, *(row for name in Scenarios.NAMES for row in rows.get(name, []))])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spherecloud", required=True)
    parser.add_argument("--library", required=True, type=pathlib.Path, help="fail_call.so")
    parser.add_argument("--results", type=pathlib.Path, default=RESULTS, help="the file to write [faults.csv]")
    parser.add_argument("--quick", action="store_true", help="a few commands and calls; writes nothing; fails when there is a defect, or "
                        "where a command makes other kinds of calls than the ledger has")
    parser.add_argument("--only", action="append", help="this command alone; repeat")
    parser.add_argument("--call", action="append", choices=FAULTS, help="this call alone; repeat")
    parser.add_argument("--most", type=int, metavar="N", help="so many calls at the beginning, between and at the end [all]")
    parser.add_argument("--show", action="store_true", help="print each defect")
    arguments = parser.parse_args()
    measured = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder, tool = pathlib.Path(scratch), pathlib.Path(arguments.spherecloud).resolve()
        scenarios = Scenarios(tool, folder)

        def serve(name, *known_chains):
            return Server(tool, arguments.library.resolve(), scenarios.make(name), folder / name.replace(" ", "_"), *known_chains)

        of_every_command, of_long_runs = chains_of_every_command(serve), set()
        for name in arguments.only or (scenarios.QUICK if arguments.quick else scenarios.NAMES):
            server = serve(name) if name == EVERY_COMMAND else serve(name, of_every_command, of_long_runs)
            if server.scenario.by_chains:
                of_long_runs |= server.chains
            measured[name] = list(measure(server, 2 if arguments.quick else arguments.most, arguments.call, arguments.show or arguments.quick))
            server.close()
            if not arguments.quick and not arguments.call:
                keep(arguments.results, measured)
    rows = [row for rows in measured.values() for row in rows]
    defects = sum(row[-1] for row in rows)
    runs = sum(row[4] for row in rows)
    print("%d runs, %d with a defect" % (runs, defects))
    changed = list(changed_kinds(measured, known_rows(RESULTS))) if arguments.quick and not arguments.call else []
    print("".join(line + "; measure it anew\n" for line in changed), end="")
    return 1 if defects or changed or not runs else 0


if __name__ == "__main__":
    sys.exit(main())
