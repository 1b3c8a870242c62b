"""The key of the tests, as the command takes it: in a file that its owner alone may read, which git does not keep."""
import os
import pathlib

HERE = pathlib.Path(__file__).resolve().parent


def private_key(folder):
    """A copy of test_key.txt in `folder`; it is fixed so that results can be compared, and protects nothing."""
    path = pathlib.Path(folder) / "test_key.txt"
    if not path.exists():
        with open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write((HERE / "test_key.txt").read_text())
    return path
