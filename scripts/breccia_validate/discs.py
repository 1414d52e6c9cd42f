"""Discs with contact bonds pressed together: the calibration charts of Fakhimi and Villegas (2007)."""
import re

import numpy as np

from .plots import INK, SOFT, plt, save
from .series import MPA
from .study import Case, Outcome, Page, Row, Study

GENESIS = (0.007, 0.04, 0.08, 0.1)
NORMAL_STIFFNESS, NORMAL_STRENGTH = 50e9, 20e3  # N/m of a metre's thickness, N
SHEAR_RATIOS = (0.05, 0.1, 0.25, 0.55, 1.0, 1.5)
STRENGTH_RATIOS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5)


def settings(genesis, shear_ratio=0.55, strength_ratio=0.2, *more):
    return (f"specimen.pack.genesis_pressure={genesis}", f"material.shear_stiffness={shear_ratio * NORMAL_STIFFNESS:.6g}",
            f"material.bond_shear_strength={NORMAL_STRENGTH / strength_ratio:.6g}", *more)


def label(*values):
    return "-".join(f"{value:g}" for value in values)


ELASTIC = [Case(label(g, k), "biaxial", "discs-biaxial.toml", settings(g, k), dry=True)
           for g in GENESIS for k in (0.0, 0.05, 0.1, 0.25, 0.55, 1.0, 1.5, 2.0)]
STRENGTH = ([Case(label(g, 0.55, s), "biaxial", "discs-biaxial.toml", settings(g, 0.55, s)) for g in GENESIS for s in STRENGTH_RATIOS]
            + [Case(label(g, k, s), "biaxial", "discs-biaxial.toml", settings(g, k, s))
               for g in (0.007, 0.08) for k in SHEAR_RATIOS if k != 0.55 for s in (0.1, 0.5)])
SLOW = [Case("slow-" + label(g, 0.55, s), "biaxial", "discs-biaxial.toml", settings(g, 0.55, s, "test.platen_speed=0.02"))
        for g, s in ((0.08, 0.2), (0.007, 0.2))]
ENVELOPE = [Case(label(g, s), "biaxial", "discs-biaxial.toml",
                 settings(g, 0.55, s, 'test.confinement=["0 MPa", "2.5 MPa", "5 MPa", "20 MPa"]'))
            for g in (0.007, 0.04, 0.08, 0.1) for s in ((0.05, 0.2, 0.5) if g != 0.1 else (0.05,))]
FRICTION = [Case(f"mu-{mu:g}", "biaxial", "discs-biaxial.toml",
                 settings(0.08, 0.55, 0.2, f"material.friction_dynamic={mu:g}", "test.stop_after_peak=0", "test.stop_strain=0.008",
                          'test.confinement=["0 MPa", "5 MPa", "20 MPa"]'))
            for mu in (0.5, 0.8)]
BRAZILIAN = [Case(label(g, k, s), "bts", "discs-brazilian.toml", settings(g, k, s))
             for g in (0.04, 0.1) for k in SHEAR_RATIOS for s in (0.1, 0.3, 0.5)]


SHADES = ("#0072B2", "#009E73", "#E69F00", "#D55E00", "#CC79A7", INK)
MARKS = "osD^vP"


def radius(result):
    """Mean radius of the packing, m, from what the program said."""
    return float(re.search(r"mean radius ([\d.]+) mm", result.folder.with_name(result.folder.name + ".log").read_text())[1]) * 1e-3


def scaled(stress, result):
    """stress R/n_b, the stress in Pa."""
    return stress * radius(result) / NORMAL_STRENGTH


def strength(result, k=0):
    return scaled(result.run(k)["peak_stress_Pa"], result)


def yes(quantity, holds, note=""):
    return Row(quantity, ("yes" if holds else "no") + note, None, "yes", "yes", bool(holds))


def rising(values):
    return bool((np.diff(values) > 0).all())


def affine(kappa):
    return (1 - kappa) / (3 + kappa)


