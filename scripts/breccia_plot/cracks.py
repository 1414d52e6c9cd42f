"""The record of broken bonds: where, when and how they broke, and what it would have sounded like."""
import csv
import re
from dataclasses import dataclass

import h5py
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from . import results
from .body import Body, View
from .errors import BadInput, FileTrouble
from .events import events_of, gutenberg_richter
from .owned import claim
from .specimen import outline
from .style import DISSIPATED, HALO, INK, SHEAR, SOFT, STORED, TENSION, condition, new_figure, plt, save

BOND_LENGTHS = 2  # mean bond lengths that cracks of one event may be apart
CRACKS, ENERGY = STORED, DISSIPATED  # colours
CHAINED = 0.2  # share of the cracks in one event from which on the picture says so: too fast a test to tell events apart
MOST_DRAWN = 1500  # cracks in the picture of the specimen; of more, a slab is drawn
LOADING = View(np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.array([0, -1.0, 0]))  # x to the right, z up


@dataclass
class Record:
    """One row per broken bond, in the order of time."""
    time: np.ndarray  # s
    strain: np.ndarray  # axial
    position: np.ndarray  # middle of the bond, m
    normal: np.ndarray  # unit vector along the bond
    shear: np.ndarray  # True: broke in shear, False: in tension
    area: np.ndarray  # m^2
    energy: np.ndarray  # released, J


def draw_cracks(series, out):
    """Draws cracks-K.png and writes events-K.csv for each run with a record of cracks; yields the lines to report."""
    for k in runs_with_cracks(series.folder / "results.h5"):
        record, length, spheres = read_record(series.folder / "results.h5", k)
        window = time_window(series.case.get("material", {}), BOND_LENGTHS * length, record)
        events = events_of(record, BOND_LENGTHS * length, window)
        law = gutenberg_richter(events.magnitude)
        write_events(events, out / f"events-{k}.csv")
        draw_record(series, k, record, length, spheres, events, law, window, out / f"cracks-{k}.png")
        b = f", b = {law.b:.2f} ± {law.error:.2f}" if law else ""
        yield f"{out / f'cracks-{k}.png'}: {counted(record.time.size, 'crack')} in {counted(events.cracks.size, 'event')}{b}"


def runs_with_cracks(path):
    if not path.exists():
        return []
    try:
        with h5py.File(path, "r") as file:
            runs = sorted(int(name[4:]) for name in file if re.fullmatch(r"run-\d+", name))
        return [k for k in runs if has_rows(path.parent / f"cracks-{k}.csv")]
    except OSError:
        return []  # damaged: the picture of the specimen says so


def has_rows(path):
    if not path.exists():
        return False
    with path.open() as file:
        return sum(1 for _, line in zip(range(2), file)) == 2


def read_record(path, k):
    """The record in the order of time, from cracks-K.csv; the mean length of a bond (m) and the spheres, from results.h5
    beside it."""
    record = path.parent / f"cracks-{k}.csv"
    try:
        table = np.atleast_1d(np.genfromtxt(record, delimiter=",", names=True))
        table = table[np.argsort(table["time_s"], kind="stable")]
        time, strain, mode = table["time_s"], table["axial_strain"], table["mode"]
        position = np.stack([table[name] for name in ("x_m", "y_m", "z_m")], axis=1)
        normal = np.stack([table[name] for name in ("nx", "ny", "nz")], axis=1)
        area, energy = table["area_m2"], table["energy_J"]
    except (OSError, KeyError, IndexError, ValueError) as reason:
        raise BadInput(f"{record}: cannot be read: {' '.join(str(reason).split())}") from reason
    try:
        with h5py.File(path, "r") as file:
            length = float(file[f"run-{k}"]["bonds/rest_length"][:].mean())
        spheres = results.spheres(path, k)
    except (OSError, KeyError, IndexError) as reason:
        raise BadInput(f"{path}: run-{k} cannot be read: {reason}") from reason
    if not (np.isfinite(time).all() and np.isfinite(position).all()):
        raise BadInput(f"{record}: times or positions that are not numbers")
    return Record(time, strain, position, normal, mode == results.SHEAR_STATE, area, energy), length, spheres


