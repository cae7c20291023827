"""Snakemake's executor for one machine, whose Python scripts are forked from one interpreter."""

import json
import os
import socket
import subprocess
import sys
from contextlib import nullcontext, suppress
from dataclasses import dataclass, field
from pathlib import Path

from snakemake.benchmark import benchmarked
from snakemake.exceptions import WorkflowError
from snakemake.executors import local
from snakemake.script import PythonScript
from snakemake_interface_executor_plugins.settings import ExecutorSettingsBase

common_settings = local.common_settings
FEW = 4  # jobs: to import what all need would cost more than it saves
THREADS = ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")
TEMPORARY = ("TMPDIR", "TMP", "TEMPDIR", "TEMP")
start_an_interpreter = PythonScript.execute_script


@dataclass
class ExecutorSettings(ExecutorSettingsBase):
    """What the interpreter is to have imported."""

    preload: list[str] = field(
        default_factory=list,
        metadata={"help": "modules that most scripts import", "nargs": "+"},
    )


class Executor(local.Executor):
    """As Snakemake's own, but for scripts that `_bears_a_fork`."""

    def __post_init__(self):
        super().__post_init__()
        jobs = sum(job.rule.script is not None for job in self.workflow.dag.needrun_jobs())
        self.server = None
        if sys.platform == "linux" and jobs >= FEW and self.executor_settings.preload:
            self.server = Server(self.executor_settings.preload)

            def execute_script(script, fname, edit=False):
                if _bears_a_fork(script) and not edit:
                    self.server.run(fname, script)
                else:
                    start_an_interpreter(script, fname, edit)

            PythonScript.execute_script = execute_script

    def shutdown(self):
        """Wait for what runs, then end the interpreter."""
        super().shutdown()
        self._end()

    def cancel(self):
        """The same, after an error."""
        super().cancel()
        self._end()

    def _end(self):
        PythonScript.execute_script = start_an_interpreter
        if self.server:
            self.server.end()
            self.server = None


def _bears_a_fork(script):
    """A script in this environment; numerical libraries were told of one thread when loaded."""
    elsewhere = script.conda_env or script.container_img or script.env_modules or script.shadow_dir
    own = script.resources.get("own_interpreter") or script.resources.get("shell_exec")
    return not elsewhere and not own and script.threads == 1


class Server:
    """The interpreter, and the socket on which it is asked for forks; ends when that closes."""

    def __init__(self, preload):
        self.socket, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with far:
            file = Path(__file__).with_name("server.py")  # alone: it has no need of Snakemake
            command = [sys.executable, file, str(far.fileno()), *preload]
            environment = os.environ | {f"{name}_NUM_THREADS": "1" for name in THREADS}
            self.process = subprocess.Popen(command, env=environment, pass_fds=[far.fileno()])

    def run(self, fname, script):
        """Run a script to its end; CalledProcessError if that is not a good one.

        Its process has the far end of a socket of its own: it says who it is, then its exit status,
        or nothing more if it is killed, and ends when the near end does with Snakemake.
        """
        temporary = script.resources.get("tmpdir")
        environment = dict.fromkeys(TEMPORARY, temporary) if temporary else {}
        near, far = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with near:
            with far, suppress(BrokenPipeError):
                request = json.dumps([fname, environment]).encode()
                socket.send_fds(self.socket, [request], [far.fileno()])
            process = near.recv(64)
            if not process:
                raise WorkflowError("the interpreter that scripts are forked from has ended")
            record = script.bench_record
            with nullcontext() if record is None else benchmarked(int(process), record):
                status = near.recv(64)
        if status != b"0":
            raise subprocess.CalledProcessError(int(status or -9), f"{sys.executable} {fname}")

    def end(self):
        """No more forks."""
        self.socket.close()
        self.process.wait()
