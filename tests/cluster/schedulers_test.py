"""The lines for GNU parallel and Snakemake of docs/guide/scale.md, run as they stand there but for a drive of six
frames, fewer seeds and fewer shards: the result is that of one process, to the byte.

usage: schedulers_test.py PROGRAM SOURCES
Exits with 77 (skipped) where one of them is not installed: apt-get install parallel snakemake.
Red where the guide's lines begin with shard 0, leave the last shard out, or merge into the folder of the shards."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

def block_with(guide, words):
    blocks = [block for block in re.findall(r"```text\n(.*?)```", guide, re.S) if words in block]
    assert len(blocks) == 1, (words, len(blocks))
    return blocks[0]


def made_small(text):
    small = re.sub(r"\b0\.\.99\b", "0..4", text)
    small = re.sub(r"\b40\b", "4", small)
    small = re.sub(r"\b41\b", "5", small)
    assert small != text
    return small


def main():
    program, sources = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    missing = [name for name in ["parallel", "snakemake"] if shutil.which(name) is None]
    if missing:
        print("skipped: not installed:", ", ".join(missing))
        return 77
    guide = (sources / "docs/guide/scale.md").read_text()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", HOME=scratch)

        def run(name, *words):
            done = subprocess.run(words, cwd=folder / name, env=environment, capture_output=True, text=True, check=False)
            assert done.returncode == 0, (words, done.stdout, done.stderr)

        for name in ["serial", "parallel", "snakemake"]:
            (folder / name).mkdir()
            shutil.copy(sources / "tests/harness/verify/bend.yaml", folder / name / "ball_circle.yaml")
        run("serial", program, "run", "ball_circle.yaml", "--seeds", "0..4", "--out", "result")
        run("parallel", "sh", "-e", "-c", made_small(block_with(guide, "parallel --joblog")))
        (folder / "snakemake/Snakefile").write_text(made_small(block_with(guide, "rule shard")))
        run("snakemake", "snakemake", "--cores", "2")
        serial = (folder / "serial/result/run.json").read_bytes()
        assert (folder / "parallel/out/ball_circle/run.json").read_bytes() == serial
        assert (folder / "snakemake/result/run.json").read_bytes() == serial
    print("GNU parallel and Snakemake give the bytes of one process")
    return 0


if __name__ == "__main__":
    sys.exit(main())
