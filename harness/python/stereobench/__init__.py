"""stereobench, a testbench of stereo vision and SLAM, from Python.

    import stereobench as sb

    scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", set={"path.laps": 0.1})
    result = sb.run(scenario, detector=my_detector)

`stereobench.datasets` opens rendered data sets; it needs no compiled part.
Lengths are in metres, angles in radians, the world frame is x east, y north, z up; pixel (0, 0) is the centre of the
top-left pixel.
"""
import importlib
import importlib.util

_PARTS = {
    "Error": "_core", "RunCrash": "_core", "Frame": "_core", "DriveFrame": "_core", "Truth": "_core",
    "Estimates": "_core", "filter_names": "_core",
    "Scenario": "scenarios",
    "Drive": "drives", "Filter": "drives", "Tally": "drives", "estimates": "drives",
    "MEASUREMENT": "drives", "LANDMARK": "drives",
    "Result": "results", "run": "results", "sweep": "results",
    "budget": "studies", "attribute": "studies", "sensitivity": "studies",
    "render": "rendering", "dataset": "rendering", "verify": "rendering",
}

__all__ = ["datasets", *_PARTS]


def __getattr__(name):
    if name == "datasets":
        return importlib.import_module("stereobench.datasets")
    if name not in _PARTS:
        raise AttributeError(f"module 'stereobench' has no attribute '{name}'")
    if importlib.util.find_spec("stereobench._core") is None:
        raise ImportError(f"stereobench.{name} needs the compiled part of the package, which is not here: install "
                          "python3-stereobench, or build with pybind11-dev and use build/release/python")
    return getattr(importlib.import_module(f"stereobench.{_PARTS[name]}"), name)


def __dir__():
    return sorted(__all__)
