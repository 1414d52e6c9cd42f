"""Single precision against double: runs that differ in the last digits of the platens' speed, twenty each way."""
import csv

import numpy as np

from .series import MPA
from .study import Case, Outcome, Page, Row, Study

COUNT = 20
TESTS = {  # program, case, what else; speeds in m/s
    "ucs": ("ucs", "failure-pack.toml", 0.1, ("specimen.pack.spheres=2000", "test.stop_after_peak=0.3")),
    "triaxial": ("triaxial", "failure-pack.toml", 0.2, ("specimen.pack.spheres=1000", 'test.confinement=["9 MPa"]', "test.stop_after_peak=0.3")),
    "tension": ("tension", "concrete-tension.toml", 0.04, ("specimen.pack.spheres=2000",)),
    "brazilian": ("bts", "concrete-bts.toml", 0.06, ("specimen.pack.spheres=3000",)),
}
NAMES = {"ucs": "unconfined compression", "triaxial": "triaxial at 9 MPa", "tension": "direct tension", "brazilian": "Brazilian test"}
QUANTITIES = (("E, GPa", "young_modulus_Pa", 1e9, "{:.6f}"), ("peak, MPa", "peak_stress_Pa", MPA, "{:.3f}"),
              ("strain at the peak, %", "strain_at_peak", 1e-2, "{:.4f}"), ("broken bonds", None, 1, "{:.0f}"))
SMALLEST = 0.01  # chance of a difference as large, below which the two are called different
SAME = 1e-5  # of the mean: what nobody measures, though runs in double that do not scatter at all can tell it
SHUFFLES = 20000


KINDS = {"double": ("double", 1e-12), "single": ("single", 1e-12), "shaken": ("double", 1e-7)}  # precision, part of the speed


def runs(kind, test):
    program, case, speed, others = TESTS[test]
    precision, part = KINDS[kind]
    return [Case(f"{test}-{kind}-{k}", program, case,
                 (*others, "output.frames=0", f'run.precision="{precision}"', f"test.platen_speed={speed * (1 + k * part):.15g}"))
            for k in range(COUNT)]


def without_damping(precision):
    """The triaxial test without non-viscous damping, to read E."""
    program, case, speed, others = TESTS["triaxial"]
    return Case(f"undamped-{precision}", program, case, (*others[:2], "test.stop_strain=0.0007", "damping.translation=0", "damping.rotation=0",
                "output.frames=0", f'run.precision="{precision}"', f"test.platen_speed={speed}"))


def values(results, precision, test, key):
    found = [results[f"{test}-{precision}-{k}"].run() for k in range(COUNT)]
    return np.array([run[key] if key else run["broken_tension"] + run["broken_shear"] for run in found], dtype=float)


def chance(one, other, statistic):
    """Of a difference as large if all runs were of one kind: by shuffling them, always in the same way."""
    random = np.random.default_rng(1)
    all_of_them, seen = np.concatenate([one, other]), abs(statistic(one) - statistic(other))
    if seen == 0:
        return 1.0
    count = 0
    for _ in range(SHUFFLES):
        mixed = random.permutation(all_of_them)
        count += abs(statistic(mixed[:len(one)]) - statistic(mixed[len(one):])) >= seen * (1 - 1e-12)
    return (count + 1) / (SHUFFLES + 1)


def first_cracks(result, count):
    with (result.folder / "cracks-0.csv").open(newline="") as file:
        return [(row["gid_lo"], row["gid_hi"]) for row in csv.DictReader(file)][:count]


def same_order(results, test):
    """Cracks that come in the same order before the first that does not."""
    one, other = (first_cracks(results[f"{test}-{precision}-0"], 100000) for precision in ("double", "single"))
    for k, (a, b) in enumerate(zip(one, other)):
        if a != b:
            return k, len(one)
    return min(len(one), len(other)), len(one)


def two_samples(results, _):
    rows = []
    for test, name in NAMES.items():
        for quantity, key, unit, number in QUANTITIES:
            if test == "brazilian" and quantity.startswith("E,"):
                continue  # a disc has none
            double, single, shaken = (values(results, kind, test, key) / unit for kind in KINDS)
            apart = abs(np.mean(single) / np.mean(double) - 1)
            of_means, of_spreads = chance(double, single, np.mean), chance(double, single, lambda x: np.std(x, ddof=1))
            told = lambda x: f"{number} ± {number}".format(np.mean(x), np.std(x, ddof=1))
            rows.append(Row(f"{name}: {quantity}, double; single", f"{told(double)}; {told(single)}", target=f"chance of means, of spreads above {SMALLEST}, or means within {SAME:g}",
                            met=bool((of_means > SMALLEST and of_spreads > SMALLEST) or apart < SAME)))
            beside = [chance(shaken, single, statistic) for statistic in (np.mean, lambda x: np.std(x, ddof=1))]
            rows.append(Row("— beside double shaken by 1e-7 of the speed", f"{told(shaken)}; chances {beside[0]:.3f}, {beside[1]:.3f}", target="the same",
                            met=bool(min(beside) > SMALLEST or abs(np.mean(single) / np.mean(shaken) - 1) < SAME)))
            rows.append(Row("— chance of a difference as large: means, spreads; means apart by", f"{of_means:.3f}, {of_spreads:.3f}; {apart:.1e}"))
        same, count = same_order(results, test)
        rows.append(Row(f"{name}: cracks in the same order before the first that is not, of {count}", float(same), target="100", met=same >= min(100, count)))
        worst = {precision: max(abs(results[f"{test}-{precision}-{k}"].run()["energy_error"]) for k in range(COUNT)) for precision in ("double", "single")}
        rows.append(Row(f"{name}: largest energy error, double; single", f"{worst['double']:.1e}; {worst['single']:.1e}", target="below 1e-3",
                        met=worst["single"] < 1e-3))
    double, single = (results[f"undamped-{precision}"].run()["young_modulus_Pa"] / 1e9 for precision in ("double", "single"))
    rows.append(Row("triaxial at 9 MPa without global damping: E, GPa, double; single; apart by", f"{double:.6f}; {single:.6f}; {abs(single / double - 1):.1e}",
                    target="below 1e-6", met=abs(single / double - 1) < 1e-6))
    return Outcome(rows, TEXT)


TEXT = f"""Each line: mean and standard deviation of {COUNT} runs whose platens differ by 1e-12 of their speed, in double and in single precision. The chance is
that of a difference as large if both were of one kind, found by shuffling the runs ({SHUFFLES} times). Before the peak all runs are alike; beyond, which
bond goes first is decided by round-off, in double as in single. Where double does not scatter at all (tension, the disc, E under pressure) any
difference is told. That of E at 9 MPa is non-viscous damping: it takes a tenth of a particle's net force, against its motion, and under pressure
rounded forces leave a net force where exact ones balance; the last row shows E without it. A push of 1e-12 leaves double among outcomes that are
close relatives, with the same first cracks; single leaves them at the first crack that differs. Its fair partner is double shaken by 1e-7 of the
speed, which is what rounding to floats amounts to."""

PAGES = [
    Page("single-precision", "Single precision against double", "`run.precision`; \"Single precision\" in `docs/model.md`.", [
        Study("single-precision", "Twenty runs each way", (*(case for test in TESTS for kind in KINDS for case in runs(kind, test)), without_damping("double"), without_damping("single")),
              two_samples),
    ]),
]
