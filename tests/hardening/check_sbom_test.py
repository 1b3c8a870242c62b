#!/usr/bin/env python3
"""check_sbom.py sees what an SBOM lacks.

    check_sbom_test.py ROOT SBOM VERSION PROGRAM
"""
import copy
import json
import sys
from pathlib import Path

from check_sbom import faults_of


def without(sbom, name):
    bad = copy.deepcopy(sbom)
    bad["packages"] = [package for package in bad["packages"] if package["name"] != name]
    return bad


def changed(sbom, change):
    bad = copy.deepcopy(sbom)
    change(bad)
    return bad


def main():
    root, path, version, program = sys.argv[1:]
    good = json.loads(Path(path).read_text(encoding="utf-8"))
    cases = {"libsodium23": without(good, "libsodium23"), "third_party/openssh_ed25519": without(good, "openssh_ed25519"),
             "SPDX-2.3": changed(good, lambda bad: bad.update(spdxVersion="SPDX-2.2")),
             "stands twice": changed(good, lambda bad: bad["packages"].append(bad["packages"][0])),
             "related to nothing": changed(good, lambda bad: bad["relationships"].pop()),
             "another version": changed(good, lambda bad: bad["packages"][0].update(versionInfo="0.0.1")),
             "no licence": changed(good, lambda bad: bad["packages"][2].update(licenseDeclared="NOASSERTION"))}
    unseen = [words for words, bad in cases.items() if not any(words in fault for fault in faults_of(Path(root), bad, version, [program]))]
    print(f"not seen: {unseen}")
    sys.exit(1 if unseen or faults_of(Path(root), good, version, [program]) else 0)


main()
