"""Groups cracks into events, as acoustic emission is recorded, and gives their magnitudes and the b-value."""
from dataclasses import dataclass
from itertools import product

import numpy as np

PAIRS_AT_ONCE = 2_000_000  # bounds the memory, whatever the number of cracks


@dataclass
class Events:
    """One row per event, in the order of their first cracks."""
    cracks: np.ndarray  # how many
    shear: np.ndarray  # how many of them broke in shear
    start: np.ndarray  # s
    duration: np.ndarray  # s, from the first crack to the last
    strain: np.ndarray  # axial, at the first crack
    centre: np.ndarray  # m, mean of the cracks' middles
    energy: np.ndarray  # J, released by all of them
    magnitude: np.ndarray  # NaN where no energy was released


@dataclass
class GutenbergRichter:
    """log10 N(>= M) = log10(events) - b (M - completeness)."""
    b: float
    error: float  # standard error of b
    completeness: float  # smallest magnitude used
    events: int  # from there on


def events_of(record, distance, window):
    """Events of a record of cracks: the cracks that a chain of steps, each no longer than `distance` (m) and
    `window` (s), connects. Hazzard and Young (2000) take cracks close in space and time as one event in this way."""
    label = linked(record.position, record.time, distance, window)
    n = label.max(initial=-1) + 1
    cracks = np.bincount(label, minlength=n)
    first = np.unique(label, return_index=True)[1]
    last = np.full(n, -np.inf)
    np.maximum.at(last, label, record.time)
    centre = np.stack([np.bincount(label, x, n) for x in record.position.T], axis=1) / cracks[:, None]
    energy = np.bincount(label, record.energy, n)
    return Events(cracks, np.bincount(label, record.shear, n).astype(int), record.time[first], last - record.time[first],
                  record.strain[first], centre, energy, magnitude_of(energy))


def magnitude_of(energy):
    """Energy magnitude: log10 E = 1.5 M + 4.8, E in J (Gutenberg and Richter 1956), with the energy that the broken bonds
    release, as Caulk (2020) does for acoustic emission of bonded particles. The share that would leave as waves
    is not known; a constant share moves every magnitude by the same amount and leaves b as it is."""
    energy = np.asarray(energy, dtype=float)
    return np.where(energy > 0, (np.log10(np.where(energy > 0, energy, 1)) - 4.8) / 1.5, np.nan)


def gutenberg_richter(magnitude, width=0.2, fewest=20):
    """b by maximum likelihood, log10(e) / (mean M - M_c), standard error b / sqrt(N) (Aki 1965). M_c, from which on the
    record follows the line, is the lower edge of the fullest of the bins `width` wide (Wiemer and Wyss 2000,
    maximum curvature). None where fewer than `fewest` events are left."""
    magnitude = magnitude[np.isfinite(magnitude)]
    if magnitude.size < fewest:
        return None
    place = np.floor(magnitude / width + 1e-9).astype(int)
    completeness = (np.argmax(np.bincount(place - place.min())) + place.min()) * width
    used = magnitude[magnitude >= completeness - 1e-9 * width]
    excess = used.mean() - completeness
    if used.size < fewest or excess <= 0:
        return None
    b = np.log10(np.e) / excess
    return GutenbergRichter(b, b / np.sqrt(used.size), completeness, used.size)


def linked(position, time, distance, window):
    """Label of each crack's event, 0, 1, ... in the order of the first cracks; the cracks must be in the order of time.

    Cells as wide as `distance`; within a cell the cracks stay in the order of time, so that those of a neighbouring
    cell which are close in time are one run of rows. Only half of the neighbours are visited: each pair comes once."""
    n = len(time)
    root = np.arange(n)
    if n < 2:
        return root
    cell = np.floor((position - position.min(axis=0)) / distance).astype(np.int64) + 1
    stride = np.cumprod([1, *(cell.max(axis=0)[:2] + 2)])
    code = cell @ stride
    cells, dense = np.unique(code, return_inverse=True)
    key = dense * (n + 1) + np.arange(n)
    rows = np.argsort(key)
    key, place = key[rows], np.empty(n, dtype=np.int64)
    place[rows] = np.arange(n)
    earliest, latest = np.searchsorted(time, time - window, "left"), np.searchsorted(time, time + window, "right")
    for offset in list(product((-1, 0, 1), repeat=3))[13:]:
        wanted = code + np.dot(offset, stride)
        other = np.minimum(np.searchsorted(cells, wanted), cells.size - 1)
        begin = np.searchsorted(key, other * (n + 1) + earliest) if any(offset) else place + 1
        count = np.searchsorted(key, other * (n + 1) + latest) - begin
        count[cells[other] != wanted] = 0
        root = join_close(root, position, rows, begin, count, distance)
    # the smallest row of each event is its root, and rows are in the order of time
    return np.unique(root, return_inverse=True)[1]


def join_close(root, position, rows, begin, count, distance):
    """Joins each crack i with those of rows[begin[i] : begin[i] + count[i]] that are not farther than `distance`."""
    total = np.concatenate([[0], np.cumsum(count)])
    low = 0
    while low < count.size:
        high = max(low + 1, int(np.searchsorted(total, total[low] + PAIRS_AT_ONCE, "right")) - 1)
        a = np.repeat(np.arange(low, high), count[low:high])
        b = rows[np.arange(a.size) - np.repeat(total[low:high] - total[low] - begin[low:high], count[low:high])]
        apart = root[a] != root[b]
        a, b = a[apart], b[apart]
        close = ((position[a] - position[b]) ** 2).sum(axis=1) <= distance**2
        root = join(root, a[close], b[close])
        low = high
    return root


def join(root, a, b):
    """Union of the sets of each pair: the larger root goes below the smaller, so no circle can close."""
    while True:
        a, b = root[a], root[b]
        apart = a != b
        if not apart.any():
            return root
        a, b = a[apart], b[apart]
        root[np.maximum(a, b)] = np.minimum(a, b)
        while (root[root] != root).any():
            root = root[root]
