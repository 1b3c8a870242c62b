#!/usr/bin/env python3
"""Every relative link of the docs leads to a file and an anchor that exist, every path that a page names exists, and
every page is reachable from docs/README.md.

    check_links.py ROOT
"""
import re
import sys
from pathlib import Path

from markdown import Page, pages, report

NAMED_PATH = re.compile(r"^(?:sdk|drivers|tests|examples|toolchains|docs)/[\w./+-]+$")


def fault(page, root, line, words):
    return f"{page.path.relative_to(root)}:{line}: {words}"


def broken_links(root):
    faults = []
    for page in pages(root):
        for line, target in page.links():
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            path = (page.path.parent / name).resolve() if name else page.path
            if not path.exists():
                faults.append(fault(page, root, line, f"no file {name}"))
            elif anchor and path.suffix == ".md" and anchor not in Page(path).anchors():
                faults.append(fault(page, root, line, f"no heading #{anchor} in {path.name}"))
    return faults


def missing_paths(root):
    """A code span that looks like a path of the source tree must be one.  `*` stands for more than one name."""
    faults = []
    for page in pages(root):
        if page.path.name == "CHANGELOG.md":  # it also speaks of what was
            continue
        for line, text in page.spans():
            if not NAMED_PATH.match(text) or (root / text).exists():
                continue
            if not list(root.glob(text.rstrip("/") + ".*")):  # a file named without its ending, such as a test
                faults.append(fault(page, root, line, f"no file or folder {text}"))
    return faults


def unreachable(root):
    """Pages that no chain of links leads to from the index."""
    index = (root / "docs" / "README.md").resolve()
    if not index.exists():
        return ["docs/README.md: there is no index"]
    seen, waiting = set(), [index]
    while waiting:
        path = waiting.pop()
        if path in seen:
            continue
        seen.add(path)
        for _, target in Page(path).links():
            other = (path.parent / target.partition("#")[0]).resolve()
            if other.suffix == ".md" and other.exists():
                waiting.append(other)
    return [f"{page.path.relative_to(root)}: not reachable from docs/README.md"
            for page in pages(root) if page.path.resolve() not in seen and page.path.parent != root]


def index_faults(root):
    """The index lists each page of docs/ once."""
    index = root / "docs" / "README.md"
    if not index.exists():
        return []
    listed = [target for _, target in Page(index).links() if re.fullmatch(r"[\w-]+\.md", target)]
    pages_of_docs = {path.name for path in (root / "docs").glob("*.md")} - {"README.md"}
    faults = [f"docs/README.md: {name} is not listed" for name in sorted(pages_of_docs - set(listed))]
    return faults + [f"docs/README.md: {name} is listed {listed.count(name)} times"
                     for name in sorted(set(listed)) if listed.count(name) > 1]


def folder_faults(root):
    """docs/architecture.md has a row for every folder that tests/layers/layers.txt has a row for."""
    page = root / "docs" / "architecture.md"
    if not page.exists():
        return ["docs/architecture.md: missing"]
    named = {text.rstrip("/") for _, text in Page(page).spans()}
    faults = []
    for line in (root / "tests" / "layers" / "layers.txt").read_text().splitlines():
        folder = line.split("|")[0].strip()
        if not folder or line.startswith("#"):
            continue
        wanted = [folder] if not folder.endswith("/X") else sorted(
            str(path.relative_to(root)) for path in (root / folder[:-2]).iterdir() if path.is_dir())
        faults += [f"docs/architecture.md: the table has no row for {name}" for name in wanted if name not in named]
    return sorted(set(faults))


def all_faults(root):
    root = Path(root).resolve()
    return (broken_links(root) + missing_paths(root) + unreachable(root) + index_faults(root) + folder_faults(root))


if __name__ == "__main__":
    sys.exit(report(all_faults(sys.argv[1])))
