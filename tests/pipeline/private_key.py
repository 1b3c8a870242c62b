"""Keys of the tests, as the command takes them: in files that their owner alone may read, which git does not keep."""
import hashlib
import os
import pathlib

HERE = pathlib.Path(__file__).resolve().parent


def private_key(folder):
    """A copy of test_key.txt in `folder`; it is fixed so that results can be compared, and protects nothing."""
    return _kept(pathlib.Path(folder) / "test_key.txt", (HERE / "test_key.txt").read_text())


NUMBERS = range(1, 13)  # of the keys that recordings are measured with


def numbered_key(number, folder):
    """The first is private_key."""
    return private_key(folder) if number == 1 else key_of("test key %d" % number, pathlib.Path(folder) / ("test_key_%d.txt" % number))


def key_of(words, path):
    """The key that these words stand for, in a file `path`; known to all too."""
    return _kept(path, hashlib.sha256(b"spherecloud " + words.encode()).hexdigest() + "\n")


def _kept(path, text):
    if not path.exists():
        with open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(text)
    return path
