"""What `sweep --adaptive` is worth: errors of a curve by levels that it chose, and by as many evenly spaced ones.

usage: adaptive_levels.py PROGRAM SCENARIO_FOLDER
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

PROGRAM, SCENARIOS = sys.argv[1:3]
FILTERS = ["ekf", "smoother"]
KEYS = {"oracle.bearing_sd_deg": (0.01, 30), "oracle.range_sd_m": (0.001, 10),
        "odometry_noise.v_constant_mps": (0.001, 3), "odometry_noise.w_constant_degps": (0.01, 30)}
FIRST, ADDED, TRUTH = 4, 6, 56  # of the truth, none but the ends is one of the others


def spaced(low, high, count):
    """Values that are evenly spaced by their logarithm."""
    return [low * (high / low) ** (i / (count - 1)) for i in range(count)]


def curves(key, levels, folder, *options):
    """For each filter the mean ATE by level."""
    out = pathlib.Path(folder) / "sweep"
    subprocess.run([PROGRAM, "sweep", f"{SCENARIOS}/open_field.yaml", "--vary", f"{key}={','.join(map(repr, levels))}",
                    "--filters", ",".join(FILTERS), "--seeds", "0..9", "--set", "path.step_s=2", "--set", "gates=[]",
                    "--quiet", "--out", out, *options], check=True, stdout=subprocess.DEVNULL)
    cells = json.loads((out / "sweep.json").read_text())["cells"]
    return {name: sorted((float(cell["values"][key]), cell["run"]["filters"][name]["ate_rms_m"]["mean"]) for cell in cells)
            for name in FILTERS}


def between(curve, level):
    """The logarithm of the error at a level, by the line between its neighbours on log-log axes."""
    for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
        if x0 <= level * (1 + 1e-9) and level <= x1 * (1 + 1e-9):
            return math.log(y0) + (math.log(y1) - math.log(y0)) * math.log(level / x0) / math.log(x1 / x0)
    raise ValueError(f"{level} is beyond {curve[0][0]} to {curve[-1][0]}")


def off(curve, truth):
    """How far a curve is off at the levels of another one, in percent: the rms and the most."""
    errors = [100 * (math.exp(abs(between(curve, level) - math.log(error))) - 1) for level, error in truth]
    return f"{math.sqrt(sum(e * e for e in errors) / len(errors)):.1f} / {max(errors):.1f}"


def main():
    print(f"| key | filter | {FIRST} levels | {FIRST} and {ADDED} of --adaptive | {FIRST + ADDED} evenly spaced |")
    print("|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for key, (low, high) in KEYS.items():
            truth = curves(key, spaced(low, high, TRUTH), folder)
            few = curves(key, spaced(low, high, FIRST), folder)
            bent = curves(key, spaced(low, high, FIRST), folder, "--adaptive", str(ADDED))
            even = curves(key, spaced(low, high, FIRST + ADDED), folder)
            for name in FILTERS:
                print(f"| `{key}` | {name} | " + " | ".join(off(c[name], truth[name]) for c in (few, bent, even)) + " |")


if __name__ == "__main__":
    main()
