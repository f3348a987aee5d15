"""The solvers that the report knows, and what their rows in report.json say."""

NAMES = {
    "bundle": "robust, bundles (ours)", "robust": "robust, packets (ours)", "fast": "fast, packets (ours)",
    "half_b": "half-b", "textbook": "textbook", "stable_q": "stable q", "kahan": "Kahan",
    "closest_approach": "closest approach", "half_b_double": "half-b, double",
    "closest_approach_double": "closest approach, double",
    "textbook_double": "textbook, double", "embree_curves": "Embree's curves"}


def unique(rows, key):
    """The values of a key, each once, in the order of the rows."""
    return list(dict.fromkeys(row[key] for row in rows))


def wrong_in_a_million(rows, *kinds):
    return 1e6 * sum(row[kind] for row in rows for kind in kinds) / sum(row["pairs"] for row in rows)


def cases_of(report, isa, solver):
    """The hard cases of a solver. The hits of bundles are those of packets, bit for bit."""
    solver = "robust" if solver == "bundle" else solver
    return [row for row in report["cases"] if (row["isa"], row["solver"]) == (isa, solver)]


def main_speeds(report):
    """The rows of the scene that is shown where there is room for one only."""
    rows = [row for row in report["speeds"] if row["structure"] == "bvh"]
    scene = unique(rows, "scene")[:2][-1]
    return [row for row in rows if row["scene"] == scene]
