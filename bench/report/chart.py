"""Charts by matplotlib, as SVG for light and dark pages, whose marks keep their values as data-tip."""

import io
import itertools
import math
import xml.etree.ElementTree as ElementTree

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.ticker import LogLocator, NullLocator
from matplotlib.transforms import Bbox

# Light colours and dark ones. The series' can be told apart by the colour-blind (Okabe and Ito 2008).
INK, FAINT, PAGE, HOT, COLD = "#222222", "#d8d8d8", "#ffffff", "#d55e00", "#eef1f4"
BLUE, GREEN, PINK, ORANGE = "#0072b2", "#009e73", "#cc79a7", "#e69f00"
SKY, GREY, OLIVE, BROWN = "#56b4e9", "#6b6b6b", "#9a8a00", "#8b4a1c"
DARK = {INK: "#e6e6e6", FAINT: "#3c4043", PAGE: "#15181b", HOT: "#f07b2c", COLD: "#23282d",
        BLUE: "#4aa8e0", GREEN: "#2bc79a", PINK: PINK, ORANGE: ORANGE, SKY: SKY, GREY: "#a8a8a8",
        OLIVE: "#d8cc3a", BROWN: "#c98c5a"}

WIDTH, HEIGHT = 720, 424  # in points, without the legend
LEFT, RIGHT, TOP, BOTTOM = 76, 20, 34, 54
LEGEND_LINE = 19
SVG = "{http://www.w3.org/2000/svg}"

ElementTree.register_namespace("", SVG[1:-1])
ElementTree.register_namespace("xlink", "http://www.w3.org/1999/xlink")
matplotlib.rcParams.update({
    "font.sans-serif": ["DejaVu Sans", "Verdana"], "font.size": 11, "svg.fonttype": "none",
    "text.color": INK, "axes.labelcolor": INK, "axes.labelsize": 11, "axes.titlesize": 13,
    "axes.titleweight": "bold", "axes.titlelocation": "left", "axes.titlepad": 12, "axes.edgecolor": FAINT,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "grid.color": FAINT,
    "axes.axisbelow": True, "xtick.labelcolor": INK, "ytick.labelcolor": INK, "xtick.major.size": 0,
    "ytick.major.size": 0, "xtick.major.pad": 8, "ytick.major.pad": 8, "figure.facecolor": PAGE,
    "axes.facecolor": PAGE, "figure.dpi": 72, "legend.frameon": False, "lines.markeredgecolor": PAGE,
    "lines.markeredgewidth": 0.8})


def style():
    """The style sheet: the dark colours take the place of the light ones that the drawing has."""
    rules = "".join(f'[style*="{what}: {light}"] {{ {what}: {dark} !important; }}\n'
                    for light, dark in DARK.items() for what in ("fill", "stroke"))
    return ("svg.chart * { stroke-linejoin: round; stroke-linecap: butt; }\n"
            f"svg.chart [data-tip]:hover, svg.chart [data-tip]:focus {{ outline: 2px solid {BLUE}; }}\n"
            f"@media (prefers-color-scheme: dark) {{\n{rules}}}\n")


def to_svg(figure, title, tips):
    """The drawing. `tips`: of the artist with this gid, one for each mark."""
    file = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": title}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    root = ElementTree.fromstring(file.getvalue())
    root.attrib.update({"class": "chart", "role": "img", "aria-label": title})
    for name in ("metadata", "defs"):  # no date, and no style for the whole page that it is on
        root.remove(root.find(SVG + name))
    for element in root.iter():
        element.text, element.tail = (element.text or "").strip(), ""
        of_marks = tips.get(element.attrib.pop("id", None)) if element.tag == f"{SVG}g" else None
        if of_marks:
            marks = element.findall(f".//{SVG}use") or element.findall(f"{SVG}path")
            for mark, tip in zip(marks, of_marks, strict=True):
                mark.attrib.update({"tabindex": "0", "data-tip": tip})
    return ElementTree.tostring(root, encoding="unicode").replace("><g", ">\n<g") + "\n"


def alone(svg):
    """A chart as a file by itself."""
    return svg.replace("\n", f"\n<style>{style()}</style>\n", 1)


def new_figure(height):
    figure = Figure(figsize=(WIDTH / 72, height / 72))
    FigureCanvasAgg(figure)
    return figure


