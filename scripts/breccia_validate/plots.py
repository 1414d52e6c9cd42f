"""Pictures of studies, in the look of scripts/plot."""
from breccia_plot import draw_curves, draw_envelope, draw_specimen, read_series
from breccia_plot.style import INK, SHEAR, SOFT, TENSION, plt, save

__all__ = ["INK", "SHEAR", "SOFT", "TENSION", "curves_of", "envelope_of", "new_axes", "plt", "save", "specimen_of"]


def new_axes(title, xlabel, ylabel, width=7, height=4.6):
    """A figure with one pair of axes; `save(figure, path)` writes and closes it."""
    figure, axes = plt.subplots(figsize=(width, height), constrained_layout=True)
    axes.set(title=title, xlabel=xlabel, ylabel=ylabel)
    return figure, axes


def curves_of(result, path):
    """The stress-strain curves that scripts/plot draws; gives the picture's name."""
    draw_curves(read_series(result.folder), path)
    return path.name


def envelope_of(result, path):
    """Mohr circles of the peaks and the line through them; gives the picture's name."""
    draw_envelope(read_series(result.folder), path)
    return path.name


def specimen_of(result, path):
    """The specimen with its cracks, from results.h5; gives the picture's name."""
    draw_specimen(read_series(result.folder), path)
    return path.name
