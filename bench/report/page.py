"""The page: all figures of report.json in one file that loads nothing else. Its text is page.html."""

import base64
import html
import math
import pathlib
import re
import string

import solvers


def table(rows, columns):
    """`columns`: a heading and a format of each. What looks like a number is set to the right."""
    def line(cells, tag):
        return "<tr>" + "".join(
            f'<{tag} class="number">{cell}</{tag}>' if re.fullmatch(r"[0-9.e+| -]*[0-9][0-9.e+| -]*", cell)
            else f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>\n"

    return ('<div class="scroll" tabindex="0"><table>\n' + line(columns, "th") + "".join(
        line([form.format(**row) for form in columns.values()], "td") for row in rows) + "</table></div>\n")


def provenance(report):
    p = report["provenance"]
    rows = {"machine": f"{p['cpu']}, {p['cores']} cores", "compiler": p["compiler"],
            "flags": f"{p['flags']}, kernels -O2, all -ffp-contract=off", "commit": p["commit"],
            "date": f"{p['date'] or 'not given'} (SOURCE_DATE_EPOCH)", "measured by": p["command"],
            "seeds": f"epsilons {report['settings']['seed']}; hard cases and scenes: in their sources"}
    return table([{"what": what, "value": value} for what, value in rows.items()],
                 {"": "{what}", "this run": "{value}"})


def costs(report):
    """The cost of exactness: the speed of robust as a ratio to that of float."""
    groups, rows = {}, []
    for row in report["speeds"]:
        place = row["scene"], "tree" if row["structure"] == "bvh" else "scan", row["isa"]
        groups.setdefault(place, {})[row["solver"]] = row
    for place, of in groups.items():
        rate = {solver: row["mrays_per_s"] for solver, row in of.items()}
        rows.append({"place": place, "bundle": rate["bundle"], "robust": rate["robust"],
                     "to_fast": rate["robust"] / rate["fast"], "to_half_b": rate["robust"] / rate["half_b"],
                     "bundle_to_half_b": rate["bundle"] / rate["half_b"], "fast_differs": of["fast"]["differ"],
                     "half_b_differs": of["half_b"]["differ"]})
    worst = min(rows, key=lambda row: row["to_fast"])
    return worst, table(rows, {
        "scene": "{place[0]}", "by": "{place[1]}", "ISA": "{place[2]}", "bundles, Mray/s": "{bundle:.3g}",
        "packets, Mray/s": "{robust:.3g}",
        "packets to fast": "{to_fast:.2f}", "packets to half-b": "{to_half_b:.2f}",
        "bundles to half-b": "{bundle_to_half_b:.2f}", "other hits: fast": "{fast_differs}",
        "half-b": "{half_b_differs}"})


def is_judged(row):
    """Whether there is a t to judge: with no decision right there is none."""
    return row["wrong_decisions"] < row["hits"]


def middle_and_most(rows, column):
    values = sorted(row[column] for row in rows if is_judged(row))
    return f"{values[len(values) // 2]:.2g} / {values[-1]:.2g}" if values else "-"


def solver_table(report):
    """What each solver gets wrong over all hard cases, beside its speed on the main scene."""
    rows = []
    for row in solvers.main_speeds(report):
        cases = solvers.cases_of(report, row["isa"], row["solver"])
        if row["isa"] == report["widest"]:
            rows.append(row | {"name": solvers.NAMES[row["solver"]],
                               "wrong": solvers.wrong_in_a_million(cases, "wrong_decisions", "wrong_roots"),
                               "ulp": middle_and_most(cases, "ulp_p99"),
                               "residual": middle_and_most(cases, "residual_u")})
    return table(rows, {"solver": "{name}", f"{rows[0]['scene']}: Mray/s": "{mrays_per_s:.3g}",
                        "wrong in a million hard pairs": "{wrong:.0f}",
                        "error of t, ulp: median / worst case": "{ulp}",
                        "distance from the surface: likewise": "{residual}"})


def case_table(report, kind):
    """Three columns for each hard case and solver. `kind`: "cases" of spheres, or "capsules"."""
    lines = {}
    for row in report[kind]:
        if row["isa"] == report["widest"]:
            judged = f"{row['ulp_p99']:.2g} | {row['residual_u']:.2g}" if is_judged(row) else "- | -"
            lines.setdefault(row["case"], {"case": row["case"]})[row["solver"]] = (
                f"{row['wrong_decisions'] + row['wrong_roots']} | {judged}")
    return table(lines.values(), {"hard case": "{case}"} | {
        solvers.NAMES[solver]: f"{{{solver}}}" for solver in solvers.unique(report[kind], "solver")
        if all(solver in line for line in lines.values())})


def sum_table(report):
    rows = []
    for isa, solver in sorted({(row["isa"], row["solver"]) for row in report["cases"]}):
        cases = solvers.cases_of(report, isa, solver)
        rows.append({"solver": solvers.NAMES[solver], "isa": isa, "pairs": sum(row["pairs"] for row in cases),
                     "wrong": solvers.wrong_in_a_million(cases, "wrong_decisions")})
    return table(rows, {"solver": "{solver}", "ISA": "{isa}", "pairs": "{pairs}",
                        "wrong hits and misses in a million": "{wrong:.0f}"})


def pictures(report):
    return "".join(
        f'<figure><img alt="{html.escape(row["remedy"])}" width="{row["width"]}" height="{row["height"]}" '
        f'src="data:image/png;base64,{base64.b64encode(bytes.fromhex(row["png"])).decode()}">'
        f'<figcaption>{html.escape(row["remedy"])}: {row["false_shadows"]} false shadows, {row["leaks"]} leaks'
        "</figcaption></figure>\n" for row in report["pictures"])


def error_after(seconds, rows):
    """The error after so many seconds: between neighbours on logarithmic axes; beyond the last one as if it
    fell with the root of time."""
    after = next((i for i, row in enumerate(rows) if row["seconds"] >= seconds), len(rows))
    before = rows[max(after - 1, 0)]
    slope = 0 if after == 0 else -0.5
    if 0 < after < len(rows):
        slope = (math.log(rows[after]["error"] / before["error"]) /
                 math.log(rows[after]["seconds"] / before["seconds"]))
    return before["error"] * (seconds / before["seconds"]) ** slope


def path_table(report):
    rows = []
    for scene in report["paths"]:
        last = scene["sequence"][-1]
        random = error_after(last["seconds"], scene["random"])
        rows.append(last | {"scene": scene["scene"], "random": random, "ratio": random / last["error"],
                            "times": (random / last["error"]) ** 2})
    return table(rows, {"scene": "{scene}", "seconds": "{seconds:.3g}", "error, Sobol": "{error:.3g}",
                        "error, random": "{random:.3g}", "ratio": "{ratio:.2f}",
                        "random takes": "{times:.1f} times as long"})


def noise_table(report):
    return table(
        [row | {"scene": scene["scene"], "uniform": row["uniform_seconds"] / row["seconds"],
                "random": row["random_seconds"] / row["seconds"]}
         for scene in report["noise"] for row in scene["to_order"]],
        {"scene": "{scene}", "noise asked for": "{asked:.3g}", "samples a pixel": "{mean_samples:.1f}",
         "seconds": "{seconds:.3g}", "99 % within": "{within_99:.3g}",
         "as many everywhere take": "{uniform:.2f} times as long", "at random": "{random:.2f} times as long"})


def seconds_at(error, rows):
    """The seconds after which rows, the errors of which fall, have this error: between neighbours on logarithmic axes."""
    rows = sorted(rows, key=lambda row: row["seconds"])
    for before, after in zip(rows, rows[1:]):
        if before["rmse"] >= error >= after["rmse"]:
            share = math.log(before["rmse"] / error) / math.log(before["rmse"] / after["rmse"])
            return before["seconds"] * (after["seconds"] / before["seconds"]) ** share
    return None


def edge_table(report):
    """What other programs take, and Boule with as many samples everywhere, over --aa at the same error."""
    rows, adaptive = [], {}
    for row in report.get("edges", []):
        adaptive.setdefault(row["scene"], []).append(row) if row["program"] == "adaptive" else None
    for row in report.get("edges", []):
        ours = seconds_at(row["rmse"], adaptive[row["scene"]]) if row["program"] != "adaptive" else None
        times = f"{row['seconds'] / ours:.1f}" if ours else "-"
        rows.append(row | {"name": {"povray": "POV-Ray", "tachyon": "Tachyon"}.get(row["program"], "Boule"), "times": times})
    return table(rows, {"scene": "{scene}", "program": "{name}", "samples": "{mode}", "seconds": "{seconds:.3f}",
                        "RMS error": "{rmse:.2f}", "99.9 % within": "{p999:.1f}",
                        "times the seconds of --aa at that error": "{times}"}) if rows else ""


def peer_table(rows):
    return table(
        [row | {"share": f"{100 * row['mrays_per_s'] / row['one_solve']:.0f} %" if row["one_solve"] else "-"}
         for row in rows],
        {"scene": "{scene}", "rays": "{rays}", "contender": "{contender}", "solver": "{solver}",
         "Mray/s": "{mrays_per_s:.3g}", "range": "{least:.3g} to {most:.3g}", "to best Embree": "{ratio:.2f}",
         "of one solve": "{share}", "wrong": "{mismatches}", "of rays": "{count}"})


def page(report, charts):
    """The HTML. `charts`: charts.py, or nothing for a page without them."""
    def figures(name):
        svgs = getattr(charts, name)(report) if charts else []
        return "".join(f"<figure>{svg}</figure>\n" for svg in svgs if svg)

    worst, cost_table = costs(report)
    peers = report["peers"]
    template = string.Template(pathlib.Path(__file__).with_suffix(".html").read_text())
    return template.substitute(
        chart_style=charts.style() if charts else "", provenance=provenance(report), speeds=figures("speeds"),
        worst_ratio=f"{worst['to_fast']:.2f}", worst_place=", ".join(worst["place"]), costs=cost_table,
        widest=report["widest"], errors=figures("errors"), solvers=solver_table(report),
        cases=case_table(report, "cases"), capsules=case_table(report, "capsules"), sums=sum_table(report),
        epsilons=figures("epsilons"),
        pictures=pictures(report), growth=figures("growth"), path_size="{} x {}".format(*report["path_size"]),
        paths=figures("paths") + path_table(report), noise=figures("noise") + noise_table(report),
        edges=(figures("edges") + edge_table(report)) or "<p>They were not measured.</p>",
        embree=html.escape(f"Embree {peers['embree']}") if peers else "This build found no Embree (libembree-dev)",
        peers=peer_table(peers["rows"]) if peers else "")
