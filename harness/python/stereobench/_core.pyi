"""The compiled part of stereobench. Arrays of pictures are read-only and no copies."""
import os
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

class Error(RuntimeError): ...
class RunCrash(Error): ...

def filter_names() -> list[str]: ...
def _estimates(name: str, drive: Drive, poses: NDArray[np.float64], covariances: Optional[NDArray[np.float64]],
               landmarks: Optional[np.ndarray]) -> Estimates: ...
def _run(scenario: Scenario, out: str, jobs: int, detector: Optional[Callable[[Frame], list]]) -> _Outcome: ...
def _sweep(scenario: Scenario, variations: list[str], out: str, jobs: int, paired_to: str, adaptive: int) -> _Outcome: ...

class _Outcome:
    json: str
    broken: str

class Scenario:
    name: str
    description: str
    sensor: str
    seeds: list[int]
    filters: list[str]
    particles: int
    path: np.ndarray
    def __init__(self, file: Union[str, os.PathLike], overrides: list[str], seeds: str, filters: str, particles: int,
                 backend: str) -> None: ...
    def _written(self, seed: Optional[int]) -> str: ...
    def _dict(self, seed: Optional[int]) -> dict[str, Any]: ...

class Frame:
    step: int
    stamp_ns: int
    setup: dict[str, Any]
    left: Optional[NDArray[np.uint8]]
    right: Optional[NDArray[np.uint8]]

class Truth:
    pose: NDArray[np.float64]
    left: np.ndarray
    right: np.ndarray
    left_ids: NDArray[np.uint8]
    right_ids: NDArray[np.uint8]
    left_depth_m: NDArray[np.float32]
    right_depth_m: NDArray[np.float32]

class DriveFrame(Frame):
    truth: Optional[Truth]
    odometry: np.ndarray
    def observe(self) -> list[dict[str, Any]]: ...
    def measure(self, balls: Optional[list[dict[str, Any]]] = None) -> np.ndarray: ...

class Drive:
    seed: int
    setup: dict[str, Any]
    start: NDArray[np.float64]
    balls: np.ndarray
    def __init__(self, scenario: Scenario, seed: int) -> None: ...
    def __len__(self) -> int: ...
    def _frame(self, step: int, setup: dict[str, Any]) -> DriveFrame: ...
    def _render(self, x_m: float, y_m: float, heading_rad: float) -> Truth: ...
    def bounds(self) -> dict[str, NDArray[np.float64]]: ...

class Filter:
    name: str
    pose: NDArray[np.float64]
    covariance: NDArray[np.float64]
    landmarks: np.ndarray
    counters: dict[str, int]
    def __init__(self, name: str, drive: Drive, particles: int = 0) -> None: ...
    def __len__(self) -> int: ...
    def step(self, odometry: np.ndarray, measurements: np.ndarray) -> None: ...
    def estimates(self) -> Estimates: ...

class Estimates:
    name: str
    def __len__(self) -> int: ...

class Tally:
    def __init__(self, scenario: Scenario) -> None: ...
    def _add(self, drive: Drive, runs: list[Estimates]) -> None: ...
    def _json(self) -> str: ...
