"""A sweep on a real SLURM of two nodes, one of which dies midway, is the local one bit for bit.

    python tests/slurm/run.py

needs root, Debian's slurm-wlm and munge, and workflow/profiles/slurm/requirements.txt, which
`--install` gets where it can. Says 'skipped: reason' and ends with 0 where they are missing. The
cluster is bound to loopback, has its configuration in a folder of its own, and is gone at the end,
also if the test is terminated. It takes a minute on a quiet machine and ends after LIMIT at the
latest.
"""

import contextlib
import importlib.util
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clone import Clone

HERE = Path(__file__).resolve().parent
TOOLS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol")
LIMIT = 600  # seconds, of which all but the last 30 may be spent on sweeps
INSTALLING = 120  # seconds
PREFIX = "gelpump-slurm-"
# the executor takes SLURM_CONF out of the environment of a job before it calls srun
SYSTEM = Path("/etc/slurm/slurm.conf")
CONFIG = """
ClusterName=gelpump
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=10
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
MessageTimeout=5
KillWait=2
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={port_1} CPUs=1 RealMemory=2000
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={port_2} CPUs=1 RealMemory=2000
PartitionName=work Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing() -> str:
    """Why the test cannot run here, or nothing."""
    if os.geteuid() != 0:
        return "not root"
    absent = [tool for tool in TOOLS if shutil.which(tool) is None]
    if absent:
        return f"no {', '.join(absent)} (apt-get install slurm-wlm munge)"
    if importlib.util.find_spec("snakemake_executor_plugin_slurm") is None:
        return "no executor (pip install -r workflow/profiles/slurm/requirements.txt)"
    if SYSTEM.is_symlink() and PREFIX in os.readlink(SYSTEM) and not SYSTEM.exists():
        SYSTEM.unlink()  # of an earlier run that was killed
    if SYSTEM.exists() or SYSTEM.is_symlink():
        return f"{SYSTEM} exists: a cluster is configured on this machine"
    return ""


def install() -> None:
    """What is missing, from Debian and from PyPI, if they can be reached; `missing` looks again."""
    requirements = Path(__file__).parents[2] / "workflow/profiles/slurm/requirements.txt"
    for command in (
        ["apt-get", "update", "-qq"],
        ["apt-get", "install", "-y", "-qq", "--no-install-recommends", "slurm-wlm", "munge"],
        [sys.executable, "-m", "pip", "install", "-q", "-r", str(requirements)],
    ):
        try:
            subprocess.run(
                command,
                env=os.environ | {"DEBIAN_FRONTEND": "noninteractive"},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=INSTALLING,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired) as problem:
            print(f"{command[0]}: {problem}")
    importlib.invalidate_caches()


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class Cluster:
    """munged, slurmctld and two slurmd of this machine."""

    def __init__(self, folder: Path):
        self.folder = folder
        for name in ("state", "n1", "n2"):
            (folder / name).mkdir()
        ports = dict(zip(("port", "port_1", "port_2"), free_ports(3), strict=True))
        host = socket.gethostname().partition(".")[0]
        self.config = folder / "slurm.conf"
        self.config.write_text(CONFIG.format(host=host, folder=folder, **ports))
        self.environment = os.environ | {"SLURM_CONF": str(self.config)}
        SYSTEM.parent.mkdir(exist_ok=True)
        SYSTEM.symlink_to(self.config)

    def start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        names = {"key": "key", "pid": "pid", "log": "log", "seed": "seed"}
        files = [f"--{n}-file={self.folder}/munge.{ending}" for n, ending in names.items()]
        self.run("munged", "--force", "-S", f"{self.folder}/munge.socket", *files)
        self.run("slurmctld", "-f", str(self.config))
        for node in ("n1", "n2"):
            self.run("slurmd", "-N", node, "-f", str(self.config))
        for _ in range(60):
            if self.run("sinfo", "-h", "-N", "-o", "%T").split() == ["idle", "idle"]:
                return
            time.sleep(0.5)
        raise RuntimeError("the nodes did not come up: " + self.run("sinfo", "-N"))

    def run(self, *command):
        done = subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=30, check=False
        )
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
        return done.stdout

    def jobs_on(self, node):
        return self.run("squeue", "-h", "-w", node, "-t", "R", "-o", "%i").split()

    def kill_node(self, node):
        """The daemon and everything it started, as if the power had failed."""
        daemon = int((self.folder / f"{node}.pid").read_text())
        jobs = self.jobs_on(node)
        doomed = [daemon]
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                try:
                    variables = (entry / "environ").read_bytes().split(b"\0")
                    command = (entry / "cmdline").read_bytes().decode()
                except OSError:
                    continue
                ours = any(f"SLURM_JOB_ID={job}".encode() in variables for job in jobs)
                on_node = f"SLURMD_NODENAME={node}".encode() in variables
                step = command.startswith("slurmstepd: [") and any(
                    f"[{job}." in command for job in jobs
                )
                if (ours and on_node) or step:
                    doomed.append(int(entry.name))
        for pid in doomed:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return jobs

    def stop(self):
        """End the daemons, and then everything else that runs from the cluster's folder."""
        SYSTEM.unlink(missing_ok=True)
        for sent in (signal.SIGTERM, signal.SIGKILL):
            for name in ("n1", "n2", "slurmctld", "munge"):
                with contextlib.suppress(OSError, ValueError):
                    os.kill(int((self.folder / f"{name}.pid").read_text()), sent)
            deadline = time.monotonic() + 5
            while self.remaining() and time.monotonic() < deadline:
                time.sleep(0.2)
        for pid in self.remaining():
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)

    def remaining(self):
        """Processes that name the cluster's folder in their command or environment."""
        found, mark = [], str(self.folder).encode()
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit() and int(entry.name) != os.getpid():
                with contextlib.suppress(OSError):
                    told = (entry / "cmdline").read_bytes() + (entry / "environ").read_bytes()
                    if mark in told:
                        found.append(int(entry.name))
        return found


