"""Runs and sweeps, as the program makes them."""
import contextlib
import json
import os
import tempfile

from stereobench import _core, _worker
from stereobench.scenarios import _list_text


class Result(dict):
    """What run.json or sweep.json says, as a dict. Numbers that do not exist are None.

    text: the file's content; broken_gates: a line for each limit of the scenario that is not kept.
    """

    def __init__(self, text, broken=""):
        super().__init__(json.loads(text))
        self.text = text
        self.broken_gates = [line for line in broken.splitlines() if line]


@contextlib.contextmanager
def _folder_for(out):
    """A folder for files: the user's, or one that goes with the call."""
    if out is not None:
        yield os.fspath(out)
        return
    with tempfile.TemporaryDirectory(prefix="stereobench_") as folder:
        yield folder


def _jobs(jobs):
    return jobs or len(os.sched_getaffinity(0))


def run(scenario, *, detector=None, jobs=None, out=None):
    """Renders a scenario's seeds, observes them, runs the filters and scores them (Result of run.json).

    detector: a callable that is given a Frame and returns a list of dicts, as detectors answer in lines of JSON
        (docs/guide/detectors.md); seeds are then driven one after the other, in this process. None: as the scenario says.
    jobs: processes, None is one a CPU; the result does not depend on them.
    out: folder for the files of `stereobench run`; None: they are not kept.
    """
    if detector is not None and not callable(detector):
        raise TypeError(f"detector: expected a callable (got {type(detector).__name__})")
    with _folder_for(out) as folder:
        if detector is not None:
            outcome = _core._run(scenario, folder, _jobs(jobs), detector)
            return Result(outcome.json, outcome.broken)
        answer = _worker.call("_run", scenario, folder, _jobs(jobs), None)
    return Result(answer["json"], answer["broken"])


def sweep(scenario, vary, *, jobs=None, out=None, paired_to=None, adaptive=0):
    """Runs a scenario over a grid of values (Result of sweep.json).

    vary: lists of values by their key path, {"camera.noise_sd_levels": [0, 1, 2, 4]}.
    paired_to: a value of the first key: each cell is compared with the one that has it, seed by seed.
    adaptive: up to so many further values, where a filter's error bends most.
    jobs, out: as for run.
    """
    variations = [f"{key}={_list_text(values)}" for key, values in vary.items()]
    with _folder_for(out) as folder:
        answer = _worker.call("_sweep", scenario, variations, folder, _jobs(jobs),
                              "" if paired_to is None else str(paired_to), adaptive)
    return Result(answer["json"], answer["broken"])
