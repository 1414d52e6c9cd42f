"""Time of the bond pass by layout, over the size of the specimen, beside the limit that the machine sets."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .style import DISSIPATED, INK, KINETIC, SHEAR, SOFT, STORED, TENSION, new_figure, save
from .study import read_study

COLOURS = (SHEAR, STORED, DISSIPATED, TENSION, KINETIC, INK, "#56B4E9")  # of the number of spheres
MARKERS = "osD^vP*"
NEEDED = {"spheres", "bonds", "threads", "precision", "numbers", "bond_storage", "particle_storage", "sums", "ns_per_bond_median",
          "ns_per_bond_least", "ns_per_bond_most", "limit_ns_per_bond"}


class Layouts:
    """What breccia-layouts left in a folder."""

    def __init__(self, folder):
        content, self.title = read_study(
            folder / "layouts.json", "layout", NEEDED,
            lambda study, machine: f"Bond pass by layout – {machine}, {study['machine']['instruction_set']}")
        self.runs = content["runs"]
        self.layouts = list(dict.fromkeys(layout_of(run) for run in self.runs))
        self.sizes = sorted({run["spheres"] for run in self.runs})
        self.threads = sorted({run["threads"] for run in self.runs})

    def runs_of(self, spheres, threads):
        return [run for run in self.runs if (run["spheres"], run["threads"]) == (spheres, threads)]


def layout_of(run):
    return tuple(run[name] for name in ("precision", "bond_storage", "particle_storage", "sums", "numbers"))


def label_of(layout, production):
    """What tells a layout from production in its precision."""
    precision, bonds, particles, sums, numbers = layout
    if layout == production:
        return f"{precision} precision: bonds in {bonds},\nparticles in {particles}, {sums} sums of {numbers}"
    if bonds != production[1]:
        return f"bonds in {bonds}"
    if particles != production[2]:
        return f"particles in {particles}"
    return f"sums: {sums}" if sums != production[3] else f"sums of {numbers}"


def draw_layouts(folder, path):
    """A panel for each number of threads, at most four; a row for each layout, a marker for each size."""
    study = Layouts(folder)
    shown = [study.threads[i] for i in np.unique(np.linspace(0, len(study.threads) - 1, 4).round().astype(int))]
    figure, axes = new_figure(study, 4.6 + 4.2 * len(shown), 1.2 + 0.46 * len(study.layouts), ncols=len(shown), sharey=True,
                              sharex=True)
    for panel, threads in zip(axes[0], shown):
        draw_threads(panel, study, threads)
    axes[0][0].set_yticks(range(len(study.layouts)), [label_of(layout, next(one for one in study.layouts if one[0] == layout[0])) for layout in study.layouts])
    axes[0][0].set_ylim(len(study.layouts) - 0.45, -0.55)
    axes[0][0].set_xscale("log")
    for panel in axes[0]:
        panel.xaxis.set_major_locator(FixedLocator([0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200]))
        panel.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:g}"))
        panel.xaxis.set_minor_locator(NullLocator())
    handles = [Line2D([], [], color=colour, marker=marker, linestyle="none", label=f"{spheres:,} spheres")
               for spheres, colour, marker in styles(study)]
    handles.append(Line2D([], [], color=SOFT, marker="|", markersize=11, markeredgewidth=2, linestyle="none", label="limit"))
    axes[0][-1].legend(handles=handles, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    save(figure, path)
    sizes, threads = len(study.sizes), len(study.threads)
    return (f"{path}: {len(study.layouts)} layouts, {sizes} size{'s' * (sizes > 1)}, "
            f"{threads} number{'s' * (threads > 1)} of threads")


def styles(study):
    return [(spheres, COLOURS[k % len(COLOURS)], MARKERS[k % len(MARKERS)]) for k, spheres in enumerate(study.sizes)]


def draw_threads(axes, study, threads):
    offsets = np.linspace(-0.27, 0.27, len(study.sizes)) if len(study.sizes) > 1 else [0.0]
    for offset, (spheres, colour, marker) in zip(offsets, styles(study)):
        runs = study.runs_of(spheres, threads)
        if not runs:
            continue
        rows = np.array([study.layouts.index(layout_of(run)) for run in runs]) + offset
        median, least, most = (np.array([run[f"ns_per_bond_{name}"] for run in runs]) for name in ("median", "least", "most"))
        axes.errorbar(median, rows, xerr=[median - least, most - median], fmt=marker, color=colour, markersize=5,
                      elinewidth=1, capsize=2)
        axes.plot([run["limit_ns_per_bond"] for run in runs], rows, linestyle="none", marker="|", color=colour,
                  markersize=7, markeredgewidth=1.6, alpha=0.6)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.set_xlabel("time per bond (ns)")
    axes.set_title(f"{threads} thread{'s' * (threads > 1)}")