def elastic(results, pictures):
    ratios = (0.0, 0.05, 0.1, 0.25, 0.55, 1.0, 1.5, 2.0)
    modulus = {g: np.array([results[label(g, k)].young_modulus for k in ratios]) * 1e9 / NORMAL_STIFFNESS for g in GENESIS}
    poisson = {g: np.array([results[label(g, k)].poisson_ratio for k in ratios]) for g in GENESIS}
    rows = [yes("E'/k_n rises with k_s/k_n, each genesis pressure", all(rising(v) for v in modulus.values())),
            yes("E'/k_n rises with genesis pressure, each k_s/k_n", all(rising([modulus[g][i] for g in GENESIS]) for i in range(len(ratios)))),
            yes("nu' falls with k_s/k_n, each genesis pressure", all((np.diff(v) < 0).all() for v in poisson.values()))]
    neighbours = {g: results[label(g, 0.55)].coordination for g in GENESIS}
    rows += [Row(f"sigma_0/k_n = {g}: neighbours, E'/k_n and nu' at k_s/k_n = 0.55",
                 f"{neighbours[g]:.2f}, {modulus[g][4]:.3f}, {poisson[g][4]:.3f}") for g in GENESIS]
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for g, colour, mark in zip(GENESIS, SHADES, MARKS):
        left.plot(ratios, modulus[g], mark + "-", color=colour, markersize=5, label=f"$\\sigma_0/k_n$ = {g:g}")
        right.plot(ratios, poisson[g], mark + "-", color=colour, markersize=5, label=f"$\\sigma_0/k_n$ = {g:g}")
    dense = np.linspace(0, 2, 100)
    right.plot(dense, affine(dense), "--", color=SOFT, linewidth=1.2, label="affine")
    left.set(title="Apparent Young's modulus", xlabel="$k_s/k_n$", ylabel="$E'/k_n$")
    right.set(title="Apparent Poisson's ratio", xlabel="$k_s/k_n$", ylabel="$\\nu'$")
    left.set_ylim(0, None)
    left.legend(fontsize=9.5)
    right.legend(fontsize=9.5)
    save(figure, pictures / "discs-elastic.png")
    table = ["| sigma_0/k_n | " + " | ".join(f"{k:g}" for k in ratios) + " |", "| --- |" + " --- |" * len(ratios)]
    table += [f"| {g:g} | " + " | ".join(f"{e:.3f}; {n:.3f}" for e, n in zip(modulus[g], poisson[g])) + " |" for g in GENESIS]
    return Outcome(rows, "\n".join(table) + """

E'/k_n; nu' over k_s/k_n, from the elastic probe: apparent constants of a uniaxial test, as in the paper's figure 2 (true ones in plane strain:
nu = nu'/(1 + nu'), E = E'(1 - nu^2)). The seed text gives the figure's axes and the use made of it, not its numbers, so trends are compared.
More genesis pressure means more contacts, and a stiffer network at the same k_n that is nearer to affine deformation.""",
                   ["discs-elastic.png"])


