#!/usr/bin/python3 -B
"""report_test.py: charts, page and front page, made of a small report. Exit code 77: no matplotlib here."""

import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

REPORT = pathlib.Path(__file__).resolve().parents[2] / "bench" / "report"
sys.path.insert(0, str(REPORT))
if importlib.util.find_spec("matplotlib") is None:
    print("skipped: there is no matplotlib")
    sys.exit(77)

import chart
import charts
import page
import readme

SOLVERS = ("bundle", "robust", "fast", "half_b", "half_b_double", "closest_approach")


def errors_of(solver):
    return {"solver": solver, "pairs": 1000, "hits": 500, "wrong_decisions": 0 if solver == "robust" else 123,
            "wrong_roots": 2, "ulp_p99": 1.5, "residual_u": 2}


def over_time(scale):
    return [{"samples": 4 ** i, "mean_samples": 4 ** i, "asked": 0.1, "seconds": 4.0 ** i, "error": scale / 2 ** i,
             "within_99": scale / 2 ** i, "uniform_seconds": 3, "random_seconds": 5} for i in range(4)]


REPORT_JSON = {
    "provenance": {"cpu": "A <CPU>", "cores": 2, "compiler": "g++", "flags": "-O2", "commit": "0123abc",
                   "date": "2026-11-22", "command": "report -o report.json"},
    "edges": [{"scene": "lecture", "program": program, "mode": mode, "seconds": seconds, "rmse": rmse, "p999": 9}
              for program, mode, seconds, rmse in (("adaptive", "--aa 8", 1, 2), ("adaptive", "--aa 4", 4, 1),
                                                   ("uniform", "1 spp", 0.5, 9), ("povray", "+A0.1", 12, 2**0.5),
                                                   ("tachyon", "16 samples", 20, 1.5))],
    "settings": {"quick": True, "seed": 1}, "widest": "avx2", "path_size": [128, 72],
    "speeds": [{"scene": scene, "structure": structure, "isa": isa, "solver": solver, "mrays_per_s": rate + i,
                "least": 9, "most": 20, "differ": 3}
               for scene in ("u1000", "u10000") for structure in ("scan", "bvh")
               for isa, rate in (("scalar", 10), ("avx2", 30)) for i, solver in enumerate(SOLVERS)],
    "cases": [{"case": case, "isa": isa} | errors_of(solver)
              for case in ("far", "near") for isa in ("scalar", "avx2") for solver in SOLVERS[1:]],
    "capsules": [{"case": case, "isa": "avx2"} | errors_of(solver)
                 for case in ("thin", "tangent") for solver in ("robust", "textbook_double", "embree_curves")],
    "map": [{"distance": distance, "grazing": grazing} | errors_of(solver)
            for grazing in (2, 4) for distance in (1, 2, 3) for solver in SOLVERS[1:]],
    "epsilons": [{"experiment": experiment, "remedy": remedy, "x": x, "points": 10, "leaks": 0, "false_shadows": 4}
                 for experiment in charts.EXPERIMENTS for remedy in ("none", "ours") for x in (0.01, 1, 100)],
    "pictures": [{"remedy": "t > 1", "width": 4, "height": 3, "false_shadows": 1, "leaks": 2, "png": "89"}],
    "growth": [{"spheres": n, "rays": rays, "isa": "avx2", "form": form, "ns": n / 50, "least": 1, "most": 99}
               for n in (100, 1000) for rays, form in (("primary", "bundle"), ("shadow", "automatic"))],
    "paths": [{"scene": "soft", "sequence": over_time(1), "random": over_time(2)}],
    "noise": [{"scene": "soft", "uniform": over_time(2), "random": over_time(3), "to_order": over_time(1)}],
    "peers": {"embree": "3.13", "rows": [
        {"scene": "u1000", "rays": rays, "contender": contender, "solver": "robust", "mrays_per_s": rate,
         "least": rate, "most": rate, "ratio": rate / 50, "count": 4096, "mismatches": wrong, "one_solve": 200}
        for rays in ("primary", "shadow") for contender, rate, wrong in (
            ("embree-single", 40, 9), ("embree-8", 50, 7), ("boule-avx2", 90, 0), ("boule-avx512", 150, 0))]}}
