#!/usr/bin/env python3
"""What the binding costs a frame: the golden session by C and by Java, turn by turn, and the ratio of the medians
of the processor time of their threads.

    overhead.py ROUNDS C_PROGRAM FOLDER -- JAVA OPTIONS... Overhead

Each program plays the session whenever it is told to, so both meet the same noise.  The first tenth of the rounds warms up.
"""
import statistics
import subprocess
import sys

REPETITIONS = 5


def start(command):
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1)


def play(program):
    program.stdin.write("go\n")
    return [int(number) for number in program.stdout.readline().split()]


def medians(rounds):
    """Of each frame, over the rounds; the last number is a prediction's."""
    return [statistics.median(column) for column in zip(*rounds)]


def main(words):
    if len(words) < 5 or words[3] != "--":
        sys.exit(__doc__)
    rounds, folder = int(words[0]), words[2]
    programs = [start([words[1], folder]), start([*words[4:], folder])]
    for _ in range(rounds // 10):
        for program in programs:
            play(program)
    ratios = []
    for _ in range(REPETITIONS):
        played = [[], []]
        for i in range(rounds // REPETITIONS):
            for which in ((0, 1) if i % 2 else (1, 0)):
                played[which].append(play(programs[which]))
        c, java = medians(played[0]), medians(played[1])
        ratios.append(sum(java[:-1]) / sum(c[:-1]))
        print(f"a frame: C {sum(c[:-1]) / len(c[:-1]) / 1e6:.3f} ms, Java {sum(java[:-1]) / len(java[:-1]) / 1e6:.3f} ms, "
              f"ratio {ratios[-1]:.4f}; a prediction: C {c[-1]:.0f} ns, Java {java[-1]:.0f} ns")
    print(f"median of {REPETITIONS} ratios: {statistics.median(ratios):.4f}, from {min(ratios):.4f} to {max(ratios):.4f}")
    for program in programs:
        program.stdin.close()
        program.wait()


if __name__ == "__main__":
    main(sys.argv[1:])
