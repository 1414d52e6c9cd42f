"""Young's modulus and Poisson's ratio of a bonded assembly: section 5.1 of the Santasusana thesis."""
import numpy as np

from .areas import PLANE, plane_settings, solid_settings
from .plots import INK, SOFT, plt, save
from .study import Case, Outcome, Page, Row, Study

E, NU = 20.0, 0.25  # MPa; put in
ALPHAS = (1.0, 1.2, 1.5, 1.75, 2.0, 2.5)
BETAS = (0.0, 1.0, 2.0, 2.5, 3.0, 10.0, 100.0)
MESHES = ("mesh 1", "mesh 2", "mesh 3", "mesh 4", "mesh 5")
SHADES = ("#0072B2", "#009E73", "#E69F00", "#D55E00", "#CC79A7", INK, SOFT)
RATIOS = (0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0)


def run_of(mesh, alpha, beta):
    """beta as the thesis' eq. 5.7 prints it: on k_s = beta G A/d, whatever alpha is."""
    case, settings = ("plane-array.toml", ()) if mesh == "mesh 5" else ("plane-discs.toml", plane_settings(mesh, 1))
    return Case(f"{mesh.replace(' ', '-')}-{alpha:g}-{beta:g}", "biaxial", case,
                settings + (f"material.normal_factor={alpha}", f"material.shear_factor={beta}"), dry=True)


FACTORS = [run_of(mesh, alpha, beta) for mesh in MESHES for alpha in ALPHAS for beta in BETAS]
TOGETHER = [run_of("mesh 2", alpha, alpha * beta) for alpha in ALPHAS[1:] for beta in (0.5, 1.5)] + [run_of("mesh 2", 1.0, b) for b in (0.5, 1.5)]
FACTORS += [case for case in TOGETHER if case not in FACTORS]


def ratio_cases():
    cases = []
    for kappa in RATIOS:
        beta = kappa * 2 * (1 + NU)
        for mesh in MESHES[:4]:
            cases.append(Case(f"{mesh.replace(' ', '-')}-{kappa:g}", "biaxial", "plane-discs.toml",
                              plane_settings(mesh, 1) + (f"material.shear_factor={beta:.6g}",), dry=True))
        cases.append(Case(f"solid-{kappa:g}", "ucs", "solid-spheres.toml",
                          ("specimen.pack.spheres=4000", f"material.shear_factor={kappa * 2.4:.6g}", 'test.platens="smooth"'), dry=True))
    return cases


def of(results, mesh, alpha, beta):
    """E in MPa, nu."""
    probe = results[f"{mesh.replace(' ', '-')}-{alpha:g}-{beta:g}"]
    return probe.young_modulus * 1e3, probe.poisson_ratio


