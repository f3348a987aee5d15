#!/usr/bin/env python3
"""What building costs: seconds by part, the dearest files, the largest process.

    bench/build_cost.py build/release                     reads what ninja has noted
    bench/build_cost.py build/release --build [TARGET...] builds first, with CPU seconds and memory

Seconds of jobs are by the clock: jobs side by side share the processors. What builds is also measured
as a whole: user and system time of all processes, and the peak memory of the largest one. For figures
to be compared begin with an empty folder, and without a compiler cache (CCACHE_DISABLE=1).
"""

import argparse
import collections
import pathlib
import re
import resource
import subprocess
import sys
import time

# The first that is found in an output's path says which part it is of.
PARTS = [
    ("kernels", r"^simd/CMakeFiles/boule_kernel_"),
    ("core, simd", r"^(core|simd)/"),
    ("program", r"^render/apps/cli/"),
    ("browser", r"^render/apps/view/"),
    ("manual", r"^render/apps/manual/"),
    ("Python", r"^render/apps/python/"),
    ("render library", r"^render/"),
    ("tests", r"^tests/"),
    ("benchmarks", r"^bench/"),
    ("other", r""),
]


def part_of(output):
    return next(name for name, pattern in PARTS if re.search(pattern, output))


def read_log(folder):
    """The last run of each job: output -> seconds."""
    log = folder / ".ninja_log"
    if not log.is_file():
        sys.exit(f"build_cost: {log}: there is no such file; was the folder built by ninja?")
    seconds = {}
    for line in log.read_text().splitlines()[1:]:
        begin, end, _, output, _ = line.split("\t")
        seconds[output.removeprefix(f"{folder.resolve()}/")] = (int(end) - int(begin)) / 1000
    return seconds


def build(folder, targets):
    """Builds, and prints what all of it took."""
    command = ["cmake", "--build", str(folder)]
    if targets:
        command += ["--target", *targets]
    before = time.monotonic()
    subprocess.run(command, check=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    print(f"{used.ru_utime + used.ru_stime:.0f} CPU s, {time.monotonic() - before:.0f} s by the clock, "
          f"largest process {used.ru_maxrss / 1024:.0f} MiB")


def report(seconds, count):
    """Prints sums by part, and the dearest jobs."""
    sums = collections.Counter()
    for output, took in seconds.items():
        sums[part_of(output)] += took
    print(f"\n| part | seconds of jobs |\n|---|--:|\n| all | {sum(sums.values()):.0f} |")
    for name, took in sums.most_common():
        print(f"| {name} | {took:.0f} |")
    print(f"\n| the dearest {count} | seconds |\n|---|--:|")
    for output in sorted(seconds, key=seconds.get, reverse=True)[:count]:
        print(f"| {re.sub(r'CMakeFiles/|[.]dir', '', output)} | {seconds[output]:.1f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="a folder that ninja builds in")
    parser.add_argument("--build", nargs="*", metavar="TARGET", help="build these targets first, or all")
    parser.add_argument("--dearest", type=int, default=10, help="how many jobs to list")
    arguments = parser.parse_args()
    if arguments.build is not None:
        build(arguments.folder, arguments.build)
    report(read_log(arguments.folder), arguments.dearest)


if __name__ == "__main__":
    main()
