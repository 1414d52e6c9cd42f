"""Free spheres at the end of a run, seen along y, and what its walls took up."""
import csv
import json
from dataclasses import dataclass

import numpy as np
from matplotlib.collections import EllipseCollection

from .errors import BadInput
from .style import SOFT, new_figure, plt, save

MOST_WALLS = 4
PARTS = ("force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm")


@dataclass
class Scene:
    title: str


def is_impact(folder):
    try:
        return json.loads((folder / "summary.json").read_text()).get("test") == "impact"
    except (OSError, ValueError, AttributeError):
        return False


def draw_grains(folder, path):
    spheres, walls = folder / "spheres.csv", folder / "walls-0.csv"
    for file in (spheres, walls):
        if not file.exists():
            raise BadInput(f"{file} is absent; of a run of breccia-impact its spheres and the loads of its walls are drawn")
    x, y, z, r = read(spheres, ("x_m", "y_m", "z_m", "r_m"))
    loads, time = read_walls(walls)
    figure, _ = new_figure(Scene(f"{x.size} spheres, {time[-1]:.3g} s"), 10, 5)
    grid = figure.add_gridspec(2, 2)
    draw_spheres(figure.add_subplot(grid[:, 0]), x, y, z, r)
    forces = figure.add_subplot(grid[0, 1])
    draw_loads(forces, time, loads, PARTS[:3], "force on the wall (N)")
    torques = figure.add_subplot(grid[1, 1], sharex=forces)
    draw_loads(torques, time, loads, PARTS[3:], "torque on it (N m)")
    torques.set_xlabel("time (s)")
    save(figure, path)
    return f"{path}: {x.size} spheres at the end, loads of {len(loads)} wall{'s' * (len(loads) != 1)}"


def read(path, columns):
    try:
        with path.open(newline="") as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        return np.array([[float(row[name]) for row in rows] for name in columns])
    except (KeyError, ValueError, TypeError) as reason:
        raise BadInput(f"{path} cannot be read: {reason}") from reason


def read_walls(path):
    """{name: {part: values}} of the walls that have names, or all, those loaded most; and the times."""
    with path.open(newline="") as file:
        names = next(csv.reader(file), ["time_s"])
    bodies = list(dict.fromkeys(name.rsplit(" ", 1)[0] for name in names[1:]))
    loads = {body: dict(zip(PARTS, read(path, [f"{body} {part}" for part in PARTS]))) for body in bodies}
    size = {body: sum(np.abs(parts[part]).mean() for part in PARTS[:3]) for body, parts in loads.items()}
    named = [body for body in bodies if not body.startswith("wall-")] or bodies
    chosen = sorted(sorted(named, key=size.get, reverse=True)[:MOST_WALLS], key=bodies.index)
    return {body: loads[body] for body in chosen}, read(path, ["time_s"])[0]


def draw_spheres(axes, x, y, z, r):
    """The nearer ones, at small y, over the others and darker."""
    order = np.argsort(-y)
    near = (y.max() - y) / max(np.ptp(y), 1e-300)
    axes.add_collection(EllipseCollection(2 * r[order], 2 * r[order], np.zeros(r.size), units="xy",
                                          offsets=np.stack([x, z], axis=1)[order], transOffset=axes.transData,
                                          facecolors=plt.get_cmap("YlGnBu")(0.15 + 0.6 * near[order]), edgecolors=SOFT,
                                          linewidths=0.3))
    pad = 2 * r.max()
    axes.set(xlim=(x.min() - pad, x.max() + pad), ylim=(z.min() - pad, z.max() + pad), xlabel="x (m)", ylabel="z (m)",
             title="at the end, seen along y", aspect="equal")


def draw_loads(axes, time, loads, parts, label):
    """Of each wall the component that is largest on average."""
    for body, values in loads.items():
        part = max(parts, key=lambda name: np.abs(values[name]).mean())
        axes.plot(time, values[part], linewidth=1.2, label=f"{body}, {part.split('_')[1]}")
    axes.set_ylabel(label)
    axes.legend(fontsize=8.5)
