"""Confined tests as the sources run them, beside what other choices give."""
import numpy as np

from .plots import INK, SHEAR, SOFT, TENSION, new_axes, plt, save
from .series import MPA
from .study import Case, Outcome, Page, Row, Study

MESH, PLUG = ("13k_30_15.csv",), ("16k_25x48.csv",)
LEVELS = (0, 4.5, 9, 20, 30, 60)
AS_BEFORE = ('material.shear_under_yield="elastic"', 'test.hydrostatic_branch="law"')


def elastic_of(run):
    return (run["young_modulus_Pa"] or float("nan")) / 1e9, run["poisson_ratio"] if run["poisson_ratio"] is not None else float("nan")


def elasticity(words, now, before):
    """Rows of E and nu over the pressure, and whether all lie within 5 % of the unconfined ones."""
    rows, first = [], elastic_of(now.summary["runs"][0])
    for level, run, old in zip(LEVELS, now.summary["runs"], before.summary["runs"]):
        e, nu = elastic_of(run)
        met = abs(e / first[0] - 1) <= 0.05 and abs(nu / first[1] - 1) <= 0.05
        rows.append(Row(f"{words}, {level:g} MPa: E, GPa; nu", f"{e:.2f}; {nu:.3f}",
                        target="E and nu within 5 % of the unconfined" if level else "", met=met if level else None,
                        run_time=run["run_time_s"]))
        rows.append(Row("— both options as they were", "{:.2f}; {:.3f}".format(*elastic_of(old))))
        peak = f"{'' if run['peak_reached'] else 'more than '}{run['peak_stress_Pa'] / MPA:.1f}"
        was = f"{'' if old['peak_reached'] else 'more than '}{old['peak_stress_Pa'] / MPA:.1f}"
        rows.append(Row("— largest axial stress, MPa; as it was", f"{peak}; {was}"))
        if level:
            rows.append(Row("— bonds broken, yielded in stage 1", f"{run['stage1_broken']:.0f}, {run['stage1_yielded']:.0f} of {run['bonds']}"))
    return rows


def concrete(results, pictures):
    rows = []
    for words, name in (("mesh of 13,500", "mesh"), ("packing of 4,000", "pack")):
        rows += elasticity(words, results[name], results[f"{name}-before"])
    figure, both = plt.subplots(1, 2, figsize=(11, 4.8), constrained_layout=True)
    for axes, name, title in ((both[0], "mesh", "stage 1 elastic, shear follows the tangent"),
                              (both[1], "mesh-before", "stage 1 by the law, shear stays elastic")):
        for k, level in enumerate(LEVELS):
            curve = results[name].curve(k)
            deviator = (curve["axial_stress_Pa"] - curve["confining_stress_Pa"]) / MPA
            colour = plt.cm.viridis(k / len(LEVELS))
            axes.plot(100 * curve["axial_strain"], deviator, color=colour, label=f"{level:g} MPa")
            axes.plot(100 * curve["radial_strain"], deviator, color=colour, linewidth=0.9)
        axes.set(title=title, xlabel="radial (left) and axial strain (%)", ylabel="axial - confining stress (MPa)",
                 xlim=(-1.5, 2), ylim=(0, 120))
        axes.axvline(0, color=SOFT, linewidth=0.7)
    both[0].legend(loc="lower right", fontsize=8)
    save(figure, pictures / "confined-concrete.png")
    return Outcome(rows, CONCRETE, ["confined-concrete.png"])


CONCRETE = """"As they were": `shear_under_yield = "elastic"` and `hydrostatic_branch = "law"`; the ends are free in stage 1 in both. The sources
give curves in figures only. The moduli are those of the straight part of the axial stage. Bonds that break in stage 1 belong to spheres that hang
on two or three bonds at the lateral surface and swing inwards under any pressure."""


def branch(result):
    """Slope of the deviator between 1 and 3 % of strain over the first one; deviators there, MPa."""
    curve = result.curve()
    strain, deviator = curve["axial_strain"], (curve["axial_stress_Pa"] - curve["confining_stress_Pa"]) / MPA
    first = np.polyfit(strain[(deviator > 1) & (deviator < 4) & (strain < 0.01)], deviator[(deviator > 1) & (deviator < 4) & (strain < 0.01)], 1)[0]
    inside = (strain > 0.01) & (strain < 0.03)
    at = [float(np.median(deviator[np.abs(strain - e) < 0.0005])) for e in (0.01, 0.03)]
    return np.polyfit(strain[inside], deviator[inside], 1)[0] / first, at, strain, deviator


