#!/usr/bin/env python3
"""Writes the bill of materials of a build: SPDX 2.3 in JSON.

    write_sbom.py ROOT VERSION OUT SECTIONS FILE...

What the sections of toolchains/packages.txt (words with commas) bring and is compiled in; what third_party holds; and whatever
the files, programs and shared libraries, link.  Versions are those of the Debian packages of this machine; elsewhere they are
left out.  SOURCE_DATE_EPOCH dates it.
"""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

TOOLS = {"ccache", "cmake", "g++", "ninja-build", "pkg-config", "gnuplot-nox"}  # they leave nothing in what is built
LICENSES = {  # by source package, as their copyright files say
    "atlas": "BSD-3-Clause", "ceres-solver": "BSD-3-Clause", "cli11": "BSD-3-Clause", "eigen3": "MPL-2.0", "ffmpeg": "LGPL-2.1-or-later AND GPL-2.0-or-later", "gcc-12": "GPL-3.0-or-later WITH GCC-exception-3.1",
    "glibc": "LGPL-2.1-or-later", "google-glog": "BSD-3-Clause", "highway": "Apache-2.0", "libjpeg-turbo": "IJG AND BSD-3-Clause AND Zlib",
    "libsodium": "ISC", "libyaml-cpp": "MIT", "yaml-cpp": "MIT", "libspng": "BSD-2-Clause", "libzstd": "BSD-3-Clause", "libzip": "BSD-3-Clause", "lz4": "BSD-2-Clause", "nanoflann": "BSD-2-Clause", "nlohmann-json3": "MIT",
    "opencv": "Apache-2.0", "openexr": "BSD-3-Clause", "openni2": "Apache-2.0", "lapack": "BSD-3-Clause", "sqlite3": "blessing",
    "suitesparse": "LGPL-2.1-or-later AND GPL-2.0-or-later", "zlib": "Zlib"}


def run(*words):
    """What a command prints, whatever its status: dpkg-query tells of what it knows.  Nothing where it is not there."""
    if not shutil.which(words[0]):
        return ""
    return subprocess.run(words, text=True, capture_output=True, check=False).stdout


def listed(path, sections):
    """The libraries of these sections of packages.txt."""
    names, inside = [], False
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            inside = line.strip("[]") in sections
        elif inside and line and not line.startswith("#") and line not in TOOLS:
            names.append(line)
    return names


def needed(path):
    """What a program or shared library asks the loader for."""
    return re.findall(r"\(NEEDED\).*\[(.+)\]", run("readelf", "--wide", "--dynamic", str(path)))


def owners(sonames):
    """{library: the Debian package that it is of}"""
    paths = {}
    for soname, path in re.findall(r"^\s+(\S+) \(.*\) => (\S+)$", run("/sbin/ldconfig", "-p"), re.MULTILINE):
        paths.setdefault(soname, Path(path).resolve())  # the first is of this machine, and may be an alternative
    real = {soname: str(paths[soname]) for soname in sonames & paths.keys()}
    ways = sorted({way for path in real.values() for way in (path, path.removeprefix("/usr"))})
    told = run("dpkg-query", "-S", *ways) if ways else ""
    owned = {line.split(": ")[1].removeprefix("/usr"): line.split(":")[0] for line in told.splitlines() if ": /" in line}
    return {soname: owned[path.removeprefix("/usr")] for soname, path in real.items() if path.removeprefix("/usr") in owned}


def of_debian(name):
    """A package of SPDX."""
    shown = run("dpkg-query", "-W", "-f", "${Version} ${source:Package}", name).split()
    version, source = shown if len(shown) == 2 else ("", name)
    package = {"name": name, "SPDXID": "SPDXRef-Package-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "downloadLocation": "NOASSERTION",
               "filesAnalyzed": False, "licenseConcluded": "NOASSERTION", "licenseDeclared": LICENSES.get(source, "NOASSERTION"),
               "copyrightText": "NOASSERTION"}
    if version:
        package["versionInfo"] = version
        package["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                    "referenceLocator": f"pkg:deb/debian/{name}@{version}?upstream={source}"}]
    return package


def of_others(origin):
    told = json.loads(origin.read_text(encoding="utf-8"))
    return {"name": told["name"], "SPDXID": "SPDXRef-Package-" + told["name"].replace("_", "-"), "versionInfo": told["version"],
            "supplier": told["supplier"], "downloadLocation": "NOASSERTION", "filesAnalyzed": False, "sourceInfo": told["source"],
            "checksums": [{"algorithm": "SHA256", "checksumValue": told["archive_sha256"]}], "licenseConcluded": told["license"],
            "licenseDeclared": told["license"], "copyrightText": "NONE"}


def document(root, version, sections, files):
    own = {"name": "spherecloud", "SPDXID": "SPDXRef-Package-spherecloud", "versionInfo": version, "downloadLocation": "NOASSERTION",
           "filesAnalyzed": False, "licenseConcluded": "Apache-2.0", "licenseDeclared": "Apache-2.0", "primaryPackagePurpose": "LIBRARY",
           "copyrightText": "Copyright 2026 The SphereCloud SDK authors"}
    ours = {"libspherecloud.so." + version.split(".", maxsplit=1)[0]}
    sonames = {soname for file in files for soname in needed(file)} - ours
    names = sorted(set(listed(root / "toolchains" / "packages.txt", sections)) | set(owners(sonames).values()))
    if shutil.which("dpkg-query"):  # some of packages.txt are optional
        names = [name for name in names if run("dpkg-query", "-W", "-f", "${Version}", name)]
    vendored = [of_others(origin) for origin in sorted((root / "third_party").glob("*/origin.json"))]
    packages = [own, *vendored, *map(of_debian, names)]
    kinds = ["CONTAINS"] * len(vendored) + ["DEPENDS_ON"] * len(names)
    links = [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": own["SPDXID"]}]
    links += [{"spdxElementId": own["SPDXID"], "relationshipType": kind, "relatedSpdxElement": package["SPDXID"]}
              for kind, package in zip(kinds, packages[1:])]
    made = {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"spherecloud-{version}",
            "packages": packages, "relationships": links,
            "hasExtractedLicensingInfos": [{"licenseId": "LicenseRef-public-domain", "name": "Public domain", "extractedText": "Public Domain"}]}
    digest = hashlib.sha256(json.dumps(made, sort_keys=True).encode()).hexdigest()
    when = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    made["documentNamespace"] = f"https://spdx.org/spdxdocs/spherecloud-{version}-{digest[:32]}"
    made["creationInfo"] = {"created": when, "creators": ["Organization: The SphereCloud SDK authors", "Tool: write_sbom.py"]}
    return made


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    root, version, out, sections, *files = sys.argv[1:]
    if not shutil.which("dpkg-query"):
        print("no dpkg-query: the SBOM has no versions, and of libraries only what packages.txt names")
    made = document(Path(root), version, sections.split(","), files)
    Path(out).write_text(json.dumps(made, indent=1) + "\n", encoding="utf-8")


main()