def time_window(material, distance, record):
    """s: what a shear wave takes over the distance. A crack that broke later cannot be of the same rupture, which is no
    faster (after Hazzard and Young 2000, 2004). Without the material's data: 1/200 of the record's duration."""
    stiffness, density = in_si(material.get("young_modulus")), in_si(material.get("density"))
    poisson = in_si(material.get("poisson_ratio"))
    if stiffness and density and poisson is not None:
        return distance / np.sqrt(stiffness / (2 * (1 + poisson) * density))
    return np.ptp(record.time) / 200


def in_si(value):
    """A quantity as case.toml writes it, "28 GPa" or 0.2; None where its unit is another."""
    factors = {"Pa": 1, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "kg/m^3": 1, "g/cm^3": 1e3, "": 1}
    match = re.fullmatch(r"\s*([-+.\deE]+)\s*(\S*)\s*", str(value))
    try:
        return float(match[1]) * factors[match[2]]
    except (TypeError, ValueError, KeyError):
        return None


def write_events(events, path):
    head = ["event", "start_time_s", "duration_s", "axial_strain", "cracks", "cracks_shear", "x_m", "y_m", "z_m", "energy_J",
            "magnitude"]
    rows = zip(range(events.cracks.size), events.start, events.duration, events.strain, events.cracks, events.shear,
               *events.centre.T, events.energy, events.magnitude)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        claim(path)
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(head)
            for row in rows:
                writer.writerow(["" if x != x else f"{x:.9g}" if isinstance(x, float) else int(x) for x in row])
    except OSError as reason:
        raise FileTrouble(f"{path} cannot be written: {reason.strerror or reason}") from reason


def draw_record(series, k, record, length, spheres, events, law, window, path):
    run = next((run for run in series.runs if run.index == k and run.curve), None)
    figure, _ = new_figure(series, 10, 8.6)
    if len(series.runs) > 1 and run:
        figure.suptitle(f"{series.title}, {condition(series, run.confinement)}", x=0.012, ha="left", fontsize=13,
                        fontweight="bold")
    grid = figure.add_gridspec(2, 2, height_ratios=[1.12, 1])
    body = Body.of(series.shape, spheres)
    draw_places(figure.add_subplot(grid[0, 0]), body, record, length)
    draw_rose(figure.add_subplot(grid[0, 1], projection="polar"), record, body.shape == "plane")
    draw_history(figure.add_subplot(grid[1, 0]), series, run, record)
    draw_magnitudes(figure.add_subplot(grid[1, 1]), events, law)
    figure.supxlabel(f"One event: cracks not more than {1000 * BOND_LENGTHS * length:.3g} mm ({BOND_LENGTHS} mean bond lengths) "
                     f"and {amount(window, 's')} apart. Energy magnitude: log₁₀ E = 1.5 M + 4.8, E in J.", fontsize=9.5,
                     color=SOFT)
    save(figure, path)


def draw_places(axes, body, record, length):
    """Cracks as short lines along their planes, seen along y, by the strain at which they broke."""
    depth = np.abs(record.position[:, 1])
    slab = np.sort(depth)[min(MOST_DRAWN, depth.size) - 1]
    shown = depth <= slab
    flat = LOADING.flat(record.normal[shown])
    across = np.linalg.norm(flat, axis=1, keepdims=True)
    half = np.minimum(np.sqrt(record.area[shown] / np.pi), 0.6 * length)[:, None]
    # a disc seen aslant is an ellipse: its long axis is drawn, along the trace of the plane
    trace = np.where(across > 1e-9, np.stack([-flat[:, 1], flat[:, 0]], axis=1) / np.maximum(across, 1e-9), [1.0, 0.0]) * half
    middle = LOADING.flat(record.position[shown])
    strain = 100 * record.strain[shown]
    low, high = (np.nanmin(strain), np.nanmax(strain)) if np.isfinite(strain).any() else (0, 1)
    colours = Normalize(low, max(high, low + 1e-9))
    lines = LineCollection(np.stack([middle - trace, middle + trace], axis=1), array=strain, norm=colours,
                           cmap=plt.get_cmap("viridis_r", 8), linewidths=1.0)  # few colours: a small file
    axes.add_collection(lines)
    outline(axes, body, LOADING)
    reach = 1.03 * body.half[[0, 2]]
    axes.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]), aspect="equal")
    axes.set_axis_off()
    part = counted(record.time.size, "crack")
    if slab < depth.max():
        part = f"{np.count_nonzero(shown):,} of {part}: |y| < {1000 * slab:.2g} mm"
    axes.figure.colorbar(lines, ax=axes, label="strain when they broke (%)", fraction=0.05, pad=0.02)
    axes.set_title(part, loc="center")


