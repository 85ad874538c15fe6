"""Completion in bash and zsh, with the adaptors that are installed: a test of zsh is skipped where there is none.

usage: completion_test.py BUILD_DIR SOURCE_DIR
"""

import pathlib
import shutil
import sys
import unittest

from installed import SOURCE, install, run, scratch_folder

# What readline would do with the answers: words that bash breaks at = and : are completed behind these.
BASH = r"""
source "$1"
COMP_LINE=$2 COMP_POINT=${#2}
_stereobench "$3"
printf '%s|\n' "${COMPREPLY[@]}"
"""

# zsh's own words print what they are given.
ZSH = r"""
compadd() {
    local name=$argv[-1] end=" "
    [[ " $* " == *" -S "* ]] && end=""
    local -a all=("${(@P)name}")
    for one in "$all[@]"; do print -r -- "$one$end|"; done
}
compset() { true }
_files() { print -r -- "files|" }
adaptor=$1
shift
words=("$@") CURRENT=$# PREFIX=$argv[-1]
source $adaptor
"""


def setUpModule():
    global prefix, scratch
    scratch = scratch_folder()
    prefix = install(pathlib.Path(scratch.name) / "program", "program")


def tearDownModule():
    scratch.cleanup()


class Bash(unittest.TestCase):
    def after(self, line):
        """What may follow: a blank before the bar ends the word."""
        text = run("bash", "--norc", "-c", BASH, "bash", prefix / "share/bash-completion/completions/stereobench", line,
                   prefix / "bin/stereobench", cwd="/")
        return [answer for answer in text.split("|\n") if answer]

    def test_commands(self):
        self.assertEqual(self.after("stereobench ver"), ["verify "])
        self.assertIn("run ", self.after("stereobench "))

    def test_only_what_stands_before_the_cursor_counts(self):
        """Red with the whole line in place of the part up to COMP_POINT."""
        text = run("bash", "--norc", "-c", BASH.replace("${#2}", "15"), "bash",
                   prefix / "share/bash-completion/completions/stereobench", "stereobench ver --as x", prefix / "bin/stereobench")
        self.assertEqual(text, "verify |\n")

    def test_behind_an_equals_sign_only_the_rest(self):
        """Red where candidates keep what bash has broken off."""
        self.assertEqual(self.after("stereobench run a.yaml --set identity=n"), ["none "])
        self.assertEqual(self.after("stereobench run a.yaml --set ident"), ["identity="])
        self.assertEqual(self.after("stereobench run a.yaml --filters=ek"), ["ekf "])

    def test_in_quotes_the_whole_word(self):
        self.assertEqual(self.after("stereobench run a.yaml --gate 'vision.recal"), ["vision.recall"])
        self.assertEqual(self.after("stereobench run a.yaml --set 'identity=n"), ["identity=none "])

    def test_behind_a_colon_only_the_rest(self):
        self.assertEqual(self.after("stereobench sweep a --vary seeds:ident"), ["identity="])

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.after("stereobench run "), [])
        self.assertIn("-o default", run("bash", "--norc", "-c", f"source {prefix}/share/bash-completion/completions/stereobench; "
                                                                "complete -p stereobench"))


@unittest.skipUnless(shutil.which("zsh"), "zsh is missing")
class Zsh(unittest.TestCase):
    def after(self, *words):
        text = run("zsh", "-f", "-c", ZSH, "zsh", prefix / "share/zsh/vendor-completions/_stereobench",
                   prefix / "bin/stereobench", *words)
        return text.split("|\n")[:-1]

    def test_whole_words_and_those_that_go_on(self):
        """Red where both are given to zsh alike."""
        self.assertEqual(self.after("ver"), ["verify "])
        self.assertEqual(self.after("run", "a.yaml", "--set", "ident"), ["identity="])
        self.assertEqual(self.after("run", "a.yaml", "--set", "identity=n"), ["identity=none "])

    def test_quotes_of_words_before(self):
        """Red where quotes are handed on: the program would take the rest of the word for one more."""
        self.assertEqual(self.after("run", "a.yaml", "'--filters'", "ek"), ["ekf "])

    def test_files_are_left_to_zsh(self):
        self.assertEqual(self.after("run", "a"), ["files"])


if __name__ == "__main__":
    unittest.main(argv=["completion_test.py", "--verbose", *sys.argv[3:]])
