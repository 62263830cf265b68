"""A small synthetic campaign as a DataFrame, for the tests of the package frictab."""
import pathlib
import subprocess
import tempfile

import pandas

from frictab.program import find_program

DESIGN = "p=600,1200,2000;psi=1,5;v=5,500;T=20,200;points=20;validation=6"
CONSTANTS = {"sigma_f_MPa": 420.0}
COLUMNS = {"sigma_n_MPa": ("Druck", "Pa"), "v_rel_mm_s": ("v", "mm/s"),
           "T_contact_C": ("T", "degC"), "tau_R_MPa": {"column": "Reibung", "unit": "Pa"}}


def twin():
    """24 tests to train on and 6 to validate, canonical columns, called synthetic by `origin`."""
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([find_program(), "twin", work + "/twin", "--seed", "3", "--design", DESIGN],
                       check=True, stdout=subprocess.DEVNULL)
        parts = [pandas.read_csv(pathlib.Path(work) / "twin" / f"{part}.csv")
                 for part in ("training", "validation")]
    return pandas.concat(parts, ignore_index=True)


def recorded(frame):
    """The same as a rig might have recorded it: other names and units, no origin."""
    return pandas.DataFrame({
        "Versuch": frame["experiment"], "Druck": frame["sigma_n_MPa"] * 1e6,
        "Reibung": frame["tau_R_MPa"] * 1e6, "v": frame["v_rel_mm_s"], "T": frame["T_contact_C"],
        "Feuchte": frame["humidity_pct"]})
