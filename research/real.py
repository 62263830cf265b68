"""Held-out error of frictab and of other methods on a measured campaign, by the same folds of whole tests.

    real.py --binary build/frictab --job examples/03_ptfe_pin_on_disc/job.toml --data measured/pps/data \\
            --ignore "Contact Potential" Displacement --out pps
The job reads the data once; each fold is then a job of its own in canonical names. The tests are
sorted by name and dealt to the folds in turn; with as many folds as tests each is left out alone."""
import argparse
import shutil
import tempfile
from pathlib import Path

import pandas as pd

from judge import markdown, mean_error, predictions
from rivals import RIVALS
from tool import Frictab

NO_CAUSES = ("experiment", "time_s", "tau_R_MPa", "F_R_N", "F_N_N", "use")
METHODS = ("law", "frictab", *[name for name in RIVALS if name != "law"])


def canonical(binary, job, data, ignore):
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(job, folder)
        (Path(folder) / "data").symlink_to(Path(data).resolve())
        tool = Frictab(binary, folder, Path(job).name)
        tool.run("data", Path(job).name, "--write", "-q")
        frame = pd.read_csv(tool.out / "data.csv", dtype={"experiment": str})
    return frame.drop(columns=[c for c in ("F_R_N", "F_N_N", "use", *ignore) if c in frame])


def judge_fold(binary, law, training, heldout, methods):
    columns = [c for c in training if c not in NO_CAUSES]
    with tempfile.TemporaryDirectory() as folder:
        files = {"training.csv": training, "heldout.csv": heldout}
        for name, frame in files.items():
            frame.to_csv(Path(folder) / name, index=False)
        (Path(folder) / "job.toml").write_text(
            f'[data]\ntraining = "training.csv"\nrows = "all"\n[models]\nuse = ["{law}"]\n[output]\ndirectory = "out"\n')
        for method, result, seconds, words in predictions(binary, folder, "job.toml", law, files, columns, methods):
            errors = [mean_error(result.stress_MPa[(heldout.experiment == test).to_numpy()], rows.tau_R_MPa)
                      for test, rows in heldout.groupby("experiment", sort=False)]
            yield method, errors, seconds, words


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--binary", required=True)
    parser.add_argument("--job", required=True, help="reads files of a folder data beside it")
    parser.add_argument("--data", required=True, help="that folder")
    parser.add_argument("--ignore", nargs="*", default=[], help="columns that follow from friction")
    parser.add_argument("--law", default="coulomb")
    parser.add_argument("--folds", type=int, default=12)
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--out", required=True, help="name of the files to write, without .csv and .md")
    arguments = parser.parse_args()
    methods = arguments.methods.split(",")
    frame = canonical(arguments.binary, arguments.job, arguments.data, arguments.ignore)
    tests = sorted(frame.experiment.unique())
    mean = frame.groupby("experiment").tau_R_MPa.mean().mean()
    lines = []
    for fold in range(min(arguments.folds, len(tests))):
        out = frame.experiment.isin(tests[fold::arguments.folds])
        training, heldout = frame[~out].reset_index(drop=True), frame[out].reset_index(drop=True)
        for method, errors, seconds, words in judge_fold(arguments.binary, arguments.law, training, heldout, methods):
            names = heldout.experiment.unique()
            lines += [dict(fold=fold, test=t, method=method, error_percent=round(100 * e / mean, 3),
                           seconds=round(seconds, 2), words=words) for t, e in zip(names, errors)]
        pd.DataFrame(lines).to_csv(arguments.out + ".csv", index=False)
        print(f"fold {fold + 1} of {arguments.folds}", flush=True)
    data = pd.DataFrame(lines)
    rows = [[m, len(part), f"{part.error_percent.mean():.1f}", f"{part.error_percent.median():.1f}",
             f"{part.groupby('fold').seconds.first().mean():.1f}",
             "; ".join(f"{n} x {w}" for w, n in part.groupby("fold").words.first().value_counts().items() if w)]
            for m, part in data.groupby("method", sort=False)]
    text = markdown(("method", "tests", "mean error, % of mean stress", "median of tests", "s a fold", "frictab says"), rows)
    Path(arguments.out + ".md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
