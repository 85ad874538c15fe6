"""Stubs of scenarios."""
import os
from typing import Any, Mapping, Optional, Sequence, Union

from stereobench import _core

class Scenario(_core.Scenario):
    def __init__(self, source: Union[str, os.PathLike[str], dict[str, Any]], set: Optional[Mapping[str, Any]] = None, *,
                 seeds: Union[None, str, int, Sequence[int]] = None, filters: Union[None, str, Sequence[str]] = None,
                 particles: Optional[int] = None, backend: Optional[str] = None) -> None: ...
    def to_dict(self, seed: Optional[int] = None) -> dict[str, Any]: ...
    def to_yaml(self, seed: Optional[int] = None) -> str: ...
