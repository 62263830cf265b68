"""What can be wrong with a file or a call, and warnings."""
from __future__ import annotations

import os
from contextlib import contextmanager
from typing import Iterator


class FrictabError(ValueError):
    """A file that cannot be read, a call that cannot be answered, or a fault that the program
    found in data or job."""


class OutsideWarning(UserWarning):
    """States lie beyond what a table or law was made for; the text counts them."""


class CautionWarning(UserWarning):
    """Results that have to be looked at: a unit that nobody gave, drift over the tolerance."""


@contextmanager
def file_faults(path: str, kind: str) -> Iterator[None]:
    """Turns what a damaged or foreign file makes a library raise into a FrictabError."""
    if not os.path.exists(path):
        raise FrictabError(f"{path}: no such file")
    if not os.path.isfile(path): # a pipe would be waited for
        raise FrictabError(f"{path}: is not a file")
    try:
        yield
    except FrictabError as fault:
        text = str(fault)
        raise fault if path in text else FrictabError(f"{path}: {text}") from None
    except Exception as fault:
        raise FrictabError(f"{path}: cannot be read as {kind}: "
                           f"{type(fault).__name__}: {fault}") from fault
