"""Stress over strain, and beside it what else the test is about: change of volume, lateral stress, broken bonds."""
import numpy as np

from .errors import CannotDraw
from .style import SHEAR, SOFT, TENSION, beside, megapascal, new_figure, place_labels, run_styles, save

ORDINATE = {
    "ucs": "axial stress (MPa)",
    "bts": "splitting stress 2P / πLD (MPa)",
    "tension": "axial stress, tension positive (MPa)",
    "shear": "shear stress (MPa)",
    "hydrostatic": "mean stress (MPa)",
    "cut": "cutting force over area of cut (MPa)",
}
ONE_STRAIN = {"bts", "usc", "hydrostatic", "shear", "cut"}  # nothing to draw over a radial strain
TITLE = {"bts": "Load and travel", "hydrostatic": "Pressure and volume", "shear": "Shear stress and displacement",
         "cut": "Force on the tool"}


def draw_curves(series, path):
    runs = series.with_curves()
    if not runs:
        raise CannotDraw("no curve-K.csv with rows is there")
    styles = run_styles(series.runs)
    figure, axes = new_figure(series, 10, 5.2, nrows=1, ncols=2, width_ratios=[1.9, 1])
    draw_stress(axes[0, 0], series, runs, styles)
    BESIDE.get(series.test, draw_volume)(axes[0, 1], series, runs, styles)
    save(figure, path)
    return f"{path}: stress-strain curves of {len(runs)} run{'s' * (len(runs) > 1)}"


def strain_of(series, run):
    """In %, with its name. Hydrostatic compression is drawn over the change of volume where that was measured."""
    volume = run.curve.get("volumetric_strain", np.array(np.nan))
    if series.test == "hydrostatic" and np.isfinite(volume).any():
        return 100 * volume, "volumetric strain"
    return 100 * run.curve["axial_strain"], series.strain_name


def draw_stress(axes, series, runs, styles):
    lateral = False
    for run in runs:
        stress, radial = run.curve["stress_Pa"] / 1e6, run.curve.get("radial_strain")
        axes.plot(strain_of(series, run)[0], stress, **styles[run.index])
        if series.test not in ONE_STRAIN and radial is not None and np.isfinite(radial).any() and np.nanmax(np.abs(radial)) > 0:
            axes.plot(100 * radial, stress, **styles[run.index])
            lateral = True
    axes.axvline(0, color=SOFT, linewidth=0.8)
    axes.margins(y=0.02)

    low, high = axes.get_xlim()
    longest = max(np.nanmax(np.abs(strain_of(series, run)[0])) for run in runs)
    axes.set_xlim(max(low, -1.25 * longest), min(high, 1.6 * longest))  # pieces that fly off must not squeeze the curve
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, 0) if low < -0.1 * high else 0, high * (1.08 if high > 0 else 1))
    if lateral:
        low, high = axes.get_xlim()
        axes.set_xlabel(f"←  radial strain (%)     {series.strain_name} (%)  →", x=min(max(-low / (high - low), 0.26), 0.74))
    else:
        axes.set_xlabel(f"{strain_of(series, runs[0])[1]} (%)")
    axes.set_ylabel(ORDINATE.get(series.test, "deviator, axial − confining stress (MPa)"))
    levels = {"shear": ", by normal stress"}.get(series.test, ", by confinement")
    axes.set_title(TITLE.get(series.test, "Stress and strain") + (levels if len(runs) > 1 else ""))
    place_labels(axes, [mark_peak(axes, series, run, styles[run.index]["color"], len(runs) > 1) for run in runs])


def mark_peak(axes, series, run, colour, name_confinement):
    """A dot at the peak (hollow where the test ended before one); returns its label for place_labels."""
    stress, strain = run.curve["stress_Pa"] / 1e6, strain_of(series, run)[0]
    row = run.peak_row
    axes.plot(strain[row], stress[row], "o", markersize=5.5, markeredgecolor=colour,
              markerfacecolor=colour if run.peak_reached else "white")
    text = f"{'peak' if run.peak_reached else 'reached'} {megapascal(1e6 * stress[row])}"
    if name_confinement:
        text = f"{megapascal(run.confinement)}: {text}"
    return text, colour, beside(strain[row], stress[row]) + beside(*last_point(strain, stress))


