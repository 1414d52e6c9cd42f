#!/usr/bin/python3
"""Reads what test_outputs.cpp wrote, with the readers that users have: read_outputs.py WHAT FILE...

Exit code 0: all is as it should be; 1: the first thing that is not is printed; 77: the reader is not installed.
"""
import json
import sys
import xml.etree.ElementTree as xml

PARTICLES = [10, 20, 30, 40, 50]
BONDS = [(10, 20), (20, 30), (20, 40), (30, 50)]
BOND_NUMBERS = [100 * lo + hi for lo, hi in BONDS]


def equal(found, wanted, what):
    if found != wanted:
        sys.exit(f"{what}: found {found}, wanted {wanted}")


def read_json(path):
    summary = json.load(open(path, encoding="utf-8"))
    equal([summary[key] for key in ("test", "version", "threads", "ranks")], ["triaxial", "0.1.0", 2, 1], "head")
    equal(summary["mohr_coulomb"],
          {"cohesion_Pa": 16e6, "friction_angle_deg": 40.5, "residual_Pa": 0.2e6, "peaks": 2}, "mohr_coulomb")
    run = summary["runs"][0]
    equal(run["peak_stress_Pa"], 60.25e6, "peak")
    equal(run["peak_deviator_Pa"], None, "an absent quantity")
    equal(run["energy_error"], None, "a quantity that is not a number")
    equal(run["phases_s"], {"platens": 0.5, "bonds": 7.5}, "phases")
    equal(run["warnings"], ["kinetic ratio 2e-3: dynamic"], "warnings")
    equal([len(run), list(run)[0], list(run)[-1]], [49, "confinement_Pa", "warnings"], "keys")


def read_h5(path):
    import h5py
    with h5py.File(path, "r") as file:
        equal(file.attrs["version"].count("."), 2, "version")
        equal(file.attrs["case"], '[material]\npreset = "concrete"\n' + "#" * 70000, "case")
        equal(sorted(file), ["run-0", "run-1"], "runs")
        run = file["run-0"]
        equal(dict(run.attrs), {"confinement_Pa": 4.5e6, "alpha": 1.25}, "attributes of the run")
        equal(sorted(run), ["bonds", "frame-000", "frame-001", "particles"], "groups of the run")
        equal(sorted(run["particles"]), ["gid", "mass", "radius", "reference_position"], "columns that stay")
        equal(sorted(run["bonds"]), ["area", "damping", "gid_hi", "gid_lo", "rest_length", "stiffness"], "of bonds")
        equal(run["particles/gid"][:].tolist(), PARTICLES, "gid")
        equal(run["particles/radius"][:].tolist(), [0.001 * g for g in PARTICLES], "radius")
        equal(list(zip(run["bonds/gid_lo"][:].tolist(), run["bonds/gid_hi"][:].tolist())), BONDS, "ends")
        equal(run["bonds/rest_length"][:].tolist(), BOND_NUMBERS, "rest_length")
        radius = run["particles/radius"]
        equal(dict(radius.attrs), {"unit": "m", "role": "reference", "meaning": "radius of the sphere"}, "of radius")
        equal(radius.fletcher32, True, "checksum")
        frame = run["frame-001"]
        equal(dict(frame.attrs), {"time_s": 2e-3, "step": 20, "axial_strain": 2e-4}, "attributes of the frame")
        equal(sorted(frame["particles"]), ["position", "spin", "velocity"], "columns that change")
        equal(sorted(frame["bonds"]),
              ["damage_normal", "damage_shear", "plastic_stretch", "shear_x", "shear_y", "shear_z", "state"], "of bonds")
        equal(frame["particles/position"][:].tolist(), [[g + 1e-3 * g, 2 * g, 3 * g] for g in PARTICLES], "position")
        equal(frame["bonds/shear_y"][:].tolist(), [-n for n in BOND_NUMBERS], "shear_y")
        equal(frame["bonds/state"][:].tolist(), [2, 0, 0, 1], "state")
        equal(frame["bonds/state"].dtype.name, "uint8", "type of state")
        equal(sorted(file["run-1/bonds"]), ["area", "gid_hi", "gid_lo", "rest_length", "stiffness"], "lean bonds")
        equal(sorted(file["run-1/frame-000/particles"]), ["position", "velocity"], "lean particles")
        equal(file["run-1/frame-000/bonds/state"][:].tolist(), [0, 0, 0, 0], "lean state")


