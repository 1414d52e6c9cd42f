#!/usr/bin/python3
"""Every program on a small specimen: the keys of its summary with their units, a band for its result, the hash of
its last state on record; and every case of data/cases, made small."""
import json
import os
import re
import subprocess

from programs import BIN, SOURCE, ProgramTest, main, run

CYLINDER = """[specimen]
shape = "cylinder"
diameter = "50 mm"
height = "100 mm"
pack = { spheres = 400, seed = 3 }
[material]
preset = "concrete"
[run]
scatter = "gather"
[output]
frames = 0
"""
DISC = CYLINDER.replace('"cylinder"', '"disc"').replace('height = "100 mm"', 'height = "20 mm"').replace("concrete", "cement")
BLOCK = CYLINDER.replace('"cylinder"', '"box"').replace('"100 mm"', '"40 mm"\ndepth = "30 mm"').replace(
    "[run]", '[test]\ncut_depth = "8 mm"\nrake_angle = 20\n[run]')
PLANE = CYLINDER.replace('shape = "cylinder"', "dimensions = 2").replace("concrete", "sandstone-discs")

ALWAYS = """confinement_Pa peak_stress_Pa peak_deviator_Pa peak_reached strain_at_peak young_modulus_Pa young_modulus_50_Pa
    poisson_ratio crack_initiation_stress_Pa crack_damage_stress_Pa tensile_strength_Pa alpha particles bonds coordination
    dropped_bonds short_bonds broken_tension broken_shear localisation contact_searches length_quantum_m force_quantum_N steps time_step_s lowest_time_step_s critical_time_step_s
    step_estimates local_step_estimates mass_factor scaled_particles run_time_s phases_s bond_updates_per_s bond_pass_per_s energy_error
    kinetic_ratio platen_mismatch rate_error step_error sampling_error state_hash stopped_by warnings""".split()

# program: case, --set, keys beyond those of every test, the result and its band, hashes of the last state with portable loops, in
# single precision (the default) and in doubles.
# Bands are those of such small specimens: units and orders of magnitude, no strength to quote.
# Hashes are of a law whose shear stiffness follows the tangent under yield (B107), and of stage 1 with free ends and raised limits.
PROGRAMS = {
    "ucs": (CYLINDER, {"test.stop_strain": 0.003}, [], ("peak_stress_Pa", 30e6, 50e6), ("5c935dbf7238158b", "42c7a883c1bfe95b")),
    "triaxial": (CYLINDER, {"test.stop_strain": 0.003, "test.confinement": '["9 MPa"]'},
                 ["hydrostatic_branch", "limits_raised_Pa", "stage1_broken", "stage1_yielded"],
                 ("peak_stress_Pa", 50e6, 90e6), ("ade82d0836a9b4d4", "e87b956ee1c05e76")),
    "usc": (CYLINDER, {"test.stop_strain": 0.003}, [], ("peak_stress_Pa", 50e6, 100e6), ("57157148d46cbc65", "1f6537cf3aa20aac")),
    "hydrostatic": (CYLINDER, {"test.confinement": '"20 MPa"'}, ["bulk_modulus_Pa"], ("bulk_modulus_Pa", 8e9, 20e9), ("43d9af1b59773521", "587e6c6b720ec402")),
    "tension": (CYLINDER, {"test.stop_strain": 0.0005}, [], ("tensile_strength_Pa", 2.5e6, 5e6), ("4b304dbb552b24dd", "4272ff4d50cc6590")),
    "shear": (CYLINDER, {"test.stop_strain": 0.003, "test.confinement": '"1 MPa"'}, [], ("peak_stress_Pa", 2e6, 9e6), ("c72b85c0857dab97", "fc18b4f8cf982afd")),
    "bts": (DISC, {"test.stop_strain": 0.003}, ["strip_corrected_strength_Pa", "first_cracks"],
            ("tensile_strength_Pa", 1e6, 6e6), ("a64c69369458f97c", "159ba4057fbb063b")),
    "cut": (BLOCK, {"test.stop_strain": 0.1, "test.platen_speed": '"2 m/s"'},
            ["cutting_force_N", "thrust_N", "largest_cutting_force_N", "specific_energy_J_per_m3"],
            ("specific_energy_J_per_m3", 1e5, 1e8), ("f4ec4019ddc6f17e", "134ec262ecab19a5")),
    "biaxial": (PLANE, {"test.stop_strain": 0.002, "test.confinement": '["1 MPa"]'}, [], ("peak_stress_Pa", 10e6, 100e6), ("d9fa732da2db77d0", "f6fe77622741ed0b")),
}
PORTABLE = os.environ | {"BRECCIA_INSTRUCTION_SET": "x86-64"}


