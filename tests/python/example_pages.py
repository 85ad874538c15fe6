"""Renders scripts in cells as pages of the guide: prose, code, what it prints, and pictures.

usage: PYTHONPATH=build/release/python /usr/bin/python3 tests/python/example_pages.py SOURCE_DIR OUT_DIR [NAME...]
Runs assets/examples/NAME.py cell by cell in a folder of its own, and writes NAME.md and its pictures to OUT_DIR. Those of
the guide are in docs/guide/examples. jupytext and nbconvert would do it: the one is not in Debian 12, the other starts a
kernel and needs some thirty packages.
"""

import contextlib
import io
import os
import pathlib
import re
import shutil
import sys
import tempfile

import stereobench as sb

NAMES = ("own_detector", "noise_budget", "own_filter")
MARKER = re.compile(r"^# %%(.*)$", re.M)
PICTURE = re.compile(r"(!\[[^\]]*\])\(([^)]+)\)")


def cells_of(script):
    """[(is_prose, text)] of a script; prose is without its comment signs."""
    parts = MARKER.split(script)
    if parts[0].strip():
        raise ValueError(f"expected a script that begins with '# %%' (got '{parts[0].strip().splitlines()[0]}')")
    cells = []
    for kind, text in zip(parts[1::2], parts[2::2]):
        is_prose = kind.strip() == "[markdown]"
        cells.append((is_prose, re.sub(r"^# ?", "", text.strip(), flags=re.M) if is_prose else text.strip("\n")))
    return cells


def with_pictures(prose, name, out):
    """Prose whose pictures lie beside the page, under the script's name."""
    def move(found):
        picture = pathlib.Path(found.group(2))
        there = picture.name if picture.stem == name else f"{name}_{picture.name}"
        shutil.copyfile(picture, out / there)
        return f"{found.group(1)}({there})"
    return PICTURE.sub(move, prose)


def pixels():
    """The fingerprint of what is rendered here: with another one, pages differ."""
    scenario = sb.Scenario("assets/scenarios/ball_circle.yaml", {"path.laps": 0.02, "gates": []}, seeds=[0], filters="ekf")
    return sb.run(scenario)["made_from"]["pixels"]


def render(source, out, name):
    """Writes the page of a script. Works in the current folder, which has `assets`."""
    file = f"assets/examples/{name}.py"
    names = {"__name__": "__main__", "__file__": file}
    blocks = []
    for is_prose, text in cells_of((source / file).read_text(encoding="utf-8")):
        if is_prose:
            blocks.append(with_pictures(text, name, out))
            continue
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(text, file, "exec"), names)
        blocks.append(f"```py\n{text}\n```")
        if printed.getvalue():
            blocks.append(f"It prints:\n\n```text\n{printed.getvalue().rstrip()}\n```")
    blocks.insert(1, f"This page is what [{name}.py](../../../{file}) gives, a script in cells.")
    blocks.append(f"<!-- Made by tests/python/example_pages.py; pixels: {pixels()} -->")
    (out / f"{name}.md").write_text("\n\n".join(blocks) + "\n", encoding="utf-8")


def main():
    source, out = (pathlib.Path(path).resolve() for path in sys.argv[1:3])
    out.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[3:] or NAMES:
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            os.symlink(source / "assets", "assets")
            render(source, out, name)
            os.chdir(source)


if __name__ == "__main__":
    main()
