"""Scenarios: what is run."""
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
        if not isinstance(source, dict):
            self._made_of = (os.fspath(source), *options)
            super().__init__(*self._made_of)
            return
        self._folder = tempfile.TemporaryDirectory(prefix="stereobench_")
        file = os.path.join(self._folder.name, "scenario.yaml")
        with open(file, "w", encoding="utf-8") as stream:
            json.dump(source, stream, indent=1)  # YAML is a superset of it
        self._made_of = (file, *options)
        try:
            super().__init__(*self._made_of)
        except _core.Error as error:
            raise _core.Error(str(error).replace(file, "scenario")) from None

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