def last_point(x, y):
    row = np.flatnonzero(np.isfinite(x) & np.isfinite(y))[-1]
    return x[row], y[row]


def draw_volume(axes, series, runs, styles):
    drawn = [run for run in runs if np.isfinite(run.curve.get("volumetric_strain", np.nan)).any()]
    sign = -1 if series.test == "shear" else 1  # contraction is positive; a shear box is read by its dilation
    for run in drawn:
        axes.plot(100 * run.curve["axial_strain"], sign * 100 * run.curve["volumetric_strain"], **styles[run.index])
    axes.axhline(0, color=SOFT, linewidth=0.8)
    if drawn:
        longest = 100 * max(np.nanmax(np.abs(run.curve["axial_strain"])) for run in drawn)
        low, high = axes.get_ylim()
        axes.set_ylim(max(low, -1.5 * longest), min(high, 1.5 * longest))
    else:
        axes.text(0.5, 0.5, "not measured", transform=axes.transAxes, ha="center", color=SOFT)
    axes.set_xlabel(f"{series.strain_name} (%)")
    axes.set_ylabel("dilation (%)" if series.test == "shear" else "← dilation     volumetric strain (%)     contraction →")
    axes.set_title("Dilation" if series.test == "shear" else "Change of volume")
    if len(drawn) > 1:
        place_labels(axes, [(megapascal(run.confinement), styles[run.index]["color"],
                             beside(*last_point(100 * run.curve["axial_strain"], sign * 100 * run.curve["volumetric_strain"])))
                            for run in drawn])


def draw_lateral(axes, series, runs, styles):
    """Axial over lateral stress; thin, the line of equal stresses."""
    for run in runs:
        axes.plot(run.curve["confining_stress_Pa"] / 1e6, run.curve["axial_stress_Pa"] / 1e6, **styles[run.index])
    axes.set_xlim(left=min(0, axes.get_xlim()[0]) if axes.get_xlim()[0] < -0.1 * axes.get_xlim()[1] else 0)
    axes.set_ylim(bottom=min(0, axes.get_ylim()[0]) if axes.get_ylim()[0] < -0.1 * axes.get_ylim()[1] else 0)
    axes.axline((0, 0), slope=1, color=SOFT, linewidth=0.9, linestyle=(0, (5, 3)))
    end = min(axes.get_xlim()[1], axes.get_ylim()[1])
    axes.set_xlabel("lateral stress (MPa)")
    axes.set_ylabel("axial stress (MPa)")
    axes.set_title("Axial over lateral stress")
    place_labels(axes, [("equal stresses", SOFT, beside(0.8 * end, 0.8 * end)[-3:] + beside(0.8 * end, 0.8 * end))])


def draw_broken(axes, series, runs, styles):
    """Broken bonds by mode; the dash tells the runs apart as in the panel of the stress."""
    labels = []
    for column, name, colour in (("broken_tension", "tension", TENSION), ("broken_shear", "shear", SHEAR)):
        for run in runs:
            strain, broken = strain_of(series, run)[0], run.curve.get(column, np.array(np.nan))
            if not np.isfinite(broken).any():
                continue
            axes.plot(strain, broken, color=colour, linestyle=styles[run.index]["linestyle"])
            if run is runs[-1]:
                labels.append((f"{broken[-1]:,.0f} in {name}", colour, before(*last_point(strain, broken))))
    axes.set_ylim(0, max(1.0, 1.1 * axes.get_ylim()[1]))
    axes.set_xlabel(f"{strain_of(series, runs[0])[1]} (%)")
    axes.set_ylabel("broken bonds (–)")
    axes.set_title("Broken bonds")
    place_labels(axes, labels)


def before(x, y, gap=6):
    """Candidates at the end of a curve, within the panel."""
    return [(x, y, 0, up * gap, "right", va) for up, va in ((1, "bottom"), (-1, "top"), (3, "bottom"), (-3, "top"))]


BESIDE = {"usc": draw_lateral, "bts": draw_broken, "tension": draw_broken, "hydrostatic": draw_broken, "cut": draw_broken}
