#!/bin/bash
# fetch_photos.sh FOLDER: unpacks into FOLDER the packages that photos.txt names, without installing them.
set -euo pipefail
list=$(cd "$(dirname "$0")" && pwd)/photos.txt
mkdir -p "$1"
cd "$1"
for package in $(sed '/^#/d; s|/.*||' "$list" | sort -u); do
  case $package in
    skimage) pip download -q --no-deps --only-binary=:all: -d . scikit-image==0.26.0 ;;
    sklearn) pip download -q --no-deps --only-binary=:all: -d . scikit-learn==1.9.1 ;;
    *) apt-get download "$package" && dpkg -x "$package"_*.deb "$package" ;;
  esac
done
for wheel in scikit_image:skimage scikit_learn:sklearn; do
  python3 -m zipfile -e "${wheel%:*}"-*.whl "${wheel#*:}"
done
