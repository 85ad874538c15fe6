"""Studies, as the program makes them: budgets, whose an error is, and what matters to it."""
import pathlib

from stereobench import _detector, _worker
from stereobench.results import Result, _folder_for, _jobs
from stereobench.scenarios import _option_words


def _range(ends):
    """"0..2", or "0.1..2:log"."""
    return ends if isinstance(ends, str) else f"{ends[0]}..{ends[1]}" + "".join(f":{spacing}" for spacing in ends[2:])


def _study(command, scenario, words, file, *, detector, jobs, out):
    """The Result of a command whose answer is a file."""
    with _folder_for(out, detector) as folder:
        options = _option_words(detector=None if detector is None else _detector.CALLABLE, jobs=_jobs(jobs, detector),
                                out=folder, quiet=True)
        _worker.call("_command", ["stereobench", command, *scenario._words(), *words, *options], detector=detector)
        return Result(pathlib.Path(folder, file).read_text(encoding="utf-8"))


def _vary(ranges):
    return [word for key, ends in ranges.items() for word in _option_words(vary=f"{key}={_range(ends)}")]


def budget(scenario, vary, metric, *, limit=None, at_least=None, share=None, confidence=None, tolerance=None, detector=None,
           jobs=None, out=None):
    """How large a fault may be for a metric to hold its limit in a share of worlds (Result of budget.json).

    vary: good and bad end by key path, {"detector_noise.centre_sd_px": (0, 2)}, in the keys' units. Several are answered
        one by one, and all together by the same fraction of their ranges.
    metric: a number of run.json, "filters.smoother.ate_rms_m".
    limit: the largest value that is good enough; at_least, in place of it: the smallest one. In the metric's unit.
    share: of the worlds in which the limit has to hold (0.95); confidence: with which that is said (0.95).
    tolerance: how near to each other levels are, as a share of a level (0.02).
    detector, jobs, out: as for run. A scenario without seeds is run on as many as share and confidence ask for.
    """
    words = _vary(vary) + _option_words(metric=metric, limit=limit, at_least=at_least, share=share, confidence=confidence,
                                        tolerance=tolerance)
    return _study("budget", scenario, words, "budget.json", detector=detector, jobs=jobs, out=out)


def attribute(scenario, *, detector=None, jobs=None, out=None):
    """Whose the error is: what each part of the chain costs, by Shapley's shares (Result of attribution.json).

    detector, jobs, out: as for run.
    """
    return _study("attribute", scenario, [], "attribution.json", detector=detector, jobs=jobs, out=out)


def sensitivity(scenario, vary, metric, *, by_stream=False, samples=None, interval=None, detector=None, jobs=None, out=None):
    """Which keys matter most to a metric, over ranges of all of them: Sobol indices (Result of sensitivity.json).

    vary: ends by key path, {"oracle.range_sd_m": (0.05, 0.5)}, in the keys' units; (0.05, 0.5, "log"): logarithms are even.
    metric: a number of run.json, "filters.ekf.ate_rms_m".
    by_stream: takes apart what is chance: world, odometry, sensor, filter.
    samples: rows, each a drive for every factor and two more (256). interval: confidence of the intervals (0.95).
    detector, jobs, out: as for run. The first of the scenario's seeds chooses the points.
    """
    words = _vary(vary) + _option_words(by_stream=by_stream, metric=metric, samples=samples, interval=interval)
    return _study("sensitivity", scenario, words, "sensitivity.json", detector=detector, jobs=jobs, out=out)
