"""Pictures of a run folder; each function takes the series and a path, and returns the line to report."""
from .cracks import draw_cracks
from .curves import draw_curves
from .energy import draw_energy
from .envelope import draw_envelope
from .errors import BadInput, CannotDraw, FileTrouble
from .grains import draw_grains, is_impact
from .layouts import draw_layouts
from .scaling import draw_scaling
from .series import read_series
from .specimen import draw_specimen
from .stability import draw_stability
from .workprecision import draw_workprecision

PICTURES = {
    "curves.png": draw_curves,
    "envelope.png": draw_envelope,
    "specimen.png": draw_specimen,
    "energy.png": draw_energy,
}
STUDIES = {"scaling": draw_scaling, "layouts": draw_layouts, "stability": draw_stability,
           "workprecision": draw_workprecision}
