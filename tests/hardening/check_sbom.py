#!/usr/bin/env python3
"""The SBOM is SPDX 2.3, and names whatever the programs link and whatever third_party holds.

    check_sbom.py ROOT SBOM VERSION FILE...
"""
import functools
import json
import re
import subprocess
import sys
from pathlib import Path

NEEDED_OF_DOCUMENT = ("spdxVersion", "dataLicense", "SPDXID", "name", "documentNamespace", "creationInfo", "packages", "relationships")
NEEDED_OF_PACKAGE = ("name", "SPDXID", "downloadLocation", "licenseDeclared")


def form_faults(sbom):
    """What SPDX asks of a document."""
    faults = [f"the document has no {key}" for key in NEEDED_OF_DOCUMENT if key not in sbom]
    if sbom.get("spdxVersion") != "SPDX-2.3" or sbom.get("dataLicense") != "CC0-1.0":
        faults.append("the document is not SPDX-2.3 under CC0-1.0")
    ids = ["SPDXRef-DOCUMENT"] + [package.get("SPDXID") for package in sbom.get("packages", [])]
    faults += [f"{name} stands twice" for name in set(ids) if ids.count(name) > 1]
    faults += [f"{name} is no identifier" for name in ids if not re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", str(name))]
    faults += [f"{package.get('name')} has no {key}" for package in sbom.get("packages", []) for key in NEEDED_OF_PACKAGE if key not in package]
    for link in sbom.get("relationships", []):
        faults += [f"{link[end]} is related and not there" for end in ("spdxElementId", "relatedSpdxElement") if link[end] not in ids]
    related = {link["relatedSpdxElement"] for link in sbom.get("relationships", [])}
    return faults + [f"{name} is related to nothing" for name in ids[1:] if name not in related]


@functools.cache
def linked_packages(path):
    """[(library, Debian package)] of all that the loader loads for a program itself, and not for its libraries."""
    dynamic = subprocess.run(["readelf", "--wide", "--dynamic", path], text=True, capture_output=True, check=True).stdout
    loaded = dict(re.findall(r"(\S+) => (/\S+)", subprocess.run(["ldd", path], text=True, capture_output=True, check=True).stdout))
    wanted = [name for name in re.findall(r"\(NEEDED\).*\[(.+)\]", dynamic)
              if name in loaded and not name.startswith("libspherecloud")]  # not the loader itself, and not ours
    real = {name: str(Path(loaded[name]).resolve()) for name in wanted}
    names = [way for path in real.values() for way in (path, path.removeprefix("/usr"))]
    told = subprocess.run(["dpkg", "-S", *names], text=True, capture_output=True, check=False).stdout
    owners = {line.split(": ")[1].removeprefix("/usr"): line.split(":")[0] for line in told.splitlines() if ": /" in line}
    return [(name, owners.get(real[name].removeprefix("/usr"), "")) for name in wanted]


def faults_of(root, sbom, version, files):
    faults = form_faults(sbom)
    packages = {package["name"]: package for package in sbom.get("packages", [])}
    for path in files:
        linked = linked_packages(path)
        if not linked:
            faults.append(f"{path} links nothing: is it a program?")
        faults += [f"{path} links {soname} of {owner or 'no package'}, which the SBOM does not name"
                   for soname, owner in linked if owner not in packages]
    if packages.get("spherecloud", {}).get("versionInfo") != version:
        faults.append(f"the SBOM is of another version than {version}")
    for folder in (path for path in (root / "third_party").iterdir() if path.is_dir()):
        if folder.name not in packages:
            faults.append(f"third_party/{folder.name} is not in the SBOM; it needs an origin.json")
    faults += [f"{name} has no licence; say it in toolchains/write_sbom.py" for name, package in packages.items()
               if package.get("licenseDeclared") == "NOASSERTION"]
    return faults


def main():
    root, path, version, *files = sys.argv[1:]
    sbom = json.loads(Path(path).read_text(encoding="utf-8"))
    faults = faults_of(Path(root), sbom, version, files)
    print("\n".join(faults) or f"{len(sbom['packages'])} packages")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
