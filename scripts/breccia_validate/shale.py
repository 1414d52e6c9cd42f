"""Shale of Onate et al. (2015)."""
from .brazilian import brazilian
from .plots import curves_of
from .series import at_alpha_one, dynamic, peak_row
from .study import Case, Outcome, Page, Row, Study, within


def ucs(results, pictures):
    result = results["cylinder"]
    run, (peak, strain) = result.run(), peak_row(result)
    return Outcome([
        Row("peak, MPa", peak, 50.0, 48.0, "50 MPa within 10 %", within(peak, 50, 0.10), run_time=result.run_time),
        Row("gauge strain at the peak", strain), Row("E, GPa", run["young_modulus_Pa"] / 1e9, 30.0),
    ], f"""Bonds fail in tension almost alone ({run['broken_tension']:,} against {run['broken_shear']:,} in shear), along the axis: shale has no compressive limit,
and the strength is that of splitting. {at_alpha_one(result, peak, 30.0)}
{dynamic(result)}""", [curves_of(result, pictures / "shale-ucs.png")])


def bts(results, pictures):
    outcome = brazilian("shale-bts", results["disc"], pictures, 5.0, 5.4, 0.15, 30.0)
    outcome.text += """

Concrete and shale have the same tensile strength of bonds, 5 MPa, and their discs, the same packing, split at the same stress: in
these tests nothing else counts. The paper has 3.0 MPa ("good agreement") for the one and 5.4 MPa for the other."""
    return outcome


PAGES = [
    Page("shale", "Shale", """Middle Brown Devonian shale as in Onate et al. (2015), section 10.3; material `data/materials/shale.toml`, their
table 6. The specimens are packings of as many spheres as theirs. The size of the disc is not given there: 150 x 75 mm here.""", [
        Study("shale-ucs", "Unconfined compression of shale", (Case("cylinder", "ucs", "shale-ucs.toml"),), ucs),
        Study("shale-bts", "Brazilian test of shale", (Case("disc", "bts", "shale-bts.toml"),), bts),
    ]),
]
