"""Measures the Python package beside the library itself: the same work, in one process, in turns.

    bench_python.py [--runs N] [--spheres N] [--rays N]

Prints medians. Run it through the target bench_python, which sets the paths.
"""

import argparse
import statistics
import subprocess
import sys
import time

import numpy as np

import boule
import boule_bench_native as native


def seconds(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def in_turns(runs, **works):
    """The median seconds of each, and its median of processor seconds, which other programs on the
    machine disturb less. They take turns, so that all see the same machine."""
    times = {name: [] for name in works}
    for run in range(runs + 1):
        for name, work in works.items():
            begin = time.process_time()
            taken = work()
            if run > 0:  # the first warms up
                times[name].append((taken, time.process_time() - begin))
    return {name: tuple(map(statistics.median, zip(*taken))) for name, taken in times.items()}


def camera_rays(count):
    """Rays of a pinhole in the order of its rows, and rays in random directions from the middle."""
    side = int(np.sqrt(count))
    y, x = np.mgrid[0:side, 0:side]
    across = (x.ravel() + 0.5) / side - 0.5
    down = 0.5 - (y.ravel() + 0.5) / side
    dir = np.stack([across, down, np.full(side * side, -1.0)], axis=1).astype(np.float32)
    org = np.broadcast_to(np.float32([0, 0, 30]), dir.shape).copy()
    return org, dir


def by_numpy(centers, radii, org, dir):
    """The nearest hits of a few rays by numpy alone: all spheres, one ray after the other."""
    nearest = np.empty(len(org))
    for k in range(len(org)):
        offset = org[k] - centers
        a = dir[k] @ dir[k]
        b = offset @ dir[k]
        c = np.einsum("ij,ij->i", offset, offset) - radii * radii
        root = b * b - a * c
        hit = root >= 0
        t = (-b[hit] - np.sqrt(root[hit])) / a
        t = t[t > 0]
        nearest[k] = t.min() if len(t) else np.inf
    return nearest


def import_seconds(module):
    """In a new interpreter, less what an empty one takes."""
    code = f"import time; t = time.perf_counter(); import {module}; print(time.perf_counter() - t)"
    return float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout)


def trace(runs, spheres, rays):
    rng = np.random.default_rng(1)
    centers = rng.uniform(-10, 10, (spheres, 3)).astype(np.float32)
    radii = np.full(spheres, 10 / spheres ** (1 / 3) * 0.4, np.float32)
    org, dir = camera_rays(rays)
    count = len(org)
    twin = native.Native(centers, radii)
    twin.set_rays(org, dir)
    tracer = boule.Tracer(centers, radii)
    hits = tracer.closest(org, dir)
    twin.closest_seconds()
    assert int(hits.id.sum(dtype=np.int64)) == twin.id_sum()
    org8, dir8 = org.astype(np.float64), dir.astype(np.float64)
    found = in_turns(
        runs,
        library=twin.closest_seconds,
        float32=lambda: seconds(lambda: tracer.closest(org, dir)),
        float64=lambda: seconds(lambda: tracer.closest(org8, dir8)),
    )
    print(f"closest, {count} rays of a camera, {spheres} spheres")
    for name, (taken, busy) in found.items():
        rate, rate_busy = found["library"][0] / taken, found["library"][1] / busy
        print(f"  {name:10} {count / taken / 1e6:8.2f} Mray/s  {rate:6.3f} of the library's rate, "
              f"by processor time {rate_busy:6.3f}")
    few = 20
    taken = seconds(lambda: by_numpy(centers.astype(np.float64), radii, org8[:few], dir8[:few]))
    print(f"  {'numpy':10} {few / taken / 1e6:8.5f} Mray/s  (by hand, {few} rays)")


def build(runs, spheres):
    rng = np.random.default_rng(2)
    centers = rng.uniform(-10, 10, (spheres, 3)).astype(np.float32)
    radii = np.full(spheres, 0.02, np.float32)
    centers8 = centers.astype(np.float64)
    found = in_turns(
        runs,
        library=lambda: native.build_seconds(centers, radii),
        float32=lambda: seconds(lambda: boule.Tracer(centers, radii)),
        float64=lambda: seconds(lambda: boule.Tracer(centers8, radii)),
    )
    print(f"from arrays to a Tracer, {spheres} spheres")
    for name, (taken, busy) in found.items():
        ratio, ratio_busy = taken / found["library"][0], busy / found["library"][1]
        print(f"  {name:10} {taken * 1000:8.1f} ms  {ratio:6.3f} of the library's time, "
              f"by processor time {ratio_busy:6.3f}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=9)
    parser.add_argument("--spheres", type=int, default=1_000_000)
    parser.add_argument("--rays", type=int, default=1_000_000)
    given = parser.parse_args()
    imports = in_turns(
        given.runs,
        boule=lambda: import_seconds("boule"),
        numpy=lambda: import_seconds("numpy"),
    )
    for name, (taken, _) in imports.items():
        print(f"import {name}: {taken * 1000:.1f} ms")
    for spheres in (1000, given.spheres):
        trace(given.runs, spheres, given.rays)
    build(given.runs, given.spheres)


if __name__ == "__main__":
    main()