def plane_angle(normal):
    """Degrees from the loading axis z to the plane of the crack: 0 splits along the load, 90 lies across it."""
    return np.degrees(np.arcsin(np.clip(np.abs(normal[:, 2]) / np.linalg.norm(normal, axis=1), 0, 1)))


def rose(normal, edges):
    """Cracks in each range of plane_angle, with those in planes of any direction alike: in space the part of a
    hemisphere between the two angles, d(sin angle); in the x-z plane all angles alike."""
    normal = normal[np.linalg.norm(normal, axis=1) > 0]
    count = np.histogram(plane_angle(normal), edges)[0]
    return count, normal.shape[0] * np.diff(np.sin(np.radians(edges)))


def draw_rose(axes, record, plane):
    """Tension to the right of the loading axis, shear to the left, each in per cent of its own number."""
    edges = np.arange(0, 91, 10)
    middle, top = np.radians(edges[:-1] + 5), 0.0
    fine = np.radians(np.linspace(0, 90, 91))
    for rows, side, name, colour in ((~record.shear, 1, "tension", TENSION), (record.shear, -1, "shear", SHEAR)):
        n = np.count_nonzero(rows)
        if not n:
            continue
        share = 100 * rose(record.normal[rows], edges)[0] / n
        axes.bar(side * middle, share, width=np.radians(10), color=colour, alpha=0.85, edgecolor="white", linewidth=0.8,
                 label=f"{n:,} in {name}")
        top = max(top, share.max())
    # the density of the random directions, times the width of a bin
    random = np.full(fine.size, 100 / 9) if plane else 100 * np.radians(10) * np.cos(fine)
    axes.plot(np.concatenate([-fine[::-1], fine]), np.concatenate([random[::-1], random]), color=INK, linewidth=1.1,
              label="random directions")
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_thetamin(-90)
    axes.set_thetamax(90)
    axes.set_thetagrids(np.arange(-90, 91, 30), [f"{abs(angle)}°" for angle in range(-90, 91, 30)])
    axes.set_ylim(0, 1.08 * max(top, random.max()))
    axes.set_yticks([tick for tick in plt.MaxNLocator(4, steps=[1, 2, 5, 10]).tick_values(0, max(top, random.max()))[1:]
                     if tick < 1.08 * max(top, random.max())])
    axes.yaxis.set_major_formatter("{x:g} %")
    axes.tick_params(axis="y", labelsize=9)
    axes.set_rlabel_position(90)
    axes.set_title("Crack planes: angle to the load (0° splits along it)", loc="center", pad=-12)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.14), ncol=3, fontsize=9.5, handlelength=1.0, columnspacing=1.0,
                handletextpad=0.5)


