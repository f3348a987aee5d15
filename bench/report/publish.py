#!/usr/bin/python3 -B
"""Makes what people read of the figures that the program `report` has measured.

    bench/report/publish.py report.json                      report.html, beside it
    bench/report/publish.py report.json --charts bench/report --readme README.md

The same figures give the same bytes. Charts need matplotlib (Debian: python3-matplotlib); without it the
page has its tables, and the exit code is 1 if --charts asks for more.
"""

import argparse
import importlib.util
import json
import os
import pathlib
import sys

import page
import readme
import solvers


def write(path, text):
    """All or nothing: under another name first."""
    temporary = path.with_name(path.name + ".temp")
    temporary.write_text(text, encoding="utf-8")
    os.replace(temporary, path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("figures", type=pathlib.Path, help="report.json")
    parser.add_argument("--edges", type=pathlib.Path, nargs="*", default=[], metavar="FIGURES.json",
                        help="what bench/others/edge_pictures.py has measured")
    parser.add_argument("--charts", type=pathlib.Path, metavar="FOLDER", help="write the charts of documents here")
    parser.add_argument("--readme", type=pathlib.Path, help="a text whose figures are brought up to date")
    arguments = parser.parse_args()
    report = json.loads(arguments.figures.read_text(encoding="utf-8"))
    report["edges"] = [row for path in arguments.edges for row in json.loads(path.read_text(encoding="utf-8"))]
    charts = None
    if importlib.util.find_spec("matplotlib"):
        import charts
    else:
        print("publish.py: no charts without matplotlib (Debian: python3-matplotlib)", file=sys.stderr)
    write(arguments.figures.with_suffix(".html"), page.page(report, charts))
    if arguments.charts and charts:
        write(arguments.charts / "speed_against_error.svg", charts.alone(charts.main_speed(report)))
        write(arguments.charts / "error_at_equal_time.svg", charts.alone(charts.paths(report)[0]))
        for scene, svg in zip(solvers.unique(report["edges"], "scene"), charts.edges(report)):
            write(arguments.charts / f"edges_{scene}.svg", charts.alone(svg))
    if arguments.readme:
        text = readme.with_block(arguments.readme.read_text(encoding="utf-8"), report)
        if text is None:
            sys.exit(f"publish.py: '{arguments.readme}' has no marks for figures")
        write(arguments.readme, text)
    return 1 if arguments.charts and not charts else 0


if __name__ == "__main__":
    sys.exit(main())
