"""Discs with contact bonds pressed together: the calibration charts of Fakhimi and Villegas (2007)."""
import numpy as np

from .plots import INK, SOFT, plt, save
from .series import MPA
from .study import Case, Outcome, Page, Row, Study

GENESIS = (0.007, 0.04, 0.08, 0.1)
NORMAL_STIFFNESS, NORMAL_STRENGTH = 50e9, 20e3  # N/m of a metre's thickness, N
RADIUS = 0.51e-3  # m, mean; the packing's own differs by less than 1 % and is read where it is printed
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
                 settings(g, 0.55, s, 'test.confinement=["0 MPa", "2.5 MPa", "5 MPa", "15 MPa", "30 MPa"]'))
            for g in (0.007, 0.04, 0.08, 0.1) for s in ((0.05, 0.2, 0.5) if g != 0.1 else (0.05,))]
FRICTION = [Case(f"mu-{mu:g}", "biaxial", "discs-biaxial.toml",
                 settings(0.08, 0.55, 0.2, f"material.friction_dynamic={mu:g}", "test.stop_after_peak=0", "test.stop_strain=0.012",
                          'test.confinement=["0 MPa", "5 MPa", "15 MPa", "30 MPa"]'))
            for mu in (0.5, 0.8)]
BRAZILIAN = [Case(label(g, k, s), "bts", "discs-brazilian.toml", settings(g, k, s))
             for g in (0.04, 0.1) for k in SHEAR_RATIOS for s in (0.1, 0.3, 0.5)]


def later(results, pictures):
    return Outcome([])


PAGES = [Page("discs", "Discs pressed together", "", [
    Study("discs-elastic", "Elastic constants", tuple(ELASTIC), later),
    Study("discs-strength", "Unconfined strength", tuple(STRENGTH + SLOW), later),
    Study("discs-envelope", "Failure envelopes", tuple(ENVELOPE), later),
    Study("discs-friction", "Friction of broken bonds", tuple(FRICTION), later),
    Study("discs-brazilian", "Brazilian strength", tuple(BRAZILIAN), later),
])]
