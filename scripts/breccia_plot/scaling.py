"""Time of a step, speed-up and efficiency over threads, beside the published times that scaling.json holds."""
from dataclasses import dataclass

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .style import DISSIPATED, INK, KINETIC, SHEAR, SOFT, STORED, TENSION, new_figure, place_labels, save
from .study import read_study

COLOURS = (SHEAR, TENSION, STORED, KINETIC, DISSIPATED)  # of the number of spheres
MARKERS = {"private": "o", "gather": "s", "atomic": "^"}
PUBLISHED_MARKERS = {"OpenMP": "D", "MPI": "v"}
NEEDED = {"study", "precision", "scatter", "threads", "spheres", "step_median_s", "step_least_s", "step_most_s", "efficiency"}


@dataclass
class Line:
    """One curve in all panels of a study; arrays over threads."""
    label: str
    style: dict
    threads: np.ndarray
    step: np.ndarray  # s
    spread: np.ndarray  # s, from the median down and up, 2 x threads; None where nobody has told
    speed_up: np.ndarray  # over one thread; where that was not measured, the fewest threads count as ideal
    efficiency: np.ndarray


class Scaling:
    """What breccia-scaling left in a folder."""

    def __init__(self, folder):
        content, self.title = read_study(
            folder / "scaling.json", "scaling", NEEDED,
            lambda study, machine: f"Scaling of the uniaxial compression of {study['test']['material']} – {machine}",
            parts=("published",))
        self.runs, self.published = content["runs"], content["published"]

    def lines(self, study):
        """Of one study: runs of the same precision, scatter and, in strong scaling, the same specimen are a line."""
        groups = {}
        for run in self.runs:
            if run["study"] == study:
                groups.setdefault(((run["precision"], run["scatter"]), run["spheres"] if study == "strong" else None), []).append(run)
        sizes = sorted({p["spheres"] for p in self.published} | {run["spheres"] for run in self.runs if run["study"] == "strong"})
        several = len({way for way, _ in groups}) > 1
        return ([self.measured_line(runs, spheres, sizes, several) for (_, spheres), runs in groups.items()] +
                ([published_line(p, colour_of(p["spheres"], sizes)) for p in self.published] if study == "strong" else []))

    def measured_line(self, runs, spheres, sizes, several):
        runs = sorted(runs, key=lambda run: run["threads"])
        threads, step, least, most, efficiency = (
            np.array([run[name] for run in runs], dtype=float)
            for name in ("threads", "step_median_s", "step_least_s", "step_most_s", "efficiency"))
        precision, scatter = runs[0]["precision"], runs[0]["scatter"]
        label = f"{spheres:,} spheres" if spheres else f"{runs[0]['spheres'] // runs[0]['threads']:,} spheres per thread"
        colour = colour_of(spheres, sizes) if spheres else INK
        style = {"color": colour, "marker": MARKERS.get(scatter, "o"), "markersize": 6,
                 "linestyle": "-" if precision == "single" else (0, (1, 1.2))}
        return Line(label + (f", {precision}, {scatter}" if several else ""), style, threads, step, np.stack([step - least, most - step]),
                    efficiency * threads, efficiency)


def colour_of(spheres, sizes):
    return COLOURS[sizes.index(spheres) % len(COLOURS)]


def published_line(test, colour):
    """Speed-ups follow from the times: those printed beside them do not always."""
    cores, time = np.array(test["cores"], dtype=float), np.array(test["time_s"], dtype=float)
    speed_up = time[0] * cores[0] / time
    style = {"color": colour, "marker": PUBLISHED_MARKERS.get(test["parallel"], "D"), "markersize": 5,
             "markerfacecolor": "white", "linestyle": (0, (4, 2)), "linewidth": 1.2}
    return Line(f"{test['code']} {test['parallel']}, {test['spheres']:,}", style, cores, time / test["steps"], None,
                speed_up, speed_up / cores)


