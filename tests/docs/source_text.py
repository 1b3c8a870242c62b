"""What a source says to people: its comments and its string literals."""
import io
import re
import subprocess
import tokenize
from pathlib import Path

TREES = ("sdk", "drivers", "tests", "examples", "toolchains")
C_LIKE = (".c", ".h", ".cpp", ".hpp", ".in")
HASHED = (".cmake", ".sh")

C_TEXT = re.compile(
    r"""//[^\n]*|/\*.*?\*/|R"(?P<raw>[^(]*)\(.*?\)(?P=raw)"|"(?:\\.|[^"\\\n])*"|(?P<letter>'(?:\\.|[^'\\\n])')""",
    re.DOTALL)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[^\n]*', re.MULTILINE)
HASH_TEXT = re.compile(r"""(?<![^\s(])#[^\n]*|"(?:\\.|[^"\\])*\"""", re.DOTALL)


def sources(root):
    """Tracked files of the trees; every file where there is no repository."""
    listed = subprocess.run(["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                            capture_output=True, text=True)
    names = listed.stdout.split("\0") if listed.returncode == 0 else [
        str(path.relative_to(root)) for tree in TREES for path in (Path(root) / tree).rglob("*")]
    for name in sorted(names):
        path = Path(root) / name
        of_a_kind = path.suffix in C_LIKE + HASHED + (".py",) or path.name == "CMakeLists.txt"
        if name.split("/")[0] in TREES and of_a_kind and path.is_file():
            yield name, path


def kept(text, spans):
    """The text with all but the spans blanked, so that lines keep their numbers."""
    blank = ["\n" if c == "\n" else " " for c in text]
    for begin, end in spans:
        blank[begin:end] = text[begin:end]
    return "".join(blank)


PYTHON_TEXT = (tokenize.COMMENT, tokenize.STRING, getattr(tokenize, "FSTRING_MIDDLE", tokenize.STRING))


def python_spans(text):
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type in PYTHON_TEXT:
            (first, column), (last, end) = token.start, token.end
            yield starts[first - 1] + column, starts[last - 1] + end


MARKS = re.compile(r"^[ \t]*(//+|/?\*+/?|#+)|\\[nt]", re.MULTILINE)


def said(path):
    """The comments and the literals, each on its line, with all else blank."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".py":
        text = kept(text, python_spans(text))
    elif path.suffix in C_LIKE:
        text = INCLUDE.sub(lambda match: " " * len(match.group(0)), text)
        text = kept(text, (match.span() for match in C_TEXT.finditer(text) if not match.group("letter")))
    else:
        text = kept(text, (match.span() for match in HASH_TEXT.finditer(text)))
    return MARKS.sub(lambda match: " " * len(match.group(0)), text)
