# SPDX-License-Identifier: MIT
"""The case base of a model: read and revised.

Each function takes `model` (a Model, or the path of one) or `cases`, the file of the case base.
"""
import json
from typing import Any, Dict, List, Optional, Union

from . import _faultline
from ._arguments import PathLike, path_of
from ._diagnosis import Diagnosis
from ._model import Model, files_of
from ._record import Record

__all__ = ["Case", "add", "confirm", "delete", "export", "import_", "list", "reject", "show"]

ModelLike = Union[Model, PathLike, None]


class Case(Record):
    """A case; attributes are the members of its JSON: id, label (kind, joint), outcome, what_was_done ...
    `note` reports an unexpected effect, or ""."""

    id: int


def _act(action: str, model: ModelLike, cases: Optional[PathLike], **given: Any) -> Any:
    arguments: Dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    if cases is not None:
        arguments["cases"] = path_of(cases)
    if isinstance(model, Model):
        path, own_cases = files_of(model, cases, f"cases.{action}")
        arguments.update({"cases": own_cases} if own_cases else {"model": path})
    elif model is not None:
        arguments["model"] = path_of(model)
    text, _, note = _faultline.cases(action, arguments)
    return json.loads(text), note


def _case(answer: Any) -> Case:
    return Case({**answer[0], "note": answer[1]})


def list(
    model: ModelLike = None,
    *,
    cases: Optional[PathLike] = None,
    fault: Optional[str] = None,
    joint: Optional[int] = None,
    outcome: Optional[str] = None,
    origin: Optional[str] = None,
    by: Optional[str] = None,
    robot: Optional[str] = None,
) -> List[Case]:
    """The cases; if a fault, joint, outcome, origin, person or robot is named, only those of it."""
    found, _ = _act(
        "list", model, cases, fault=fault, joint=joint, outcome=outcome, origin=origin, by=by, robot=robot
    )
    return [Case(case) for case in found]


def show(id: int, model: ModelLike = None, *, cases: Optional[PathLike] = None) -> Case:
    """One case in full."""
    return _case(_act("show", model, cases, id=id))


def add(
    diagnosis: Union[Diagnosis, PathLike, None] = None,
    model: ModelLike = None,
    *,
    cases: Optional[PathLike] = None,
    fault_id: int = 1,
    fault: Optional[str] = None,
    joint: Optional[int] = None,
    done: Optional[str] = None,
    by: Optional[str] = None,
    date: Optional[str] = None,
    robot: Optional[str] = None,
) -> Case:
    """Adds a diagnosed fault (of a Diagnosis, or of a JSON report) as a case; with `fault`, the actual
    fault, it is confirmed. An event that is already a case is not added again; new statements about it are
    kept."""
    text = diagnosis.to_json() if isinstance(diagnosis, Diagnosis) else None
    report = None if diagnosis is None or isinstance(diagnosis, Diagnosis) else path_of(diagnosis)
    return _case(
        _act(
            "add",
            model,
            cases,
            diagnosis=report,
            diagnosis_text=text,
            fault_id=fault_id,
            fault=fault,
            joint=joint,
            done=done,
            by=by,
            date=date,
            robot=robot,
        )
    )


def confirm(
    id: int,
    model: ModelLike = None,
    *,
    cases: Optional[PathLike] = None,
    fault: Optional[str] = None,
    joint: Optional[int] = None,
    done: Optional[str] = None,
    by: Optional[str] = None,
    date: Optional[str] = None,
) -> Case:
    """Confirms that the decision of a case was right, or corrects it to `fault`."""
    return _case(_act("confirm", model, cases, id=id, fault=fault, joint=joint, done=done, by=by, date=date))


def reject(
    id: int,
    model: ModelLike = None,
    *,
    cases: Optional[PathLike] = None,
    fault: Optional[str] = None,
    joint: Optional[int] = None,
    done: Optional[str] = None,
    by: Optional[str] = None,
    date: Optional[str] = None,
) -> Case:
    """Records that the decision of a case was wrong, with `fault` as the actual one."""
    return _case(_act("reject", model, cases, id=id, fault=fault, joint=joint, done=done, by=by, date=date))


def delete(id: int, model: ModelLike = None, *, cases: Optional[PathLike] = None) -> Case:
    """Removes a case for good; returns it."""
    return _case(_act("delete", model, cases, id=id))


def export(
    path: PathLike, model: ModelLike = None, *, cases: Optional[PathLike] = None, confirmed: bool = False
) -> None:
    """Writes all cases, or those that people confirmed, as JSON without loss."""
    _act("export", model, cases, file=path_of(path), confirmed=confirmed)


def import_(
    path: PathLike,
    model: ModelLike = None,
    *,
    cases: Optional[PathLike] = None,
    replace: bool = False,
    merge: bool = False,
) -> Record:
    """Makes a case base from an export, or merges it into one: read, added, updated."""
    found, _ = _act("import", model, cases, file=path_of(path), replace=replace, merge=merge)
    return Record(found)