def unconfined(results, pictures):
    over_strength = {g: np.array([strength(results[label(g, 0.55, s)]) for s in STRENGTH_RATIOS]) for g in GENESIS}
    over_stiffness = {(g, s): np.array([strength(results[label(g, k, s)]) for k in SHEAR_RATIOS]) for g in (0.007, 0.08) for s in (0.1, 0.5)}
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.3), constrained_layout=True)
    for g, colour, mark in zip(GENESIS, SHADES, MARKS):
        left.plot(STRENGTH_RATIOS, over_strength[g], mark + "-", color=colour, markersize=5, label=f"$\\sigma_0/k_n$ = {g:g}")
    for (g, s), values in over_stiffness.items():
        right.plot(SHEAR_RATIOS, values, MARKS[GENESIS.index(g)] + ("-" if s == 0.1 else "--"), color=SHADES[GENESIS.index(g)], markersize=5,
                   label=f"$\\sigma_0/k_n$ = {g:g}, $n_b/s_b$ = {s:g}")
    left.set(title="Unconfined strength, $k_s/k_n$ = 0.55", xlabel="$n_b/s_b$", ylabel="$q_u R/n_b$")
    right.set(title="Unconfined strength", xlabel="$k_s/k_n$", ylabel="$q_u R/n_b$")
    for axes in (left, right):
        axes.set_ylim(0, None)
        axes.legend(fontsize=9.5, handlelength=3)
    save(figure, pictures / "discs-strength.png")
    means = [over_strength[g].mean() for g in GENESIS]
    ordered = sum(rising([over_strength[g][i] for g in GENESIS]) for i in range(len(STRENGTH_RATIOS)))
    rows = [yes("q_u R/n_b rises with genesis pressure, mean over n_b/s_b", rising(means), " (" + ", ".join(f"{m:.2f}" for m in means) + ")"),
            Row("the same for each n_b/s_b", f"{ordered} of {len(STRENGTH_RATIOS)}"),
            yes("q_u falls where k_s/k_n falls from 0.55 to 0.05, all four series", all(v[0] < v[3] for v in over_stiffness.values()),
                " (" + ", ".join(f"{v[0] / v[3]:.2f}" for v in over_stiffness.values()) + ")"),
            yes("q_u falls as n_b/s_b grows from 0.1 to 0.5, each genesis pressure", all(v[1] > v[-1] for v in over_strength.values()))]
    slow = [(name, strength(results[name]), strength(results[name.removeprefix("slow-")])) for name in results if name.startswith("slow-")]
    change = max(abs(a / b - 1) for _, a, b in slow)
    rows.append(Row("platens at 0.02 in place of 0.05 m/s: largest change of q_u", f"{100 * change:.1f} %", None, None, "below 5 %", change < 0.05))
    table = ["| sigma_0/k_n | " + " | ".join(f"n_b/s_b {s:g}" for s in STRENGTH_RATIOS) + " |", "| --- |" + " --- |" * len(STRENGTH_RATIOS)]
    table += [f"| {g:g} | " + " | ".join(f"{v:.2f}" for v in over_strength[g]) + " |" for g in GENESIS]
    table += ["", "| sigma_0/k_n, n_b/s_b | " + " | ".join(f"k_s/k_n {k:g}" for k in SHEAR_RATIOS) + " |", "| --- |" + " --- |" * len(SHEAR_RATIOS)]
    table += [f"| {g:g}, {s:g} | " + " | ".join(f"{v:.2f}" for v in values) + " |" for (g, s), values in over_stiffness.items()]
    seconds = sum(r.run_time for r in results.values())
    rows[0].run_time = seconds
    worst = max(r.run()["kinetic_ratio"] for r in results.values())
    return Outcome(rows, "\n".join(table) + f"""

q_u R/n_b; the paper draws such values over k_s/k_n for sigma_0/k_n = 0.007 and 0.08 (its figure 3) and states in words what is listed above. One
packing for each pressure. Where n_b/s_b is small bonds break in tension only on the way to the peak, and how strong they are in shear does not matter: that is
what n_b/s_b of 0.3 and more lets in. Kinetic over stored energy reaches {worst:.1e} before the peak: brittle discs throw energy about when bonds break, and
the runs are marked dynamic; the slower runs say what that is worth.""", ["discs-strength.png"])


def angle(low, high, rise):
    """Friction angle, degrees, of a line in sigma_1, sigma_3: slope tan^2(45 + phi/2)."""
    slope = rise / (high - low)
    return float(np.degrees(np.arcsin((slope - 1) / (slope + 1)))) if slope > 0 else float("nan")


