"""Data sets: written and verified as the program does. `stereobench.datasets` reads them."""
import os
import pathlib

from stereobench import _core, _detector, _worker
from stereobench.results import _jobs
from stereobench.scenarios import _file_of, _option_words


def _write(command, words, out, jobs, detector=None):
    options = _option_words(jobs=_jobs(jobs, detector), out=os.fspath(out), quiet=True)
    _worker.call("_command", ["stereobench", command, *words, *options], detector=detector)
    return pathlib.Path(out)


def render(scenario, out, *, format=None, truth=None, truth_format=None, frames=None, every=None, crop=None, scale=None,
           picture=None, detector=None, jobs=None):
    """Writes stereo pairs with their truth as a data set, and returns its folder (Path).

    out: the folder. Several seeds have folders in it (seed_0), and so have several formats. What is complete there is
        left as it is, what is not is gone on with.
    format: "plain", "kitti", ...; or a list of them. None: "plain", which stereobench.datasets opens.
    truth: further truth, a list of balls, surface, range, normal, disparity, match, flow; or "all".
    truth_format: "exact", "tiff" or "kitti".
    frames: steps that get pictures, "0..90:10"; every: each K-th pair.
    crop: x, y, width, height of what is kept, px; scale: "1/2" makes a pixel of 2 x 2; picture: "grey", "linear16", ...
    detector: a callable whose answers are the log's observations, as for run; `out` is then empty or not there.
    jobs: as for run.
    Without seeds of its own, the first seed of a scenario is rendered.
    """
    if detector is not None and os.path.isdir(out) and os.listdir(out):
        raise _core.Error(f"{os.fspath(out)}: expected an empty folder: nothing says which function its answers are of")
    words = scenario._camera_words() + _option_words(
        format=format, truth=truth, truth_format=truth_format, frames=frames, every=every, crop=crop, scale=scale,
        picture=picture, detector=None if detector is None else _detector.CALLABLE)
    return _write("render", words, out, jobs, detector)


def dataset(collection, out, *, backend=None, jobs=None):
    """Renders a collection: several scenarios, seeds and variations, with splits. Returns its folder (Path).

    collection: path of a YAML file (docs/guide/collections.md), or a dict with its keys; paths in a dict are absolute.
    out: the folder; each drive lies in SPLIT/NAME/seed_N, which stereobench.datasets opens.
    backend: as for Scenario; jobs: as for run.
    """
    with _file_of(collection, "collection") as file:
        return _write("dataset", [file, *_option_words(backend=backend)], out, jobs)


def verify(folder, *, format=None):
    """Holds all that a data set or a collection says twice against itself.

    format: of a data set, where the folder does not tell it.
    Returns a line for each fault, with its file and frame (list of str); none where all is well.
    """
    return _core._verify(os.fspath(folder), format or "")
