"""Error against run time of the recipes that breccia-workprecision tried, fronts, noise floor, and what the packing does."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator

from .errors import BadInput
from .style import DISSIPATED, HALO, INK, KINETIC, SHEAR, SOFT, STORED, TENSION, new_figure, save
from .study import read_study

# colour and marker of each family; the base is drawn last and larger
FAMILIES = {
    "step": (SHEAR, "o", "step"), "speed": (TENSION, "s", "platen speed"), "mass": (KINETIC, "v", "mass scaling"),
    "scheme": ("#56B4E9", "D", "damping scheme"), "damping": (STORED, "^", "global damping"),
    "precision": (DISSIPATED, "P", "precision"), "scatter": ("#8c6d31", "X", "sums"),
    "combinations": ("#9a9a9a", "o", "combinations"), "base": (INK, "*", "the case")}
MEASURES = {"peak": "peak", "young": "Young modulus", "strain_at_peak": "strain at the peak", "curve": "curve up to the peak"}
TOLERANCES = (0.05, 0.02, 0.01)
LEAST = 1e-5  # an error of nothing is drawn here
NEEDED = {"purpose", "family", "spheres", "run_time_s", "status"} | {f"error_{name}" for name in MEASURES}


class WorkPrecision:
    """What breccia-workprecision left in a folder."""

    def __init__(self, folder):
        path = folder / "workprecision.json"
        content, self.title = read_study(path, "work-precision", NEEDED, title_of, parts=("case",))
        if "reference" not in content:
            raise BadInput(f"{path} has no reference yet: let the study run on with --resume")
        try:
            self.runs = content["runs"]
            self.recipes = [run for run in self.runs if run["purpose"] == "recipe" and run["status"] != "broke"]
            self.sizes = [run for run in self.runs if run["purpose"] == "size" and run["status"] != "broke"]
            self.resolution, self.floor = content["reference"]["resolution"], content["floor"]
            self.fronts = {name: [self.runs[k] for k in content["fronts"][name]] for name in MEASURES}
            self.fits, self.groups = content["sizes"]["fits"] or {}, content["sizes"]["groups"]
        except (KeyError, IndexError, TypeError) as reason:
            raise BadInput(f"{path} cannot be read as a work-precision study: {reason}") from reason


def title_of(content, machine):
    case = content["case"]
    pressure = f" at {case['confinement_Pa'] / 1e6:.3g} MPa" if case["confinement_Pa"] else ""
    name = {"ucs": "Unconfined", "triaxial": "Triaxial"}.get(case["test"], case["test"])
    spheres = next((run["spheres"] for run in content["runs"] if run["purpose"] != "size"), 0)
    return f"{name} compression{pressure}, {spheres:,} spheres: error against run time – {machine}"


def draw_workprecision(folder, path):
    study = WorkPrecision(folder)
    columns = 2 + bool(study.sizes)
    figure, axes = new_figure(study, 4.1 * columns + 2.8, 8.2, nrows=2, ncols=columns)
    with_floor = [draw_measure(panel, study, name) for panel, name in zip(axes[:, :2].ravel(), MEASURES)]
    if study.sizes:
        draw_sizes(axes[0][2], study, "peak")
        draw_sizes(axes[1][2], study, "strain_at_peak")
    used = [family for family in FAMILIES if any(run["family"] == family for run in study.recipes)]
    handles = [Line2D([], [], linestyle="none", color=colour, marker=marker, markersize=11 if family == "base" else 6.5, label=label)
               for family, (colour, marker, label) in FAMILIES.items() if family in used]
    handles += [Line2D([], [], color=INK, linewidth=1.2, label="Pareto front"),
                Line2D([], [], color="#dcdcdc", linewidth=9, label="not told apart by the reference")]
    if any(with_floor):
        handles.append(Line2D([], [], color=INK, linewidth=1.1, linestyle=(0, (1, 2)), label="noise floor"))
    own = axes[0][-1].get_legend()
    axes[0][-1].legend(handles=handles, loc="upper left", bbox_to_anchor=(1.01, 1.0))
    if own:
        axes[0][-1].add_artist(own)
    save(figure, path)
    return f"{path}: {len(study.recipes)} recipes, {len(study.sizes)} specimens of other sizes"


def errors(runs, name):
    return np.maximum([np.nan if run[f"error_{name}"] is None else abs(run[f"error_{name}"]) for run in runs], LEAST)


def draw_measure(axes, study, name):
    """Points of all recipes; the front runs along the edge of the band where it cannot be told further.

    Returns whether the noise floor lies in the picture."""
    times, all_errors = np.array([run["run_time_s"] for run in study.recipes]), errors(study.recipes, name)
    axes.set(xscale="log", yscale="log")
    limit, floor = (max(values[name] or LEAST, LEAST) for values in (study.resolution, study.floor))
    shown = np.concatenate([all_errors[np.isfinite(all_errors)], [limit, 0.012]])
    bottom, top = max(min(shown.min(), limit) / 1.8, LEAST / 1.8), max(shown.max(), 0.05) * 1.7
    axes.set_ylim(100 * bottom, 100 * top)
    axes.axhspan(100 * bottom, 100 * limit, color="#dcdcdc", zorder=0.5, linewidth=0)
    if floor > bottom:
        axes.axhline(100 * floor, color=INK, linewidth=1.1, linestyle=(0, (1, 2)), zorder=1)
    if len(times):
        set_times(axes, times)
    for tolerance in TOLERANCES:
        axes.axhline(100 * tolerance, color=SOFT, linewidth=0.8, zorder=1)
        axes.annotate(f"{100 * tolerance:g} %", (1, 100 * tolerance), xycoords=("axes fraction", "data"), xytext=(-2, 2),
                      textcoords="offset points", ha="right", va="bottom", fontsize=8.5, color=SOFT, path_effects=HALO)
    draw_front(axes, study.fronts[name], name, limit)
    for family, (colour, marker, _) in FAMILIES.items():
        mine = np.array([run["family"] == family for run in study.recipes], dtype=bool)
        axes.plot(times[mine], 100 * all_errors[mine], linestyle="none", marker=marker, color=colour, markersize=13 if family == "base" else 6.5,
                  markeredgecolor="white", markeredgewidth=0.7, zorder={"base": 4, "combinations": 2.5}.get(family, 3))
    percent_scale(axes.yaxis)
    axes.set(xlabel="run time (s)", ylabel="error (%)")
    axes.set_title(f"Error of the {MEASURES[name]}")
    return floor > bottom


def draw_front(axes, front, name, limit):
    """Stairs: with so much time the error is that of the best recipe that is as fast."""
    if not front:
        return
    times, values = np.array([run["run_time_s"] for run in front]), np.maximum(errors(front, name), limit)
    end = axes.get_xlim()[1]
    axes.step(np.append(times, end), 100 * np.append(values, values[-1]), where="post", color=INK, linewidth=1.2, zorder=2)


def set_times(axes, times):
    low, high = times.min() / 1.35, times.max() * 1.35
    axes.set_xlim(low, high)
    ticks = [t for decade in range(-4, 7) for t in (10.0 ** decade, 2 * 10.0 ** decade, 5 * 10.0 ** decade) if low <= t <= high]
    axes.xaxis.set_major_locator(FixedLocator(ticks))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda t, _: f"{t:g}"))


def percent_scale(axis):
    """Decades, and 2 and 5 between them where there are few."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 80 * low else (1,), numticks=20))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(lambda e, _: f"{e:g}"))