def envelope(results, pictures):
    rows, angles = [], {}
    figure, panes = plt.subplots(1, 3, figsize=(11, 4), constrained_layout=True, sharey=True)
    table = ["| sigma_0/k_n, n_b/s_b | " + " | ".join(f"sigma_3 = {p:g} MPa" for p in (0, 2.5, 5, 20)) + " | friction angle, 0 to 5 MPa | 5 to 20 MPa |",
             "| --- |" + " --- |" * 6]
    for name, result in results.items():
        g, s = (float(v) for v in name.split("-"))
        p = np.array([run["confinement_Pa"] for run in result.summary["runs"]])
        peak = np.array([run["peak_stress_Pa"] for run in result.summary["runs"]])
        first = np.polyfit(p[:3], peak[:3], 1)[0]
        angles[g, s] = angle(0, 1, first), angle(p[2], p[-1], peak[-1] - peak[2])
        table.append(f"| {g:g}, {s:g} | " + " | ".join(f"{v:.2f}" for v in scaled(peak, result)) + f" | {angles[g, s][0]:.0f} | {angles[g, s][1]:.0f} |")
        if g in (0.007, 0.04, 0.08):
            axes = panes[(0.007, 0.04, 0.08).index(g)]
            k = (0.05, 0.2, 0.5).index(s)
            axes.plot(scaled(p, result), scaled(peak, result), MARKS[k] + "-", color=SHADES[k], markersize=5, label=f"$n_b/s_b$ = {s:g}")
            axes.set(title=f"$\\sigma_0/k_n$ = {g:g}", xlabel="$\\sigma_3 R/n_b$")
    panes[0].set_ylabel("$\\sigma_1 R/n_b$ at the peak")
    panes[0].set_ylim(0, None)
    panes[0].legend(fontsize=9.5, loc="upper left")
    save(figure, pictures / "discs-envelope.png")
    highest = max(angles, key=lambda at: angles[at][0])
    rows.append(Row(f"largest friction angle at low pressure, degrees (sigma_0/k_n {highest[0]:g}, n_b/s_b {highest[1]:g})", round(angles[highest][0], 1),
                    None, "60 or more", "60 or more", angles[highest][0] >= 60, run_time=sum(r.run_time for r in results.values())))
    rows.append(yes("strength rises with genesis pressure at every confinement, n_b/s_b = 0.05",
                    all(rising([scaled(results[label(g, 0.05)].run(k)["peak_stress_Pa"], results[label(g, 0.05)]) for g in (0.007, 0.04, 0.08)])
                        for k in range(4))))
    rows.append(yes("angle larger with small n_b/s_b: 0.05 against 0.5, sigma_0/k_n = 0.08", angles[0.08, 0.05][0] > angles[0.08, 0.5][0],
                    f" ({angles[0.08, 0.05][0]:.0f} against {angles[0.08, 0.5][0]:.0f} degrees)"))
    rows.append(yes("envelope curved like a rock's: angle falls with pressure, sigma_0/k_n = 0.08, n_b/s_b = 0.05",
                    angles[0.08, 0.05][0] > angles[0.08, 0.05][1], f" ({angles[0.08, 0.05][0]:.0f} to {angles[0.08, 0.05][1]:.0f} degrees)"))
    return Outcome(rows, "\n".join(table) + "\n\nsigma_1 R/n_b at the peak; angles in degrees from lines in sigma_1, sigma_3 of slope tan^2(45 + phi/2), "
                   "the first through 0, 2.5 and 5 MPa. k_s/k_n = 0.55, friction 0.5, one packing for each pressure. "
                   "Up to 20 MPa the envelopes of n_b/s_b = 0.05 are straight, since no bond breaks in shear on the way to the peak; those of 0.2 bend over, at "
                   "sigma_0/k_n = 0.04 from 54 to 34 degrees. A bend at 0.05 may lie beyond: how far the paper's figure 5 goes its text does not say.", ["discs-envelope.png"])


