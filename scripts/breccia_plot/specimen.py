"""The cracked specimen: a cut through the axis with the cracks on it, and all cracks seen inside the outline."""
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D

from . import results
from .body import Body, face_on
from .errors import CannotDraw
from .style import INK, SHEAR, SOFT, TENSION, choose, condition, new_figure, save

MODES = ((results.TENSION_STATE, "tension", TENSION), (results.SHEAR_STATE, "shear", SHEAR))
COLOUR_OF_STATE = np.array([(1, 1, 1), to_rgb(TENSION), to_rgb(SHEAR)])


def draw_specimen(series, path):
    frames = read_frames(series)
    body = Body.of(series.shape, frames[0][1])
    factor = magnification(body, [frame for _, frame in frames])
    views = [face_on(body, frame.reference[frame.crack_ends].mean(axis=1)) for _, frame in frames]
    reach = np.max([extent(body, view, frame, factor) for view, (_, frame) in zip(views, frames)], axis=0)
    figure, pairs, stacked = panels(series, len(frames), reach)
    confinements = {run.index: run.confinement for run in series.runs}
    for (cut, inside), view, (k, frame) in zip(pairs, views, frames):
        draw_cut(cut, body, view, frame, factor)
        draw_inside(inside, body, aslant(view), frame, factor)
        heading = [condition(series, confinements[k])] if len(series.runs) > 1 and k in confinements else []
        heading += [f"{series.strain_name} {100 * frame.strain:.2g} %"] if np.isfinite(frame.strain) else []
        cut.set_title("\n".join(heading) if stacked else ", ".join(heading), fontsize=10.5, loc="center")
        legend(inside, frame, 1 if stacked else 2)
    scale_bar(pairs[0][0], body, reach)
    what = {"disc": "at mid-thickness", "plane": "of the plane"}.get(body.shape, "through the axis")
    size = "to scale" if factor == 1 else f"magnified {factor:,} times"
    figure.text(0.5, 0.12 / figure.get_figheight(), f"{'Above' if stacked else 'Left'}: cut {what}; "
                f"{'below' if stacked else 'right'}: all broken bonds, as crack faces. Displacements {size}.",
                ha="center", fontsize=9.5, color=SOFT)
    save(figure, path)
    return f"{path}: broken bonds of {len(frames)} run{'s' * (len(frames) > 1)}"


def panels(series, n, reach):
    """Figure and (cut, view) axes of n runs: pairs in one row while there is room, else cuts above views; all panels
    have the shape of `reach` and the same scale."""
    stacked = n > 2
    rows, columns = (2, n) if stacked else (1, 2 * n)
    top, bottom, gap = 0.75 + 0.2 * stacked, 0.75 + 0.2 * stacked, 0.15
    shape = reach[1] / reach[0]
    # no wider than 10 inches, no panel taller than looks well; no narrower than the title
    wide = min((10 - gap) / columns - gap, (4.4 if stacked else 5.8) / shape)
    width, height = max(8.0, gap + columns * (wide + gap)), rows * wide * shape + (rows - 1) * 2 * gap + top + bottom
    figure, _ = new_figure(series, width, height)
    figure.set_layout_engine("none")  # panels of one scale: placed by hand
    pitch = (width - gap) / columns
    axes = np.empty((rows, columns), dtype=object)
    for row in range(rows):
        for column in range(columns):
            left = gap + column * pitch + (pitch - gap - wide) / 2
            low = bottom + (rows - 1 - row) * (wide * shape + 2 * gap)
            panel = figure.add_axes((left / width, low / height, wide / width, wide * shape / height))
            panel.set(xlim=(-reach[0], reach[0]), ylim=(-reach[1], reach[1]))
            panel.set_axis_off()
            axes[row, column] = panel
    return figure, axes.T if stacked else axes.reshape(n, 2), stacked


def aslant(view):
    return view.turned(24, 15)


def read_frames(series):
    """(run, last frame) of up to four runs."""
    file = series.folder / "results.h5"
    if not file.exists():
        raise CannotDraw("results.h5 is absent")
    try:
        frames = [(k, results.last_frame(file, k)) for k in choose(results.runs_with_frames(file))]
        frames = [(k, frame) for k, frame in frames if frame is not None]
        if frames and not series.spheres:
            series.spheres, series.bonds = results.sizes(file, frames[0][0])
    except (OSError, KeyError) as reason:
        raise CannotDraw(f"results.h5 cannot be read: {reason}") from reason
    if not frames:
        raise CannotDraw("results.h5 has no frame")
    return frames


