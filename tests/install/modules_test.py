"""Projects that use one module each, against an installed stereobench.

usage: modules_test.py BUILD_DIR SOURCE_DIR
"""

import json
import pathlib
import re
import sys
import unittest

from installed import BUILD, MODULES, SOURCE, files_below, install, module_headers, one_below, run, scratch_folder

CONSUMERS = SOURCE / "tests/install/consumers"


def setUpModule():
    global folder, prefix, scratch
    scratch = scratch_folder()
    folder = pathlib.Path(scratch.name)
    install(folder / "first", "dev")
    prefix = (folder / "first").rename(folder / "moved")  # what is installed knows no absolute place


def tearDownModule():
    scratch.cleanup()


def configure(module, *options, source=CONSUMERS):
    build = folder / f"build_{module}"
    text = run("cmake", "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DMODULE={module}",
               "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options)
    return build, text


def build_consumer(module):
    build, _ = configure(module)
    run("cmake", "--build", build, "-j", "1")
    return build


def compile_command(build):
    (entry,) = json.loads((build / "compile_commands.json").read_text())
    return entry["command"].split()


def needed_by(program):
    """Libraries, also those of libraries."""
    return {line.split()[0] for line in run("ldd", program).splitlines()}


class Slam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.build = build_consumer("slam")

    def test_a_filter_runs(self):
        self.assertRegex(run(self.build / "consumer"), r"^odometry is 0\.\d+ m off, the filter 0\.00\d m\n$")

    def test_looks_for_nothing_else(self):
        looked_for = set((self.build / "looked_for.txt").read_text().split())
        self.assertIn("Eigen3", looked_for)
        for other in ["OpenCV", "OpenGL", "PNG", "TIFF", "assimp", "glm", "fmt", "yaml-cpp", "nlohmann_json", "CLI11"]:
            self.assertNotIn(other, looked_for)

    def test_links_neither_pictures_nor_graphics(self):
        needed = needed_by(self.build / "consumer")
        self.assertTrue(any(name.startswith("libccolamd") for name in needed), needed)
        for name in needed:
            self.assertNotRegex(name, r"(?i)opencv|mesa|egl|libgl\b|libGL\.|assimp|png|tiff|yaml")

    def test_is_compiled_as_our_sources_are(self):
        command = compile_command(self.build)
        self.assertIn("-ffp-contract=off", command)
        self.assertIn("-DEIGEN_MAX_ALIGN_BYTES=16", command)
        self.assertNotIn("-DGLM_FORCE_EXPLICIT_CTOR", command)
        self.assertFalse([word for word in command if word.startswith("-W")])
        self.assertIn(f"-isystem {prefix}/include/stereobench", " ".join(command))


class OtherModules(unittest.TestCase):
    def check(self, module, *arguments):
        build = build_consumer(module)
        run(build / "consumer", *arguments)
        needed = needed_by(build / "consumer")
        self.assertFalse([name for name in needed if re.search(r"OSMesa|libGL\.|libEGL", name)], "is opened at run time")
        return build, set((build / "looked_for.txt").read_text().split())

    def test_vision(self):
        _, looked_for = self.check("vision")
        self.assertFalse({"yaml-cpp", "assimp", "glm", "CLI11"} & looked_for)

    def test_worlds(self):
        _, looked_for = self.check("worlds")
        self.assertFalse({"assimp", "glm", "CLI11"} & looked_for)

    def test_renderer(self):
        build, looked_for = self.check("renderer")
        self.assertIn("-DGLM_FORCE_EXPLICIT_CTOR", compile_command(build))
        self.assertFalse({"CLI11", "nlohmann_json", "OpenSSL"} & looked_for)

    def test_harness(self):
        self.check("harness", "faults", "camera")


class Package(unittest.TestCase):
    def fails(self, module, *options, source=CONSUMERS):
        try:
            configure(module, *options, source=source)
        except AssertionError as error:
            return " ".join(str(error).split())
        self.fail("is found")

    def test_an_unknown_module_is_named(self):
        self.assertIn("no component is called 'slum', expected one of slam, vision,", self.fails("slum"))

    def test_what_is_missing_is_named(self):
        text = self.fails("worlds", "-DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON")
        self.assertIn("its module worlds needs what is missing: yaml-cpp (Debian: libyaml-cpp-dev)", text)

    def project(self, name, text):
        source = folder / name
        source.mkdir()
        (source / "CMakeLists.txt").write_text("cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES CXX)\n" + text)
        return source

    def test_an_optional_module_may_be_missing(self):
        source = self.project("optional", """
            find_package(stereobench REQUIRED COMPONENTS slam OPTIONAL_COMPONENTS worlds harness)
            message("${stereobench_slam_FOUND} ${stereobench_vision_FOUND} ${stereobench_harness_FOUND}")
            if(TARGET stereobench::worlds OR NOT TARGET stereobench::vision)
              message(FATAL_ERROR "worlds are there, or vision is not")
            endif()""")
        _, text = configure("optional", "-DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON", source=source)
        self.assertIn("TRUE TRUE FALSE", text)

    def test_all_modules_where_none_is_named(self):
        source = self.project("all", "find_package(stereobench 0.1 REQUIRED)\n" + "".join(
            f'if(NOT TARGET stereobench::{module})\nmessage(FATAL_ERROR "{module} is missing")\nendif()\n' for module in MODULES))
        configure("all", source=source)

    def test_another_version_is_refused(self):
        source = self.project("version", "find_package(stereobench 0.2 REQUIRED COMPONENTS slam)\n")
        self.assertIn("0.1.0", self.fails("version", source=source))

    def test_every_header_of_a_module_and_nothing_of_this_checkout(self):
        headers = [file for file in files_below(prefix / "include/stereobench")]
        ours = [str(path.relative_to(SOURCE)) for path in module_headers()]
        self.assertEqual(headers, sorted(ours))
        for path in prefix.rglob("*.cmake"):
            for place in (SOURCE, BUILD, "/usr/include"):
                self.assertNotIn(str(place), path.read_text(), path)

    def test_the_example_of_the_guide_is_the_one_that_is_built(self):
        page = (SOURCE / "docs/guide/installing.md").read_text()
        blocks = re.findall(r"```(?:cmake|cpp)\n(.*?)```", page, re.S)
        self.assertEqual(len(blocks), 2)
        source = folder / "guide"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(blocks[0])
        (source / "drive.cpp").write_text(blocks[1])
        build, _ = configure("guide", source=source)
        run("cmake", "--build", build)
        self.assertIn("the filter", run(one_below(build, "drive")))


if __name__ == "__main__":
    unittest.main(argv=["modules_test.py", "--verbose", *sys.argv[3:]])
