#!/usr/bin/python3
"""point_peers.py [--spheres N] [--points N] [--repeats N]

What is near points, and pairs of spheres: Boule's Tracer beside scipy's cKDTree in one process and thread, for spheres of
equal radii, which are all that a tree of points can do. Seconds are the process's, the least of turns. Answers are compared.
Needs the package boule on PYTHONPATH, python3-numpy and python3-scipy.
"""
import argparse
import time

import boule
import numpy as np
from scipy.spatial import cKDTree


def timed(times, name, work):
    start = time.process_time()
    answer = work()
    times.setdefault(name, []).append(time.process_time() - start)
    return answer


def sorted_pairs(pairs):
    pairs = np.sort(pairs, axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--spheres", type=int, default=1_000_000)
    parser.add_argument("--points", type=int, default=200_000)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    rng = np.random.default_rng(1)
    centers = rng.random((options.spheres, 3)).astype(np.float32)
    points = rng.random((options.points, 3))
    radius = np.float32(0.5 * (1.5 / np.pi / options.spheres) ** (1 / 3))  # as many pairs as spheres
    reach = float(np.cbrt(3 / np.pi / options.spheres))  # of centres: four a point
    tracer, tree = boule.Tracer(centers, radius, threads=1), cKDTree(centers.astype(float))
    ours, theirs, same = {}, {}, {}
    for _ in range(options.repeats):
        for k in (1, 8):
            name = f"nearest, k = {k}"
            a = timed(ours, name, lambda: tracer.nearest(points, k=k))
            b = timed(theirs, name, lambda: tree.query(points, k=k))
            same[name] = np.mean(np.reshape(a.id, -1) == np.reshape(b[1], -1))
        name = f"within {reach:.3g}"
        a = timed(ours, name, lambda: tracer.within(points, reach - float(radius)))
        b = timed(theirs, name, lambda: tree.query_ball_point(points, reach, return_sorted=True))
        same[name] = np.mean([np.array_equal(a.id[a.offset[i]:a.offset[i + 1]], b[i]) for i in range(len(points))])
        a = timed(ours, "pairs", tracer.pairs)
        b = sorted_pairs(timed(theirs, "pairs", lambda: tree.query_pairs(2 * float(radius), output_type="ndarray")))
        same["pairs"] = float(np.array_equal(np.stack([a.first, a.second], axis=1), b))
    print(f"{len(b)} pairs")
    for name in ours:
        print(f"{name}: Boule {min(ours[name]):.3f} s, cKDTree {min(theirs[name]):.3f} s, "
              f"{min(theirs[name]) / min(ours[name]):.2f} times; {100 * same[name]:.4f} % of the answers are the same")


main()
