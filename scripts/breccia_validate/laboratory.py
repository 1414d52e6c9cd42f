"""Laboratory tests of Onate et al. (2015)."""
from .study import Case, Outcome, Page, Row, Study, within

MPA = 1e6


def strength(result, k=0):
    return result.run(k)["peak_stress_Pa"] / MPA


def cement_bts(results, pictures):
    result = results["disc"]
    sigma = result.run()["tensile_strength_Pa"] / MPA
    return Outcome([Row("tensile strength, MPa", sigma, 2.9, 3.0, "2.9 MPa within 10 %", within(sigma, 2.9, 0.10),
                        run_time=result.run_time)])


PAGES = [
    Page("cement", "Cement", "An oil-well cement.", [
        Study("cement-bts", "Brazilian test of cement", (Case("disc", "bts", "cement-bts.toml"),), cement_bts,
              meshes=("16k_bts_38_22.csv",)),
    ]),
]
