#!/usr/bin/env python3
"""Writes docs/error_cases.md from what the tests were refused (tests/support/refusals).

    make_error_cases.py ROOT RECORDS PROGRAM...                 writes the page
    make_error_cases.py ROOT RECORDS PROGRAM... --check         compares it with the one that is there
    make_error_cases.py ROOT RECORDS PROGRAM... --unprovoked    the statements of the sources that no test provokes

RECORDS has a file PROGRAM.tsv of each program of tests that ran: case, function or command, code, message.  --check ends
with 77 where a program has not run.
"""
import argparse
import re
import sys
from pathlib import Path

from refusal_sites import all_sites, origins

SKIPPED = 77
SUBJECTS = {  # the longest that a source's path begins with
    "sdk/runtime": "The C interface",
    "drivers": "Cameras",
    "sdk/host/recording": "Recordings",
    "sdk/host/recording/foreign": "Recordings of other programs",
    "sdk/host/frames": "Recordings",
    "sdk/host/calibration": "Calibration files of other programs",
    "sdk/host/cameras": "Calibration files of other programs",
    "sdk/host/import": "Models of COLMAP, and point models",
    "sdk/host/mapping": "Mapping without poses",
    "sdk/host/guide": "Mapping without poses",
    "sdk/host/publish": "Maps and their release",
    "sdk/host/advise": "Advice, evaluation, reports",
    "sdk/host/evaluate": "Advice, evaluation, reports",
    "sdk/host/report": "Advice, evaluation, reports",
    "sdk/host/audit": "Audit",
    "sdk/host/live": "Cameras",
    "sdk/host/base": "Files",
    "sdk/host/signing": "Signed maps",
    "sdk/signature": "Signed maps",
    "sdk/host/keys": "Signed maps",
    "sdk/encryption": "Encrypted maps",
    "sdk/host/encryption": "Encrypted maps",
    "sdk/host/cli": "The command",
}
DRIVERS = ("libcamera", "openni2", "raw", "sample", "simulated", "v4l2")  # whose functions explain themselves
INTRO = """# Error cases

<!-- Made by tests/docs/make_error_cases.py: run `ninja error_cases`. -->

What the library and the command say when they refuse, each as a test provokes it. [errors.md](errors.md) explains the status values, [cli.md](cli.md) the exit codes.
The cases are {count} messages, of {provoked} of the {sites} statements that refuse ({share} %).

- *Where* is the function of the C interface, the command, or the source that refused.
- Numbers and names in a message are those of the case; `...` is a path of the machine.
- Where the cure is empty, the cause says what must be.
- A library that is called from the command line ends the command with exit code 1, and `exit 2` is a wrong command line. Of several functions that refuse alike, all are named.
"""


class Refusal:
    def __init__(self, case, where, code, message, sites):
        self.case, self.where, self.code, self.message = case, where, code, message
        self.sites = origins([site for site in sites if self.may_be_of(site.path)], message)

    def may_be_of(self, path):
        """Could a statement of this source have said it?"""
        if self.where.startswith("spherecloud"):
            return True
        if self.where:
            driver = self.where.split("_")[1]
            return path.startswith((f"drivers/{driver}/", "drivers/pixels/") if driver in DRIVERS else "sdk/runtime/")
        is_status = self.code.startswith("SPHC_")  # of a Failure
        return path.startswith(("sdk/host/recording/", "drivers/replay/") if is_status else "sdk/host/")


def plain(message, root):
    """Without what differs from machine to machine or from run to run."""
    message = message.replace(str(root) + "/", "")
    message = re.sub(r"(?:\.\.\.)?/(?:tmp|var/tmp|dev/shm)/[^\s:;,'\")]*(?=/)", "...", message)
    message = re.sub(r"/(?:tmp|var/tmp|dev/shm)/[^\s:;,'\")]+", "...", message)
    return re.sub(r"SphereCloud \d+\.\d+\.\d+\S*", "SphereCloud VERSION", message)


def without_numbers(message):
    return re.sub(r"(?<![A-Za-z_])-?(?:[\d.]+(?:e[+-]?\d+)?|nan|inf)\b", "0", message)


def outermost(records):
    """A failure is often thrown again with more in front of it: what is said last, in one case."""
    kept = []
    for record in records:  # (case, where, code, message)
        while kept and kept[-1][0] == record[0] and kept[-1][3] in record[3] and (not kept[-1][1] or kept[-1][3] != record[3]):
            kept.pop()
        kept.append(record)
    return kept