def draw_sizes(axes, study, name):
    """Each specimen against the reference, and the spread over seeds as a band about the reference."""
    spheres = np.array([run["spheres"] for run in study.sizes], dtype=float)
    values = np.array([np.nan if run[f"error_{name}"] is None else run[f"error_{name}"] for run in study.sizes])
    axes.set_xscale("log")
    axes.axhline(0, color=SOFT, linewidth=0.8)
    ends = np.array([spheres.min() / 1.4, spheres.max() * 1.4])
    if fit := study.fits.get(name):
        n = np.geomspace(*ends, 60)
        band = 100 * fit["factor"] * n ** fit["exponent"]
        axes.fill_between(n, -band, band, color=SHEAR, alpha=0.13, linewidth=0, zorder=0.5)
        root = 100 * fit["factor_of_root"] / np.sqrt(n)
        for sign in (1, -1):
            axes.plot(n, sign * root, color=SOFT, linewidth=1, linestyle=(0, (4, 3)), label="∝ 1/√n" if sign > 0 else None)
        axes.fill_between([], [], [], color=SHEAR, alpha=0.13, linewidth=0, label=f"spread over seeds ∝ $n^{{{fit['exponent']:.2f}}}$")
    axes.plot(spheres, 100 * values, linestyle="none", marker="o", color=SHEAR, alpha=0.75, markersize=5.5, markeredgewidth=0,
              label="a specimen")
    means = [(group["spheres"], group["mean"][name]) for group in study.groups if group["mean"][name] is not None]
    if means:
        n, mean = np.array(means, dtype=float).T
        axes.plot(n, 100 * mean, color=TENSION, marker="_", markersize=14, markeredgewidth=2, linewidth=1.2, label="mean")
    used = sorted(set(spheres))
    axes.xaxis.set_major_locator(FixedLocator(used))
    axes.xaxis.set_minor_locator(NullLocator())
    axes.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:,.0f}" if n < 1000 else f"{n / 1000:g}k"))
    axes.set_xlim(*ends)
    reach = 1.15 * np.nanmax(np.abs(100 * values))
    axes.set_ylim(-reach, reach * 1.35)
    axes.set(xlabel="spheres", ylabel="difference from the reference (%)")
    axes.set_title(f"Other packings: {MEASURES[name]}")
    axes.legend(loc="upper right", fontsize=8.5, ncols=2, columnspacing=1.2, handlelength=1.6)
