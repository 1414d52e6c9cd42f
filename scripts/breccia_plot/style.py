"""One look for all pictures: legible at a width of 1000 px, safe for the colour-blind, below 300 kB."""
import io

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib import patheffects  # noqa: E402
from PIL import Image  # noqa: E402

from .errors import FileTrouble  # noqa: E402
from .owned import claim  # noqa: E402

MOST_BYTES = 300_000
INK, SOFT = "#222222", "#6b6b6b"
# Okabe and Ito's palette
TENSION, SHEAR = "#D55E00", "#0072B2"
WORK, STORED, DISSIPATED, KINETIC = INK, "#009E73", "#E69F00", "#CC79A7"
HALO = [patheffects.withStroke(linewidth=3, foreground="white")]

plt.rcParams.update({
    "figure.dpi": 160, "font.family": "DejaVu Sans", "font.size": 10.5, "axes.titlesize": 11, "axes.labelsize": 10.5,
    "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": SOFT,
    "axes.labelcolor": INK, "axes.linewidth": 0.8, "axes.grid": True, "axes.axisbelow": True, "grid.color": "#e6e6e6",
    "grid.linewidth": 0.7, "xtick.color": SOFT, "ytick.color": SOFT, "xtick.labelcolor": INK, "ytick.labelcolor": INK,
    "text.color": INK, "lines.linewidth": 1.8, "lines.solid_capstyle": "round", "legend.frameon": False,
})


def new_figure(series, width, height, **grid):
    """A figure `width` x `height` inches with the title of the series at the top left."""
    figure = plt.figure(figsize=(width, height), constrained_layout=True)
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)
    figure.suptitle(series.title, x=0.012, ha="left", fontsize=13, fontweight="bold")
    return figure, figure.subplots(squeeze=False, **grid) if grid else None


def megapascal(stress):
    return f"{stress / 1e6:.3g} MPa"


def condition(series, pressure):
    """What tells one run of a series from another: its confinement, or the normal stress of a shear test."""
    if series.test == "shear":
        return f"{megapascal(pressure)} normal stress"
    return f"{megapascal(pressure)} confined" if round(pressure) else "unconfined"


def run_styles(runs):
    """Colour and dash of each run: one colour per confinement, dark to light as it rises; repeats of it are dashed."""
    levels = sorted({round(run.confinement, -3) for run in runs})
    shades = matplotlib.colormaps["plasma"](np.linspace(0.0, 0.68, len(levels)) if len(levels) > 1 else [0.1])
    seen, styles = {}, {}
    for run in runs:
        level = levels.index(round(run.confinement, -3))
        styles[run.index] = {"color": shades[level], "linestyle": ("-", "--", ":", "-.")[seen.get(level, 0) % 4]}
        seen[level] = seen.get(level, 0) + 1
    return styles


def choose(runs, most=4):
    """At most `most` of the runs: the first, the last, and evenly between."""
    return [runs[i] for i in np.unique(np.linspace(0, len(runs) - 1, most).round().astype(int))]


def place_labels(axes, labels):
    """Writes each (text, colour, candidates) where it covers least of the curves and of the labels before it.

    A candidate is (x, y, right, up, ha, va): a point in data, an offset from it in points, and the alignment there;
    the earlier one wins a tie. Call when the limits of the axes are final."""
    figure = axes.figure
    figure.canvas.draw()  # the layout fixes the transforms
    window, curves, taken = axes.get_window_extent(), curve_pixels(axes), []
    for text, colour, candidates in labels:
        label = axes.annotate(text, (0, 0), xytext=(0, 0), textcoords="offset points", color=colour, fontsize=9.5,
                              fontweight="bold", path_effects=HALO, annotation_clip=False)
        label.set_in_layout(False)
        size = label.get_window_extent()
        best = None
        for rank, (x, y, right, up, ha, va) in enumerate(candidates):
            corner = axes.transData.transform((x, y)) + np.array([right, up]) * figure.dpi / 72
            corner -= [size.width * {"left": 0, "center": 0.5, "right": 1}[ha],
                       size.height * {"bottom": 0, "center": 0.5, "top": 1}[va]]
            low, high = corner, corner + [size.width, size.height]
            covered = np.count_nonzero(((curves > low - 2) & (curves < high + 2)).all(axis=1))
            clash = sum((low < other_high).all() and (high > other_low).all() for other_low, other_high in taken)
            outside = (low < window.min - 2).any() or (high > window.max + 2).any()
            cost = covered + 1e4 * (clash + outside) + rank
            if best is None or cost < best[0]:
                best = cost, (low, high), candidates[rank]
        x, y, right, up, ha, va = best[2]
        label.xy = x, y
        label.set_position((right, up))
        label.set(ha=ha, va=va)
        taken.append(best[1])


def curve_pixels(axes, step=3):
    """Points a few pixels apart along every curve of the axes."""
    points = [np.empty((0, 2))]
    for line in axes.get_lines():
        corners = line.get_transform().transform(line.get_xydata())
        corners = corners[np.isfinite(corners).all(axis=1)]
        if len(corners):
            along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
            every = np.arange(0, along[-1] + step, step)
            points.append(np.stack([np.interp(every, along, corners[:, i]) for i in (0, 1)], axis=1))
    return np.concatenate(points)


def beside(x, y, gap=7):
    """Candidates around a point."""
    return [(x, y, gap, 0, "left", "center"), (x, y, 0, gap, "center", "bottom"), (x, y, -gap, gap, "right", "bottom"),
            (x, y, gap, gap, "left", "bottom"), (x, y, 0, -gap, "center", "top"), (x, y, -gap, -gap, "right", "top"),
            (x, y, gap, -gap, "left", "top"), (x, y, -gap, 0, "right", "center"), (x, y, 0, 3 * gap, "center", "bottom"),
            (x, y, 0, -3 * gap, "center", "top")]


def save(figure, path):
    """Writes the PNG, with fewer colours, then fewer dots, where it would be too large."""
    try:
        png = smallest_loss(figure)
        path.parent.mkdir(parents=True, exist_ok=True)
        claim(path)
        path.write_bytes(png)
    except OSError as reason:
        raise FileTrouble(f"{path} cannot be written: {reason.strerror or reason}") from reason
    finally:
        plt.close(figure)


def smallest_loss(figure):
    for dpi in (160, 130, 110, 90, 70):
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=dpi, facecolor="white", metadata={"Software": "breccia"})
        if buffer.tell() < MOST_BYTES:
            break
        picture = Image.open(buffer).convert("RGB")
        for colours in (112, 48, 24):
            buffer = fewer_colours(picture, colours)
            if buffer.tell() < MOST_BYTES:
                return buffer.getvalue()
    return buffer.getvalue()


def fewer_colours(picture, colours):
    """PNG of `colours` colours of the picture and 16 true greys: without these, text and grid take on a tint."""
    own = np.reshape(picture.quantize(colours, method=Image.Quantize.MEDIANCUT).getpalette()[:3 * colours], (-1, 3))
    own = own[np.ptp(own, axis=1) > 16]  # an almost white one would be taken for white
    palette = Image.new("P", (1, 1))
    palette.putpalette([level for grey in range(0, 256, 17) for level in 3 * [grey]] + own.ravel().tolist())
    buffer = io.BytesIO()
    picture.quantize(palette=palette, dither=Image.Dither.NONE).save(buffer, format="png", optimize=True)
    return buffer