def factors(results, pictures):
    rows = []
    lines = ["| mesh | E at beta 0 | 1 | 2.5 | 3 | 100 | nu at beta 0 | 1 | 2.5 | 3 | 100 | alpha for E at beta 1 |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for mesh in MESHES:
        shown = (0.0, 1.0, 2.5, 3.0, 100.0)
        needed = E / of(results, mesh, 1.0, 1.0)[0]
        lines.append(f"| {mesh} | " + " | ".join(f"{of(results, mesh, 1.0, b)[0]:.2f}" for b in shown) + " | "
                     + " | ".join(f"{of(results, mesh, 1.0, b)[1]:.3f}" for b in shown) + f" | {needed:.3f} |")
    irregular = MESHES[:4]
    # both factors together: k_s/k_n stays
    straight = max(abs(of(results, "mesh 2", a, a * b)[0] / (a * of(results, "mesh 2", 1.0, b)[0]) - 1) for a in ALPHAS[1:] for b in (0.5, 1.5))
    constant = max(abs(of(results, "mesh 2", a, a * b)[1] - of(results, "mesh 2", 1.0, b)[1]) for a in ALPHAS[1:] for b in (0.5, 1.5))
    rows.append(Row("E over alpha, k_s/k_n kept: largest departure from a straight line through zero", f"{straight:.1e}", None, "0",
                    "0 within 1e-5", straight <= 1e-5))
    rows.append(Row("nu over alpha, k_s/k_n kept: largest change", f"{constant:.1e}", None, "0", "0 within 1e-5", constant <= 1e-5))
    bend = max(abs(1 - r_squared(ALPHAS, [of(results, m, a, b)[0] for a in ALPHAS])) for m in MESHES for b in BETAS)
    rows.append(Row("E over alpha, k_s kept (eq. 5.7 as printed): 1 - R^2 of a straight line", f"{bend:.1e}", None, "0", "0 within 0.01", bend <= 0.01))
    drift = max(abs(of(results, m, 2.5, b)[1] - of(results, m, 1.0, b)[1]) for m in irregular for b in (1.0, 2.0, 2.5, 3.0))
    rows.append(Row("nu over alpha, k_s kept: change from alpha 1 to 2.5, largest", f"{drift:.3f}", None, "0", "0 within 0.01", drift <= 0.01))
    rows += [Row(f"{m}: E at beta 3, MPa (thesis: that put in, where beta is large)", f"{of(results, m, 1.0, 3.0)[0]:.2f}", None, E,
                 "20 within 5 %", abs(of(results, m, 1.0, 3.0)[0] / E - 1) <= 0.05, of(results, m, 1.0, 3.0)[0] / E - 1) for m in irregular]
    rows += [Row(f"{m}: nu at beta 3 (thesis: near zero)", f"{of(results, m, 1.0, 3.0)[1]:.3f}", None, "0", "0 within 0.05",
                 abs(of(results, m, 1.0, 3.0)[1]) <= 0.05) for m in irregular]
    top = all(of(results, m, a, 0.0)[1] >= max(of(results, m, a, b)[1] for b in BETAS) for m in irregular for a in ALPHAS)
    rows.append(Row("largest nu at beta 0, all meshes and alpha", "yes" if top else "no", None, "yes", "yes", top))
    highest = max(of(results, m, 1.0, 0.0)[1] for m in irregular)
    rows.append(Row("largest nu of all (thesis: mesh 2, 0.9; above 0.5)", f"{highest:.2f}", None, 0.9, "above 0.5", highest > 0.5))
    square = max(abs(of(results, "mesh 5", 1.0, b)[1]) for b in BETAS[:5])
    rows.append(Row("square array: largest nu, beta 0 to 3", f"{square:.4f}", None, "0", "0 within 0.005", square <= 0.005))
    draw_factors(results, pictures / "elasticity-factors.png")
    draw_alpha(results, pictures / "elasticity-alpha.png")
    text = "\n".join(lines) + """

E in MPa at alpha = 1, of an elastic probe between smooth platens, printed to seven digits. E = 20 MPa and nu = 0.25 are put in, as
in the thesis; its meshes 1 to 4 stand as packings with their numbers of discs, spreads of radii and porosities, mesh 5 is its own.

- **Linear in alpha, nu free of alpha**: exactly so when alpha multiplies both stiffnesses, that is when beta counts from the k_n in use.
  Equation 5.7 as printed puts alpha on k_n alone. Then E is a straight line in alpha to the eye but not through zero, and nu rises with
  alpha, as it must: it follows k_s/k_n alone. So the thesis' figures 5.15 to 5.23 were not made with the equation as printed, or its
  second and first conclusions would exclude one another.
- **E recovered where the tangential stiffness is large**: within the thesis' beta, up to 3. There k_s reaches k_n (beta = 2(1 + nu) =
  2.5), and with areas that tile the plane an affine assembly has E = 2 (1 + kappa)/(3 + kappa) times that put in and nu = (1 - kappa)/(3 + kappa),
  kappa = k_s/k_n: E and zero at kappa = 1. It is no limit: at beta = 100 E is half as much again, and nu near -0.5 on its way to -1.
- **nu is largest at beta = 0** and depends on the network, as the thesis has it: there a frictionless network of not quite five
  neighbours is near the four at which it would lose its stiffness. Mesh 4 is the exception, and an artefact: at beta = 0 exactly, discs at its
  mantle are not held and spoil the reading (below, 0.40 at k_s/k_n = 0.02).
- **alpha that gives E at beta = 1**: the thesis needs 1.21 on its mesh 2.
"""
    return Outcome(rows, text, ["elasticity-factors.png", "elasticity-alpha.png"])


def r_squared(x, y):
    x, y = np.asarray(x), np.asarray(y)
    miss = y - np.polyval(np.polyfit(x, y, 1), x)
    return 1 - (miss @ miss) / ((y - y.mean()) @ (y - y.mean()))


def affine_plane(kappa):
    return (1 - kappa) / (3 + kappa)


def affine_solid(kappa):
    return (1 - kappa) / (4 + kappa)


def ratio(results, pictures):
    kappa = np.array(RATIOS)
    plane = {m: np.array([results[f"{m.replace(' ', '-')}-{k:g}"].poisson_ratio for k in RATIOS]) for m in MESHES[:4]}
    solid = np.array([results[f"solid-{k:g}"].poisson_ratio for k in RATIOS])
    falls = all((np.diff(nu[1:]) < 0).all() for nu in (*plane.values(), solid))
    rows = [Row("nu falls with k_s/k_n, all specimens, from 0.02 on", "yes" if falls else "no", None, "yes", "yes", falls),
            Row("largest nu in space, k_s = 0", f"{solid[0]:.3f}", None, "near 0.3", "0.3 within 0.03", abs(solid[0] - 0.3) <= 0.03)]
    for m, nu in plane.items():
        rows.append(Row(f"largest nu in the plane, k_s = 0, {m}", f"{nu[0]:.3f}", None, "0.25", "0.25 within 0.05", abs(nu[0] - 0.25) <= 0.05))
        strain = nu[0] / (1 + nu[0])
        rows.append(Row(f"the same read as plane strain, nu/(1 + nu), {m}", f"{strain:.3f}", None, "0.25"))
    figure, axes = plt.subplots(figsize=(7, 4.8), constrained_layout=True)
    axes.set(title="Poisson's ratio of the specimen", xlabel="$k_s/k_n$ of the bonds", ylabel="Poisson's ratio")
    axes.axhline(0, color=SOFT, linewidth=0.8)
    dense = np.linspace(0, 3, 200)
    axes.plot(dense, affine_plane(dense), "--", color=SHADES[0], linewidth=1.2, label="plane, affine: $(1-\\kappa)/(3+\\kappa)$")
    axes.plot(dense, affine_solid(dense), "--", color=SHADES[3], linewidth=1.2, label="space, affine: $(1-\\kappa)/(4+\\kappa)$")
    for (m, nu), mark in zip(plane.items(), "osD^"):
        axes.plot(kappa, nu, mark + "-", color=SHADES[0], markersize=4.5, linewidth=1, alpha=0.85, label=f"plane, {m}")
    axes.plot(kappa, solid, "v-", color=SHADES[3], markersize=5.5, linewidth=1.4, label="space, 4,000 spheres")
    axes.legend(fontsize=9.5)
    save(figure, pictures / "elasticity-ratio.png")
    text = """Figure 5.1 of the thesis, after Labra, is described there by its limits: nu at most 0.25 in the plane and near 0.3 in space. In space that
holds. In the plane the packings here go further as k_s vanishes: nu of discs is the apparent one, lateral over axial strain, which
would be 1/3 if the deformation were affine (1/4 read as plane strain, the limits of Tavarez and Plesha in the thesis' section 5.1.1)
and is more where the network has few neighbours, since frictionless bonds then hardly resist a change of shape. The thesis' own meshes reach 0.9
(its section 5.1.3), so the 0.25 belongs to Labra's assembly and not to discs as such. Mesh 4 at k_s = 0 is no material answer: without shear stiffness some of its discs
at the mantle are not held, and the gauge that reads the widening there follows them (0.40 at k_s/k_n = 0.02; E passes smoothly)."""
    return Outcome(rows, text, ["elasticity-ratio.png"])


def draw_factors(results, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.4), constrained_layout=True)
    for axes, what, name, put_in in ((left, 0, "Young's modulus, MPa", E), (right, 1, "Poisson's ratio", NU)):
        axes.set(xlabel="beta, factor of the shear stiffness", ylabel=name)
        axes.axhline(put_in if what == 0 else 0, color=SOFT, linewidth=1, linestyle="--")
        for mesh, colour, mark in zip(MESHES, SHADES, "osD^v"):
            betas = BETAS
            axes.plot([max(b, 0.3) for b in betas], [of(results, mesh, 1.0, b)[what] for b in betas], mark + "-", color=colour, markersize=5, label=mesh)
        axes.set_xscale("log")
        axes.axvspan(0.25, 3, color="#f1f4f7", zorder=0)
        axes.set_xlim(0.25, 130)
        axes.set_xticks([0.3, 1, 3, 10, 100], ["0", "1", "3", "10", "100"])
        axes.minorticks_off()
    left.set_title("E at alpha = 1 (dashed: put in)")
    right.set_title("nu, shaded: range of the thesis")
    left.legend(fontsize=9.5)
    save(figure, path)


