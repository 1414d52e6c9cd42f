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


SPEEDS = (1, 0.5, 0.2, 0.1, 0.05, 0.02)
SPEEDS_13K = (0.2, 0.1, 0.05)
MESH_13K = ("13k_30_15.csv",)


def todo(results, pictures):
    return Outcome([])


PAGES = [
    Page("cement", "Cement", "An oil-well cement.", [
        Study("cement-bts", "Brazilian test of cement", (Case("disc", "bts", "cement-bts.toml"),), cement_bts,
              meshes=("16k_bts_38_22.csv",)),
        Study("cement-usc", "", (Case("plug", "usc", "cement-usc.toml"),), todo, meshes=("16k_25x48.csv",)),
    ]),
    Page("concrete", "Concrete", "", [
        Study("concrete-bts", "", (Case("disc", "bts", "concrete-bts.toml"),), todo),
        Study("concrete-cyclic", "", (Case("unconfined", "ucs", "concrete-cyclic.toml"),
                                      Case("confined", "triaxial", "concrete-cyclic-40.toml")), todo),
        Study("concrete-tension", "", (Case("cylinder", "tension", "concrete-tension.toml"),), todo),
        Study("concrete-shear", "", (Case("box", "shear", "concrete-shear.toml"),), todo),
        Study("speed", "", tuple(Case(f"at-{v}", "ucs", "concrete-speed.toml", (f"test.platen_speed={v}",))
                                 for v in SPEEDS), todo),
        Study("speed-13k", "", tuple(Case(f"at-{v}", "ucs", "concrete-ucs.toml", (f"test.platen_speed={v}",
              "test.stop_strain=0.0028", "test.stop_after_peak=0.2", "output.frames=0")) for v in SPEEDS_13K), todo, meshes=MESH_13K),
    ]),
    Page("shale", "Shale", "", [
        Study("shale-ucs", "", (Case("cylinder", "ucs", "shale-ucs.toml"),), todo),
        Study("shale-bts", "", (Case("disc", "bts", "shale-bts.toml"),), todo),
    ]),
    Page("high-confinement", "", "", [
        Study("high-confinement", "", (Case("hydrostatic", "hydrostatic", "high-confinement-hydrostatic.toml"),
                                       Case("triaxial", "triaxial", "high-confinement-triaxial.toml")), todo),
    ]),
]