def friction(results, pictures):
    confinement = [run["confinement_Pa"] for run in results["mu-0.5"].summary["runs"]]
    peak = {m: np.array([run["peak_stress_Pa"] for run in results[f"mu-{m:g}"].summary["runs"]]) for m in (0.5, 0.8)}
    rest = {}
    for m in (0.5, 0.8):
        result = results[f"mu-{m:g}"]
        rest[m] = []
        for k in range(len(confinement)):
            curve = result.curve(k)
            stress = curve[next(name for name in curve if "stress" in name)]
            rest[m].append(np.median(stress[-len(stress) // 10:]))
    rest = {m: np.array(v) for m, v in rest.items()}
    change, remains = np.abs(peak[0.8] / peak[0.5] - 1), np.abs(rest[0.8][1:] / rest[0.5][1:] - 1)
    rows = [Row("peak, friction 0.8 in place of 0.5: largest change over three confinements", f"{100 * change.max():.1f} %", None, "small", "below 5 %", change.max() < 0.05,
                run_time=sum(r.run_time for r in results.values())),
            Row("residual strength, the same, confined runs: largest change", f"{100 * remains.max():.1f} %", None, "negligible", "below 10 %", remains.max() < 0.10)]
    figure, axes = plt.subplots(figsize=(6.4, 4.4), constrained_layout=True)
    axes.set(title="Peak and residual, $\\sigma_0/k_n$ = 0.08, $n_b/s_b$ = 0.2", xlabel="$\\sigma_3 R/n_b$", ylabel="$\\sigma_1 R/n_b$")
    x = scaled(np.array(confinement), results["mu-0.5"])
    for m, colour in ((0.5, SHADES[0]), (0.8, SHADES[3])):
        axes.plot(x, scaled(peak[m], results[f"mu-{m:g}"]), "o-", color=colour, markersize=5.5, label=f"peak, friction {m:g}")
        axes.plot(x, scaled(rest[m], results[f"mu-{m:g}"]), "s--", color=colour, markersize=5, label=f"residual, friction {m:g}")
    axes.set_ylim(0, None)
    axes.legend(fontsize=9.5)
    save(figure, pictures / "discs-friction.png")
    signs = ", ".join(f"{100 * (v - 1):+.0f} %" for v in peak[0.8] / peak[0.5])
    after = ", ".join(f"{100 * (v - 1):+.0f} %" for v in rest[0.8][1:] / rest[0.5][1:])
    levels = ", ".join(f"{p / MPA:g}" for p in confinement)
    return Outcome(rows, f"""The paper has it (figure 6) that friction has a small effect on the peak and a negligible one on the residual strength. Here the peaks differ by
{signs} at {levels} MPa, the residual strengths of the confined runs by {after}: of either sign, so no trend with friction can be told from one packing, whose
cracks take another way with any change. The residual strengths are still falling by steps: they are the median stress over the last tenth of the
records, at 0.8 % of platen strain, and waver by a fifth within one run.""", ["discs-friction.png"])


def brazilian(results, pictures):
    values = {(g, s): np.array([scaled(results[label(g, k, s)].run()["tensile_strength_Pa"], results[label(g, k, s)]) for k in SHEAR_RATIOS])
              for g in (0.04, 0.1) for s in (0.1, 0.3, 0.5)}
    higher = sum(bool(a > b) for s in (0.1, 0.3, 0.5) for a, b in zip(values[0.1, s], values[0.04, s]))
    total = 3 * len(SHEAR_RATIOS)
    means = {g: np.mean([values[g, s].mean() for s in (0.1, 0.3, 0.5)]) for g in (0.04, 0.1)}
    inner = [s for s in (0.1, 0.3, 0.5) if 0 < int(np.argmax(values[0.1, s])) < len(SHEAR_RATIOS) - 1]
    rows = [yes("sigma_t R/n_b rises with genesis pressure, 0.04 to 0.1, mean of the series", means[0.1] > means[0.04],
                f" ({means[0.04]:.2f} to {means[0.1]:.2f})"),
            Row("the same, pair by pair", f"{higher} of {total}"),
            yes("sigma_t has a maximum over k_s/k_n at sigma_0/k_n = 0.1, in some series", bool(inner),
                (" (n_b/s_b " + ", ".join(f"{s:g}" for s in inner) + ")") if inner else "")]
    rows[0].run_time = sum(r.run_time for r in results.values())
    figure, panes = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True, sharey=True)
    for axes, g in zip(panes, (0.1, 0.04)):
        axes.set(title=f"Brazilian strength, $\\sigma_0/k_n$ = {g:g}", xlabel="$k_s/k_n$")
        for k, s in enumerate((0.1, 0.3, 0.5)):
            axes.plot(SHEAR_RATIOS, values[g, s], MARKS[k] + "-", color=SHADES[k], markersize=5, label=f"$n_b/s_b$ = {s:g}")
    panes[0].set_ylabel("$\\sigma_t R/n_b$")
    panes[0].set_ylim(0, None)
    panes[0].legend(fontsize=9.5)
    save(figure, pictures / "discs-brazilian.png")
    table = ["| sigma_0/k_n, n_b/s_b | " + " | ".join(f"k_s/k_n {k:g}" for k in SHEAR_RATIOS) + " |", "| --- |" + " --- |" * len(SHEAR_RATIOS)]
    table += [f"| {g:g}, {s:g} | " + " | ".join(f"{v:.2f}" for v in row) + " |" for (g, s), row in values.items()]
    return Outcome(rows, "\n".join(table) + "\n\nsigma_t R/n_b with sigma_t = 2 P/(pi D), of discs of 1,200 discs, one packing for each pressure (the paper's figure 8 and what its text "
                   "says of it).", ["discs-brazilian.png"])


PAGES = [Page("discs", "Discs with contact bonds", """
The calibration charts of Fakhimi and Villegas (Rock Mech. Rock Engng 40, 2007): discs pressed together until the walls feel a genesis pressure
sigma_0, then relieved of their forces and bonded where they touch, law `contact-bond`. R = 0.51 mm (0.44 to 0.58 mm), k_n = 50 GPa and n_b = 20 kN/m
are theirs; specimens of 29 x 58 mm with 2,000 discs, R/D = 0.018 for their 0.013. Their text states the trends of the charts, and those are the
targets here.
""", [
    Study("discs-elastic", "Discs: elastic constants", tuple(ELASTIC), elastic),
    Study("discs-strength", "Discs: unconfined strength", tuple(STRENGTH + SLOW), unconfined),
    Study("discs-envelope", "Discs: failure envelopes", tuple(ENVELOPE), envelope),
    Study("discs-friction", "Discs: friction of broken bonds", tuple(FRICTION), friction),
    Study("discs-brazilian", "Discs: Brazilian strength", tuple(BRAZILIAN), brazilian),
])]