def draw_scaling(folder, path):
    study = Scaling(folder)
    rows = [(name, study.lines(name)) for name in ("strong", "weak") if any(run["study"] == name for run in study.runs)]
    figure, axes = new_figure(study, 12, 0.6 + 3.9 * len(rows), nrows=len(rows), ncols=3, width_ratios=[1.35, 1, 1])
    for row, (name, lines) in zip(axes, rows):
        for panel in row:
            set_threads(panel, lines)
        draw_time(row[0], name, lines)
        draw_speed_up(row[1], lines)
        draw_efficiency(row[2], lines)
    save(figure, path)
    return f"{path}: {' and '.join(name for name, _ in rows)} scaling, {len(study.runs)} point{'s' * (len(study.runs) > 1)}"


def set_threads(axes, lines):
    """Threads on a scale where they double evenly, each number that was used marked."""
    used = sorted({n for line in lines for n in line.threads})
    axes.set_xscale("log", base=2)
    axes.xaxis.set_major_locator(FixedLocator(used))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:g}"))
    axes.set_xlim(used[0] / 1.15, used[-1] * 1.15)
    axes.set_xlabel("threads (–)")


def draw_time(axes, name, lines):
    """Times of the codes differ by orders of magnitude: a log scale. In weak scaling all would ideally be equal: from 0."""
    labels, strong = [], name == "strong"
    for line in lines:
        axes.plot(line.threads, 1e3 * line.step, **line.style)
        if line.spread is not None:
            axes.errorbar(line.threads, 1e3 * line.step, 1e3 * line.spread, fmt="none", ecolor=line.style["color"],
                          elinewidth=1, capsize=3)
        labels.append((line.label, line.style["color"], near(line.threads, 1e3 * line.step)))
    if strong:
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(low / 1.5, high * 1.5)  # room for the labels
        axes.yaxis.set_major_formatter(FuncFormatter(lambda t, _: f"{t:g}"))
        axes.yaxis.set_minor_locator(NullLocator())
    else:
        axes.set_ylim(0, 1.15 * axes.get_ylim()[1])
    axes.set_ylabel("time per step (ms)")
    axes.set_title("Strong scaling: the same specimen" if strong else "Weak scaling: as many spheres for each thread")
    place_labels(axes, labels)


def near(x, y, gap=8):
    """Candidates above and below the points of a curve, its end first, where curves are apart, and beyond the end."""
    last = len(x) - 1
    above = [(last, "right"), (0, "left")] + [(k, "center") for k in range(1, last)]
    places = [(x[k], y[k], 0, up * gap, ha, va) for up, va in ((1, "bottom"), (-1, "top")) for k, ha in above]
    places += [(x[last], y[last], 0, up * gap, "right", va) for up, va in ((-3, "top"), (3, "bottom"))]
    return places + [(x[last], y[last], gap, up * gap, "left", "center") for up in (0, 1, -1, 2, -2)]


def draw_speed_up(axes, lines):
    ends = np.array(axes.get_xlim())
    axes.plot(ends, ends, color=SOFT, linewidth=0.9)
    for line in lines:
        axes.plot(line.threads, line.speed_up, **line.style)
    axes.set_yscale("log", base=2)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:g}"))
    axes.yaxis.set_minor_locator(NullLocator())
    axes.set_ylabel("speed-up (–)")
    axes.set_title("Speed-up")
    place_labels(axes, [("ideal", SOFT, [(ends[1], ends[1], -22, -2, "right", "center")])])


def draw_efficiency(axes, lines):
    axes.axhline(1, color=SOFT, linewidth=0.9)
    for line in lines:
        axes.plot(line.threads, line.efficiency, **line.style)
    axes.set_ylim(0, max(1.1, 1.05 * max(line.efficiency.max() for line in lines)))
    axes.set_ylabel("efficiency (–)")
    axes.set_title("Efficiency: speed-up over threads")
