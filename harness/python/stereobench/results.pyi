"""Stubs of runs and sweeps."""
import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

from stereobench._core import Frame
from stereobench.scenarios import Scenario

Path = Union[str, os.PathLike[str]]
Detector = Callable[[Frame], list[dict[str, Any]]]

class Result(dict[str, Any]):
    text: str
    broken_gates: list[str]
    def __init__(self, text: str, broken: str = "") -> None: ...

def run(scenario: Scenario, *, detector: Optional[Detector] = None, jobs: Optional[int] = None,
        out: Optional[Path] = None) -> Result: ...
def sweep(scenario: Scenario, vary: Mapping[str, Sequence[Any]], *, paired_to: Any = None, adaptive: int = 0,
          detector: Optional[Detector] = None, jobs: Optional[int] = None, out: Optional[Path] = None) -> Result: ...
