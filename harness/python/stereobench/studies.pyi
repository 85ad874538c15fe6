"""Stubs of studies."""
from typing import Mapping, Optional, Union

from stereobench.results import Detector, Path, Result
from stereobench.scenarios import Scenario

Ends = Union[str, tuple[float, float]]
SpacedEnds = Union[Ends, tuple[float, float, str]]

def budget(scenario: Scenario, vary: Mapping[str, Ends], metric: str, *, limit: Optional[float] = None,
           at_least: Optional[float] = None, share: Optional[float] = None, confidence: Optional[float] = None,
           tolerance: Optional[float] = None, detector: Optional[Detector] = None, jobs: Optional[int] = None,
           out: Optional[Path] = None) -> Result: ...
def attribute(scenario: Scenario, *, detector: Optional[Detector] = None, jobs: Optional[int] = None,
              out: Optional[Path] = None) -> Result: ...
def sensitivity(scenario: Scenario, vary: Mapping[str, SpacedEnds], metric: str, *, by_stream: bool = False,
                samples: Optional[int] = None, interval: Optional[float] = None, detector: Optional[Detector] = None,
                jobs: Optional[int] = None, out: Optional[Path] = None) -> Result: ...
