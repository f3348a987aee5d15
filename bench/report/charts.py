"""The charts of report.json: which figures each shows."""

from matplotlib.collections import PatchCollection
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch, Rectangle

import solvers
from chart import (BLUE, BROWN, COLD, GREEN, GREY, HOT, INK, LEFT, OLIVE, ORANGE, PINK, SKY, WIDTH, alone,
                   draw, new_figure, number, style, to_svg)

COLORS = {"bundle": INK, "robust": BROWN, "fast": BLUE, "half_b": HOT, "textbook": ORANGE, "stable_q": PINK,
          "kahan": OLIVE, "closest_approach": SKY, "half_b_double": GREEN, "closest_approach_double": GREY}
SHAPES = {"scalar": "o", "sse42": "s", "avx2": "^", "avx512": "D", "neon": "v"}
FORMS = {"bundle": ("bundles", INK), "packet": ("packets", BLUE), "single": ("single rays", HOT)}
SECONDARY = {"shadow": ("shadow rays to a point", INK), "light": ("shadow rays to a ball", BLUE),
             "mirror": ("mirrored", HOT), "diffuse": ("diffuse bounces", ORANGE)}
EXPERIMENTS = {
    "scale": ("Wrong shadows over the scene's scale", "size of a ball, in units"),
    "distance": ("Wrong shadows over the camera's distance", "distance of the camera, in radii of the ball"),
    "ground": ("Wrong shadows over the radius of the ground",
               "radius of the ground sphere, in radii of the balls on it")}
MAPPED = ("robust", "fast", "closest_approach", "half_b", "half_b_double")


def isa_key(rows):
    return [(isa, GREY, shape) for isa, shape in SHAPES.items() if any(row["isa"] == isa for row in rows)]


def speed(report, rows):
    """Mray/s against wrong decisions per million, a point for each solver and ISA, of one scene's rows."""
    series, names = [], {}
    for row in sorted(rows, key=lambda row: row["mrays_per_s"]):
        name, rate = solvers.NAMES[row["solver"]], row["mrays_per_s"]
        x = solvers.wrong_in_a_million(solvers.cases_of(report, row["isa"], row["solver"]), "wrong_decisions")
        series.append(([(x, rate, f"{name}, {row['isa']}: {rate:.3g} Mray/s ({row['least']:.3g} to "
                                  f"{row['most']:.3g}), {x:.0f} wrong in a million")],
                       COLORS[row["solver"]], SHAPES[row["isa"]], False))
        names[name] = (x, rate)  # the fastest of a solver comes last
    key = [(solvers.NAMES[solver], color, "o") for solver, color in COLORS.items()
           if solvers.NAMES[solver] in names]
    way = "through the tree" if rows[0]["structure"] == "bvh" else "every sphere tested"
    return draw(f"Speed against error, {rows[0]['scene']}, {way}", "wrong hits or misses in a million hard pairs",
                "million rays per second, one thread", series, key + isa_key(rows), names)


def main_speed(report):
    return speed(report, solvers.main_speeds(report))


def speeds(report):
    """One chart for each scene, of scans first."""
    groups = {}
    for row in sorted(report["speeds"], key=lambda row: row["structure"] == "bvh"):
        groups.setdefault((row["structure"], row["scene"]), []).append(row)
    return [speed(report, rows) for rows in groups.values()]


def hot(share):
    """Of a cell: the more is wrong, the hotter."""
    return to_rgba(HOT, 0.15 + 0.85 * share) if share > 0 else to_rgba(COLD)


def errors(report):
    """Where five solvers go wrong, by distance and by how closely a sphere is grazed."""
    title = "Wrong hits and misses, by distance and grazing"
    figure, tips = new_figure(560), {}
    figure.suptitle(title, x=LEFT / WIDTH, y=0.985, ha="left", fontsize=13, fontweight="bold")
    *maps, rest = figure.subplots(2, 3, sharex=True, sharey=True, gridspec_kw={
        "left": LEFT / WIDTH, "right": 0.985, "bottom": 0.11, "top": 0.89, "wspace": 0.07, "hspace": 0.14}).flat
    for axes, solver in zip(maps, MAPPED):
        name, cells = solvers.NAMES[solver], [row for row in report["map"] if row["solver"] == solver]
        tips[solver] = [
            f"{name}, distance 10^{row['distance'] / 2:.1f} radii, 2^-{row['grazing']}: {row['wrong_decisions']} of "
            f"{row['pairs']} wrong; t off by {row['ulp_p99']:.3g} ulp (p99)" for row in cells]
        axes.add_collection(PatchCollection(
            [Rectangle((row["distance"] - 0.48, row["grazing"] - 0.96), 0.96, 1.92) for row in cells], gid=solver,
            facecolors=[hot(row["wrong_decisions"] / row["pairs"]) for row in cells], edgecolors="none"))
        axes.set_title(name, fontsize=11, fontweight="normal", pad=6)
    distances, grazings = solvers.unique(report["map"], "distance"), solvers.unique(report["map"], "grazing")
    rest.set(xlim=(distances[0] - 0.5, distances[-1] + 0.5), ylim=(grazings[0] - 1, grazings[-1] + 1),
             xticks=range(2, distances[-1] + 1, 4), yticks=range(4, grazings[-1] + 1, 4))
    rest.xaxis.set_major_formatter(lambda distance, _: number(10 ** (distance / 2)))
    for axes in (*maps, rest):
        axes.grid(False)
        axes.spines[:].set_visible(False)
    rest.axis("off")
    maps[2].xaxis.set_tick_params(labelbottom=True)
    rest.legend(handles=[Patch(facecolor=hot(share), label=f"{100 * share:g} % wrong")
                         for share in (0, 0.01, 0.25, 0.5, 1)], loc="center")
    figure.supxlabel("distance of the sphere, in radii", fontsize=11, y=0.03)
    figure.supylabel("k, where rays are aimed at r (1 ± 2⁻ᵏ)", fontsize=11, x=0.04)
    return [to_svg(figure, title, tips)]


