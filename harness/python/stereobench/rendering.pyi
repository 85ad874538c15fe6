"""Stubs of data sets that are written and verified."""
import pathlib
from typing import Any, Optional, Sequence, Union

from stereobench.results import Detector, Path
from stereobench.scenarios import Scenario

Names = Union[str, Sequence[str]]

def render(scenario: Scenario, out: Path, *, format: Optional[Names] = None, truth: Optional[Names] = None,
           truth_format: Optional[str] = None, frames: Optional[str] = None, every: Optional[int] = None,
           crop: Optional[Sequence[int]] = None, scale: Optional[str] = None, picture: Optional[str] = None,
           detector: Optional[Detector] = None, jobs: Optional[int] = None) -> pathlib.Path: ...
def dataset(collection: Union[Path, dict[str, Any]], out: Path, *, backend: Optional[str] = None,
            jobs: Optional[int] = None) -> pathlib.Path: ...
def verify(folder: Path, *, format: Optional[str] = None) -> list[str]: ...
