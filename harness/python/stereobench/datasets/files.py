"""The files of one data set, as its manifest lists them."""

from __future__ import annotations

import hashlib
import json
import pathlib

from .errors import DatasetError

ABOUT = "dataset.json"
MANIFEST = "manifest-sha256.txt"  #: written last: without it, a data set is not finished
_PART_BYTES = 1 << 20


class Files:
    """The list of a data set's files. Nothing but dataset.json and the manifest is opened until a file is asked for."""

    def __init__(self, folder: pathlib.Path):
        """Reads what `folder` says of itself. Raises DatasetError where it is unfinished, broken or of another layout."""
        self.folder = folder
        self.about = _about(folder / ABOUT)
        self._sha256 = _manifest(folder / MANIFEST)

    def __contains__(self, name: str) -> bool:
        return name in self._sha256

    def path(self, name: str) -> pathlib.Path:
        """The path of a listed file. Raises DatasetError where it is not listed or not there."""
        path = self.folder / name
        if name not in self._sha256:
            raise DatasetError(f"{path}: not in this data set, expected a file that {MANIFEST} lists")
        if not path.is_file():
            raise DatasetError(f"{path}: missing, expected a file that {MANIFEST} lists")
        return path

    def check_sha256(self) -> None:
        """Reads every listed file. Raises DatasetError for the first that is not as it was written."""
        for name, wanted in self._sha256.items():
            path = self.path(name)
            found = _sha256(path)
            if found != wanted:
                raise DatasetError(f"{path}: SHA-256 {found}, expected {wanted} as {MANIFEST} says")


def _manifest(path: pathlib.Path) -> dict[str, str]:
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        raise DatasetError(f"{path}: missing, expected a finished folder; run the same `stereobench render` again") from None
    except (OSError, ValueError) as error:
        raise DatasetError(f"{path}: {error}, expected lines of a SHA-256 and a file's name") from None
    files = {}
    for number, line in enumerate(lines, 1):
        sha256, gap, name = line.partition("  ")
        if not gap or not name or len(sha256) != 64:
            raise DatasetError(f"{path}:{number}: expected a SHA-256, two spaces and a file's name")
        files[name] = sha256
    return files


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
    for key in ("seed", "frames"):
        if key not in about:
            raise DatasetError(f"{path}: no key {key!r}, expected one as `stereobench render` writes it")
    return about


def _sha256(path: pathlib.Path) -> str:
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while part := file.read(_PART_BYTES):
            digest.update(part)
    return digest.hexdigest()