def draw_history(axes, series, run, record):
    """Stress, and how far cracks and energy have come, over strain; over time where the strain went back and forth."""
    over_time = run is not None and goes_back(run.curve["axial_strain"])
    if over_time:
        time_s = run.curve.get("time_s", np.arange(run.curve["axial_strain"].size))
        scale, name = (1000, "ms") if time_s.max() < 1 else (1, "s")
        at, cracks_at, name = scale * time_s, scale * record.time, f"time ({name})"
    else:
        at = 100 * run.curve["axial_strain"] if run else None
        cracks_at, name = 100 * strain_of_cracks(run, record), f"{series.strain_name} (%)"
    stress = []
    if run:
        stress = axes.plot(at, run.curve["stress_Pa"] / 1e6, color=SOFT, linewidth=1.6, label="stress")
        axes.set_ylim(min(0, 1.08 * np.nanmin(run.curve["stress_Pa"]) / 1e6), 1.08 * np.nanmax(run.curve["stress_Pa"]) / 1e6 or 1)
    axes.set_ylabel("stress (MPa)")
    axes.set_xlabel(name)
    axes.set_xlim(left=min(0, axes.get_xlim()[0]) if axes.get_xlim()[0] < -0.05 * axes.get_xlim()[1] else 0)
    part = axes.twinx()
    part.spines["right"].set_visible(True)
    part.grid(False)
    total = record.energy.sum()
    part.plot(cracks_at, 100 * np.arange(1, record.time.size + 1) / record.time.size, color=CRACKS,
              label=counted(record.time.size, "crack"))
    if total > 0:
        part.plot(cracks_at, 100 * np.cumsum(record.energy) / total, color=ENERGY, linestyle=(0, (5, 1.5)),
                  label=f"{amount(total, 'J')} released")
    part.set_ylim(0, 104)
    part.set_ylabel("cracks, energy so far (%)")
    part.legend(handles=[*stress, *part.get_lines()], loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncol=3, fontsize=9.5,
                handlelength=1.6, columnspacing=1.2, borderaxespad=0.2)


def strain_of_cracks(run, record):
    """As recorded; by the curve where that is the platens' strain, or where none was recorded."""
    if run and (run.platen_strain or not np.isfinite(record.strain).all()) and "time_s" in run.curve:
        whole = np.isfinite(run.curve["axial_strain"])
        return np.interp(record.time, run.curve["time_s"][whole], run.curve["axial_strain"][whole])
    return record.strain


def goes_back(strain):
    """True where a strain falls by more than 2 % of its range: unloading."""
    strain = strain[np.isfinite(strain)]
    sign = np.sign(strain[-1] - strain[0]) or 1
    return bool((np.maximum.accumulate(sign * strain) - sign * strain).max() > 0.02 * np.ptp(strain))


def counted(n, name):
    return f"{n:,} {name}{'s' * (n != 1)}"


def amount(value, unit):
    """With a prefix that leaves a number above one."""
    scales = ((1e-3, "k"), (1, ""), (1e3, "m"))
    return next((f"{value * scale:.3g} {prefix}{unit}" for scale, prefix in scales if value * scale >= 1),
                f"{1e6 * value:.3g} µ{unit}")


def draw_magnitudes(axes, events, law):
    """How many events are as large as M or larger, and the line of Gutenberg and Richter."""
    magnitude = np.sort(events.magnitude[np.isfinite(events.magnitude)])
    axes.set_title(f"{counted(events.cracks.size, 'event')} by magnitude")
    axes.set_xlabel("energy magnitude M (–)")
    axes.set_ylabel("events of M or more (–)")
    if not magnitude.size:
        axes.text(0.5, 0.5, "no energy was released", transform=axes.transAxes, ha="center", color=SOFT)
        return
    axes.plot(magnitude, np.arange(magnitude.size, 0, -1), "o", markersize=3, markerfacecolor="none", markeredgecolor=SHEAR,
              markeredgewidth=0.8)
    axes.set_yscale("log")
    axes.set_ylim(0.7, 2 * magnitude.size)
    if law:
        span = np.array([law.completeness, law.completeness + np.log10(law.events) / law.b])
        axes.plot(span, law.events * 10 ** (-law.b * (span - law.completeness)), color=INK, linewidth=1.5)
        text = f"b = {law.b:.2f} ± {law.error:.2f}\n{law.events:,} events from M = {law.completeness:.1f}".replace("-", "−")
    else:
        text = "too few events for b"
    largest = np.nanargmax(events.magnitude)
    share = events.cracks[largest] / events.cracks.sum()
    if share > CHAINED:
        text += f"\nlargest: {100 * share:.0f} % of the cracks"
    axes.text(0.03, 0.04, text, transform=axes.transAxes, va="bottom", path_effects=HALO)
