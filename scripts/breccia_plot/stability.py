"""What became of each scene of the stability study: a map of verdicts, scenes down, fractions of the limit across."""
from matplotlib.patches import Rectangle

from .style import DISSIPATED, INK, TENSION, new_figure, save
from .study import read_study

NEEDED = {"scene", "stresses", "part", "fraction", "verdict", "energy_error", "drift", "peak_stress_Pa", "peak_change", "steps"}
# verdict: colour, mark. Marks and lightness tell them apart too, so that no colour has to
LOOKS = {"stable": ("#cfe8dc", ""), "blew up": (DISSIPATED, "✕"), "stopped": ("#8fc1e3", "■"), "refused": ("#d9d9d9", "–"),
         "unnoticed": (TENSION, "!!")}
MEANINGS = {"stable": "stable", "blew up": "blew up: guard after so many steps", "stopped": "stopped, its cause named",
            "refused": "refused", "unnoticed": "peak wrong, not noticed"}
PARTS = {"network": "network without loss:\nlargest energy error", "damped": "network with\ncontact damping",
         "law": "whole law, loaded:\npeak, and its change"}


class Stability:
    """What breccia-stability left in a folder."""

    def __init__(self, folder):
        content, self.title = read_study(
            folder / "stability.json", "stability", NEEDED,
            lambda study, machine: f"Stability: step over the largest stable one, {study['test']['material']}")
        self.runs = content["runs"]
        self.scenes = list(dict.fromkeys((run["scene"], run["stresses"]) for run in self.runs))

    def fractions(self, part):
        return sorted({run["fraction"] for run in self.runs if run["part"] == part and run["fraction"] > 0})


def text_in(run, first):
    """What a field says. first: the smallest fraction of its part, whose peak the others are held against."""
    mark = LOOKS.get(run["verdict"], ("", "?"))[1]
    if run["verdict"] in ("blew up", "stopped"):
        return f"{mark} {short_count(run['steps'])}"
    if run["verdict"] == "refused":
        return mark
    if run["part"] == "law" and run["peak_change"] is not None:
        percent = 100 * run["peak_change"]
        if run["fraction"] == first:
            return f"{run['peak_stress_Pa'] / 1e6:.2g} MPa" if run["peak_stress_Pa"] < 1e7 else f"{run['peak_stress_Pa'] / 1e6:.0f} MPa"
        if run["verdict"] == "unnoticed":
            return f"{mark} {percent:+.0f} %"
        return f"{percent:+.0f} %" if abs(percent) >= 9.95 else f"{percent:+.1f} %".replace("-0.0", "0.0").replace("+0.0", "0.0")
    return short(run["energy_error"] if run["energy_error"] is not None else run["drift"])


def short_count(steps):
    return str(steps) if steps < 10_000 else f"{steps / 1e3:.0f}k"


def short(value):
    """2.3e-09 as 2e-9; nothing where there is no number."""
    if value is None:
        return ""
    mantissa, exponent = f"{value:.0e}".split("e")
    return "0" if value == 0 else f"{mantissa}e{int(exponent)}"


def draw_stability(folder, path):
    study = Stability(folder)
    parts = [part for part in PARTS if any(run["part"] == part for run in study.runs)]
    widths = [max(1, len(study.fractions(part))) for part in parts]
    figure, axes = new_figure(study, 5.0 + 0.66 * sum(widths), 1.9 + 0.34 * len(study.scenes), ncols=len(parts), sharey=True,
                              width_ratios=widths)
    for panel, part in zip(axes[0], parts):
        draw_part(panel, study, part)
    axes[0][0].set_yticks(range(len(study.scenes)), [stresses for _, stresses in study.scenes], fontsize=9.5)
    axes[0][0].set_ylim(len(study.scenes) - 0.5, -0.5)
    seen = [verdict for verdict in LOOKS if any(run["verdict"] == verdict for run in study.runs)]
    handles = [Rectangle((0, 0), 1, 1, facecolor=LOOKS[verdict][0], edgecolor="white") for verdict in seen]
    labels = [f"{LOOKS[verdict][1]}  {MEANINGS[verdict]}".strip() for verdict in seen]
    key = 0.5 / figure.get_figheight()  # of the height, for a line below the map
    figure.get_layout_engine().set(rect=(0, key, 1, 1 - key))
    figure.legend(handles, labels, loc="lower left", ncols=len(seen), fontsize=9.5)
    save(figure, path)
    return f"{path}: {len(study.scenes)} scene{'s' * (len(study.scenes) > 1)}, {len(study.runs)} runs"


def draw_part(axes, study, part):
    fractions = study.fractions(part) or [0]
    names = [scene for scene, _ in study.scenes]
    for run in study.runs:
        if run["part"] != part:
            continue
        refused = run["fraction"] == 0  # never begun: one field over the whole row
        left, width = (0, len(fractions)) if refused else (fractions.index(run["fraction"]), 1)
        row = names.index(run["scene"])
        axes.add_patch(Rectangle((left - 0.5, row - 0.5), width, 1, facecolor=LOOKS.get(run["verdict"], ("white", ""))[0],
                                 edgecolor="white", linewidth=1.5))
        axes.text(left + 0.5 * (width - 1), row, text_in(run, fractions[0]), ha="center", va="center", fontsize=8.5, color=INK)
    limit = sum(fraction < 1 for fraction in fractions) - 0.5
    if 0 < limit < len(fractions) - 0.5:
        axes.axvline(limit, color=INK, linewidth=1.6)
    axes.set_xlim(-0.5, len(fractions) - 0.5)
    axes.set_xticks(range(len(fractions)), [f"{fraction:g}" if fraction else "" for fraction in fractions])
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.grid(visible=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    axes.set_title(PARTS[part], fontsize=10)
