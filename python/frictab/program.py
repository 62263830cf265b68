"""The installed program: where it is, and how it is run."""
from __future__ import annotations

import os
import shutil
import signal
import subprocess
import tempfile
import threading
import weakref
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Sequence, TextIO, Union

from .faults import FrictabError

PathLike = Union[str, "os.PathLike[str]"]
_HERE = Path(__file__).resolve().parent


class Scratch:
    """A temporary folder, which goes with this object, or when the process ends."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="frictab_"))
        self.remove = weakref.finalize(self, shutil.rmtree, self.path, True)


@dataclass(frozen=True)
class Outcome:
    """Exit code, stdout and stderr of one call."""
    code: int
    out: str
    err: str


def find_program() -> str:
    """FRICTAB, else `frictab` of PATH, else one that lies with this package: in it, installed
    under the same prefix, or built in its source tree. Raises FrictabError with what was looked
    at."""
    named = os.environ.get("FRICTAB")
    if named:
        found = shutil.which(named)
        if not found:
            raise FrictabError(f"FRICTAB is '{named}', which is not a program that can be run")
        return os.path.abspath(found)
    above = list(_HERE.parents)
    places = [_HERE / "bin", *(p / "bin" for p in above[3:4]),
              *(p / "build" / "release" for p in above[1:2])]
    for candidate in ("frictab", *(str(place / "frictab") for place in places)):
        found = shutil.which(candidate)
        if found:
            return os.path.abspath(found)
    raise FrictabError("the program frictab was not found: neither in FRICTAB, nor on PATH, nor "
                       f"in {', '.join(map(str, places))}. Install it, or set FRICTAB to its "
                       "path: os.environ['FRICTAB'] = '/path/to/frictab'")


def run(arguments: Sequence[PathLike], directory: Optional[PathLike] = None,
        program: Optional[str] = None, echo: Optional[TextIO] = None) -> Outcome:
    """Runs the program in a directory and waits; an interruption of this process ends it too.
    Lines of its stderr are also written to `echo` as they come."""
    command = [program or find_program(), *(os.fspath(a) for a in arguments)]
    try:
        child = subprocess.Popen(command, cwd=directory, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 encoding="utf-8", errors="replace")
    except OSError as fault:
        raise FrictabError(f"{command[0]} cannot be run: {fault.strerror}") from None
    heard: list[str] = []
    listener = threading.Thread(target=_listen, args=(child.stderr, heard, echo))
    listener.start()
    try:
        assert child.stdout
        out = child.stdout.read()
        child.wait()
    except BaseException:
        _end(child)
        raise
    finally:
        listener.join()
        for pipe in (child.stdout, child.stderr):
            if pipe:
                pipe.close()
    return Outcome(child.returncode, out, "".join(heard))


def _listen(pipe: TextIO, heard: list[str], echo: Optional[TextIO]) -> None:
    for line in pipe:
        heard.append(line)
        if echo:
            echo.write(line)
            echo.flush()


def _end(child: subprocess.Popen[str]) -> None:
    child.send_signal(signal.SIGINT) # it removes what is half written
    try:
        child.wait(5)
    except subprocess.TimeoutExpired:
        child.kill()
        child.wait()


def answer(arguments: Sequence[PathLike], directory: Optional[PathLike] = None) -> str:
    """stdout of a call that has to succeed. Raises FrictabError with what the program says."""
    outcome = run(arguments, directory)
    if outcome.code != 0:
        raise FrictabError(fault_text(outcome))
    return outcome.out


def fault_text(outcome: Outcome) -> str:
    """The message of a call that failed."""
    if outcome.code < 0:
        return f"frictab was ended by {signal.Signals(-outcome.code).name}"
    lines = outcome.err.splitlines()
    first = next((i for i, line in enumerate(lines) if "error: " in line), 0) # progress before it
    return ("\n".join(lines[first:]).strip() or outcome.out.strip()
            or f"frictab ended with {outcome.code}")