def magnification(body, frames):
    """1, or a round number that makes displacements of less than 0.5 % of the height show."""
    largest = max(np.percentile(np.linalg.norm(frame.position - frame.reference, axis=1), 99) for frame in frames)
    size = 2 * max(body.half)
    if largest == 0 or largest > 0.005 * size:
        return 1
    wanted = 0.02 * size / largest
    decade = 10 ** np.floor(np.log10(wanted))
    return int(max(m for m in (1, 2, 5) if m * decade <= wanted) * decade)


def moved(frame, factor):
    return frame.reference + factor * (frame.position - frame.reference)


def extent(body, view, frame, factor):
    """Half width and half height that hold the outline in both views, and the spheres but for a few that flew off."""
    spheres = np.percentile(np.abs(view.flat(moved(frame, factor))), 99.8, axis=0) + np.median(frame.radius)
    lines = [np.abs(look.flat(line)).max(axis=0) for look in (view, aslant(view)) for line, _ in body.edges(look.toward)]
    return 1.02 * np.max([spheres, *lines], axis=0)


def draw_cut(axes, body, view, frame, factor):
    """Spheres as the plane of the cut meets them before the test, at the places where they are now."""
    depth = frame.reference @ view.toward
    met = np.abs(depth) < frame.radius
    size = 2 * np.sqrt(frame.radius[met] ** 2 - depth[met] ** 2)
    place = moved(frame, factor)
    axes.add_collection(EllipseCollection(size, size, np.zeros(size.size), units="xy", offsets=view.flat(place[met]),
                                          transOffset=axes.transData, facecolors="#d9d9d9", edgecolors="#a6a6a6", linewidths=0.3))
    centres = place[frame.crack_ends].mean(axis=1)
    near = np.abs(frame.reference[frame.crack_ends].mean(axis=1) @ view.toward) < np.mean(frame.radius)
    # a crack face is square to its bond: its trace on the cut is square to the bond's picture
    bond = view.flat(np.diff(place[frame.crack_ends], axis=1)[:, 0])
    length = np.linalg.norm(bond, axis=1)
    near &= length > 0
    trace = np.stack([-bond[near, 1], bond[near, 0]], axis=1) * (frame.crack_radius[near] / length[near])[:, None]
    middle = view.flat(centres[near])
    axes.add_collection(LineCollection(np.stack([middle - trace, middle + trace], axis=1), linewidths=1.3,
                                       colors=COLOUR_OF_STATE[frame.crack_state[near]]))
    outline(axes, body, view)


def draw_inside(axes, body, view, frame, factor, corners=10):
    """Crack faces as discs, paler the farther they are from the eye."""
    outline(axes, body, view)
    if not frame.crack_state.size:
        return
    place = moved(frame, factor)[frame.crack_ends]
    centres, normal = place.mean(axis=1), np.diff(place, axis=1)[:, 0]
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal), axis=1)])
    first /= np.maximum(np.linalg.norm(first, axis=1), 1e-300)[:, None]
    second = np.cross(normal, first)
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)[:, None]
    turn = np.cos(angle) * first[:, None] + np.sin(angle) * second[:, None]
    faces = view.flat(centres[:, None] + frame.crack_radius[:, None, None] * turn)

    depth = centres @ view.toward
    far = np.clip((depth.max() - depth) / max(np.ptp(depth), 1e-300), 0, 1)[:, None]
    shade = 0.70 + 0.30 * np.abs(normal @ view.toward)[:, None]
    # few tints and hard edges: thousands of overlapping discs make a small file then
    far, shade = np.round(5 * far) / 5, np.round(10 * shade) / 10
    colour = 1 - (1 - COLOUR_OF_STATE[frame.crack_state] * shade) * (1 - 0.65 * far)
    order = np.argsort(depth)
    axes.add_collection(PolyCollection(faces[order], facecolors=colour[order], linewidths=0, antialiaseds=False))


def outline(axes, body, view):
    for line, in_sight in body.edges(view.toward):
        axes.plot(*view.flat(line).T, color=SOFT, linewidth=0.9 if in_sight else 0.7, linestyle="-" if in_sight else (0, (4, 3)),
                  zorder=3 if in_sight else 0)


def legend(axes, frame, columns):
    marks = [Line2D([], [], marker="o", linestyle="", color=colour, label=f"{frame.count(state):,} in {name}")
             for state, name, colour in MODES]
    axes.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=columns, fontsize=9.5, handletextpad=0.0,
                columnspacing=0.8, borderaxespad=0.1)


def scale_bar(axes, body, reach):
    decade = 10 ** np.floor(np.log10(body.half[0]))
    length = max(m * decade for m in (1, 2, 5) if m * decade <= body.half[0])
    y = -reach[1]
    axes.plot([-length / 2, length / 2], [y, y], color=INK, linewidth=2.5, clip_on=False, solid_capstyle="butt")
    axes.annotate(f"{1000 * length:g} mm", (0, y), xytext=(0, -5), textcoords="offset points", ha="center", va="top", fontsize=9.5)
