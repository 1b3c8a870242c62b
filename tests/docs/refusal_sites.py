"""Where the sources refuse: each statement that throws or explains, with the text in it, and which statement a message came from."""
import re
from pathlib import Path

FOLDERS = ["sdk/runtime", "sdk/host", "drivers"]
BEGIN = re.compile(r"\bthrow\s+[\w:]+\s*[({]|\b(?:refuse\w*|fail|explain|problem)\s*\(|\bMessageWriter\s*(?:\w+\s*)?\("
                   r"|^ *(?:text|writer)\s*<<", re.MULTILINE)
TOKEN = re.compile(r'"((?:[^"\\\n]|\\.)*)"|//[^\n]*|/\*.*?\*/|\'(?:[^\'\\\n]|\\.)\'|;', re.DOTALL)
BETWEEN_LITERALS = re.compile(r"[\s\\]*")
SHORTEST = 8  # characters that tell one statement from another


class Site:
    """A statement that refuses.  `parts` are the pieces of fixed text in it, in the order of the message."""

    def __init__(self, path, line, parts):
        self.path, self.line, self.parts = path, line, parts
        self.characters = sum(map(len, parts))

    def likeness(self, message):
        """How many characters of the message this statement wrote; 0 where it is another's."""
        found = at = 0
        for part in self.parts:
            begin = message.find(part, at)
            if begin >= 0:
                found, at = found + len(part), begin + len(part)
        return found if found >= SHORTEST and found >= 0.4 * self.characters else 0


def pieces(literal):
    """Fixed text of a literal, which may be a format of printf."""
    text = re.sub(r"\\(.)", lambda escape: {"n": "\n", "t": "\t"}.get(escape[1], escape[1]), literal)
    return [piece.strip() for piece in re.split(r"%[-+ #0]*[\d.*]*(?:hh|h|ll|l|z|j)?[a-zA-Z]|\n", text) if len(piece.strip()) > 2]


def statement(text, begin):
    """The literals from `begin` to the end of the statement; those side by side are one."""
    literals, at = [], None
    for token in TOKEN.finditer(text, begin):
        if token[0] == ";":
            break
        if token[1] is not None:
            if at is not None and BETWEEN_LITERALS.fullmatch(text, at, token.start()):
                literals[-1] += token[1]
            else:
                literals.append(token[1])
            at = token.end()
    return literals


def sites_of(path, name):
    # Comments would begin statements; literals may look like comments.
    text = TOKEN.sub(lambda token: " " * len(token[0]) if token[0].startswith("/") and "\n" not in token[0] else token[0],
                     path.read_text(encoding="utf-8"))
    for match in BEGIN.finditer(text):
        parts = [piece for literal in statement(text, match.end()) for piece in pieces(literal)]
        if sum(map(len, parts)) >= SHORTEST:
            yield Site(name, text.count("\n", 0, match.start()) + 1, parts)


def all_sites(root):
    root = Path(root)
    found = {}
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".c"):
                for site in sites_of(path, str(path.relative_to(root))):
                    found.setdefault((site.path, tuple(site.parts)), site)
    return list(found.values())


def origins(sites, message):
    """The statements that wrote a message: those most like it first, then those whose text is in it as a whole."""
    likenesses = [site.likeness(message) for site in sites]
    best = max(likenesses, default=0)
    return ([site for site, likeness in zip(sites, likenesses) if likeness == best > 0]
            + [site for site, likeness in zip(sites, likenesses) if best > likeness == site.characters])
