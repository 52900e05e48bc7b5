#!/usr/bin/env python3
"""How far fitted parts carry against the true ones.

Fits each hidden part of a folder that hidden_parts wrote, then finds for both parts the range at which a
scenario loses 1 % of its messages. A second folder has recordings of the same parts in stronger light.
Prints a row a part, and how many are within 10 %; a part that carries nowhere has the nearest range. Exit code 1
says that these are fewer than --least.
"""

import argparse
import concurrent.futures
import json
import math
import pathlib
import subprocess
import sys

NEAREST_M, FURTHEST_M = 0.1, 40.0
OF_THE_BENCH = ("broken", "clock_error", "start_s", "ambient_w_per_m2", "said_first", "first_level", "level_factor")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("far", type=pathlib.Path, help="folder with the first recording of each part")
    parser.add_argument("near", type=pathlib.Path, nargs="?", help="folder with another one, in stronger light")
    parser.add_argument("--program", type=pathlib.Path, required=True, help="cosys-sim")
    parser.add_argument("--plan", type=pathlib.Path, required=True)
    parser.add_argument("--first-level", default="60", help="irradiance of the plan's first step, in mW/m2 (60)")
    parser.add_argument("--module", default="TSOP4856", help="what the parts are said to be like (TSOP4856)")
    parser.add_argument("--scenario", type=pathlib.Path, required=True)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--least", type=float, default=0, help="share of the parts that are to be within 10 %% (0)")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="folder for parts and results")
    return parser.parse_args()


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def write_true_part(truth, path):
    """Of numbers that are 0 where a part has none, those that are 0 are left out."""
    numbers = [line.split() for line in truth.read_text().splitlines()]
    lines = [f'{key} = {{ value = {value}, source = "drawn" }}' for key, value in numbers
             if not key.startswith(OF_THE_BENCH) and float(value) != 0]
    path.write_text("\n".join([f'name = "{path.stem}"', *lines]) + "\n")


def range_m(crossing):
    """NEAREST_M also of a part that carries nowhere, FURTHEST_M of one that carries everywhere."""
    ends = {"all_above": NEAREST_M, "all_below": FURTHEST_M}
    if crossing["kind"] in ends:
        return ends[crossing["kind"]]
    if crossing["at"] is not None:
        return crossing["at"]
    return math.nan if crossing["low"] is None else math.sqrt(crossing["low"] * crossing["high"])


def find_range_m(asked, part):
    found = run([asked.program, "find", asked.scenario, "--parts", asked.output, "--set", f"receiver.module={part}",
                 "--over", f"receiver.range_m={NEAREST_M}:{FURTHEST_M}", "-n", "1000", "--tolerance", "0.02",
                 "-t", "1", "--json", "-o", asked.output / f"{part}.h5"])
    return range_m(json.loads(found)["crossings"][0])


def compare(asked, which):
    parts = asked.output / "modules"
    write_true_part(asked.far / f"{which}.truth", parts / f"true{which}.toml")
    captures = [folder / f"{which}.csv" for folder in (asked.far, asked.near) if folder]
    run([asked.program, "fit", *captures, "--plan", asked.plan, "--irradiance", asked.first_level, "--module",
         asked.module, "-o", parts / f"fitted{which}.toml"])
    return find_range_m(asked, f"true{which}"), find_range_m(asked, f"fitted{which}")


def main():
    asked = arguments()
    (asked.output / "modules").mkdir(parents=True, exist_ok=True)
    parts = sorted(int(path.stem) for path in asked.far.glob("*.truth"))
    within = 0
    print("part,true_m,fitted_m,error", flush=True)
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        for which, (true_m, fitted_m) in zip(parts, pool.map(lambda part: compare(asked, part), parts)):
            error = fitted_m / true_m - 1
            within += abs(error) <= 0.1
            print(f"{which},{true_m:.3f},{fitted_m:.3f},{error:+.3f}", flush=True)
    print(f"{within} of {len(parts)} within 10 %")
    return 0 if within >= asked.least * len(parts) else 1


sys.exit(main())
