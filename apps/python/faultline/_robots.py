# SPDX-License-Identifier: MIT
"""A model for each of several robots."""
import contextlib
import os
from collections.abc import Mapping as MappingType
from typing import Any, Dict, Hashable, Iterable, Iterator, List, Mapping, Optional

from ._arguments import PathLike, Progress, labels_for, path_of, text_of
from ._by_robot import Frames, RobotFiles, check_clock, file_of, split
from ._log import Log, logs_of
from ._model import Labels, Learned, learn
from .errors import Error, InputError, OutputError, UsageError

FEWEST_ROWS = 50
"""Of a robot, over all of its runs: with fewer `learn` has nothing to learn from."""
LONGEST_NAME = 200
"""Bytes of a file's name, so that those of the case base and of unfinished files beside it fit into 255."""


def _paths_of(names: Iterable[Any], output: Optional[PathLike]) -> Dict[Any, Optional[str]]:
    """The file of each robot's model, None for one in memory."""
    folder = path_of(output)
    paths: Dict[Any, Optional[str]] = {}
    for name in names:
        text = str(name)
        path = os.path.join(folder, f"{text}.model")
        unusable = not text.isprintable() or text != text.strip() or not text or text.startswith(".")
        if output is None:
            paths[name] = None
        elif unusable or set(text) & {"/", "\\"} or len(os.fsencode(text)) > LONGEST_NAME:
            raise InputError(
                f"robot {text!r}",
                "cannot be the name of a file; rename it in the table, to letters, digits, - and _, or leave "
                "out `output` and save each model under a name of your own",
            )
        elif path in paths.values():
            raise InputError(f"robot {text}", "is the id of two robots, as text and as a number; convert one")
        else:
            paths[name] = path
    return paths


def _checked(
    frame: Frames, by: Hashable, run: Optional[Hashable], robot: RobotFiles
) -> Dict[Any, List[Log]]:
    """The logs of each robot, of which each has a robot file and enough rows."""
    found = split(frame, by, run)
    for name, runs in found.items():
        rows = sum(each.rows for each in runs)
        if rows < FEWEST_ROWS:
            raise InputError(
                f"robot {name}",
                f"has {rows} rows in all of its runs, too few to learn from: add healthy runs of it in which "
                "every joint moves, three of half a minute or more, or leave its rows out",
            )
        for each in runs:
            check_clock(name, each.log, file_of(robot, name), run)
    return {name: [each.log for each in runs] for name, runs in found.items()}


def _given(logs: Any, run: Optional[Hashable]) -> Dict[Any, List[Log]]:
    """Logs that are by robot already."""
    if not isinstance(logs, MappingType) or run is not None:
        raise UsageError("by", "names the column of the robots' ids; without it give a dict of logs by robot")
    found = {name: logs_of(of_it) for name, of_it in logs.items()}
    for name, of_it in found.items():
        if not of_it:
            raise InputError(f"robot {name}", "has no log; add healthy runs of it, or leave it out")
    if not found:
        raise UsageError("learn_robots", "was given no robot")
    return found


def _labels_by_robot(labels: Labels, logs: Mapping[Any, List[Log]]) -> Dict[Any, Labels]:
    if not isinstance(labels, MappingType):
        return {name: labels for name in logs}
    labels_for(labels, [log for of_it in logs.values() for log in of_it])  # refuses those of no log
    own = {name: {os.path.basename(log.name) for log in of_it} for name, of_it in logs.items()}
    return {
        name: {key: label for key, label in labels.items() if os.path.basename(text_of(key)) in own[name]}
        for name in logs
    }


def _progress_of(progress: Progress, name: Any, before: int, robots: int) -> Progress:
    if progress is None:
        return None
    return lambda what, share: progress(f"{name}: {what}", (before + share) / robots)


@contextlib.contextmanager
def _folder(output: Optional[PathLike]) -> Iterator[None]:
    """Makes the folder, and removes it if it was made and an error leaves it empty."""
    path = path_of(output)
    is_new = bool(path) and not os.path.exists(path)
    try:
        if path:
            os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise OutputError(path, f"is no folder and cannot be made one ({error.strerror})") from None
    try:
        yield
    except BaseException:
        if is_new and not os.listdir(path):
            os.rmdir(path)
        raise


def learn_robots(
    logs: Any,
    robot: RobotFiles,
    *,
    by: Optional[Hashable] = None,
    run: Optional[Hashable] = None,
    output: Optional[PathLike] = None,
    labels: Labels = None,
    runs_per_label: int = 3,
    alarms_per_hour: float = 0.01,
    keep_all: bool = False,
    force: bool = False,
    seed: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> Dict[Any, Learned]:
    """Learns a model of each robot, by its id: what `learn` gives for the logs of that robot alone. `logs` is
    a table with the rows of all robots, which the columns `by` and `run` separate as in logs_by_robot; or,
    without `by`, a dict of logs by robot. `robot` is a robot file for all, or a dict of them by id. With
    `output`, a folder that is made, the models are written there as ID.model, each whole and as soon as it is
    learned. All tables are checked before the first robot is learned. An error in learning names its robot;
    the models of the robots before it stay. The other options are those of `learn`."""
    found = _given(logs, run) if by is None else _checked(logs, by, run, robot)
    files = {name: file_of(robot, name) for name in found}
    paths = _paths_of(found, output)
    labels_of = _labels_by_robot(labels, found)
    models: Dict[Any, Learned] = {}
    with _folder(output):
        for before, (name, of_it) in enumerate(found.items()):
            try:
                models[name] = learn(
                    of_it,
                    files[name],
                    output=paths[name],
                    labels=labels_of[name],
                    runs_per_label=runs_per_label,
                    alarms_per_hour=alarms_per_hour,
                    keep_all=keep_all,
                    force=force,
                    seed=seed,
                    threads=threads,
                    progress=_progress_of(progress, name, before, len(found)),
                )
            except Error as error:
                raise type(error)(f"robot {name}, {error.where}", error.message) from error
    return models
