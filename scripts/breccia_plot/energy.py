"""Is the test quasi-static, and where did the work go."""
import numpy as np

from .errors import CannotDraw
from .style import (DISSIPATED, INK, KINETIC, STORED, WORK, beside, choose, condition, megapascal, new_figure, place_labels,
                    run_styles, save)

LIMIT = 1e-3  # of kinetic over stored energy, up to the peak
ENERGIES = (("work_J", "work in", WORK), ("stored_J", "stored", STORED), ("dissipated_J", "dissipated", DISSIPATED),
            ("kinetic_J", "kinetic", KINETIC))


def draw_energy(series, path):
    runs = [run for run in series.with_curves() if known(run, "kinetic_J") and known(run, "stored_J")]
    if not runs:
        raise CannotDraw("no curve-K.csv with energies is there")
    shown = choose(runs)
    figure, _ = new_figure(series, 10, 6.8)
    grid = figure.add_gridspec(2, len(shown), height_ratios=[1.1, 1])
    draw_ratio(figure.add_subplot(grid[0, :]), series, runs, run_styles(series.runs))
    panels = [figure.add_subplot(grid[1, column]) for column in range(len(shown))]
    scale, name = unit(shown)
    for axes, run in zip(panels, shown):
        draw_balance(axes, series, run, scale)
        axes.set_title("Energies" if len(series.runs) == 1 else condition(series, run.confinement))
    panels[0].set_ylabel(f"energy ({name})")
    panels[0].legend(loc="upper left", fontsize=9.5, handlelength=1.2, borderaxespad=0.2)
    save(figure, path)
    return f"{path}: energies of {len(runs)} run{'s' * (len(runs) > 1)}"


def known(run, column):
    return np.isfinite(run.curve.get(column, np.nan)).any()


def unit(runs):
    largest = max(np.nanmax(np.abs(run.curve[column])) for run in runs for column, _, _ in ENERGIES if known(run, column))
    return next(((scale, name) for scale, name in ((1e-3, "kJ"), (1, "J"), (1e3, "mJ")) if largest * scale >= 1), (1e6, "µJ"))


def draw_ratio(axes, series, runs, styles):
    labels = []
    for run in runs:
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = run.curve["kinetic_J"] / run.curve["stored_J"]
        ratio[~(ratio > 0)] = np.nan
        strain, peak = 100 * run.curve["axial_strain"], run.peak_row
        style = dict(styles[run.index], linewidth=1.2)
        axes.plot(strain[:peak + 1], ratio[:peak + 1], **style)
        axes.plot(strain[peak:], ratio[peak:], **style, alpha=0.3)
        if run.peak_reached:
            axes.plot(strain[peak], ratio[peak], "o", color=style["color"], markersize=5.5)
        if len(runs) > 1:
            level = np.nanmedian(ratio[-max(1, ratio.size // 20):]) if np.isfinite(ratio).any() else LIMIT
            labels.append((megapascal(run.confinement), style["color"],
                           [place for y in (1, 4, 1 / 4, 16, 1 / 16) for place in beside(strain[-1], y * level)]))
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, 1e-7), min(max(high, 3 * LIMIT), 10))
    axes.axhline(LIMIT, color=INK, linewidth=1, linestyle=(0, (5, 3)))
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, 0) if low < -0.1 * high else 0, high * 1.03)
    axes.set_xlabel(f"{series.strain_name} (%)")
    axes.set_ylabel("kinetic / stored energy (–)")
    axes.set_title("Kinetic over stored energy: quasi-static below 10⁻³ up to the peak (dot); pale after it")
    place_labels(axes, labels)


def draw_balance(axes, series, run, scale):
    for column, name, colour in ENERGIES:
        if known(run, column):
            axes.plot(100 * run.curve["axial_strain"], scale * run.curve[column], color=colour, label=name)
    axes.set_xlabel(f"{series.strain_name} (%)")
    axes.set_xlim(left=min(0, 100 * np.nanmin(run.curve["axial_strain"])))
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]) if axes.get_ylim()[0] < -0.1 * axes.get_ylim()[1] else 0)
