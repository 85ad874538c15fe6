"""The files of one data set, as dataset.json lists them."""

from __future__ import annotations

import hashlib
import json
import pathlib

from .errors import DatasetError

LIST = "dataset.json"
_PART_BYTES = 1 << 20


class Files:
    """The list of a data set's files. Nothing but dataset.json is opened until a file is asked for."""

    def __init__(self, folder: pathlib.Path):
        """Reads dataset.json in `folder`. Raises DatasetError where it is missing, broken or of another layout."""
        self.folder = folder
        self.about = _about(folder / LIST)
        self._listed = self.about["files"]

    def __contains__(self, name: str) -> bool:
        return name in self._listed

    def path(self, name: str) -> pathlib.Path:
        """The path of a listed file that has the size it was written with. Raises DatasetError otherwise."""
        path = self.folder / name
        if name not in self._listed:
            raise DatasetError(f"{path}: not in this data set, expected a file that {LIST} lists")
        try:
            size = path.stat().st_size
        except OSError as error:
            raise DatasetError(f"{path}: {error.strerror}, expected a file that {LIST} lists") from None
        wanted = self._listed[name]["bytes"]
        if size != wanted:
            raise DatasetError(f"{path}: {size} bytes, expected {wanted} as {LIST} says")
        return path

    def check_sha256(self) -> None:
        """Reads every listed file. Raises DatasetError for the first that is not as it was written."""
        for name, listed in self._listed.items():
            path = self.path(name)
            found = _sha256(path)
            if found != listed["sha256"]:
                raise DatasetError(f"{path}: SHA-256 {found}, expected {listed['sha256']} as {LIST} says")


def _about(path: pathlib.Path) -> dict:
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        seeds = " (a folder of several seeds is opened by open_seeds)" if list(path.parent.glob("seed_*")) else ""
        raise DatasetError(f"{path}: missing, expected a finished folder of `stereobench render`{seeds}") from None
    except (OSError, ValueError) as error:
        raise DatasetError(f"{path}: {error}, expected JSON that `stereobench render` wrote") from None
    layout = about.get("format", "plain") if isinstance(about, dict) else None
    if layout != "plain":
        raise DatasetError(f"{path}: format {layout!r}, expected 'plain' (`stereobench render --format plain`)")
    for key in ("seed", "frames", "files"):
        if key not in about:
            raise DatasetError(f"{path}: no key {key!r}, expected one as `stereobench render` writes it")
    return about


def _sha256(path: pathlib.Path) -> str:
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while part := file.read(_PART_BYTES):
            digest.update(part)
    return digest.hexdigest()