DRAWN = ("speeds", "errors", "epsilons", "growth", "paths", "noise", "edges")


def tips(svg):
    return re.findall(r'data-tip="([^"]*)"', svg)


class Charts(unittest.TestCase):
    def expect_colors(self, svg):
        """Colours stand in the drawing, as librsvg and PDF want them, and a dark page has one for each."""
        drawing = re.sub(r"<style>.*?</style>", "", svg, flags=re.DOTALL)
        self.assertLessEqual(set(re.findall(r"#[0-9a-f]{6}", drawing)), set(chart.DARK))
        texts = re.findall(r"<text [^>]*>", drawing)
        self.assertGreater(len(texts), 5)
        for text in texts:
            self.assertIn(f"fill: {chart.INK}", text)

    def test_colors_suit_light_and_dark(self):
        for name in DRAWN:
            for svg in getattr(charts, name)(REPORT_JSON):
                self.expect_colors(svg)

    def test_shipped_charts_suit_light_and_dark(self):
        shipped = sorted(REPORT.glob("*.svg"))
        self.assertEqual([path.name for path in shipped], ["edges_flake4.svg", "edges_lecture.svg",
                                                             "error_at_equal_time.svg", "speed_against_error.svg"])
        for path in shipped:
            self.expect_colors(path.read_text())
            self.assertIn(chart.style(), path.read_text())

    def test_each_mark_has_its_values(self):
        svg = charts.main_speed(REPORT_JSON)
        self.assertEqual(len(tips(svg)), 2 * len(SOLVERS))
        self.assertIn("robust, bundles (ours), avx2: 30 Mray/s (9 to 20), 0 wrong in a million", tips(svg))
        self.assertIn("half-b, scalar: 13 Mray/s (9 to 20), 123000 wrong in a million", tips(svg))
        self.assertEqual(len(tips(*charts.errors(REPORT_JSON))), 6 * len(charts.MAPPED))

    def test_each_name_stands_once(self):
        svg = charts.main_speed(REPORT_JSON)
        for name in ("robust, bundles (ours)", "half-b", "closest approach", "scalar", "avx2"):
            self.assertEqual(svg.count(f">{name}<"), 1, name)

    def test_zero_has_a_place(self):
        axes = chart.new_figure(400).add_subplot()
        chart.set_logarithmic(axes, "x", [0, 30, 2000])
        zero, ten, hundred, thousand = (axes.transData.transform((x, 1))[0] for x in (0, 10, 100, 1000))
        self.assertAlmostEqual(zero, axes.bbox.x0)
        self.assertAlmostEqual(ten - zero, thousand - hundred)
        self.assertIn("0", [chart.number(tick) for tick in axes.get_xticks()])

    def test_numbers_of_axes_are_short(self):
        self.assertEqual([chart.number(x) for x in (0, 0.001, 0.5, 10000, 1e5, 1e-12)],
                         ["0", "0.001", "0.5", "10000", "10⁵", "10⁻¹²"])

    def test_names_meet_nothing(self):
        axes = chart.new_figure(300).add_axes((0, 0, 1, 1), xlim=(0, 720), ylim=(0, 300))
        names = {f"some name {i}": (700 + i, 100 + 3 * i) for i in range(8)} | {"alone": (5, 124)}
        self.assertEqual(chart.write_names(axes, names, list(names.values())), [])
        taken = [chart.Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in names.values()]
        axes.figure.draw_without_rendering()
        self.assertEqual(len(axes.texts), len(names))
        for note in axes.texts:
            box = chart.Text.get_window_extent(note, axes.figure.canvas.get_renderer())
            self.assertEqual(box.count_overlaps(taken), 0, note.get_text())
            self.assertTrue(0 <= box.x0 and box.x1 <= 720 and 0 <= box.y0 and box.y1 <= 300, note.get_text())
            taken.append(box)

    def test_without_room_the_legend_names_it(self):
        long = "longer than its plot " * 9 + "is"
        for name, has_line in (("short", False), (long, True)):
            svg = chart.draw("title", "x", "y", [([(1, 1, "tip")], chart.BLUE, "o", False)],
                             [(name, chart.BLUE, "o"), ("isa", chart.GREY, "s")], {name: (1, 1)})
            self.assertEqual(svg.count(f">{name}<"), 1)
            self.assertEqual(svg.count(f"fill: {chart.BLUE}"), 1 + has_line)


