"""What the studies leave: a JSON file with runs, machine and whatever each of them adds."""
import json

from .errors import BadInput


def read_study(path, what, needed, title_of, parts=()):
    """Content of the file and the title of its picture.

    what: the study, for messages. needed: names that every run must have. title_of(content, machine): text, where
    machine is "CPU, N cores". parts: what the file must hold beside runs and machine. Raises BadInput where the file is missing or damaged.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        cpu, cores = content["machine"]["cpu"], content["machine"]["cores"]
        title = title_of(content, f"{cpu}, {cores} core{'s' * (cores > 1)}")
        runs, _ = content["runs"], [content[part] for part in parts]
        missing = sorted({name for run in runs for name in needed - run.keys()})
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as reason:
        raise BadInput(f"{path} cannot be read as a {what} study: {reason}") from reason
    if not runs:
        raise BadInput(f"{path} holds no run")
    if missing:
        raise BadInput(f"{path} was not written by breccia: a run lacks {missing[0]}")
    return content, title
