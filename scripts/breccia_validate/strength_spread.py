"""Strength at equal Young's modulus over the range of bonds: how much a choice of the network decides."""
import numpy as np

from .plots import INK, SOFT, plt, save
from .series import MPA
from .study import Case, Outcome, Page, Row, Study

RANGES = (0.05, 0.10, 0.15, 0.20)
SEEDS = (1, 2, 3)
AIM = 0.05
# area of a bond in stiffness, area of its strengths
PARTITIONS = {"as-is": ("minimum", "same"), "strength": ("minimum", "voronoi"), "both": ("voronoi", "voronoi"),
              "scaled": ("voronoi", "same"), "polyhedron": ("polyhedron", "same")}
LABELS = {"as-is": "min areas", "strength": "min areas, strengths on Voronoi faces", "both": "Voronoi faces for both",
          "scaled": "alpha times Voronoi faces", "polyhedron": "polyhedron areas"}
COLOURS = {"as-is": INK, "strength": "#D55E00", "both": "#0072B2", "scaled": "#56B4E9", "polyhedron": "#009E73"}
MARKS = {"as-is": "o", "strength": "s", "both": "^", "scaled": "v", "polyhedron": "D"}


def name_of(test, spheres, partition, reach, seed):
    return f"{test}-{spheres}-{partition}-{int(round(100 * reach)):02d}-{seed}"


def cases_of(test, spheres, partitions, ranges=RANGES, seeds=SEEDS):
    cases = []
    for partition in partitions:
        area, strength = PARTITIONS[partition]
        for reach in ranges:
            for seed in seeds:
                cases.append(Case(name_of(test, spheres, partition, reach, seed), test, f"strength-spread-{test}.toml",
                                  (f"specimen.pack.spheres={spheres}", f"specimen.pack.seed={seed}", f"bonds.range={reach:.2f}",
                                   f'bonds.area="{area}"', f'bonds.strength_area="{strength}"')))
    return cases


def strength(result, test):
    return result.run()["tensile_strength_Pa" if test == "bts" else "peak_stress_Pa"] / MPA


CASES = {
    1000: cases_of("ucs", 1000, PARTITIONS, RANGES + (0.30,)) + cases_of("bts", 1000, ("as-is", "strength", "both")),
    4000: cases_of("ucs", 4000, PARTITIONS) + cases_of("bts", 4000, ("as-is", "strength", "both"), seeds=(1, 2)),
    13000: cases_of("ucs", 13000, ("as-is", "both"), seeds=(1,)) + cases_of("ucs", 13000, ("as-is",), seeds=(2, 3))
           + cases_of("bts", 13000, ("as-is", "both"), (0.05, 0.10, 0.20), (1,)),
}
NETWORK = [Case(f"{area}-{int(round(100 * reach)):02d}", "ucs", "strength-spread-ucs.toml",
                (f"bonds.range={reach:.2f}", f'bonds.area="{area}"', "test.stop_strain=0.0005", "test.platen_speed=0.05",
                 "features.breakage=false", "features.plasticity=false", "output.frames=1"))
           for area in ("minimum", "polyhedron", "voronoi") for reach in RANGES + (0.30,)]


def evaluate_small(results, pictures):
    return Outcome([])


PAGES = [Page("strength-spread", "Strength over the range of bonds", "", [
    Study("strength-spread-1000", "1,000 spheres", tuple(CASES[1000]), evaluate_small),
    Study("strength-spread-4000", "4,000 spheres", tuple(CASES[4000]), evaluate_small),
    Study("strength-spread-13000", "13,000 spheres", tuple(CASES[13000]), evaluate_small),
    Study("strength-spread-network", "What the bonds feel", tuple(NETWORK), evaluate_small),
])]
