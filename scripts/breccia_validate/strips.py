"""The strips of the Brazilian test: what their width and depth do to an elastic disc and to strengths."""
import h5py
import numpy as np

from .plots import SHEAR, SOFT, TENSION, plt, save
from .series import MPA
from .study import Case, Outcome, Page, Row, Study

MESH = ("16k_bts_38_22.csv",)
D, L = 37.8e-3, 21.9e-3  # m, of the mesh's disc
MEAN = 0.6311e-3  # m, mean radius of its spheres
WIDTHS = (0.06, 0.10, 0.15, 0.20, 0.30)  # over the diameter
DEPTHS = (0.25, 0.5, 1.0, 1.5, 2.5, 4.0)  # mean radii
WIDE, DEEP = 0.15, 2.5  # the defaults
ELASTIC = ("features.breakage=false", "features.plasticity=false", "output.stress=true", "output.frames=1", "test.stop_strain=0.0004",
           'test.platen_speed="0.02 m/s"', 'material.preset="concrete"')
MATERIALS = ("concrete", "cement", "shale")


def of(width, depth):
    return (f'test.strip_width="{width * D * 1e3:.5g} mm"', f'test.strip_depth="{depth * MEAN * 1e3:.5g} mm"')


PLANES = ('test.strips="planes"',)
SHAPES = [(f"w{w:g}", of(w, DEEP)) for w in WIDTHS] + [(f"d{d:g}", of(WIDE, d)) for d in DEPTHS if d != DEEP] + [("planes", PLANES)]


def under_rigid_strips(x, z, width):
    """xx and zz over 2P/(pi D L) in a disc of diameter 1 between strips of this width: pairs of opposite point loads (Michell), spread over the
    arcs as the pressure under a rigid strip is, 1/sqrt(1 - s^2) over -1 < s < 1; Hondros (1959) has them spread evenly."""
    radius, half = 0.5, np.arcsin(width)
    angles = half * np.cos((np.arange(60) + 0.5) * np.pi / 60)  # equal weights: Gauss and Chebyshev
    xx, zz = np.zeros_like(x), np.zeros_like(x)
    for angle in angles:
        direction = np.array([np.sin(angle), np.cos(angle)])
        for sense in (1, -1):
            rx, rz = x - sense * radius * direction[0], z - sense * radius * direction[1]
            r = np.hypot(rx, rz)
            along = -sense * (rx * direction[0] + rz * direction[1]) / r
            xx -= 2 / np.pi * along * (rx / r) ** 2 / r
            zz -= 2 / np.pi * along * (rz / r) ** 2 / r
        xx += 1 / (np.pi * radius)
        zz += 1 / (np.pi * radius)
    vertical = np.cos(angles).sum()  # of the loads; 2P/(pi D L) is 2/pi for P = D = L = 1
    return xx / vertical / (2 / np.pi), zz / vertical / (2 / np.pi)


def centre(result, width):
    """xx and zz over 2P/(pi D L) within a fifth of the radius of the axis, and the same of the closed form there."""
    with h5py.File(result.folder / "results.h5") as file:
        run = file["run-0"]
        frame = run[sorted(name for name in run if name.startswith("frame"))[-1]]["particles"]
        where, stress = np.array(run["particles"]["reference_position"]), np.array(frame["stress_normal"])
        weight = np.array(run["particles"]["radius"]) ** 3
    nominal = result.curve()["axial_stress_Pa"][-1]
    inside = np.hypot(where[:, 0], where[:, 2]) < 0.2 * 0.5 * D
    measured = [np.average(stress[inside, k], weights=weight[inside]) / nominal for k in (0, 2)]
    grid = np.linspace(-0.1, 0.1, 41)
    x, z = np.meshgrid(grid, grid)
    disc = np.hypot(x, z) < 0.1
    wanted = [component[disc].mean() for component in under_rigid_strips(x, z, width)]
    return measured, wanted


