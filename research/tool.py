"""Runs frictab on a job folder and reads what it wrote."""
import json
import os
import subprocess
import tomllib
from pathlib import Path

import pandas as pd

# Histories that grow with the slid distance; an effect of one is an effect of the distance.
DISTANCE_HISTORIES = {"sliding_distance", "time_since_start", "friction_work", "energy", "slip", "pressure_path"}


class Frictab:
    def __init__(self, binary, folder, job="job.toml"):
        self.binary, self.folder, self.job = str(Path(binary).resolve()), Path(folder), job
        settings = tomllib.loads((self.folder / job).read_text())
        self.out = self.folder / settings.get("output", {}).get("directory", "out")

    def run(self, *arguments):
        done = subprocess.run([self.binary, *arguments], cwd=self.folder, capture_output=True, text=True,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
        if done.returncode:
            said = (done.stderr.strip() or done.stdout.strip())[-500:]
            raise RuntimeError(f"frictab {' '.join(arguments)} ended with {done.returncode}: {said}")
        return done.stdout

    def calibrate(self):
        self.run("calibrate", self.job, "-q", "-j1")

    def trace(self):
        self.run("trace", self.job, "-q", "-j1")
        return json.loads((self.out / "trace.json").read_text())

    def predict(self, frame, law, file):
        """Of every row of `file`, in the order of `frame`, which has the same rows."""
        self.run("predict", self.job, file, "--model", law, "-q", "-j1", "-o", "predicted.csv", "--force")
        predicted = pd.read_csv(self.folder / "predicted.csv", dtype={"experiment": str})
        if len(predicted) != len(frame):
            raise RuntimeError(f"frictab predicts {len(predicted)} of {len(frame)} rows of {file}")
        keys = frame.experiment.astype(str).to_frame().assign(row=frame.groupby("experiment").cumcount() + 1)
        return keys.merge(predicted, on=["experiment", "row"], how="left").tau_R_MPa.to_numpy()


def named_columns(trace):
    names = set()
    for effect in trace["effects"]:
        grows = effect["derived"] in DISTANCE_HISTORIES or "time_s" in effect["columns"]
        names |= {"s_mm"} if grows else set(effect["columns"])
    return names


def in_words(trace):
    return "; ".join(f"{' x '.join(e['columns'])} {e['form']} on {e['acts_on']}" for e in trace["effects"])


def stated_error(trace):
    return (trace["after"] if trace["effects"] else trace["as_calibrated"])["validation"]["mae_MPa"]