class Texts(unittest.TestCase):
    def test_page_shows_everything(self):
        text = page.page(REPORT_JSON, charts)
        self.assertEqual((text.count("<svg "), text.count("<h2>"), text.count("<table>")), (13, 10, 10))
        for part in ("A &lt;CPU&gt;, 2 cores", "runs at <b>0.92</b> of fast (u1000, scan, scalar)", "Embree 3.13.",
                     '<td class="number">6.0</td>', 'src="data:image/png;base64,iQ=="', '<td class="number">125 | 1.5 | 2</td>'):
            self.assertIn(part, text)
        self.assertIn("found no Embree", page.page(REPORT_JSON | {"peers": None}, None))

    def test_error_after_some_seconds(self):
        rows = [{"seconds": 1, "error": 8}, {"seconds": 4, "error": 2}]
        for seconds, error in ((0.5, 8), (1, 8), (2, 4), (4, 2), (16, 1)):
            self.assertAlmostEqual(page.error_after(seconds, rows), error)

    def test_front_page_is_written_anew(self):
        text = readme.with_block(f"before\n{readme.BEGIN}old\n{readme.END}after\n", REPORT_JSON)
        self.assertTrue(text.startswith(f"before\n{readme.BEGIN}- **Fast.** 3.0 times as many primary rays"))
        self.assertTrue(text.endswith(f"levels.\n{readme.END}after\n"))
        self.assertIn("| u1000 | 50 | 150 | 3.00 | 50 | 150 | 3.00 | 14 | 0 |\n", text)
        self.assertIn("- **Exact.** 0 wrong hits. Embree returns 14 wrong hits", text)
        self.assertLessEqual(max(map(len, text.splitlines())), 118)
        self.assertNotIn("old", text)
        self.assertNotIn("|", readme.block(REPORT_JSON | {"peers": None}))

    def test_links_and_commands_stay_whole(self):
        for indent in range(0, 100, 7):
            text = readme.wrap(f"{'x' * indent} and then `report -o report.json` or [repeat it](here)", "  ")
            self.assertIn("`report -o report.json`", text)
            self.assertIn("[repeat it](here)", text)


class Publish(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.readme = self.folder / "README.md"
        self.readme.write_text(f"{readme.BEGIN}{readme.END}")
        (self.folder / "report.json").write_text(json.dumps(REPORT_JSON))

    def publish(self, *options, python=(), seed="0"):
        return subprocess.run(["/usr/bin/python3", "-B", *python, REPORT / "publish.py", self.folder / "report.json",
                               "--readme", self.readme, *options],
                              capture_output=True, text=True, env=os.environ | {"PYTHONHASHSEED": seed})

    def test_same_figures_give_same_bytes(self):
        all_files = []
        for seed in ("1", "2"):
            run = self.publish("--charts", self.folder, seed=seed)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            all_files.append({path.name: path.read_bytes() for path in self.folder.iterdir()})
        self.assertEqual(*all_files)
        self.assertEqual(sorted(all_files[0]), ["README.md", "error_at_equal_time.svg", "report.html",
                                                "report.json", "speed_against_error.svg"])

    def test_without_matplotlib_the_rest_works(self):
        run = self.publish(python=["-S"])  # -S: without Debian's packages
        self.assertEqual(run.returncode, 0)
        self.assertRegex(run.stderr, r"^publish.py: no charts without matplotlib[^\n]*\n$")
        self.assertIn("| u1000 | 50 |", self.readme.read_text())
        text = (self.folder / "report.html").read_text()
        self.assertEqual((text.count("<svg "), text.count("<table>")), (0, 9))
        self.assertEqual(self.publish("--charts", self.folder, python=["-S"]).returncode, 1)

    def test_readme_without_marks_stays(self):
        self.readme.write_text("no marks")
        run = self.publish()
        self.assertEqual(run.returncode, 1)
        self.assertIn("has no marks for figures", run.stderr)
        self.assertEqual(self.readme.read_text(), "no marks")


if __name__ == "__main__":
    unittest.main()
