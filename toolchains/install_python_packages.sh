#!/bin/sh
# install_python_packages.sh FOLDER - makes FOLDER a Python environment with what python_packages.txt names.
set -eu
list=$(dirname "$0")/python_packages.txt
folder=${1:?install_python_packages.sh FOLDER: name the folder to make}
cmp -s "$list" "$folder/installed.txt" && exit 0
python3 -m venv "$folder"
"$folder/bin/pip" install --quiet --disable-pip-version-check -r "$list"
cp "$list" "$folder/installed.txt"