def main() -> int:
    if "--install" in sys.argv[1:] and missing():
        install()
    reason = missing()
    if reason:
        print(f"skipped: {reason}")
        return 0
    # the folder goes and the daemons end even if the test is told to stop
    for each in (signal.SIGTERM, signal.SIGHUP, signal.SIGALRM):
        signal.signal(each, lambda number, _: sys.exit(f"ended by {signal.Signals(number).name}"))
    signal.alarm(LIMIT)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix=PREFIX, ignore_cleanup_errors=True) as name:
        local, remote = (Clone(Path(name) / each) for each in ("local", "remote"))
        for clone in (local, remote):
            shutil.copy(HERE / "sweep.yaml", clone.path / "config/sweeps/slurm.yaml")
        target = "results/sweeps/slurm/sweep.nc"
        here = local.snakemake(target)
        assert here.returncode == 0, here.stdout + here.stderr
        cluster = Cluster(Path(name))
        run = None
        try:
            cluster.start()
            profile = ["--profile", "workflow/profiles/slurm", "--slurm-no-account"]
            quick = ["--slurm-status-command", "squeue"]
            quick += ["--slurm-init-seconds-before-status-checks", "3", "--latency-wait", "10"]
            command = [sys.executable, "-m", "snakemake", target, *profile, *quick]
            command += ["--default-resources", "slurm_partition=work", "mem_mb=500", "runtime=10"]
            log = open(Path(name) / "snakemake.log", "w+")  # noqa: SIM115
            run = subprocess.Popen(
                command,
                cwd=remote.path,
                env=remote.environment() | {"SLURM_CONF": str(cluster.config)},
                stdout=log,
                stderr=subprocess.STDOUT,
            )
            killed = []
            chunks = remote.path / "results/sweeps/slurm/chunks"
            while run.poll() is None and time.monotonic() - start < LIMIT - 30:
                if not killed and list(chunks.glob("[0-9]*.nc")) and cluster.jobs_on("n1"):
                    killed = cluster.kill_node("n1")
                    print(f"killed node n1 with its job {', '.join(killed)}", flush=True)
                time.sleep(0.3)
            log.seek(0)
            text = log.read()
            failures = sorted((remote.path / ".snakemake/slurm_logs").rglob("*.log"))
            told = "".join(each.read_text()[-1500:] for each in failures[:2])
            assert run.poll() == 0, text[-3000:] + cluster.run("squeue") + told
            assert killed, "the sweep ended before a node could be killed"
            for path in [target, *(f"results/sweeps/slurm/chunks/{i:06d}.nc" for i in range(6))]:
                same = (local.path / path).read_bytes() == (remote.path / path).read_bytes()
                assert same, f"{path} differs from the local one"
            down = cluster.run("sinfo", "-h", "-N", "-o", "%N %T").splitlines()
            print("nodes at the end:", ", ".join(down))
        finally:
            signal.alarm(0)
            if run is not None and run.poll() is None:
                run.kill()
            cluster.stop()
            assert not cluster.remaining(), "the cluster is still there"
    print(f"passed: equal bit for bit, {time.monotonic() - start:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
