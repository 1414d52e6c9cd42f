"""Oil-well cement of Onate et al. (2015)."""
import numpy as np

from .brazilian import brazilian
from .plots import SHEAR, SOFT, TENSION, curves_of, envelope_of, new_axes, save
from .series import MPA, dynamic, peak_row, triaxial_rows
from .study import Case, Outcome, Page, Row, Study, within

PLUG = ("16k_25x48.csv",)


def bts(results, pictures):
    outcome = brazilian("cement-bts", results["disc"], pictures, 2.9, 3.0, 0.10, 3.8)
    outcome.text += """

847 lb on a disc of 1.487 x 0.863 in are 2.90 MPa. Below each strip the pressure is 2 P/(0.3 D L), some 28 MPa at the
peak, three times the first compressive limit of this cement (8.5 MPa): bonds there yield and shear long before the middle
carries its tensile strength, and wedges form. Where the run ends, at 0.76 % of travel, no crack has grown through the disc: it was
crushed at its strips, and the stress is no tensile strength to quote, near the experiment or not."""
    return outcome


def usc(results, pictures):
    result = results["plug"]
    curve = result.curve()
    strain, deviator = curve["axial_strain"], (curve["axial_stress_Pa"] - curve["confining_stress_Pa"]) / MPA
    # strains of equal steps: rows come at equal times, and strain jumps where layers collapse
    grid = np.arange(0.0002, np.nanmax(strain), 0.0001)
    order = np.argsort(strain, kind="stable")
    smooth = np.interp(grid, strain[order], deviator[order])
    axial = np.interp(grid, strain[order], curve["axial_stress_Pa"][order] / MPA)

    def slope(values, low, high):
        inside = (grid >= low) & (grid <= high)
        return np.polyfit(grid[inside], values[inside], 1)[0]

    first = slope(smooth, grid[smooth > 1][0], grid[smooth > 4][0])
    half = 0.0005
    tangent = np.array([slope(smooth, e - half, e + half) for e in grid])
    onset = int(np.flatnonzero((tangent < 0.5 * first) & (smooth > 4))[0])
    early = int(np.flatnonzero((tangent < 0.9 * first) & (smooth > 4))[0])
    stiff = np.array([slope(axial, e - half, e + half) for e in grid])
    end = grid[-1]
    plateau = slope(smooth, grid[onset], grid[onset] + 0.005)
    last = slope(smooth, end - 0.008, end)
    first_axial = slope(axial, grid[smooth > 1][0], grid[smooth > 4][0])
    axial_last = slope(axial, end - 0.008, end)
    flat = grid[np.flatnonzero((stiff < 0.1 * first_axial) & (smooth > 4))[0]]

    figure, axes = new_axes("Uniaxial strain of the cement plug", "axial strain of the gauge (%)", "MPa")
    axes.plot(100 * strain, curve["axial_stress_Pa"] / MPA, color=SHEAR, label="axial stress")
    axes.plot(100 * strain, deviator, color=TENSION, label="axial - lateral stress")
    axes.plot(100 * strain, curve["confining_stress_Pa"] / MPA, color=SOFT, label="lateral stress")
    axes.axhline(10, color=SOFT, linewidth=0.9, linestyle="--")
    axes.text(100 * strain[-1], 10.2, "onset wanted of axial - lateral stress: 10 MPa", color=SOFT, fontsize=9, ha="right", va="bottom")
    axes.plot(100 * grid[onset], smooth[onset], "o", color=TENSION)
    axes.text(100 * grid[onset] + 0.06, smooth[onset] - 0.2, "onset", color=TENSION, fontsize=9, va="top")
    axes.legend()
    save(figure, pictures / "cement-usc.png")
    broken = result.run()["broken_tension"] + result.run()["broken_shear"]
    text = f"""Strain is that of the gauge. Onset: the deviator at which its tangent, a least-squares line over 0.1 % of strain, falls to half of
the first slope (1 to 4 MPa); the first slope of the elastic specimen is E/(1 + nu). The flat part begins where the tangent of the axial stress
falls below a tenth of its first slope. The last slope is that of the last 0.8 % of strain, up to {100 * end:.1f} %; bonds beyond their
third limit have 1/24 = 0.042 of their stiffness (YRC 3), {broken:,} of {result.run()['bonds']:,} are broken by then, nearly all in shear.
After the knee the deviator goes on rising, slowly; with an elastic shear stiffness under yield it sinks (`confined.md`).
{dynamic(result)}"""
    return Outcome([
        Row("deviator at the onset of non-linearity, MPa", smooth[onset], "about 10", None, "10 MPa within 15 %",
            within(smooth[onset], 10, 0.15), error=smooth[onset] / 10 - 1, run_time=result.run_time),
        Row("deviator where the tangent has lost a tenth, MPa", smooth[early]),
        Row("first slope of the deviator, GPa", first / 1e3),
        Row("slope in the 0.5 % of strain after the onset, over the first", plateau / first),
        Row("flat from strain, %; axial stress there, MPa", f"{100 * flat:.2f}; {np.interp(flat, grid, axial):.1f}"),
        Row("last slope over the first, axial stress", axial_last / first_axial),
        Row("last slope over the first, deviator", last / first),
        Row(f"axial, lateral stress at {100 * end:.1f} %, MPa", f"{axial[-1]:.1f}, {axial[-1] - smooth[-1]:.1f}"),
    ], text, ["cement-usc.png"])


def ucs(results, pictures):
    result = results["plug"]
    run, (peak, strain) = result.run(), peak_row(result)
    return Outcome([
        Row("peak, MPa", peak, 17.0, None, "17 MPa within 10 %", within(peak, 17, 0.10), run_time=result.run_time),
        Row("gauge strain at the peak", strain), Row("E, GPa", run["young_modulus_Pa"] / 1e9, 3.8),
    ], "The paper used 42,000 spheres and 70 psi of a jacket; here there are 18,582 and none.\n" + dynamic(result),
        [curves_of(result, pictures / "cement-ucs.png")])


def triaxial(results, pictures):
    result = results["plug"]
    return Outcome(triaxial_rows(result), """The limits are those of the paper's table 4 for each confinement. The curves of the
experiment are in figures only, so there is no number to meet.\n""" + dynamic(result), [curves_of(result, pictures / "cement-triaxial.png"), envelope_of(result, pictures / "cement-triaxial-envelope.png")])


PAGES = [
    Page("cement", "Oil-well cement", """The plug and the disc of Onate et al. (2015), on the meshes of the paper's companions; material
`data/materials/cement.toml`, their tables 2 to 4.""", [
        Study("cement-bts", "Brazilian test of cement", (Case("disc", "bts", "cement-bts.toml"),), bts,
              meshes=("16k_bts_38_22.csv",)),
        Study("cement-usc", "Uniaxial strain of cement", (Case("plug", "usc", "cement-usc.toml"),), usc, meshes=PLUG),
        Study("cement-ucs", "Unconfined compression of cement", (Case("plug", "ucs", "cement-ucs.toml"),), ucs, meshes=PLUG),
        Study("cement-triaxial", "Triaxial compression of cement", (Case("plug", "triaxial", "cement-triaxial.toml"),), triaxial,
              meshes=PLUG),
    ]),
]
