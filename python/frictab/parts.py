"""Verification and trace of a run: verify.json and trace.json."""
from __future__ import annotations

import html
from typing import Any, Mapping, Optional

from .frames import pandas_module


class Part:
    """A JSON file of the results: `record` the file, `table` its rows, `[key]` its entries."""

    def __init__(self, record: Mapping[str, Any], rows: Any, headline: str) -> None:
        self.record, self.table, self.headline = record, rows, headline

    def __getitem__(self, key: str) -> Any:
        return self.record[key]

    def __repr__(self) -> str:
        return f"<frictab: {self.headline}>"

    def _repr_html_(self) -> str:
        return f"<p>{html.escape(self.headline)}</p>" + str(self.table.to_html(na_rep=""))


class Verification(Part):
    """verify.json: `passed`, and per table and routine the drift from its law."""

    def __init__(self, record: Mapping[str, Any]) -> None:
        names = ["model", "subject", "passed", "ran", "max_abs_MPa", "worst_case_MPa",
                 "proven_MPa", "allowed_MPa", "share_outside"]
        rows = pandas_module().DataFrame([[r.get(n) for n in names] for r in record["records"]],
                                   columns=names)
        self.passed: Optional[bool] = record["passed"]
        word = {True: "passed", False: "FAILED", None: "not decided: a routine could not run"}
        super().__init__(record, rows, f"verification {word[self.passed]}: "
                         f"{len(rows)} tables and routines against their laws")


class Trace(Part):
    """trace.json: `verdict`, the effects that were added (`table`), and the leads that were not."""

    def __init__(self, record: Mapping[str, Any]) -> None:
        pandas = pandas_module()
        effects = ["columns", "derived", "form", "acts_on", "p_value", "gain_MPa", "formula"]
        leads = ["name", "form", "p_value", "why_not_added"]
        self.verdict = str(record["verdict"])
        self.leads = pandas.DataFrame([[r.get(n) for n in leads] for r in record.get("leads", [])],
                                      columns=leads)
        rows = pandas.DataFrame([[r.get(n) for n in effects] for r in record["effects"]],
                                columns=effects)
        super().__init__(record, rows, f"search for what {record['model']} lacks: "
                         f"{self.verdict.replace('_', ' ')}")
