"""What several studies read from a run."""
from .study import Row

MPA = 1e6


def peak_row(result, k=0):
    """Peak stress, MPa, and the gauge's strain there."""
    run = result.run(k)
    return run["peak_stress_Pa"] / MPA, run["strain_at_peak"]


def dynamic(result):
    """What the runs say about being quasi-static, as a sentence; empty where they are."""
    said = []
    for k, run in enumerate(result.summary["runs"]):
        for warning in run["warnings"]:
            name = f"run {k}: " if len(result.summary["runs"]) > 1 else ""
            said.append(name + warning.removeprefix("dynamic: "))
    return "Marked dynamic: " + "; ".join(said) + "." if said else ""


def triaxial_rows(result):
    """One row per confinement, without a target."""
    rows = []
    for k, run in enumerate(result.summary["runs"]):
        p = run["confinement_Pa"] / MPA
        peak = f"{run['peak_stress_Pa'] / MPA:.1f} ({run['peak_deviator_Pa'] / MPA:.1f}) at {100 * run['strain_at_peak']:.2f} %"
        rows.append(Row(f"{p:.3g} MPa: axial stress (deviator), MPa{'' if run['peak_reached'] else ', no peak'}", peak,
                        run_time=run["run_time_s"]))
    return rows


def at_alpha_one(result, stress, young):
    """What the paper's area factor would make of a stress (MPa): forces and stiffnesses of bonds go with their areas alike."""
    alpha = result.run()["alpha"]
    return (f"alpha is {alpha:.3f} here, so that E is as asked; the paper prints 1. Strengths and E of a slow test go with it: "
            f"alpha = 1 means {stress / alpha:.3g} MPa, and E = {young / alpha:.3g} GPa in place of {young:.3g}.")
