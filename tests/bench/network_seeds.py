#!/usr/bin/python3
"""SYNTHETIC data: what the network owes to the seed of its training, and how far it follows tests.

usage: network_seeds.py FRICTAB [SEED ...]

Campaigns of the twin, seeds 1 to 6; on each the network is trained with the campaign's own seed and
with 101 and 102. Printed: MAE on the tests of the training and on the validation, beside those of the
twin's truth. A training error below the truth's own is scatter of tests that was learned.
"""
import json
import pathlib
import subprocess
import sys
import tempfile


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    campaigns = [int(s) for s in sys.argv[2:]] or list(range(1, 7))

    def run(*arguments):
        subprocess.run([binary, *arguments], check=True, capture_output=True)

    over, below, trained = {"own": [], "101": [], "102": []}, 0, 0
    print("campaign  seed  training, truth   validation, truth   over the truth")
    for campaign in campaigns:
        with tempfile.TemporaryDirectory() as where:
            run("twin", where, "--seed", str(campaign), "--oracle", "-q")
            truth = json.loads(pathlib.Path(where, "twin.json").read_text())
            truth = {part: truth[part]["errors"]["oracle"]["mae_MPa"]
                     for part in ("training", "validation")}
            for name in over:
                seed = str(campaign) if name == "own" else name
                run("calibrate", f"{where}/job.toml", "--force", "--seed", seed, "-q",
                    "--set", 'models.use="neural_network"')
                model = json.loads(pathlib.Path(where, "out/calibration.json").read_text())["models"][0]
                ours = {part: model[part]["mae_MPa"] for part in truth}
                over[name].append(100 * (ours["validation"] / truth["validation"] - 1))
                below += ours["training"] < truth["training"]
                trained += 1
                print(f"{campaign:8}  {seed:>4}  {ours['training']:8.3f} {truth['training']:6.3f}"
                      f"   {ours['validation']:10.3f} {truth['validation']:6.3f}"
                      f"   {over[name][-1]:+10.1f} %")
    for name, each in over.items():
        print(f"seed {name}: {sum(each) / len(each):+.1f} % over the truth in the mean")
    print(f"training error below the truth's own: {below} of {trained}")


if __name__ == "__main__":
    main()
