"""The Debian packages on a bare Debian 12: installed by apt, used, and purged without a trace.

usage: bare_root_test.py BUILD_DIR SOURCE_DIR; exits with 77 (skipped) without root, debootstrap, unshare, help2man,
dpkg-shlibdeps or a mirror. STEREOBENCH_DEBIAN_MIRROR names another mirror than deb.debian.org.
"""

import os
import pathlib
import shutil
import sys
import unittest
import urllib.request

from installed import BUILD, SKIPPED, run, scratch_folder

MIRROR = os.environ.get("STEREOBENCH_DEBIAN_MIRROR", "http://deb.debian.org/debian")
NAMES = ["stereobench", "libstereobench-dev", "python3-stereobench"]
# What apt, dpkg and the linker keep of anything that is installed.
STATE = ("/var/lib/dpkg/", "/var/lib/apt/", "/var/cache/", "/var/log/", "/etc/ld.so.cache", "/tmp/", "/proc/")


def skip(why):
    print(f"{why}: skipped")
    sys.exit(SKIPPED)


if os.geteuid() != 0:
    skip("not root")
for program, package in [("debootstrap", "debootstrap"), ("unshare", "util-linux"), ("help2man", "help2man"),
                         ("dpkg-shlibdeps", "dpkg-dev"), ("file", "file")]:
    if shutil.which(program) is None:
        skip(f"{program} is missing (apt-get install {package})")
try:
    urllib.request.urlopen(f"{MIRROR}/dists/bookworm/Release", timeout=20).close()
except OSError as error:
    skip(f"no mirror of Debian: {error}")


def setUpModule():
    global root, scratch
    scratch = scratch_folder()
    folder = pathlib.Path(scratch.name)
    folder.chmod(0o755)  # apt reads packages as a user of its own
    run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", folder / "debs")
    root = folder / "root"
    run("debootstrap", "--variant=minbase", "bookworm", root, MIRROR)
    for deb in (folder / "debs").glob("*.deb"):
        shutil.copy(deb, root / "tmp")


def tearDownModule():
    scratch.cleanup()


def inside(command):
    """Runs a line of the shell in the root. What it mounts goes with it."""
    script = f"mount -t proc proc {root}/proc && exec chroot {root} /bin/bash -euc \"$1\""
    return run("unshare", "--mount", "bash", "-c", script, "bash", command,
               env={"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C.UTF-8", "HOME": "/tmp"})


def paths():
    found = set()
    for place, folders, files in os.walk(root):
        own = "/" + os.path.relpath(place, root)
        found |= {os.path.normpath(f"{own}/{name}").replace("//", "/") for name in folders + files}
    return {path for path in found if not (path + "/").startswith(STATE)}


class BareRoot(unittest.TestCase):
    def test_installs_runs_and_leaves_nothing(self):
        inside("apt-get update")
        inside("apt-get install --yes --no-install-recommends /tmp/stereobench_*.deb /tmp/python3-stereobench_*.deb")
        text = inside("cd /tmp && stereobench run /usr/share/stereobench/scenarios/ball_circle.yaml --seeds 0 "
                      "--set path.laps=0.02 --set gates=[] --filters ekf --out out && rm -r out")
        self.assertIn("recall 1.0000", text)
        self.assertIn("osmesa", inside("stereobench doctor || true"))
        inside("cd / && python3 -c 'import stereobench; from stereobench import datasets'")
        with_ours = paths()
        ours = set(inside("dpkg --listfiles stereobench python3-stereobench").split())
        self.assertIn("/usr/bin/stereobench", ours & with_ours)

        inside("apt-get purge --yes stereobench python3-stereobench")
        left = paths()
        self.assertEqual({path for path in left if "stereobench" in path}, set())
        gone = with_ours - left
        self.assertEqual(left - with_ours, set())
        self.assertEqual({path for path in gone if path not in ours and "stereobench" not in path}, set())
        self.assertNotIn("stereobench", inside("dpkg --list"))

        inside("apt-get install --yes --no-install-recommends --simulate /tmp/libstereobench-dev_*.deb")  # can be installed


if __name__ == "__main__":
    unittest.main(argv=["bare_root_test.py", "--verbose", *sys.argv[3:]])
