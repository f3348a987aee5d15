"""The README's table of figures, from report.json."""

import re
import textwrap

import solvers

BEGIN, END = "<!-- report: begin -->\n", "<!-- report: end -->\n"
# A test looks for this line in the report of the commit that was measured.
HEADING = "| scene | primary: Embree | Boule | ratio | shadow: Embree | Boule | ratio | wrong: Embree | Boule |"
MOST_ROWS = 8  # a first look; the page has them all


def wrap(text, indent=""):
    """Lines of 118 characters at most; what links and commands say stays on one."""
    whole = re.sub(r"\[.*?\]|`.*?`", lambda found: found[0].replace(" ", "\0"), text)
    return textwrap.fill(whole, 118, subsequent_indent=indent, break_long_words=False,
                         break_on_hyphens=False).replace("\0", " ") + "\n"


def find_duel(rows, scene, rays):
    """The best of Embree and the widest of Boule on the same rays, or nothing. Boule's rows come in the order
    of their instruction sets, the widest last."""
    rows = [row for row in rows if (row["scene"], row["rays"]) == (scene, rays)]
    embree = [row for row in rows if row["contender"].startswith("embree")]
    boule = [row for row in rows if row["contender"] in ("boule-avx2", "boule-avx512")]
    if not embree or not boule:
        return None
    return max(embree, key=lambda row: row["mrays_per_s"]), boule[-1]


def find_duels(rows):
    """Scene -> the duels on its primary and its shadow rays, of scenes that both have traced."""
    duels = {scene: [find_duel(rows, scene, rays) for rays in ("primary", "shadow")]
             for scene in solvers.unique(rows, "scene")}
    return dict([(scene, pair) for scene, pair in duels.items() if all(pair)][:MOST_ROWS])


def wrong(pair, contender):
    return sum(duel[contender]["mismatches"] for duel in pair)


def span(values, form=""):
    """"1.7 to 3.8", or one number where both are the same."""
    return " to ".join(dict.fromkeys(format(value, form) for value in (min(values), max(values))))


def claims(version, duels):
    """The two claims that are measured."""
    primary, shadow = ([pair[i][1]["ratio"] for pair in duels.values()] for i in (0, 1))
    link = "([repeat it](docs/howto/claims.md#how-fast))"
    return wrap(f"- **Fast.** {span(primary, '.1f')} times as many primary rays a second as Embree {version}, "
                f"and {span(shadow, '.1f')} times as many shadow rays {link}.", "  ") + wrap(
        f"- **Exact.** {sum(wrong(pair, 1) for pair in duels.values())} wrong hits. Embree returns "
        f"{span([wrong(pair, 0) for pair in duels.values()])} wrong hits in each of these scenes {link}.", "  ")


def table(duels):
    """A row for each scene: its primary rays, its shadow rays, and how many both got wrong together."""
    lines = [HEADING, "|---|" + "---:|" * 8]
    for scene, pair in duels.items():
        rates = "".join(f" {embree['mrays_per_s']:.3g} | {boule['mrays_per_s']:.3g} | "
                        f"{boule['ratio']:.2f} |" for embree, boule in pair)
        lines.append(f"| {scene} |{rates} {wrong(pair, 0)} | {wrong(pair, 1)} |")
    return "\n".join(lines) + "\n"


def block(report):
    p = report["provenance"]
    date = f", {p['date']}" if p["date"] else ""
    measured = f"Measured on {p['cpu']}, {p['compiler']}, commit {p['commit']}{date}, by `{p['command']}`"
    embree = report["peers"]
    duels = find_duels(embree["rows"]) if embree else {}
    if not duels:
        return wrap(f"{measured}. This build found no Embree to compare with.")
    return f"{claims(embree['embree'], duels)}\n{table(duels)}\n" + wrap(
        f"{measured}: one thread, {report['widest']}, million rays a second, the same "
        f"{embree['rows'][0]['count']} camera rays of each scene, Embree in the best of its modes. A hit is wrong "
        "if an independent tree in double finds another one. uN: N balls at random; sticksN: N atoms with bonds; "
        "flakeN: a sphereflake of N levels.")


def with_block(readme, report):
    """The text with the figures between its marks; nothing where it has none."""
    before, begin, rest = readme.partition(BEGIN)
    _, end, after = rest.partition(END)
    return before + begin + block(report) + end + after if begin and end else None
