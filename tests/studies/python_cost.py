"""What a detector in Python costs a frame beyond its own work: the pictures as arrays, and its answer as measurements.
With several jobs its pictures come from another process.

usage: PYTHONPATH=build/release/python /usr/bin/python3 tests/studies/python_cost.py [LAPS of ball_circle]
The answers are those of our detector, so that all else is the same with and without Python.
"""

import json
import pathlib
import statistics
import sys
import tempfile
import time

import stereobench as sb

SCENARIO = "assets/scenarios/ball_circle.yaml"


def milliseconds(work):
    began = time.perf_counter()
    work()
    return 1e3 * (time.perf_counter() - began)


def shown(frame):
    return frame.left[0, 0, 0], frame.right[0, 0, 0], frame.setup["rig"]


laps = float(sys.argv[1]) if len(sys.argv) > 1 else 0.5
scenario = sb.Scenario(SCENARIO, {"path.laps": laps, "gates": []}, seeds=[0], filters="ekf")
costs, balls = [], 0
for own, ours in zip(sb.Drive(scenario), sb.Drive(scenario)):
    answer = own.observe()
    ours.observe()
    balls += len(answer)
    python_ms = milliseconds(lambda: (shown(own), own.measure(answer)))
    costs.append(python_ms - milliseconds(ours.measure))
print(f"{len(costs)} frames, {balls / len(costs):.1f} balls a frame: {statistics.median(costs):.2f} ms a frame "
      f"(median), {max(costs):.2f} ms at most")

for jobs in [1, 2]:
    with tempfile.TemporaryDirectory() as folder:
        sb.run(scenario, detector=lambda frame: [], out=folder, jobs=jobs)
        seconds = json.loads(pathlib.Path(folder, "timing.json").read_text())["seconds"]
    print(f"in run, jobs={jobs}: {1e3 * seconds['observe'] / len(scenario.path):.2f} ms a frame (mean), beside "
          f"{1e3 * seconds['render'] / len(scenario.path):.1f} ms of rendering")
