"""Formulas as frictab writes them into tables and models: Python's spelling, a closed grammar.

The text of a file is parsed here and never given to eval: numbers, names, + - * / ** ( ) and the
functions below are all there is.
"""
from __future__ import annotations

import re
from typing import Any, Callable, Iterator, NoReturn, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .faults import FrictabError

Numbers = NDArray[np.float64]
Part = Tuple[Any, ...]

_TOKEN = re.compile(r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
                    r"|(?P<name>[A-Za-z_][A-Za-z_0-9]*)|(?P<sign>\*\*|<=|[-+*/^(),]))")


def _where(a: Numbers, b: Numbers, x: Numbers, y: Numbers) -> Numbers:
    return np.where(np.isnan(a) | np.isnan(b), np.nan, np.where(a <= b, x, y))


def _arctan(x: Numbers) -> Any: # as frictab computes it
    return np.pi / 2 - np.arccos(x / np.sqrt(1.0 + x * x))


_FUNCTIONS = {"exp": np.exp, "log": np.log, "ln": np.log, "sqrt": np.sqrt, "sin": np.sin,
              "tanh": np.tanh, "arccos": np.arccos, "acos": np.arccos,
              "arctan": _arctan, "atan": _arctan}
_OF_TWO = {"minimum": np.minimum, "min": np.minimum, "maximum": np.maximum, "max": np.maximum}


class Formula:
    """A formula of named values; equal parts are computed once."""

    def __init__(self, text: str) -> None:
        self.text = text
        # ("number", x), ("name", n) or (function, operand, ...), operands first
        self._parts: list[Part] = []
        self._known: dict[Part, int] = {}
        try:
            self._root = _Parser(text, self._part).parse()
        except RecursionError: # of a caller that is deep in calls itself
            raise FrictabError("too many nested terms in a formula") from None
        self._last_use = {o: i for i, part in enumerate(self._parts)
                          if callable(part[0]) for o in part[1:]}
        self.names: set[str] = {part[1] for part in self._parts if part[0] == "name"}

    def __call__(self, **values: ArrayLike) -> Numbers:
        """The formula where each of its names has a number or an array; numpy's broadcasting."""
        missing = sorted(self.names - set(values))
        if missing:
            raise FrictabError(f"the formula needs {', '.join(missing)}")
        done: list[Any] = [None] * len(self._parts)
        with np.errstate(all="ignore"):
            for i, (kind, *rest) in enumerate(self._parts):
                if kind == "number":
                    done[i] = np.float64(rest[0])
                elif kind == "name":
                    done[i] = np.asarray(values[rest[0]], float)
                else:
                    done[i] = kind(*(done[o] for o in rest))
                    self._forget(done, rest, i) # a network has thousands of parts
        result: Numbers = done[self._root]
        return result

    def held_ranges(self) -> dict[str, tuple[float, float]]:
        """Where the formula holds a name between two numbers, as minimum(maximum(x, 30), 60):
        {name: (low, high)}, the narrowest of each."""
        ranges: dict[str, tuple[float, float]] = {}
        for part in self._parts:
            upper = self._bound(part, np.minimum)
            lower = self._bound(self._parts[upper[0]], np.maximum) if upper else None
            if not upper or not lower or self._parts[lower[0]][0] != "name":
                continue
            name = self._parts[lower[0]][1]
            low, high = ranges.get(name, (-np.inf, np.inf))
            ranges[name] = max(low, lower[1]), min(high, upper[1])
        return ranges

    def _bound(self, part: Part, function: Any) -> Optional[tuple[int, float]]:
        if part[0] is not function:
            return None
        for one, other in (part[1:], part[:0:-1]):
            if self._parts[other][0] == "number":
                return one, self._parts[other][1]
        return None

    def _forget(self, done: list[Any], operands: list[Any], at: int) -> None:
        for o in operands:
            if self._last_use[o] == at and o != self._root:
                done[o] = None

    def _part(self, *part: Any) -> int:
        if part not in self._known:
            self._known[part] = len(self._parts)
            self._parts.append(part)
        return self._known[part]


class _Parser:
    """Calls part(kind, ...) for each part, operands first; part returns what stands for it."""

    def __init__(self, text: str, part: Callable[..., int]) -> None:
        self.text, self.part = text, part
        self.tokens, self.at, self.depth = list(self._split(text)), 0, 0

    def _split(self, text: str) -> Iterator[tuple[str, str, int]]:
        text, end = text.rstrip(), 0
        while end < len(text):
            token = _TOKEN.match(text, end)
            if not token:
                self._fail(f"unexpected '{text[end:].lstrip()[0]}'", end)
            kind = str(token.lastgroup)
            yield kind, token[kind], token.start(kind)
            end = token.end()

    def _fail(self, what: str, place: Optional[int] = None) -> NoReturn:
        if place is None:
            place = self.tokens[self.at][2] if self.at < len(self.tokens) else len(self.text)
        near = slice(max(0, place - 60), place + 60)
        shown = self.text if len(self.text) < 200 else f"... {self.text[near]} ..."
        raise FrictabError(f"{what} in column {place + 1} of the formula '{shown}'")

    def _accept(self, *signs: str) -> Optional[str]:
        if self.at < len(self.tokens):
            kind, text, _ = self.tokens[self.at]
            if kind == "sign" and text in signs:
                self.at += 1
                return text
        return None

    def _expect(self, sign: str) -> None:
        if not self._accept(sign):
            self._fail(f"expected '{sign}'")

    def parse(self) -> int:
        root = self._sum()
        if self.at < len(self.tokens):
            self._fail(f"unexpected '{self.tokens[self.at][1]}'")
        return root

    def _sum(self) -> int:
        total = self._product()
        while sign := self._accept("+", "-"):
            total = self.part(np.add if sign == "+" else np.subtract, total, self._product())
        return total

    def _product(self) -> int:
        total = self._unary()
        while sign := self._accept("*", "/"):
            total = self.part(np.multiply if sign == "*" else np.divide, total, self._unary())
        return total

    def _unary(self) -> int:
        self.depth += 1
        if self.depth > 150:
            self._fail("too many nested terms")
        result = self.part(np.negative, self._unary()) if self._accept("-") else self._power()
        self.depth -= 1
        return result

    def _power(self) -> int:
        base = self._atom()
        return self.part(np.power, base, self._unary()) if self._accept("**", "^") else base

    def _atom(self) -> int:
        if self._accept("("):
            inner = self._sum()
            self._expect(")")
            return inner
        if self.at >= len(self.tokens):
            self._fail("the formula ends too early")
        kind, text, _ = self.tokens[self.at]
        if kind == "sign":
            self._fail(f"unexpected '{text}'")
        self.at += 1
        if kind == "number":
            return self.part("number", float(text))
        return self._call(text) if self._accept("(") else self.part("name", text)

    def _call(self, name: str) -> int:
        kind: Any
        between: list[str]
        if name == "where":
            kind, between = _where, ["<=", ",", ","]
        elif name in _OF_TWO:
            kind, between = _OF_TWO[name], [","]
        elif name in _FUNCTIONS:
            kind, between = _FUNCTIONS[name], []
        else:
            self.at -= 2
            self._fail(f"unknown function '{name}'")
        operands = [self._sum()]
        for sign in between:
            self._expect(sign)
            operands.append(self._sum())
        self._expect(")")
        return self.part(kind, *operands)