def read(root, records):
    sites, refusals, seen = all_sites(root), [], set()
    for path in records:
        lines = path.read_text(encoding="utf-8", errors="replace").split("\n")[:-1]
        for case, where, code, message in outermost([line.split("\t") for line in lines]):
            message = plain(message, root)
            once = case, where, code, without_numbers(message)  # a test may try every length of a file
            if once not in seen:
                seen.add(once)
                refusals.append(Refusal(case, where, code, message, sites))
    return sites, [refusal for refusal in refusals if refusal.sites]


def subject(refusal):
    if refusal.where.startswith("spherecloud"):
        return "The command"
    path = refusal.sites[0].path
    return SUBJECTS[max((begin for begin in SUBJECTS if path.startswith(begin)), key=len)]


def place(refusal):
    """Of a failure without a function: the source, without the folders that all have."""
    return refusal.where or re.sub(r"^sdk/host/|\.\w+$", "", refusal.sites[0].path)


def key(refusal):
    """Messages that differ in numbers and names alone are one."""
    text = re.sub(r"'[^']*'", "''", refusal.message)
    text = without_numbers(text)
    return subject(refusal), refusal.code, refusal.sites[0].path, refusal.sites[0].line, re.sub(r"\S*\.\.\.\S*", "...", text)


def cell(text):
    return re.sub(r"[^ -~]", "?", text).replace("|", "\\|").replace("<", "&lt;").replace("[", "\\[").replace("*", "\\*") \
        .replace("_", "\\_").replace("`", "'")


def cause_and_cure(message):
    """A message is "cause; cure", or a cause that says what must be."""
    cause, mark, cure = message.partition("; ")
    return (cause, cure) if mark else (message, "")


def rows(refusals):
    """(subject, row) of each message, in the order of the sources."""
    groups = {}
    for refusal in refusals:
        groups.setdefault(key(refusal), []).append(refusal)
    for group_key, group in sorted(groups.items()):
        first = min(group, key=lambda refusal: (refusal.case, refusal.message))
        places = " ".join(f"`{name}`" for name in sorted({place(refusal) for refusal in group}))
        cause, cure = map(cell, cause_and_cure(first.message))
        yield group_key[0], f"| `{first.case}` | {places} | {first.code} | {cause} | {cure} |"


def page(root, records):
    sites, refusals = read(root, records)
    provoked = {(site.path, site.line) for refusal in refusals for site in refusal.sites}
    by_subject = {}
    for name, row in rows(refusals):
        by_subject.setdefault(name, []).append(row)
    text = INTRO.format(count=sum(map(len, by_subject.values())), provoked=len(provoked), sites=len(sites),
                        share=100 * len(provoked) // len(sites))
    for name in dict.fromkeys(SUBJECTS.values()):
        if name in by_subject:
            text += f"\n## {name}\n\n| case | where | code | message: cause | and cure |\n| --- | --- | --- | --- | --- |\n"
            text += "\n".join(by_subject[name]) + "\n"
    return text


def unprovoked(root, records):
    sites, refusals = read(root, records)
    provoked = {(site.path, site.line) for refusal in refusals for site in refusal.sites}
    missing = [site for site in sites if (site.path, site.line) not in provoked]
    for site in missing:
        print(f"{site.path}:{site.line}: {' # '.join(site.parts)}")
    print(f"{len(sites) - len(missing)} of {len(sites)} statements that refuse are provoked by a test")


def check(root, records):
    missing = [path.stem for path in records if not path.exists()]
    if missing:
        print("skipped: these tests did not run yet:", *missing)
        return SKIPPED
    made, path = page(root, records), root / "docs" / "error_cases.md"
    there = path.read_text(encoding="utf-8") if path.exists() else ""
    if made == there:
        print("docs/error_cases.md has every refusal")
        return 0
    made_lines, there_lines = made.splitlines(), there.splitlines()
    for mark, lines, others in (("lost: ", there_lines, made_lines), ("new:  ", made_lines, there_lines)):
        print(*[mark + line for line in lines if line not in set(others)], sep="\n")
    print("docs/error_cases.md is stale: run `ninja error_cases`, read the difference, and commit it")
    return 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root", type=Path)
    parser.add_argument("records", type=Path)
    parser.add_argument("programs", nargs="+")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--unprovoked", action="store_true")
    options = parser.parse_args()
    root = options.root.resolve()
    records = [options.records / f"{program}.tsv" for program in options.programs]
    if options.unprovoked:
        return unprovoked(root, records)
    if options.check:
        return check(root, records)
    (root / "docs" / "error_cases.md").write_text(page(root, records), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
