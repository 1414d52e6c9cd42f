"""Reads the last frame of a run from results.h5."""
from dataclasses import dataclass

import h5py
import numpy as np

TENSION_STATE, SHEAR_STATE = 1, 2  # column state of the bonds; 0 is intact


@dataclass
class Spheres:
    radius: np.ndarray
    reference: np.ndarray  # centres when the bonds were made


@dataclass
class Frame:
    radius: np.ndarray
    reference: np.ndarray  # centres when the bonds were made
    position: np.ndarray
    strain: float
    crack_ends: np.ndarray  # rows (lo, hi) of each broken bond
    crack_radius: np.ndarray  # of the bond's cross-section
    crack_state: np.ndarray

    def count(self, state):
        return int(np.count_nonzero(self.crack_state == state))


def frames_of(run):
    names = [name for name in run if name.startswith("frame-") and name[6:].isdigit()]
    return sorted(names, key=lambda name: int(name[6:]))


def runs_with_frames(path):
    with h5py.File(path, "r") as file:
        runs = [name for name in file if name.startswith("run-") and name[4:].isdigit() and frames_of(file[name])]
    return sorted(int(name[4:]) for name in runs)


def sizes(path, k):
    """Number of spheres and bonds of a run."""
    with h5py.File(path, "r") as file:
        return file[f"run-{k}/particles/gid"].size, file[f"run-{k}/bonds/gid_lo"].size


def spheres(path, k):
    with h5py.File(path, "r") as file:
        particles = file[f"run-{k}/particles"]
        return Spheres(particles["radius"][:], particles["reference_position"][:])


def last_frame(path, k):
    """The newest frame of run k that is whole (a run that was killed may leave a part of one); None without any."""
    with h5py.File(path, "r") as file:
        run = file[f"run-{k}"]
        for name in reversed(frames_of(run)):
            try:
                return read_frame(run, run[name])
            except (KeyError, OSError):
                continue
    return None


def read_frame(run, frame):
    particles, bonds = run["particles"], run["bonds"]
    state = frame["bonds/state"][:]
    broken = np.flatnonzero(state)
    gid = particles["gid"][:]
    ends = np.stack([np.searchsorted(gid, bonds[end][:][broken]) for end in ("gid_lo", "gid_hi")], axis=1)
    # in two dimensions the area has a depth, which is not to be seen
    crack_radius = np.minimum(np.sqrt(bonds["area"][:][broken] / np.pi), 0.6 * bonds["rest_length"][:][broken])
    return Frame(particles["radius"][:], particles["reference_position"][:], frame["particles/position"][:],
                 float(frame.attrs.get("axial_strain", np.nan)), ends, crack_radius, state[broken])