class Programs(ProgramTest):
    def summary_of(self, program, *more):
        case, sets, *_ = PROGRAMS[program]
        path = self.write("case.toml", case)
        words = [word for key, value in sets.items() for word in ("--set", f"{key}={value}")]
        done = run(program, path, "--out", self.work / program, "--force", "--threads", 2, *words, *more, env=PORTABLE)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return json.loads((self.work / program / "summary.json").read_text())

    def check(self, program):
        summary = self.summary_of(program)
        _, _, own, (key, low, high), states = PROGRAMS[program]
        self.assertEqual([summary[name] for name in ("test", "threads", "ranks")], [program, 2, 1])
        (result,) = summary["runs"]
        missing = [name for name in ALWAYS + own if name not in result]
        self.assertEqual(missing, [])
        for name, value in result.items():  # SI: a number with a dimension says which
            if isinstance(value, float) and abs(value) > 1e3:
                self.assertRegex(name, "_(Pa|per_s|s|N|per_m3)$")
        self.assertTrue(low < result[key] < high, f"{key} {result[key]:.4g} is not between {low:.3g} and {high:.3g}")
        self.assertEqual(set(result["phases_s"]) >= {"bonds", "integrate", "platens"}, True)
        (in_doubles,) = self.summary_of(program, "--set", 'run.precision="double"')["runs"]
        self.assertEqual((result["state_hash"], in_doubles["state_hash"]), states,
                         "the physics has changed: say why where the hash is put on record (tests/cli/test_programs.py)")

    def test_every_program_is_here_or_has_a_script(self):
        of_their_own = {"pack", "impact", "layouts", "scaling", "stability", "workprecision"}
        scripts = {path.stem.removeprefix("test_") for path in (SOURCE / "tests" / "cli").glob("test_*.py")}
        self.assertEqual(of_their_own - scripts, {"pack"})  # every script packs
        programs = {path.stem for path in (SOURCE / "drivers").glob("*.cpp")}
        self.assertEqual(programs, set(PROGRAMS) | of_their_own)


for name in PROGRAMS:
    setattr(Programs, f"test_{name}", lambda self, name=name: self.check(name))


class Cases(ProgramTest):
    """Each case of data/cases by the program that its first lines name, with few spheres and to a small strain."""

    def run_case(self, path):
        program = re.findall(r"breccia-(\w+) ", path.read_text())[-1]  # others before it prepare
        if program in ("pack", "impact"):
            text = path.read_text()
            small = re.sub(r"spheres = \d+", "spheres = 300", text)
            if "[spheres]" in text:  # a block of 800 on its way for some milliseconds
                run("pack", SOURCE / "data" / "cases" / "pack-heap.toml", "--out", self.work / "out" / "heap")
                small = re.sub(r"^starts = .*$|^frames = .*$", "", small, flags=re.MULTILINE)
                small = re.sub(r"^duration = .*$", 'duration = "5 ms"', small, flags=re.MULTILINE)
                small = small.replace("out/heap", str(self.work / "out" / "heap"))
            return run(program, self.write(path.name, small), "--out", self.out)
        if program == "workprecision":
            return run("ucs", path, "--dry-run", "--set", "specimen.pack.spheres=300")
        sets = ["--set", "output.frames=0"]
        if "[specimen.pack]" in path.read_text():
            sets += ["--set", "specimen.pack.spheres=300"]
        if program != "hydrostatic":
            sets += ["--set", "test.stop_strain=0.0005"]
        if "unload_at" in path.read_text():
            sets += ["--set", "test.unload_at=[0.0002]"]
        return run(program, path, "--out", self.out, "--threads", 2, *sets)

    def test_there_are_cases(self):
        self.assertGreater(len(CASES), 10)


CASES = sorted((SOURCE / "data" / "cases").glob("*.toml"))


def check_case(self, path):
    done = self.run_case(path)
    self.assertEqual((done.returncode, done.stderr), (0, ""), path.name)


for path in CASES:
    setattr(Cases, "test_" + path.stem.replace("-", "_"), lambda self, path=path: check_case(self, path))


class InstructionSets(ProgramTest):
    def test_one_that_is_not_there_is_refused(self):
        done = run("ucs", self.case, "--dry-run", env=os.environ | {"BRECCIA_INSTRUCTION_SET": "sse9"})
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("sse9", done.stderr)
        self.assertNotIn("terminate", done.stderr)


if __name__ == "__main__":
    main()
