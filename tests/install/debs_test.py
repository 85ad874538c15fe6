"""The Debian packages: what is in them, what lintian says of them, and whether they are the same bytes every time.

usage: debs_test.py BUILD_DIR SOURCE_DIR; exits with 77 (skipped) without lintian, help2man or dpkg-shlibdeps
"""

import os
import pathlib
import re
import shutil
import sys
import unittest

from installed import BUILD, SKIPPED, SOURCE, module_headers, one_below, run, scratch_folder

NAMES = ["stereobench", "libstereobench-dev", "python3-stereobench"]
HAS_PYTHON = any((BUILD / "python/stereobench").glob("_core*.so"))

for program, package in [("lintian", "lintian"), ("help2man", "help2man"), ("dpkg-shlibdeps", "dpkg-dev"), ("file", "file")]:
    if shutil.which(program) is None:
        print(f"{program} is missing: skipped (apt-get install {package})")
        sys.exit(SKIPPED)


def pack(folder, **environment):
    """By CPack, as scripts/package.sh does."""
    run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", folder, umask=0o022,
        env=os.environ | {"SOURCE_DATE_EPOCH": "1795910400"} | environment)


def setUpModule():
    global folder, debs, scratch
    scratch = scratch_folder()
    folder = pathlib.Path(scratch.name)
    pack(folder / "first")
    debs = {name: one_below(folder / "first", f"{name}_*.deb") for name in NAMES}


def tearDownModule():
    scratch.cleanup()


def field(name, of):
    return run("dpkg-deb", "--field", debs[name], of).strip()


def files_in(name):
    """Their paths, with mode and owner."""
    lines = (line.split() for line in run("dpkg-deb", "--contents", debs[name]).splitlines())
    return {words[5].removeprefix("."): (words[0], words[1]) for words in lines if not words[5].endswith("/")}


class Debs(unittest.TestCase):
    def test_the_same_bytes_every_time(self):
        pack(folder / "second", TZ="Pacific/Kiritimati", LC_ALL="C")
        for name, deb in debs.items():
            self.assertEqual(deb.read_bytes(), (folder / "second" / deb.name).read_bytes(), name)

    def test_lintian_finds_no_errors_and_no_warnings(self):
        text = run("lintian", "--allow-root", "--fail-on", "error,warning", *debs.values())
        self.assertNotIn("E:", text)

    def test_versions(self):
        native = run("dpkg", "--print-architecture").strip()
        for name, architecture in zip(NAMES, [native, native, native if HAS_PYTHON else "all"]):
            self.assertEqual(field(name, "Version"), run("dpkg-parsechangelog", "--file", SOURCE / "packaging/changelog",
                                                         "--show-field", "Version").strip())
            self.assertEqual(field(name, "Architecture"), architecture)
            self.assertEqual(field(name, "Priority"), "optional")

    def test_the_program_needs_what_it_opens(self):
        needs = field("stereobench", "Depends")
        self.assertIn("libosmesa6", needs)
        self.assertRegex(needs, r"libopencv-core\d")  # of the program's own links
        self.assertNotIn("-dev", needs)
        self.assertIn("libegl1", field("stereobench", "Recommends"))

    def test_the_program_has_its_files(self):
        files = files_in("stereobench")
        for path in ["bin/stereobench", "share/stereobench/scenarios/ball_circle.yaml", "share/man/man1/stereobench-run.1.gz",
                     "share/bash-completion/completions/stereobench", "share/zsh/vendor-completions/_stereobench",
                     "share/doc/stereobench/copyright", "share/doc/stereobench/changelog.Debian.gz"]:
            self.assertIn("/usr/" + path, files)
        self.assertEqual({owner for _, owner in files.values()}, {"root/root"})
        run("dpkg-deb", "--extract", debs["stereobench"], folder / "extracted")
        self.assertNotIn(".symtab", run("readelf", "-SW", folder / "extracted/usr/bin/stereobench"), "is not stripped")

    def test_modules_need_the_packages_of_what_they_include(self):
        """The fields are made of the modules' dependencies.cmake; here of the headers themselves."""
        needed = {re.split(r"[ (]", word.strip())[0] for word in field("libstereobench-dev", "Depends").split(",")}
        included = set()
        for path in module_headers():
            included |= set(re.findall(r"^ *# *include <([^>]+/[^>]+|[^>]+\.h)>", path.read_text(), re.M))
        places = [pathlib.Path(place) for place in ["/usr/include", "/usr/include/eigen3", "/usr/include/opencv4",
                                                    f"/usr/include/{run('dpkg-architecture', '-qDEB_HOST_MULTIARCH').strip()}"]]
        found = [next((place / header for place in places if (place / header).exists()), None) for header in sorted(included)]
        self.assertNotIn(None, found)
        owners = {line.split(":")[0] for line in run("dpkg", "--search", *[path.resolve() for path in found]).splitlines()}
        self.assertGreater(len(owners), 10)
        owners = {"libopencv-dev" if owner == "libopencv-core-dev" else owner for owner in owners}  # which brings it
        self.assertEqual(owners - needed - {"linux-libc-dev"}, set())

    def test_the_python_package_needs_its_python_and_numpy(self):
        needs = field("python3-stereobench", "Depends")
        self.assertIn("python3-numpy", needs)
        if HAS_PYTHON:
            self.assertRegex(needs, r"python3 \(>= 3\.\d+\), python3 \(<< 3\.\d+\)")
            self.assertRegex(needs, r"libopencv-core\d")  # of the compiled part's own links
        self.assertIn("/usr/lib/python3/dist-packages/stereobench/datasets/dataset.py", files_in("python3-stereobench"))

    def test_packages_that_are_named_exist(self):
        """Those of the Containerfile and of the packages' own fields that CPack did not work out."""
        text = (SOURCE / "scripts/Containerfile").read_text()
        install = re.search(r"apt-get install .*?--no-install-recommends ([a-z0-9 -]+)", text)
        named = set(install.group(1).split())
        for name in NAMES:
            for of in ["Recommends", "Suggests"] + (["Depends"] if name == "libstereobench-dev" else []):
                named |= {word.split()[0] for word in field(name, of).split(",") if word.strip()}
        known = set(run("apt-cache", "pkgnames").split())
        if "libc6" not in known:
            self.skipTest("apt has no lists of packages (apt-get update)")
        self.assertEqual(named - set(NAMES) - known, set())


if __name__ == "__main__":
    unittest.main(argv=["debs_test.py", "--verbose", *sys.argv[3:]])
