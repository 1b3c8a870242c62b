#!/usr/bin/env python3
"""What Python adds to a frame: the same frames through C and through the package, by turns, in one process.

    SPHERECLOUD_LIBRARY=... SPHERECLOUD_GOLDEN=... PYTHONPATH=bindings/python python3 bindings/python/measure/overhead.py [ROUNDS [SCALE]]

C is timed in C, around sphc_localizer_process, with a clock in C.  Python is timed in Python, around process, and
by itself around making the Frame and reading the pose.  Times are the processor's in this thread, so
that other programs do not count.  Frames are those of the golden session, walked to and fro, and SCALE times
as wide and high (1, 2 or 3).  This needs a C compiler.
"""
import ctypes
import itertools
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tests"))

import session  # noqa: E402
import spherecloud as sphc  # noqa: E402
from spherecloud import _interface, _library  # noqa: E402
from spherecloud.frames import FrameStruct  # noqa: E402


def compiled(folder):
    library = pathlib.Path(folder) / "in_c.so"
    include = HERE.parents[2] / "sdk" / "include"
    subprocess.run(["cc", "-O2", "-shared", "-fPIC", "-I", include, HERE / "in_c.c", "-o", library], check=True)
    made = ctypes.CDLL(str(library))
    made.time_process.restype, made.monotonic_ns.restype = ctypes.c_int64, ctypes.c_int64
    return made


def grown(camera, scale):
    return sphc.Camera(camera.model, scale * camera.width, scale * camera.height, [scale * value for value in camera.params])


def localizer(scale, **options):
    rig = sphc.Rig(grown(session.COLOR, scale), grown(session.DEPTH, scale), session.RIG.color_from_depth)
    return sphc.Localizer(rig, max_keypoints=400 * scale, depth_sigma_m=session.CONFIG["depth_sigma_m"], **options)


class InC:
    """A localizer without a function of Python's, and structs that are filled before the clock runs."""

    def __init__(self, made, room, scale):
        self.made, self.slot, self.result = made, FrameStruct(sphc.Format.DEPTH16), _interface.sphc_localizer_result()
        _library.interface().sphc_localizer_result_init(self.result, ctypes.sizeof(self.result))
        self.process = ctypes.cast(_library.interface().sphc_localizer_process, ctypes.c_void_p)
        clock = _interface.sphc_clock_fn(ctypes.cast(made.monotonic_ns, ctypes.c_void_p).value)
        self.localizer = localizer(scale, clock=None, log=None)
        self.localizer._config.clock = clock
        self.localizer._owned = self.localizer._made()
        self.localizer.set_map(session.MAP_ID, room)

    def time(self, frame):
        alive = self.slot.fill(frame)
        took = self.made.time_process(self.process, self.localizer._owned.pointer, ctypes.byref(self.slot.raw), ctypes.byref(self.result))
        assert took > 0 and alive
        return took


def time_in_python(made, frame):
    """(of process, of making the Frame and of the pose)"""
    begin = time.thread_time_ns()
    given = sphc.Frame(frame.color, frame.depth, frame.color_time_ns, frame.depth_time_ns, frame.sequence, frame.prior)
    ready = time.thread_time_ns()
    result = made.process(given)
    done = time.thread_time_ns()
    assert result.pose is not None
    return done - ready, ready - begin + time.thread_time_ns() - done


def walked(rounds, scale):
    """Frames of ever growing time; the blank one is left out, since a frame without a search says little."""
    frames = [session.frame(row) for row in session.ROWS if row["status"] == "0"]
    for frame in frames:
        frame.color, frame.depth = (image.repeat(scale, 0).repeat(scale, 1) for image in (frame.color, frame.depth))
    for index in range(rounds):
        place = index % (2 * len(frames) - 2)
        frame = frames[min(place, 2 * len(frames) - 2 - place)]
        frame.color_time_ns = 10**9 + 33_000_000 * index
        frame.depth_time_ns = frame.color_time_ns + 3_000_000
        yield frame


def main(rounds, scale):
    with tempfile.TemporaryDirectory() as folder, sphc.Map.open(session.MAP) as room:
        c, python = InC(compiled(folder), room, scale), localizer(scale)
        python.set_map(session.MAP_ID, room)
        pairs = []
        for index, frame in enumerate(walked(rounds, scale)):
            first = c.time(frame) if index % 2 else None
            second = time_in_python(python, frame)
            pairs.append((first or c.time(frame), *second))
    in_c, in_python, around = (statistics.median(times) / 1e6 for times in zip(*pairs))
    print(f"{rounds} frames: C {in_c:.3f} ms, Python {in_python:.3f} ms, ratio {in_python / in_c:.4f}; "
          f"Frame and pose {1e3 * around:.1f} us more")


if __name__ == "__main__":
    main(*(int(given) if given else usual for given, usual in itertools.zip_longest(sys.argv[1:3], (600, 1))))