def elastic(results, pictures):
    rows, points = [], []
    for name, words in SHAPES:
        width = float(name[1:]) if name.startswith("w") else WIDE
        (xx, zz), (want_xx, want_zz) = centre(results[name], width)
        label = {"w": f"width {width:g} D, depth {DEEP:g} mean radii", "d": f"width {WIDE:g} D, depth {name[1:]} mean radii"}.get(name[0], "planes of width 0.15 D")
        default = name == f"w{WIDE:g}"
        rows.append(Row(f"{label}: tension, compression at the centre over 2P/(pi D L)", f"{xx:.3f}, {zz:.3f}", None, f"{want_xx:.3f}, {want_zz:.3f}",
                        "tension of the closed form within 2 %" if default else "", abs(xx / want_xx - 1) <= 0.02 if default else None, error=xx / want_xx - 1))
    return Outcome(rows, """Concrete that neither yields nor breaks, on the mesh of 15,070 spheres. Closed form (column "paper"): opposite loads on arcs as wide as the strips,
spread as the pressure under a rigid strip is, mean over the same middle of the disc, a fifth of the radius wide. The strips move as rigid bodies;
under an even pressure (Hondros 1959) the middle of the default disc would carry 0.933.""", [])


def strengths(results, pictures):
    rows = []
    figure, both = plt.subplots(1, 2, figsize=(10, 4.4), constrained_layout=True, sharey=True)
    for material, colour in zip(MATERIALS, (TENSION, SHEAR, SOFT)):
        value = {name: (results[f"{material}-{name}"].run()["tensile_strength_Pa"] or float("nan")) / MPA for name, _ in SHAPES}
        depths = {d: value[f"d{d:g}"] if d != DEEP else value[f"w{WIDE:g}"] for d in DEPTHS}
        both[0].plot(WIDTHS, [value[f"w{w:g}"] for w in WIDTHS], "o-", color=colour, label=material)
        both[1].plot(list(depths), list(depths.values()), "o-", color=colour, label=material)
        both[1].plot([0], [value["planes"]], "s", color=colour)
        rows.append(Row(f"{material}: strength, MPa, at widths {', '.join(f'{w:g}' for w in WIDTHS)} D", ", ".join(f"{value[f'w{w:g}']:.2f}" for w in WIDTHS)))
        rows.append(Row(f"— at depths {', '.join(f'{d:g}' for d in DEPTHS)} mean radii", ", ".join(f"{v:.2f}" for v in depths.values())))
        rows.append(Row("— between planes", value["planes"]))
    both[0].set(title="width of the strips", xlabel="width over diameter", ylabel="2P/(pi D L) at the peak (MPa)")
    both[1].set(title="depth of the strips; squares: planes", xlabel="depth over mean radius")
    both[0].legend()
    save(figure, pictures / "strips.png")
    return Outcome(rows, "The same mesh with the three materials, platens 0.05 m/s each, accuracy fast.", ["strips.png"])


PACKED = ((0.06, 2.5), (0.10, 2.5), (0.15, 2.5), (0.15, 1.0), (0.15, 0.5))  # width over diameter, depth over mean radius
PACKED_D, PACKED_MEAN = 150e-3, 1.93e-3  # m


def packed(results, pictures):
    rows = []
    for width, depth in PACKED:
        run = results[f"w{width:g}-d{depth:g}"].run()
        rows.append(Row(f"concrete: width {width:g} D, depth {depth:g} mean radii: strength, MPa; first cracks",
                        f"{run['tensile_strength_Pa'] / MPA:.2f}; {run['first_cracks']}"))
    return Outcome(rows, "27,000 spheres packed here, strips 0.05 m/s each, accuracy fast: as on the mesh, width decides and depth does not.", [])


PAGES = [
    Page("strips", "Strips of the Brazilian test", "Keys `test.strip_width`, `strip_depth`, `strips`: `docs/model.md`, (B61).", [
        Study("strips-elastic", "An elastic disc", tuple(Case(name, "bts", "cement-bts.toml", (*words, *ELASTIC)) for name, words in SHAPES), elastic, meshes=MESH),
        Study("strips-strength", "Strengths over width and depth", tuple(
            Case(f"{material}-{name}", "bts", "cement-bts.toml", (*words, f'material.preset="{material}"', "output.frames=0", 'time.accuracy="fast"',
                 "test.stop_after_peak=0.3"))
            for material in MATERIALS for name, words in SHAPES), strengths, meshes=MESH),
        Study("strips-packed", "The same on a packing of 27,000", tuple(
            Case(f"w{width:g}-d{depth:g}", "bts", "concrete-bts.toml",
                 (f'test.strip_width="{width * PACKED_D * 1e3:.5g} mm"', f'test.strip_depth="{depth * PACKED_MEAN * 1e3:.4g} mm"', "output.frames=0",
                  'time.accuracy="fast"', 'test.platen_speed="0.05 m/s"', "test.stop_strain=0.0035"))
            for width, depth in PACKED), packed),
    ]),
]
