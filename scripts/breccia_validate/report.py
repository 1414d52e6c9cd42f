"""Makes studies and writes the pages. What a study found is kept in data/validation/results, so that a page can be made
anew while only some of its studies were run."""
import dataclasses
import json
import re
import sys

from .runner import SOURCE, SPECIMENS
from .study import Row

FOLDER = SOURCE / "data" / "validation"
RESULTS = FOLDER / "results"


def make(study, runner):
    """Runs the cases of the study and stores its outcome; skips it, by name, without its meshes."""
    absent = [mesh for mesh in study.meshes if not (SPECIMENS / mesh).exists()]
    if absent:
        print(f"skipped {study.name}: {SPECIMENS / absent[0]} is not there", file=sys.stderr)
        return
    results = {case.name: runner.run(study, case) for case in study.cases}
    outcome = study.evaluate(results, FOLDER)
    RESULTS.mkdir(parents=True, exist_ok=True)
    stored = {"study": study.name, "rows": [dataclasses.asdict(complete(row)) for row in outcome.rows],
              "text": re.sub(r"\n{3,}", "\n\n", outcome.text.strip()), "pictures": outcome.pictures}
    (RESULTS / f"{study.name}.json").write_text(json.dumps(stored, indent=2) + "\n")
    for row in outcome.rows:
        print(f"{study.name}: {row.quantity}: {number(row.breccia)}{', ' + verdict(row.met) if row.target else ''}", flush=True)


def complete(row):
    if row.error is None and all(isinstance(value, (int, float)) for value in (row.breccia, row.experiment)) and row.experiment:
        row.error = row.breccia / row.experiment - 1
    for name in ("breccia", "experiment", "paper", "error", "run_time"):  # numpy's numbers are not JSON's
        value = getattr(row, name)
        if value is not None and not isinstance(value, str):
            setattr(row, name, float(value))
    row.met = None if row.met is None else bool(row.met)
    return row


def stored(study):
    path = RESULTS / f"{study.name}.json"
    if not path.exists():
        return None
    outcome = json.loads(path.read_text())
    outcome["rows"] = [Row(**row) for row in outcome["rows"]]
    return outcome


def write_pages(pages):
    """All pages and the summary, from what is stored; a page none of whose studies was ever made is left out."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    summary = []
    for page in pages:
        found = [(study, outcome) for study in page.studies if (outcome := stored(study))]
        if not found:
            continue
        parts = [f"# {page.title}\n\n{page.intro.strip()}\n"]
        for study, outcome in found:
            parts.append(section(study, outcome))
            summary += [(page, study, row) for row in outcome["rows"] if row.target]
        if page.closing:
            parts.append(page.closing.strip() + "\n")
        (FOLDER / f"{page.name}.md").write_text("\n".join(parts))
    (FOLDER / "README.md").write_text(overview(pages, summary))


def section(study, outcome):
    lines = [f"## {study.title}\n"]
    commands = commands_of(study.cases)
    lines.append(f"`scripts/validate {study.name}`" + (" runs\n" if commands else "\n"))
    lines += [f"- {command}" for command in commands] + ([""] if commands else [])
    lines += ["| quantity | experiment | paper | breccia | error | run time, s | target | |",
              "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for row in outcome["rows"]:
        cells = [row.quantity, number(row.experiment), number(row.paper), number(row.breccia), percent(row.error),
                 "" if row.run_time is None else f"{row.run_time:.0f}", row.target, verdict(row.met) if row.target else ""]
        lines.append("| " + " | ".join(cells) + " |")
    if outcome["text"]:
        lines += ["", outcome["text"]]
    lines += [""] + [f"![{name}]({name})" for name in outcome["pictures"]] + ([""] if outcome["pictures"] else [])
    return "\n".join(lines)


def commands_of(cases, most=8):
    """One line a run; of a study of many runs one line a case file."""
    if len(cases) <= most:
        return [f"`breccia-{case.program} data/validation/cases/{case.file}" + (" --dry-run" if case.dry else "")
                + "".join(f" --set '{setting}'" for setting in case.set) + "`" for case in cases]
    lines = {}
    for case in cases:
        command = f"`breccia-{case.program} data/validation/cases/{case.file}{' --dry-run' if case.dry else ''}`"
        lines.setdefault(command, []).append({setting.split("=")[0] for setting in case.set})
    return [f"{command}, {len(keys)} times" + (f", with other values of {', '.join(f'`{key}`' for key in sorted(set().union(*keys)))}"
                                               if any(keys) else "") for command, keys in lines.items()]


def overview(pages, summary):
    met = sum(bool(row.met) for _, _, row in summary)
    lines = ["# Validation", "",
             "breccia against laboratory tests, the results that its sources print, and closed forms. Nothing is fitted to reach a",
             "target but the area factor `alpha`, and that by an elastic probe before the test; what misses its target says so, and",
             "why as far as that is known. `scripts/validate` makes all of it anew, `scripts/validate STUDY` one study,",
             "`scripts/validate --list` names them. Run times are of one thread of a shared machine with other work on it.", "",
             "Meshes of the paper and its companions are not part of breccia: their studies run where they lie in a folder",
             "`shared/specimens` beside the source folder. All other specimens are packed by the cases.", "",
             f"{met} of {len(summary)} targets are met.", "",
             "| study | quantity | target | breccia | | run time, s |", "| --- | --- | --- | --- | --- | --- |"]
    for page, study, row in summary:
        lines.append(f"| [{study.title}]({page.name}.md) | {row.quantity} | {row.target} | {number(row.breccia)} | {verdict(row.met)} | "
                     + ("" if row.run_time is None else f"{row.run_time:.0f}") + " |")
    lines += ["", "Pages:", ""] + [f"- [{page.title}]({page.name}.md)" for page in pages if (FOLDER / f"{page.name}.md").exists()]
    lines += ["- [Impacts of Chung and Ooi](chung-ooi.md), made by `scripts/validate-impact`"] if (FOLDER / "chung-ooi.md").exists() else []
    return "\n".join(lines) + "\n"


def number(value):
    if value is None:
        return ""
    return value if isinstance(value, str) else f"{value:.3g}" if abs(value) < 1000 else f"{value:,.0f}"


def percent(error):
    return "" if error is None else f"{100 * error:+.1f} %"


def verdict(met):
    return {True: "met", False: "**missed**", None: ""}[met]