def frames_of(path):
    import h5py

    def read(_, found):
        if isinstance(found, h5py.Dataset):
            found[()]  # its checksum is tested

    with h5py.File(path, "r") as file:
        file.visititems(read)
        return [name for name in file["run-0"] if name.startswith("frame-")]


def read_frames(*paths_and_counts):
    for path, count in zip(paths_and_counts[::2], paths_and_counts[1::2]):
        equal(frames_of(path), [f"frame-{i:03}" for i in range(int(count))], path)


def read_frames_at_least(*paths_and_counts):
    for path, count in zip(paths_and_counts[::2], paths_and_counts[1::2]):
        equal(frames_of(path)[:int(count)], [f"frame-{i:03}" for i in range(int(count))], path)


def poly_data(path):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    equal(reader.GetErrorCode(), 0, path)
    return reader.GetOutput()


def arrays(data):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def near(found, wanted, what):
    import numpy
    if not numpy.allclose(found, wanted, rtol=1e-6, atol=0):
        sys.exit(f"{what}: found {found}, wanted {wanted}")


def read_vtp(frames):
    particles = poly_data(f"{frames}/run-0/particles-001.vtp")
    equal([particles.GetNumberOfPoints(), particles.GetNumberOfVerts()], [5, 5], "points, vertices")
    near(particles.GetPoint(1), [20.02, 40, 60], "point")
    data = arrays(particles.GetPointData())
    equal(sorted(data), ["displacement", "gid", "held", "mass", "radius", "spin", "velocity"], "point data")
    equal(data["gid"].tolist(), PARTICLES, "gid")
    equal(data["held"].tolist(), [0, 0, 1, 0, 0], "held")
    near(data["displacement"][:, 0], [1e-3 * g for g in PARTICLES], "displacement")
    near(data["velocity"][:, 2], [-g for g in PARTICLES], "velocity")
    near(data["radius"], [1e-3 * g for g in PARTICLES], "radius")

    bonds = poly_data(f"{frames}/run-0/bonds-001.vtp")
    equal([bonds.GetNumberOfPoints(), bonds.GetNumberOfLines()], [5, 4], "points, lines")
    for cell, ends in enumerate(BONDS):
        found = [PARTICLES[bonds.GetCell(cell).GetPointId(end)] for end in (0, 1)]
        equal(tuple(found), ends, "ends of a line")
    data = arrays(bonds.GetCellData())
    equal(sorted(data), ["area", "damage_normal", "damage_shear", "damping", "gid_hi", "gid_lo", "plastic_stretch",
                         "rest_length", "shear_force", "state", "stiffness"], "cell data")
    equal([data["state"].dtype.name, data["state"].tolist()], ["uint8", [2, 0, 0, 1]], "state")
    near(data["rest_length"], BOND_NUMBERS, "rest_length")
    near(data["shear_force"][:, 1], [-n for n in BOND_NUMBERS], "shear_force")
    near(data["damage_normal"], [0, 0, 0.5, 1], "damage_normal")

    sets = xml.parse(f"{frames}/run-0.pvd").getroot().findall("Collection/DataSet")
    equal([(s.get("timestep"), s.get("part"), s.get("file")) for s in sets],
          [("0", "0", "run-0/particles-000.vtp"), ("0", "1", "run-0/bonds-000.vtp"),
           ("0.5", "0", "run-0/particles-001.vtp"), ("0.5", "1", "run-0/bonds-001.vtp")], ".pvd")


def read_no_bonds(folder):
    import h5py
    with h5py.File(f"{folder}/results.h5", "r") as file:
        equal(list(file["run-0/bonds"]), [], "bonds")
        equal(file["run-0/frame-000/bonds/state"].shape, (0,), "state")
    equal(poly_data(f"{folder}/frames/run-0/bonds-000.vtp").GetNumberOfLines(), 0, "lines")
    equal(poly_data(f"{folder}/frames/run-0/particles-000.vtp").GetNumberOfPoints(), 5, "points")


def main():
    what, arguments = sys.argv[1], sys.argv[2:]
    readers = {"json": read_json, "h5": read_h5, "vtp": read_vtp, "no-bonds": read_no_bonds, "frames": read_frames,
               "frames-at-least": read_frames_at_least}
    try:
        readers[what](*arguments)
    except ImportError:
        sys.exit(77)


main()
