#!/usr/bin/env python3
"""Runs the blind trial: makes recordings, has them diagnosed, and only then opens the labels and scores."""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import threading
import time

import report
from scoring import Trial, score, summary

BUILD = pathlib.Path(__file__).resolve().parents[2] / "build" / "host" / "bin"
METHODS = ("morepro", "single_term", "stlsq")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--suite", default="small", help="small, full, varied, dev_rich or dev_production (default small)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, another set of machines and effects")
    parser.add_argument("--program", type=pathlib.Path, default=BUILD / "morepro")
    parser.add_argument("--generator", type=pathlib.Path, default=BUILD / "blind_generate")
    parser.add_argument("--baselines", type=pathlib.Path, help="blind_baselines: scored beside the program")
    parser.add_argument("--folder", type=pathlib.Path, help="where results go (default: a temporary folder)")
    parser.add_argument("--resume", action="store_true", help="keep the diagnoses that --folder already holds")
    parser.add_argument("--score-only", action="store_true", help="score what --folder holds")
    parser.add_argument("--also", type=pathlib.Path, nargs="+", default=[], metavar="FOLDER",
                        help="folders of other seeds, scored along: what one seed is too small for, as calibration")
    parser.add_argument("--bootstrap", type=int, help="passed to diagnose")
    parser.add_argument("--every", type=int, default=1, help="only every Nth trial, for a shorter look")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--timeout", type=float, default=300.0, help="seconds for one diagnosis")
    parser.add_argument("--keep", action="store_true", help="keep the recordings (11 MB each)")
    parser.add_argument("--json", type=pathlib.Path, help="write the scores")
    return parser.parse_args()


def run(command, timeout_s):
    """(status, stderr); a program that hangs has status -1."""
    try:
        done = subprocess.run([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              timeout=timeout_s, check=False)
        return done.returncode, done.stderr.strip()
    except subprocess.TimeoutExpired:
        return -1, f"no answer within {timeout_s:g} s"


class Runner:
    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.lock = threading.Lock()
        self.done = 0
        self.count = 0
        self.diagnosis_s = 0.0
        for name in ("trials", "labels") + METHODS:
            (folder / name).mkdir(parents=True, exist_ok=True)

    def all(self):
        suite = [self.options.generator, "--suite", self.options.suite, "--seed", self.options.seed]
        text = subprocess.run([str(word) for word in suite + ["--count-only"]], capture_output=True, text=True, check=True).stdout
        chosen = range(0, int(text), self.options.every)
        self.count = len(chosen)
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(lambda index: self.one(suite, index), chosen))

    def one(self, suite, index):
        name = f"trial_{index:04d}"
        label = self.folder / "labels" / f"{name}.json"
        if not (self.options.resume and label.exists() and (self.folder / "morepro" / f"{name}.json").exists()):
            label.unlink(missing_ok=True)
            status, error = run(suite + ["--only", index, "--out", self.folder / "trials", "--labels", label], 600)
            if status != 0:
                raise SystemExit(f"blind_generate failed for {name}: {error}")
            trial = self.folder / "trials" / name
            if (trial / "recording.csv").exists():
                self.diagnose(trial, name, index)
        self.progress()

    def diagnose(self, trial, name, index):
        recording, machine = trial / "recording.csv", trial / "machine.toml"
        answer = self.folder / "morepro" / f"{name}.json"
        answer.unlink(missing_ok=True)
        command = [self.options.program, "diagnose", recording, "--machine", machine, "--json", answer, "--seed", index + 1,
                   "--progress", "off"] + (trial / "options.txt").read_text().split()
        if self.options.bootstrap is not None:
            command += ["--bootstrap", self.options.bootstrap]
        start = time.monotonic()
        status, error = run(command, self.options.timeout)
        self.diagnosis_s += time.monotonic() - start
        if status != 0 or not answer.exists():
            answer.write_text(json.dumps({"verdict": "failed", "error": error, "status": status}))
        if self.options.baselines:
            for method in METHODS[1:]:
                run([self.options.baselines, method, recording, machine, self.folder / method / f"{name}.json"], 120)
        if not self.options.keep:
            recording.unlink()

    def progress(self):
        with self.lock:
            self.done += 1
            if sys.stderr.isatty() or self.done % 20 == 0 or self.done == self.count:
                print(f"{self.done}/{self.count} trials", file=sys.stderr, flush=True)


def read(path):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return None


def opened_labels(folder):
    """Only now: every diagnosis has been written."""
    labels = []
    for path in sorted((folder / "labels").glob("*.json")):
        labels += json.loads(path.read_text())
    (folder / "labels.json").write_text(json.dumps(labels, indent=1))
    return [label | {"folder": folder} for label in labels]


def answered(method, labels):
    return [Trial(label, read(label["folder"] / method / f"{label['id']}.json")) for label in labels if not label["unreachable"]]


def scored_sets(labels, methods):
    results = {}
    for set_name in ("rich", "production"):
        chosen = [label for label in labels if label["set"] == set_name]
        if chosen:
            results[set_name] = {method: score(answered(method, chosen)) for method in methods}
    return results


def print_results(labels, results):
    for set_name, scores in results.items():
        report.print_table(set_name, scores["morepro"], {name: rows for name, rows in scores.items() if name != "morepro"})
    for set_name in results:
        chosen = [label for label in labels if label["set"] == set_name]
        report.print_confusion(set_name, answered("morepro", chosen))
    report.print_misses(answered("morepro", labels))
    left = [label for label in labels if label["unreachable"]]
    print(f"\n== {len(left)} trials left out, because an effect would need an absurd size in that excitation")
    for set_name in results:
        names = collections.Counter(e["name"] for label in left if label["set"] == set_name for e in label["effects"] if not e["reachable"])
        print(f"  {set_name}: " + (", ".join(f"{name} x{count}" for name, count in sorted(names.items())) or "-"))


def is_clearly_broken(results):
    """Wide limits: a small suite can only see what is broken, not what is good."""
    for scores in (methods["morepro"] for methods in results.values()):
        if scores["failed"]["hits"] > 0 or scores["false_alarm"]["hits"] > 1:
            return True
    rich = results["rich"]["morepro"]
    return (rich["detected"]["value"] or 0.0) < 0.6 or (rich["right_effect"]["value"] or 0.0) < 0.6


def main():
    options = arguments()
    folder = options.folder or pathlib.Path(tempfile.mkdtemp(prefix="blind_trial_"))
    start = time.monotonic()
    runner = Runner(options, folder)
    if not options.score_only:
        runner.all()
    labels = sum(map(opened_labels, [folder] + options.also), [])
    methods = [name for name in METHODS if name == "morepro" or any((folder / name).glob("*.json"))]
    results = scored_sets(labels, methods)
    print_results(labels, results)
    print(f"\n{len(labels)} trials, {time.monotonic() - start:.0f} s, of which diagnosis {runner.diagnosis_s:.0f} s of process time"
          f"\nsuite {options.suite}, seed {options.seed}")
    if options.json:
        trials = [summary(trial) for trial in answered("morepro", labels)]
        temporary = options.json.with_name(options.json.name + ".new")
        temporary.write_text(json.dumps({"schema": "morepro.blind_trial/1", "suite": options.suite, "seed": options.seed,
                                         "scores": results, "trials": trials}, indent=1))
        os.replace(temporary, options.json)
    if not options.folder:
        shutil.rmtree(folder)
    return 1 if options.suite == "small" and is_clearly_broken(results) else 0


if __name__ == "__main__":
    sys.exit(main())
