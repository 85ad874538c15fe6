"""A sweep in 40 shards on a Slurm of one machine, with tasks and daemons killed on the way: the result is that of
one process, to the byte, and no drive was kept twice.

usage: slurm_test.py PROGRAM SOURCES
Exits with 77 (skipped) where Slurm is not installed: apt-get install slurm-wlm munge."""
import json
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from one_machine_slurm import Slurm, missing_programs, wait_for  # noqa: E402

SHARDS = 40
KILLS = 10
PASSED_OVER = {"timing.json"}


def command_of(scenario):
    return ["sweep", scenario, "--vary", "oracle.range_sd_m=0.1,0.2,0.3,0.4", "--seeds", "0..19", "--filters",
            "ekf,ufastslam", "--set", "particles=400"]


def write_job(folder, sources, program):
    scenario = os.path.relpath(sources / "assets/scenarios/open_field.yaml", folder)
    job = folder / "job.yaml"
    job.write_text(f"""
job: field
command: {json.dumps(command_of(scenario))}
shards: {SHARDS}
out: work
program: {program}
slurm: {{cpus: 1, at_once: 2, time: "10"}}
""")
    return job


def processes_of_shards():
    """Programs that do a shard now."""
    found = []
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"--shard" in words and b"auto/%d" % SHARDS in words and words[0].endswith(b"stereobench"):
            found.append(int(entry.name))
    return found


def kill_tasks(slurm, seed):
    """Kills programs in the middle of their shards, as a machine does that goes down."""
    chance = random.Random(seed)
    kills = 0
    while kills < KILLS:
        wait_for(lambda: slurm.administer() or processes_of_shards(), "a shard runs")
        try:
            os.kill(chance.choice(processes_of_shards()), signal.SIGKILL)
            kills += 1
        except (IndexError, ProcessLookupError):
            continue  # it ended just now
        time.sleep(0.1 + 0.2 * chance.random())


def kept_drives(folder):
    keys = []
    for store in sorted(folder.glob("shards/*/unfinished.drives")):
        keys += re.findall(rb"stereobench-answer 2 ([0-9a-f]{64}) ", store.read_bytes())
    return keys


def files_of(folder):
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*")
            if file.is_file() and file.name not in PASSED_OVER}


def main():
    program, sources = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    if missing_programs():
        print("skipped: not installed:", ", ".join(missing_programs()))
        return 77
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        folder = Path(scratch)
        job = write_job(folder, sources, program)
        with Slurm(folder / "slurm") as slurm:
            def cluster(step, expected=0):
                done = slurm.run(program, "cluster", step, job, check=False)
                assert done.returncode == expected, (step, done.returncode, done.stdout, done.stderr)
                return done.stdout

            assert "40 shards are finished" not in cluster("status", 3)
            print(cluster("submit"), end="")
            again = slurm.run(program, "cluster", "submit", job, check=False)
            assert again.returncode == 2 and "was submitted before" in again.stderr, again.stderr
            wait_for(lambda: len(processes_of_shards()) == 2, "two shards run")
            slurm.kill("slurmctld")
            slurm.restart("slurmctld")
            kill_tasks(slurm, seed=1)
            slurm.kill("slurmd")
            slurm.restart("slurmd")
            wait_for(lambda: slurm.administer() or slurm.is_at_rest(), "the queue is at rest", 600)
            print(cluster("status", 3), end="")
            before = len(kept_drives(folder / "work"))
            print(cluster("resume"), end="")
            wait_for(lambda: slurm.administer() or slurm.is_at_rest(), "the queue is at rest", 600)
            print(cluster("status"), end="")
            logs = "".join(log.read_text() for log in sorted((folder / "work/logs").glob("*.txt")))
            assert (folder / "work/result/sweep.json").exists(), logs

        keys = kept_drives(folder / "work")
        print(f"{before} drives before the resume, {len(keys)} in all")
        assert len(keys) == len(set(keys)) == 80, (len(keys), len(set(keys)))
        scenario = os.path.relpath(sources / "assets/scenarios/open_field.yaml", folder)
        words = [str(program), *command_of(scenario), "--out", str(folder / "serial")]
        serial = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
        assert serial.returncode in (0, 1), serial.stderr
        expected, got = files_of(folder / "serial"), files_of(folder / "work/result")
        assert expected.keys() == got.keys(), expected.keys() ^ got.keys()
        different = [name for name in expected if expected[name] != got[name]]
        assert not different, different
    print(f"the merged result of {SHARDS} shards is the serial one, {len(expected)} files")
    return 0


if __name__ == "__main__":
    sys.exit(main())