def draw_alpha(results, path):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), constrained_layout=True)
    for axes, what, name in ((left, 0, "Young's modulus, MPa"), (right, 1, "Poisson's ratio")):
        axes.set(xlabel="alpha, factor of the normal stiffness", ylabel=name)
        for beta, colour, mark in zip(BETAS[:5], SHADES, "osD^v"):
            start = of(results, "mesh 2", 1.0, beta)
            axes.plot(ALPHAS, [of(results, "mesh 2", a, beta)[what] for a in ALPHAS], mark + "-", color=colour, markersize=5, label=f"beta {beta:g}")
            together = [a * start[0] for a in ALPHAS] if what == 0 else [start[1]] * len(ALPHAS)
            axes.plot(ALPHAS, together, ":", color=colour, linewidth=1.2)
    left.set_title("Mesh 2: E; dotted: alpha on both stiffnesses")
    right.set_title("Mesh 2: nu")
    left.legend(fontsize=9.5)
    save(figure, path)


PAGES = [Page("elasticity", "Elasticity of a bonded assembly", """
What E and nu come out of local stiffnesses k_n = alpha E A/d and k_s = beta G A/d, with areas that tile the body: the calibration
study of the Santasusana thesis, section 5.1.3 (figures 5.15 to 5.23), and Poisson's ratio over k_s/k_n (figure 5.1). The law is
`kdem` with polyhedron areas; its keys are `normal_factor` and `shear_factor`.
""", [
    Study("elasticity-factors", "E and nu over alpha and beta", tuple(FACTORS), factors),
    Study("elasticity-ratio", "Poisson's ratio over k_s/k_n", tuple(ratio_cases()), ratio),
])]
