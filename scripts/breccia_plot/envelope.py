"""Mohr circles of the peaks, or shear strengths over normal stress, and the Mohr-Coulomb line that the summary gives."""
import numpy as np

from .errors import CannotDraw
from .series import COMPRESSION_TO_FAILURE, TESTS
from .style import HALO, INK, SOFT, megapascal, new_figure, place_labels, run_styles, save


def draw_envelope(series, path):
    if series.test == "shear":
        return draw_shear(series, path)
    runs = [run for run in series.runs if (run.summary.get("peak_stress_Pa") or 0) > 0]
    if series.test not in COMPRESSION_TO_FAILURE:
        raise CannotDraw(f"{TESTS.get(series.test, series.test)} has no Mohr circles")
    if len(runs) < 2:
        raise CannotDraw("an envelope needs the peaks of two runs in summary.json")
    line = mohr_coulomb_line(series.mohr_coulomb)
    styles = run_styles(series.runs)
    peaks = [(run.confinement, run.summary["peak_stress_Pa"]) for run in runs]
    flatness = max(major - minor for minor, major in peaks) / max(major for _, major in peaks)
    height = 1.4 + max(2.1, 3.1 * flatness)  # inches; circles are round, so their panel's height follows from its width
    figure, axes = new_figure(series, 10, height, nrows=1, ncols=2, width_ratios=[2.1, 1])
    draw_circles(axes[0, 0], runs, styles, line)
    draw_peaks(axes[0, 1], runs, styles, line)
    save(figure, path)
    return f"{path}: failure envelope of {len(runs)} runs" + ("" if line else ", circles alone: no mohr_coulomb in summary.json")


def draw_shear(series, path):
    """Each run of the direct shear test is one point of the envelope."""
    runs = series.with_curves()
    if len(runs) < 2:
        raise CannotDraw("an envelope needs the curves of two runs")
    line, styles = mohr_coulomb_line(series.mohr_coulomb), run_styles(series.runs)
    figure, grid = new_figure(series, 8, 5.2, nrows=1, ncols=1)
    axes = grid[0, 0]
    normal, strength, reached = shear_points(runs)
    if line:
        cohesion, friction = line
        span = np.array([0, 1.08 * normal.max()])
        axes.plot(span, cohesion + span * np.tan(friction), color=INK, linewidth=1.5)
        axes.annotate(f"c = {cohesion:.3g} MPa\nφ = {np.degrees(friction):.1f}°\nτ = c + σ tan φ", (0.03, 0.97),
                      xycoords="axes fraction", va="top", fontsize=11, path_effects=HALO)
    for run, x, y, whole in zip(runs, normal, strength, reached):
        colour = styles[run.index]["color"]
        axes.plot(x, y, "o", markersize=9, clip_on=False, zorder=3, markeredgecolor=colour, markeredgewidth=1.5,
                  markerfacecolor=colour if whole else "white")
    if not all(reached):
        axes.text(0.97, 0.04, "hollow: still rising when the test ended", transform=axes.transAxes, ha="right", color=SOFT,
                  fontsize=9.5, path_effects=HALO)
    axes.set_xlim(0, 1.08 * normal.max() or 1)
    axes.set_ylim(0, 1.15 * max(strength.max(), axes.get_ylim()[1] / 1.1))
    axes.set_xlabel("normal stress σ (MPa)")
    axes.set_ylabel("shear strength τ (MPa)")
    axes.set_title("Shear strength over normal stress")
    save(figure, path)
    return f"{path}: shear strengths of {len(runs)} runs" + ("" if line else ", no line: no mohr_coulomb in summary.json")


def shear_points(runs):
    """Normal stress at the peak and shear stress there, MPa, and whether it was a peak."""
    rows = [(run.curve["confining_stress_Pa"][run.peak_row], run.curve["stress_Pa"][run.peak_row]) for run in runs]
    normal, shear = np.abs(np.array(rows).T) / 1e6
    return normal, shear, [run.peak_reached for run in runs]


