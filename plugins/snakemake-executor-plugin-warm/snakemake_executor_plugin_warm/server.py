"""The interpreter that imports once what scripts need, and then forks one process for each."""

import atexit
import gc
import importlib
import json
import os
import runpy
import signal
import socket
import sys
import threading
import traceback
from contextlib import suppress


def main(descriptor: int, modules: list[str]) -> None:
    """Fork at each request until the socket closes."""
    for module in modules:
        importlib.import_module(module)
    gc.collect()
    gc.freeze()  # a collection would write to, and so copy, the pages of all that is shared
    asked = socket.socket(fileno=descriptor)
    asked.set_inheritable(False)
    interrupt = signal.signal(signal.SIGINT, signal.SIG_IGN)  # scripts hear it, and Snakemake does
    signal.signal(signal.SIGCHLD, lambda *_: reap(os.WNOHANG))
    while True:
        request, descriptors, _, _ = socket.recv_fds(asked, 65536, 1)
        if not request:
            return reap(0)
        with socket.socket(fileno=descriptors[0]) as told:
            if os.fork() == 0:
                asked.close()
                signal.signal(signal.SIGINT, interrupt)
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                told.send(str(os.getpid()).encode())
                threading.Thread(target=end_with, args=(told,), daemon=True).start()
                status = run(*json.loads(request))
                told.send(str(status).encode())
                os._exit(status)


def reap(how: int) -> None:
    """Take note of forks that have ended: their CPU time counts with this process's."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, how)[0]:
            pass


def end_with(snakemake: socket.socket) -> None:
    """End this process when there is nobody who waits for it."""
    snakemake.recv(1)
    os._exit(1)


def run(script: str, environment: dict[str, str]) -> int:
    """Run a script as Python would; its exit status."""
    status = 0
    os.environ.update(environment)
    sys.argv, sys.path[0] = [script], os.path.dirname(script)
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        status = end.code or 0
        if not isinstance(status, int):
            print(status, file=sys.stderr)
            status = 1
    except BaseException:
        traceback.print_exc()
        status = 1
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    return status & 0xFF


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
