"""Runs and sweeps, as the program makes them."""
import contextlib
import fcntl
import json
import os
import pathlib
import tempfile

from stereobench import _core, _detector, _worker
from stereobench.scenarios import _list_text


class Result(dict):
    """What run.json, sweep.json or the file of a study says, as a dict. Numbers that do not exist are None.

    text: the file's content; broken_gates: of run and sweep, a line for each limit of the scenario that is not kept.
    """

    def __init__(self, text, broken=""):
        super().__init__(json.loads(text))
        self.text = text
        self.broken_gates = [line for line in broken.splitlines() if line]


def _remove_drives(file):
    """Removes what a killed call left, which may be of another function."""
    with contextlib.suppress(FileNotFoundError), open(file, "r+b") as drives:
        try:
            fcntl.lockf(drives, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise _core.Error(f"{file}: another stereobench is writing to this folder; wait for it, or choose another "
                              "folder") from None
        file.unlink()


@contextlib.contextmanager
def _folder_for(out, detector):
    """A folder for files: the user's, or one that goes with the call."""
    if out is None:
        with tempfile.TemporaryDirectory(prefix="stereobench_") as folder:
            yield folder
        return
    if detector is not None:
        _remove_drives(pathlib.Path(out, "unfinished.drives"))
    yield os.fspath(out)


def _jobs(jobs, detector=None):
    """Processes: by default one a CPU, and one where a detector is to see its frames in order."""
    return int(jobs or 0) or (len(os.sched_getaffinity(0)) if detector is None else 1)


def run(scenario, *, detector=None, jobs=None, out=None):
    """Renders a scenario's seeds, observes them, runs the filters and scores them (Result of run.json).

    detector: a callable that is given a Frame and returns a list of dicts, as detectors answer in lines of JSON
        (docs/guide/detectors.md). It is called in this thread. None: as the scenario says.
    jobs: processes; the result does not depend on them. None is one a CPU; with a detector it is one, and drives come one
        after the other. More of them render while a detector thinks, and show it frames of several drives by turns.
    out: folder for the files of `stereobench run`; None: they are not kept.
    """
    with _folder_for(out, detector) as folder:
        if detector is None or _jobs(jobs, detector) > 1:
            return Result(*_worker.call("_run", folder, _jobs(jobs, detector), False, scenario=scenario, detector=detector))
        with _detector.called_here(detector) as name:
            return Result(*_core._run(_core.Scenario(*scenario._made_of, name), folder, 1, True))


def sweep(scenario, vary, *, paired_to=None, adaptive=0, detector=None, jobs=None, out=None):
    """Runs a scenario over a grid of values (Result of sweep.json).

    vary: lists of values by their key path, {"camera.noise_sd_levels": [0, 1, 2, 4]}.
    paired_to: a value of the first key: each cell is compared with the one that has it, seed by seed.
    adaptive: up to so many further values, where a filter's error bends most.
    detector: as for run; cells that share pictures may show it each of them once for each of its setups.
    jobs, out: as for run.
    """
    variations = [f"{key}={_list_text(values)}" for key, values in vary.items()]
    with _folder_for(out, detector) as folder:
        return Result(*_worker.call("_sweep", variations, folder, _jobs(jobs, detector),
                                    "" if paired_to is None else str(paired_to), adaptive, scenario=scenario,
                                    detector=detector))
