"""A Slurm on this machine alone, in a folder of its own: no systemd, no cgroup, no accounting."""
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "sinfo"]

CONFIGURATION = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
ReturnToService=2
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing_programs():
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    return [name for name in PROGRAMS if shutil.which(name, path=path) is None]


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Slurm:
    """Up while a `with` block runs; `environment` is what its clients need."""

    def __init__(self, folder, cpus=2):
        self.folder = Path(folder)
        for name in ["state", "spool", "munge"]:
            (self.folder / name).mkdir(parents=True)
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname().split(".")[0], folder=self.folder, user=user, cpus=cpus,
            controller_port=free_port(), node_port=free_port()))
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"),
                                PATH=os.environ["PATH"] + ":/usr/sbin:/sbin")

    def run(self, *words, check=True):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=check)

    def __enter__(self):
        munge = self.folder / "munge"
        munge.chmod(0o711)
        (munge / "key").write_bytes(os.urandom(128))
        (munge / "key").chmod(0o400)
        self.run("munged", "--force", f"--key-file={munge}/key", f"--socket={munge}/socket",
                 f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        self.run("slurmctld", "-c", "-i")
        self.run("slurmd", "-c")
        self.wait_until_up()
        return self

    def wait_until_up(self):
        wait_for(lambda: self.run("sinfo", "-h", "-o", "%T", check=False).stdout.startswith(("idle", "mix", "alloc")),
                 "the node is up")

    def pid(self, daemon):
        return int((self.folder / f"{daemon}.pid").read_text())

    def kill(self, daemon):
        """As the kernel does when memory is short. The controller is killed when it has just written down its jobs,
        which it does some seconds after a change: what it started since, it would not know of."""
        if daemon == "slurmctld":
            state = self.folder / "state/job_state"
            before = state.stat().st_mtime_ns if state.exists() else 0
            wait_for(lambda: state.exists() and state.stat().st_mtime_ns != before, "the controller writes its state")
        process = self.pid(daemon)
        os.kill(process, signal.SIGKILL)
        wait_for(lambda: not Path(f"/proc/{process}/exe").exists(), f"{daemon} is gone")

    def restart(self, daemon):
        self.run(*([daemon, "-i"] if daemon == "slurmctld" else [daemon]))
        self.wait_until_up()

    def administer(self):
        """What an administrator does where a controller that was killed had not yet written down what it started:
        it starts the same job again, and takes the node out of service, as that runs the job already."""
        if "drain" in self.run("sinfo", "-h", "-o", "%T", check=False).stdout:
            self.run("scontrol", "update", f"nodename={socket.gethostname().split('.')[0]}", "state=resume", check=False)

    def is_at_rest(self):
        """Whether nothing runs or will: the queue is empty, or waits for tasks that are held, as the node daemon was
        killed while they were launched."""
        answer = self.run("squeue", "-h", "-r", "-o", "%r", check=False)
        reasons = answer.stdout.splitlines()
        held = [reason for reason in reasons if reason.startswith("launch failed")]
        waiting = held and reasons.count("Dependency") + len(held) == len(reasons)
        return answer.returncode == 0 and (waiting or not reasons)

    def __exit__(self, *_):
        self.run("scancel", "--user", str(os.getuid()), check=False)
        for daemon in ["slurmd", "slurmctld"]:
            try:
                os.kill(self.pid(daemon), signal.SIGTERM)
            except (OSError, ValueError):
                pass
        self.run("pkill", "-f", f"munged.*{self.folder}", check=False)


def wait_for(condition, what, seconds=180):
    until = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > until:
            raise AssertionError(f"did not come true in {seconds} s: {what}")
        time.sleep(0.1)
