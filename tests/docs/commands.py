"""What the built commands say of themselves."""
import re
import subprocess
from pathlib import Path


def run_help(words):
    return subprocess.run([*map(str, words), "--help"], text=True, capture_output=True, check=True).stdout


def subcommands(help_text):
    """Names under the heading "Subcommands:"."""
    names, inside = [], False
    for line in help_text.split("\n"):
        if re.match(r"subcommands:", line, re.IGNORECASE):
            inside = True
        elif inside and re.match(r"  \S", line):
            names.append(line.split()[0])
        elif inside and line and not line.startswith(" "):
            inside = False
    return names


def help_texts(command):
    """The help of a command and of each of its subcommands, by the words that people type."""
    name, own = Path(command).name, run_help([command])
    texts = {name: own}
    if not subcommands(own):
        raise ValueError(f"{command} --help names no subcommand")
    for sub in subcommands(own):
        texts[f"{name} {sub}"] = run_help([command, sub])
    return texts


def options_of(help_text):
    """Every option that a help text explains."""
    return set(re.findall(r"(?<![\w-])(--?[A-Za-z][\w-]*)", help_text))