def mohr_coulomb_line(fit):
    """(cohesion in MPa, friction angle in radians), or None where the summary has no fit."""
    if not fit or None in (fit.get("cohesion_Pa"), fit.get("friction_angle_deg")):  # JSON writes null for not-a-number
        return None
    return fit["cohesion_Pa"] / 1e6, np.radians(fit["friction_angle_deg"])


def draw_circles(axes, runs, styles, line):
    angle = np.linspace(0, np.pi, 181)
    highest, furthest, labels = 0.0, 0.0, []
    for run in runs:
        minor, major = run.confinement / 1e6, run.summary["peak_stress_Pa"] / 1e6
        middle, radius = (major + minor) / 2, (major - minor) / 2
        axes.plot(middle + radius * np.cos(angle), radius * np.sin(angle), **styles[run.index])
        labels.append((megapascal(run.confinement), styles[run.index]["color"], around(middle, radius)))
        highest, furthest = max(highest, radius), max(furthest, major)
    left = 0.0
    if line:
        cohesion, friction = line
        left = -min(cohesion / np.tan(friction) if friction > 0 else 0.0, 0.12 * furthest)
        sigma = np.array([left, furthest])
        axes.plot(sigma, cohesion + sigma * np.tan(friction), color=INK, linewidth=1.5)
        axes.annotate(f"c = {cohesion:.1f} MPa\nφ = {np.degrees(friction):.1f}°\nτ = c + σ tan φ", (0, 0.97),
                      xycoords=("data", "axes fraction"), xytext=(8, 0), textcoords="offset points", va="top", fontsize=11,
                      path_effects=HALO)
        axes.axvline(0, color=SOFT, linewidth=0.8)
    axes.set_xlim(left, furthest * 1.03)
    axes.set_ylim(0, highest * 1.22)
    axes.set_aspect("equal", anchor="N")
    axes.set_xlabel("normal stress σ (MPa)")
    axes.set_ylabel("shear stress τ (MPa)")
    axes.set_title("Mohr circles of the peaks, by confinement")
    place_labels(axes, labels)


def around(middle, radius, gap=4):
    """Candidates for the label of a circle: outside its right half, then inside."""
    places = []
    for side, ha, va in ((1, "left", "bottom"), (-1, "right", "top")):
        for degrees in range(85, 10, -10):
            x, y = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
            places.append((middle + radius * x, radius * y, side * gap * x, side * gap * y, ha, va))
    return places


def draw_peaks(axes, runs, styles, line):
    confinement = np.array([run.confinement for run in runs]) / 1e6
    if line:
        cohesion, friction = line
        slope = (1 + np.sin(friction)) / (1 - np.sin(friction))
        intercept = 2 * cohesion * np.sqrt(slope)
        span = np.array([0, confinement.max() * 1.05])
        axes.plot(span, intercept + slope * span, color=INK, linewidth=1.5)
        axes.text(0.97, 0.04, f"σ₁ = {intercept:.1f} MPa + {slope:.2f} σ₃", transform=axes.transAxes, ha="right",
                  va="bottom", path_effects=HALO)
    for run in runs:
        colour, reached = styles[run.index]["color"], run.summary.get("peak_reached", True)
        axes.plot(run.confinement / 1e6, run.summary["peak_stress_Pa"] / 1e6, "o", markersize=8, clip_on=False, zorder=3,
                  markeredgecolor=colour, markeredgewidth=1.5, markerfacecolor=colour if reached else "white")
    if not all(run.summary.get("peak_reached", True) for run in runs):
        axes.text(0.03, 0.97, "hollow: still rising\nwhen the test ended", transform=axes.transAxes, va="top", color=SOFT,
                  fontsize=9.5, path_effects=HALO)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.set_xlabel("confinement σ₃ (MPa)")
    axes.set_ylabel("peak axial stress σ₁ (MPa)")
    axes.set_title("Strength over confinement")