def epsilon(rows, title, x):
    """False shadows and leaks of each remedy in one experiment, in percent of the points."""
    looks = zip((BLUE, HOT, GREEN, PINK, ORANGE, BROWN, GREY), "os^vPXp")
    key = [(remedy, *((INK, "D") if remedy == "ours" else next(looks)))
           for remedy in solvers.unique(rows, "remedy")]
    series = [([(row["x"], 100 * (row["false_shadows"] + row["leaks"]) / max(row["points"], 1),
                 f"{remedy}, {row['x']:.3g}: {row['false_shadows']} false shadows and {row['leaks']} leaks at "
                 f"{row['points']} points")
                for row in rows if row["remedy"] == remedy], *look, True) for remedy, *look in key]
    return draw(title, x, "points judged wrongly, %", series, key, percent=True)


def epsilons(report):
    return [epsilon([row for row in report["epsilons"] if row["experiment"] == experiment], *labels)
            for experiment, labels in EXPERIMENTS.items()]


def growth(report):
    """Time of a ray over the number of spheres: a line for each form or kind of rays, and each ISA."""
    svgs = []
    for of_ray, column, lines in (("camera", "form", FORMS), ("secondary", "rays", SECONDARY)):
        rows, series = [row for row in report["growth"] if row[column] in lines], []
        for line, isa in dict.fromkeys((row[column], row["isa"]) for row in rows):
            name, color = lines[line]
            series.append(([(row["spheres"], row["ns"], f"{name}, {isa}, {row['spheres']} spheres: {row['ns']:.1f} "
                             f"ns ({row['least']:.1f} to {row['most']:.1f})")
                            for row in rows if (row[column], row["isa"]) == (line, isa)], color, SHAPES[isa], True))
        svgs.append(draw(f"Time of a {of_ray} ray among n random spheres", "spheres",
                         "nanoseconds a ray, one thread", series,
                         [(name, color, "o") for name, color in lines.values()] + isa_key(rows)))
    return svgs


def over_time(title, y, column, lines, tip):
    """Errors over seconds. `lines`: the rows of each, its name, colour and shape."""
    return draw(title, "seconds, one thread", y, [
        ([(row["seconds"], row[column], f"{name}, {tip.format(**row)}") for row in rows], color, shape, True)
        for rows, name, color, shape in lines], [look for _, *look in lines])


def paths(report):
    """Error over time, ours beside random samples."""
    return [over_time(
        f"Error of path tracing over time, {scene['scene']}", "RMS error of the radiance", "error",
        [(scene["sequence"], "scrambled Sobol (ours)", INK, "o"),
         (scene["random"], "plain random numbers", HOT, "s")],
        "{samples} samples a pixel: error {error:.3g} after {seconds:.3g} s") for scene in report["paths"]]


def noise(report):
    """Error over time: as many samples everywhere, in sequence and at random, and noise to order."""
    return [over_time(
        f"Error of pictures over time, {scene['scene']}", "error of 99 % of the pixels, displayed", "within_99",
        [(scene["to_order"], "noise to order", INK, "o"),
         (scene["uniform"], "as many samples everywhere", BLUE, "^"),
         (scene["random"], "the same, plain random numbers", HOT, "s")],
        "{mean_samples:.3g} samples a pixel: 99 % within {within_99:.3g} after {seconds:.3g} s")
        for scene in report["noise"]]


def edges(report):
    """Error over time of whole pictures without noise, a chart for each scene: bench/others/edge_pictures.py."""
    lines = {"adaptive": ("Boule, --aa", INK, "o"), "uniform": ("Boule, as many samples everywhere", BLUE, "^"),
             "povray": ("POV-Ray, adaptive", HOT, "s"), "tachyon": ("Tachyon, as many samples everywhere", GREEN, "v")}
    of_scene = {}
    for row in sorted(report.get("edges", []), key=lambda row: row["seconds"]):
        of_scene.setdefault(row["scene"], {}).setdefault(row["program"], []).append(row)
    return [over_time(
        f"Error of whole pictures over time, {scene}", "RMS error, codes of 255", "rmse",
        [(of_scene[scene][program], *look) for program, look in lines.items() if program in of_scene[scene]],
        "{mode}: RMS error {rmse:.3g}, 99.9 % within {p999:.3g}, after {seconds:.3g} s")
        for scene in solvers.unique(report.get("edges", []), "scene")]
