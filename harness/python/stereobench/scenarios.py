"""Scenarios: what is run."""
import contextlib
import json
import os
import tempfile

from stereobench import _core


def _override(key, value):
    """"key=value" as --set takes it."""
    return f"{key}={value if isinstance(value, str) else json.dumps(value)}"


def _text(value):
    """A value as YAML has it."""
    return value if isinstance(value, str) else str(value).lower() if isinstance(value, bool) else str(value)


def _list_text(values):
    """A list as options take it: "0,4,7"."""
    if values is None:
        return ""
    if isinstance(values, str) or not hasattr(values, "__iter__"):
        return _text(values)
    return ",".join(_text(value) for value in values)


def _option_words(**options):
    """Options of a command line. None and False are not said, True is a flag, a list is "a,b"."""
    return [f"--{name.replace('_', '-')}" + ("" if value is True else f"={_list_text(value)}")
            for name, value in options.items() if value is not None and value is not False]


@contextlib.contextmanager
def _file_of(source, called, folder=None):
    """The path of a YAML file, also of a dict's. Errors name it as it is called.

    folder: for the file of a dict; None: it goes with the call.
    """
    if not isinstance(source, dict):
        yield os.fspath(source)
        return
    with contextlib.ExitStack() as ends:
        folder = folder or ends.enter_context(tempfile.TemporaryDirectory(prefix="stereobench_"))
        file = os.path.join(folder, f"{called}.yaml")
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(source, stream, indent=1)  # YAML is a superset of it
        try:
            yield file
        except _core.Error as error:
            raise type(error)(str(error).replace(file, called)) from None


class Scenario(_core.Scenario):
    """A scenario file, or a dict with the same keys, with some of its values replaced.

    source: path of a YAML file, or a dict; paths in a dict are absolute.
    set: values by their key paths, {"camera.noise_sd_levels": 4}; text stands as --set takes it.
    seeds: [0, 1] or "0..9"; filters: names; particles: of each particle filter; None is as the scenario says.
    backend: what renders: "osmesa", "egl" or "egl-gpu"; None is osmesa where its library is, else egl.
    Raises Error with the program's message, e.g. for an unknown key.
    """

    def __init__(self, source, set=None, *, seeds=None, filters=None, particles=None, backend=None):
        overrides = [_override(key, value) for key, value in (set or {}).items()]
        options = (overrides, _list_text(seeds), _list_text(filters), particles or 0, backend or "")
        if isinstance(source, dict):
            self._folder = tempfile.TemporaryDirectory(prefix="stereobench_")
        with _file_of(source, "scenario", isinstance(source, dict) and self._folder.name) as file:
            self._made_of = (file, *options)
            super().__init__(*self._made_of, "")

    def _camera_words(self):
        """It as a command line says it that runs no filters."""
        file, overrides, seeds, _, _, backend = self._made_of
        return [file, *(f"--set={override}" for override in overrides),
                *_option_words(seeds=seeds or None, backend=backend or None)]

    def _words(self):
        """It as a command line says it."""
        _, _, _, filters, particles, _ = self._made_of
        return self._camera_words() + _option_words(filters=filters or None, particles=particles or None)

    def to_dict(self, seed=None):
        """The scenario as a dict with the keys of files, and absolute paths.

        seed: nothing is left to chance, the world is that of the seed.
        """
        return self._dict(seed)

    def to_yaml(self, seed=None):
        """The same as the lines of a file."""
        return self._written(seed)

    def __repr__(self):
        return f"<stereobench.Scenario '{self.name}', {len(self.path)} steps, {self.sensor}>"
