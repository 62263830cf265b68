"""DataFrames that the program reads as files, and its messages on these files."""
from __future__ import annotations

import csv
import difflib
import re
from pathlib import Path
from typing import Any, Iterable, Mapping, Optional

import numpy as np

from .faults import FrictabError


def pandas_module() -> Any:
    """pandas, which fits and results need, and reading tables does not."""
    try:
        import pandas
    except ImportError:
        raise FrictabError("this needs pandas: pip install pandas (Debian: python3-pandas)"
                           ) from None
    return pandas


def is_frame(given: Any) -> bool:
    return hasattr(given, "to_csv") and hasattr(given, "columns")


def plain_frame(given: Any, argument: str) -> Any:
    """With named levels of the index as columns. Its index stays known."""
    if not is_frame(given):
        raise FrictabError(f"{argument} is a {type(given).__name__}; it is a pandas.DataFrame")
    names = [n for n in given.index.names if n is not None and n not in given.columns]
    frame = given.reset_index(names) if names else given
    wrong = [c for c in frame.columns if not isinstance(c, str)]
    if wrong:
        raise FrictabError(f"{argument} has a column {wrong[0]!r}; names of columns are texts: "
                           f"{argument}.rename(columns=str)")
    twice = frame.columns[frame.columns.duplicated()]
    if len(twice):
        raise FrictabError(f"{argument} has two columns '{twice[0]}'")
    if not len(frame):
        raise FrictabError(f"{argument} has no rows")
    return frame


def write_frame(frame: Any, file: Path) -> None:
    """Numbers as the shortest text that is read back to the same bits."""
    frame.to_csv(file, index=False, encoding="utf-8", lineterminator="\n")


def read_frame(file: Path) -> Any:
    """A CSV of the program: names of tests are texts, numbers have all their bits."""
    return pandas_module().read_csv(file, dtype={"experiment": str, "outside": str},
                                    float_precision="round_trip")


def near(name: str, names: Iterable[Any]) -> str:
    """The end of a message on a name that is not among `names`."""
    known = [str(n) for n in names]
    found = difflib.get_close_matches(name, known, 1, 0.6)
    if found:
        return f"; did you mean '{found[0]}'?"
    return f" (there are {', '.join(known[:12])}{', ...' if len(known) > 12 else ''})"


def as_arguments(text: str) -> str:
    """A message of the program with arguments of Campaign instead of keys of the job file."""
    for pattern, words in (
            (r"(\w+) = \{ column = \"([^\"]*)\", unit = \"([^\"]*)\", \.\.\. \}",
             r'columns={"\1": ("\2", "\3")}'),
            (r"\bdata\.(\w+) = ", r"\1="), (r"\[data\.(\w+)\]", r"\1"),
            (r"`unit` where it is mapped", "its unit in columns"),
            (r"unit = (\"\w+\") where it is mapped", r"\1 as its unit in columns"),
            (r"\bthe file has\b", "the frame has"), (r"^--set \d+: ", "")):
        text = re.sub(pattern, words, text, flags=re.M)
    return text


def in_rows(text: str, folder: Path, frames: Mapping[str, Any]) -> str:
    """A message of the program with rows and columns instead of lines of the files that
    `frames`, by argument, were written to: folder/ARGUMENT.csv."""
    names = "|".join(map(re.escape, frames))
    text = re.sub(r"^\S+ begins so:\n(?: +\d+ \|.*\n)*", "", text, flags=re.M) # the caller has them
    return re.sub(rf"(?:{re.escape(str(folder))}/)?\b({names})\.csv(?::(\d+))?(?::(\d+))?",
                  lambda m: _place(folder / f"{m[1]}.csv", m[1], frames[m[1]], m[2], m[3]), text)


def _place(file: Path, argument: str, frame: Any, line: Optional[str], at: Optional[str]) -> str:
    with open(file, encoding="utf-8", newline="") as all_lines:
        lines = all_lines.read().split("\n")
    whole = len(lines) == len(frame) + 2 # else a cell has lines of its own
    if line is None or not 2 <= int(line) <= len(frame) + 1 or not whole:
        return argument
    place = f"{argument}, row {frame.index[int(line) - 2]}"
    if at is not None:
        before = lines[int(line) - 1].encode()[:int(at) - 1].decode(errors="replace")
        cells = next(csv.reader([before]), [""])
        place += f", column '{frame.columns[len(cells) - 1]}'"
    return place


def order_by_test(frame: Any, tests: Any) -> Any:
    """Positions of a frame's rows in the order in which the program gives them back, test by test.
    `tests`: the name of the test of each row, as it gave them."""
    wanted = _runs(tests)
    if len(wanted) == 1:
        return np.arange(len(frame))
    for column in frame.columns:
        rows = frame.groupby(column, sort=False).indices
        own = {spelled(name): rows[name] for name in rows}
        found = [own.get(spelled(name), ()) for name, _ in wanted]
        if len(rows) == len(wanted) and [len(f) for f in found] == [n for _, n in wanted]:
            return np.concatenate(found)
    raise FrictabError("data has no column that names the tests as the campaign has them")


def _runs(tests: Any) -> list[tuple[str, int]]:
    found: list[tuple[str, int]] = []
    for test in tests:
        if found and found[-1][0] == test:
            found[-1] = test, found[-1][1] + 1
        else:
            found.append((test, 1))
    return found


def spelled(name: Any) -> str:
    """The name of a test; a number in one way, as files write 1.0 also as 1."""
    try:
        return repr(float(name))
    except ValueError:
        return str(name)