def usc(results, pictures):
    rows = []
    figure, axes = new_axes("Uniaxial strain of the cement plug", "axial strain of the gauge (%)", "axial - lateral stress (MPa)")
    for name, words, colour in (("tangent", "shear follows the tangent", SHEAR), ("elastic", "shear stays elastic", TENSION)):
        slope, at, strain, deviator = branch(results[name])
        run = results[name].run()
        wanted = 1 / 24
        rows.append(Row(f"{words}: slope from 1 to 3 % of strain, over the first", slope, target="1/YRC3 = 0.042 within a third" if name == "tangent" else "",
                        met=abs(slope / wanted - 1) <= 1 / 3 if name == "tangent" else None, error=slope / wanted - 1, run_time=run["run_time_s"]))
        rows.append(Row("— deviator at 1 and 3 %, MPa; broken bonds",
                        f"{at[0]:.1f}, {at[1]:.1f}; {run['broken_tension'] + run['broken_shear']} of {run['bonds']}"))
        axes.plot(100 * strain, deviator, color=colour, label=words)
    axes.legend(loc="lower right")
    save(figure, pictures / "confined-usc.png")
    return Outcome(rows, USC, ["confined-usc.png"])


USC = """The paper's figure 13 has a hardening branch after the knee. Where all bonds go on along their last branch the slope is 1/YRC3 of the first; in
uniaxial strain those across the axis never yield. With an elastic shear stiffness the bonds shear off and the deviator sinks."""


def cement(results, pictures):
    rows = []
    for k, name in enumerate(("500 psi", "1000 psi", "2000 psi", "4000 psi")):
        for words, case in (("", "cement"), ("— both options as they were", "cement-before")):
            run = results[case].summary["runs"][k]
            e, nu = elastic_of(run)
            target = "3.8 GPa within 10 %" if not words else ""
            rows.append(Row(words or f"{name}: E, GPa; nu; largest axial stress, MPa",
                            f"{e:.2f}; {nu:.3f}; {'' if run['peak_reached'] else 'more than '}{run['peak_stress_Pa'] / MPA:.1f}", target=target,
                            met=abs(e / 3.8 - 1) <= 0.1 if not words else None, error=e / 3.8 - 1, run_time=run["run_time_s"]))
    return Outcome(rows, "The limits are those of the paper's table 4, raised by the bond stress of stage 1.", [])


PAGES = [
    Page("confined", "Confined tests", """What stage 1 and the shear stiffness under yield do to E, nu and strength: `docs/model.md`, "Confined tests".""", [
        Study("confined-concrete", "Concrete at six confinements", (
            Case("mesh", "triaxial", "concrete-triaxial.toml", ('test.confinement=["0 MPa","4.5 MPa","9 MPa","20 MPa","30 MPa","60 MPa"]', "output.frames=0")),
            Case("mesh-before", "triaxial", "concrete-triaxial.toml",
                 ('test.confinement=["0 MPa","4.5 MPa","9 MPa","20 MPa","30 MPa","60 MPa"]', "output.frames=0", *AS_BEFORE)),
            Case("pack", "triaxial", "confined-pack.toml", ("output.frames=0",)),
            Case("pack-before", "triaxial", "confined-pack.toml", ("output.frames=0", *AS_BEFORE))), concrete, meshes=MESH),
        Study("confined-usc", "Uniaxial strain of cement", (
            Case("tangent", "usc", "cement-usc.toml", ("output.frames=0",)),
            Case("elastic", "usc", "cement-usc.toml", ("output.frames=0", 'material.shear_under_yield="elastic"'))), usc, meshes=PLUG),
        Study("confined-cement", "Cement at four confinements", (
            Case("cement", "triaxial", "cement-triaxial.toml", ("output.frames=0", "time.accuracy=\"fast\"")),
            Case("cement-before", "triaxial", "cement-triaxial.toml", ("output.frames=0", "time.accuracy=\"fast\"", *AS_BEFORE))),
              cement, meshes=PLUG),
    ]),
]
