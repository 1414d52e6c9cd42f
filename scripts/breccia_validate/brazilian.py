"""What a Brazilian test is judged by: its strength, and whether the disc splits along the loaded diameter."""
import csv
import shutil

import numpy as np
from breccia_plot import draw_cracks, read_series

from .series import MPA, at_alpha_one, dynamic
from .study import Outcome, Row, within

SLICES, BAND = 20, 0.1  # across the loaded diameter; half-width of the band about its plane, over D


def brazilian(name, result, pictures, experiment, paper, fraction, young):
    run = result.run()
    strength = run["tensile_strength_Pa"] / MPA
    share, span = splitting(result)
    lines = list(draw_cracks(read_series(result.folder), result.folder))
    assert lines, "a Brazilian test without a record of cracks"
    shutil.copyfile(result.folder / "cracks-0.png", pictures / f"{name}-cracks.png")
    drop = run.get("first_drop_stress_Pa")
    first = f"the load at its first drop of 5 % gives {drop / MPA:.2f} MPa" if drop else "it never drops by 5 %"
    text = f"""2 P/(pi L D) of the largest load; {first}, and with the correction
for the width of the strips, (1 - (b/R)^2)^1.5 with b = 0.15 R, it is {run['strip_corrected_strength_Pa'] / MPA:.2f} MPa. The first twenty cracks: {run['first_cracks']}.
Of the broken bonds {100 * share:.0f} % lie within a tenth of the diameter from the plane of the loaded diameter; cut into {SLICES} slices across
that diameter, {span} have broken bonds of the band in them ({run['broken_tension']:,} broke in tension, {run['broken_shear']:,} in shear). {at_alpha_one(result, strength, young)}
{dynamic(result)}"""
    return Outcome([
        Row("tensile strength, MPa", strength, experiment, paper, f"{experiment:g} MPa within {100 * fraction:.0f} %",
            within(strength, experiment, fraction), run_time=result.run_time),
        Row(f"slices of the loaded diameter that cracked, of {SLICES}", float(span), target=f"at least {SLICES - 2}: splits",
            met=span >= SLICES - 2),
    ], text, [f"{name}-cracks.png"])


def splitting(result):
    """Share of the broken bonds in the band about the loaded plane, and the number of slices with three of them or more."""
    with (result.folder / "cracks-0.csv").open(newline="") as file:
        places = np.array([(float(row["x_m"]), float(row["z_m"])) for row in csv.DictReader(file)])
    diameter = diameter_of(result)
    inside = np.abs(places[:, 0]) < BAND * diameter
    counts, _ = np.histogram(places[inside, 1], SLICES, (-diameter / 2, diameter / 2))
    return inside.mean(), int((counts >= 3).sum())


def diameter_of(result):
    """m, from the case as it was run."""
    text = read_series(result.folder).case["specimen"]["diameter"]
    number, unit = text.split()
    return float(number) * {"mm": 1e-3, "cm": 1e-2, "m": 1.0}[unit]
