#!/usr/bin/env python3
"""Does the example of a language find the golden session's poses?  Runs COMMAND, which must end well and say nine poses, in the order of
the frames, and of frame 6 that it has too few keypoints.

    says_poses.py FIRST POSE NO_POSE COMMAND...      patterns of the line of frame 0, of any frame with a pose, and of one without
"""
import re
import subprocess
import sys

WITHOUT_POSE = 6  # of ten frames


def fault_of(status, said, first, pose, no_pose):
    """What is wrong with it, or None."""
    lines = said.splitlines()
    wanted = [first, *(no_pose if frame == WITHOUT_POSE else pose for frame in range(1, 10))]
    if status != 0:
        return "exit status %d" % status
    if len(lines) != len(wanted):
        return "%d lines instead of %d" % (len(lines), len(wanted))
    for frame, (line, pattern) in enumerate(zip(lines, wanted)):
        if not re.fullmatch(r"(frame )?%d: %s" % (frame, pattern), line):
            return "not as wanted: " + line
    return None


def main():
    first, pose, no_pose, *command = sys.argv[1:]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    print(done.stdout, end="")
    fault = fault_of(done.returncode, done.stdout, first, pose, no_pose)
    return "says_poses.py: " + fault if fault else 0


if __name__ == "__main__":
    sys.exit(main())