def number(value, _=None):
    """Of an axis: 10⁵ where digits are many."""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:g}"
    power = str(round(math.log10(value)))
    return "10" + power.translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def set_logarithmic(axes, name, values):
    """Where 0 has a place of its own, a decade before the others."""
    positive = [value for value in values if value > 0] or [1]
    least, most = min(positive) / 1.4, max(positive) * 1.4
    axis = getattr(axes, f"{name}axis")
    if 0 in values:
        decade = 10.0 ** math.floor(math.log10(min(positive)))
        getattr(axes, f"set_{name}scale")("symlog", linthresh=decade, linscale=0.9)
        getattr(axes, f"set_{name}lim")(0, 10.0 ** math.ceil(math.log10(most)))
    else:
        getattr(axes, f"set_{name}scale")("log")
        getattr(axes, f"set_{name}lim")(least, most)
        axis.set_major_locator(LogLocator(subs=(1, 2, 5) if most / least < 100 else (1,)))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(number)


def write_names(axes, names, points):
    """Writes names beside their points, where they meet neither each other nor a mark, and leads a line to
    those that had to go farther. Returns the names that found no room."""
    renderer = axes.figure.canvas.get_renderer()
    plot = axes.get_window_extent(renderer)
    taken = [Bbox.from_bounds(x - 5, y - 5, 10, 10) for x, y in axes.transData.transform(points)]
    left_out = []
    for name, point in names.items():
        note = axes.annotate(name, point, (0, 0), textcoords="offset points", fontsize=10, va="center",
                             arrowprops={"arrowstyle": "-", "color": GREY, "linewidth": 0.6, "shrinkA": 0,
                                         "shrinkB": 4, "relpos": (0.5, 0.5)})
        for up, side in itertools.product(sorted(range(-144, 145, 6), key=abs), (1, -1)):
            note.set(position=(side * (9 if abs(up) < 18 else 20), up), ha="left" if side > 0 else "right")
            note.update_positions(renderer)
            box = Text.get_window_extent(note, renderer).padded(1)  # without the line
            inside = plot.x0 <= box.x0 and box.x1 <= plot.x1 and plot.y0 <= box.y0 and box.y1 <= plot.y1
            if inside and not box.count_overlaps(taken):
                taken.append(box)
                note.arrow_patch.set_visible(abs(up) >= 12)
                break
        else:
            note.remove()
            left_out.append(name)
    return left_out


def set_box(figure, axes, height):
    """The axes keep their size, whatever the height of the figure."""
    figure.set_size_inches(WIDTH / 72, height / 72)
    axes.set_position((LEFT / WIDTH, 1 - (HEIGHT - BOTTOM) / height, (WIDTH - LEFT - RIGHT) / WIDTH,
                       (HEIGHT - BOTTOM - TOP) / height))


def draw(title, x, y, series, key, names=None, percent=False):
    """A chart. `series`: points, each x, y and tip; colour; shape; whether a line joins them. `key`: name,
    colour and shape of each entry of the legend, which leaves out the `names` that there is room for beside
    their points. `percent`: of y, which is logarithmic otherwise. Without series: the empty text."""
    if not series:
        return ""
    figure, tips, points = new_figure(HEIGHT), {}, []
    axes = figure.add_axes((0, 0, 1, 1), xlabel=x, ylabel=y)
    axes.set_title(title)

    def look(color, marker):  # triangles seem smaller than they are
        return {"color": color, "marker": marker, "markersize": 9.5 if marker in "^v" else 8}

    for i, (marks, color, marker, line) in enumerate(series):
        xs, ys, tips[f"series{i}"] = zip(*marks)
        points += zip(xs, ys)
        axes.plot(xs, ys, **look(color, marker), linewidth=1.6 * line, clip_on=False, zorder=3,
                  gid=f"series{i}")
    set_logarithmic(axes, "x", [point[0] for point in points])
    axes.set_ylim(bottom=0) if percent else set_logarithmic(axes, "y", [point[1] for point in points])
    set_box(figure, axes, HEIGHT)
    written = set(names or ()) - set(write_names(axes, names or {}, points))
    handles = [Line2D([], [], **look(color, marker), linewidth=0, label=name)
               for name, color, marker in key if name not in written]
    columns = 4 if max(len(name) for name, *_ in key) <= 25 else 3
    set_box(figure, axes, HEIGHT + LEGEND_LINE * math.ceil(len(handles) / columns))
    figure.legend(handles=handles, ncol=columns, loc="lower left", bbox_to_anchor=(LEFT / WIDTH, 0),
                  borderaxespad=0.3, borderpad=0, handlelength=1, handletextpad=0.4, columnspacing=1.6)
    return to_svg(figure, title, tips)
