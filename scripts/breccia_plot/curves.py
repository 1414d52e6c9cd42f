"""Stress over axial strain (right) and radial strain (left); volumetric strain over axial strain."""
import numpy as np

from .errors import CannotDraw
from .style import SOFT, beside, megapascal, new_figure, place_labels, run_styles, save

ORDINATE = {
    "ucs": "axial stress (MPa)",
    "bts": "splitting stress (MPa)",
    "tension": "axial stress (MPa)",
    "shear": "shear stress (MPa)",
    "hydrostatic": "axial stress (MPa)",
    "impact": "axial stress (MPa)",
}


def draw_curves(series, path):
    runs = series.with_curves()
    if not runs:
        raise CannotDraw("no curve-K.csv with rows is there")
    styles = run_styles(series.runs)
    figure, axes = new_figure(series, 10, 5.2, nrows=1, ncols=2, width_ratios=[1.9, 1])
    draw_stress(axes[0, 0], series, runs, styles)
    draw_volume(axes[0, 1], runs, styles)
    save(figure, path)
    return f"{path}: stress-strain curves of {len(runs)} run{'s' * (len(runs) > 1)}"


def stress_of(series, run):
    """Hydrostatic stress has no deviator: there the axial stress is the curve."""
    return run.curve["axial_stress_Pa" if series.test == "hydrostatic" else "deviator_Pa"] / 1e6


def draw_stress(axes, series, runs, styles):
    lateral = False
    for run in runs:
        stress, radial = stress_of(series, run), run.curve.get("radial_strain")
        axes.plot(100 * run.curve["axial_strain"], stress, **styles[run.index])
        if radial is not None and np.isfinite(radial).any() and np.nanmax(np.abs(radial)) > 0:
            axes.plot(100 * radial, stress, **styles[run.index])
            lateral = True
    axes.axvline(0, color=SOFT, linewidth=0.8)
    axes.margins(y=0.02)

    low, high = axes.get_xlim()
    longest = max(np.nanmax(np.abs(run.curve["axial_strain"])) for run in runs) * 100
    axes.set_xlim(max(low, -1.25 * longest), min(high, 1.6 * longest))  # pieces that fly off must not squeeze the curve
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, 0) if low < -0.1 * high else 0, high * (1.08 if high > 0 else 1))
    if lateral:
        low, high = axes.get_xlim()
        axes.set_xlabel("←  radial strain (%)     axial strain (%)  →", x=min(max(-low / (high - low), 0.26), 0.74))
    else:
        axes.set_xlabel("axial strain (%)")
    axes.set_ylabel(ORDINATE.get(series.test, "deviator, axial − confining stress (MPa)"))
    axes.set_title("Stress and strain" + (", by confinement" if len(runs) > 1 else ""))
    place_labels(axes, [mark_peak(axes, series, run, styles[run.index]["color"], len(runs) > 1) for run in runs])


def mark_peak(axes, series, run, colour, name_confinement):
    """A dot at the peak (hollow where the test ended before one); returns its label for place_labels."""
    stress, strain = stress_of(series, run), 100 * run.curve["axial_strain"]
    row = int(np.nanargmax(np.abs(stress)))
    axes.plot(strain[row], stress[row], "o", markersize=5.5, markeredgecolor=colour,
              markerfacecolor=colour if run.peak_reached else "white")
    text = f"{'peak' if run.peak_reached else 'reached'} {stress[row]:.3g} MPa"
    if name_confinement:
        text = f"{megapascal(run.confinement)}: {text}"
    return text, colour, beside(strain[row], stress[row]) + beside(*last_point(strain, stress))


def last_point(x, y):
    row = np.flatnonzero(np.isfinite(x) & np.isfinite(y))[-1]
    return x[row], y[row]


def draw_volume(axes, runs, styles):
    drawn = [run for run in runs if np.isfinite(run.curve.get("volumetric_strain", np.nan)).any()]
    for run in drawn:
        axes.plot(100 * run.curve["axial_strain"], 100 * run.curve["volumetric_strain"], **styles[run.index])
    axes.axhline(0, color=SOFT, linewidth=0.8)
    if drawn:
        longest = 100 * max(np.nanmax(np.abs(run.curve["axial_strain"])) for run in drawn)
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, -1.5 * longest), min(high, 1.5 * longest))
    else:
        axes.text(0.5, 0.5, "not measured", transform=axes.transAxes, ha="center", color=SOFT)
    axes.set_xlabel("axial strain (%)")
    axes.set_ylabel("← dilation     volumetric strain (%)     contraction →")
    axes.set_title("Change of volume")
    if len(drawn) > 1:
        place_labels(axes, [(megapascal(run.confinement), styles[run.index]["color"],
                             beside(*last_point(100 * run.curve["axial_strain"], 100 * run.curve["volumetric_strain"])))
                            for run in drawn])
