"""Samples every Python process whose PYTHONPATH holds this folder; see `benchmarks.profile`.

Python imports this module by its name before anything else.  Every few milliseconds of CPU time the
stack of the main thread is given the CPU time of the process since the last sample: a long call
into C is one heavy sample of the Python function that made it.  What was gathered is left in the
folder that GELPUMP_PROFILE names when the process ends.
"""

import atexit
import json
import os
import resource
import signal
import sys
import time

INTERVAL = 0.004  # s of CPU time; the kernel's clock does not tick much faster


def _begin(folder: str) -> None:
    start = latest = time.process_time()  # all of it was the interpreter's own start
    born, process, sampling, told = time.monotonic(), os.getpid(), 0.0, False
    seconds: dict[tuple[str, ...], float] = {}

    def sample(_, frame):
        nonlocal latest, sampling
        now = time.process_time()
        stack = []
        while frame is not None:
            stack.append(f"{frame.f_code.co_filename}:{frame.f_code.co_name}")
            frame = frame.f_back
        key = tuple(reversed(stack))
        seconds[key] = seconds.get(key, 0.0) + now - latest
        latest = time.process_time()
        sampling += latest - now

    def leave():
        nonlocal told
        if told or os.getpid() != process:  # of a fork, its parent tells
            return
        told = True
        signal.setitimer(signal.ITIMER_PROF, 0)
        sample(None, None)
        stacks = json.dumps([[list(stack), spent] for stack, spent in seconds.items()])
        record = {
            "command": sys.argv,
            "start": start,
            "sampling": sampling + time.process_time() - latest,
            "seconds": time.process_time(),
            "wall": time.monotonic() - born,
            "memory_mb": _peak(),
        }
        with open(os.path.join(folder, f"{process}.json"), "w", encoding="utf-8") as file:
            file.write(f'{json.dumps(record)[:-1]}, "stacks": {stacks}}}')

    exit_now = os._exit

    def leave_now(status):
        leave()
        exit_now(status)

    os._exit = leave_now  # which calls no exit handlers
    atexit.register(leave)
    signal.signal(signal.SIGPROF, sample)
    signal.setitimer(signal.ITIMER_PROF, INTERVAL, INTERVAL)


def _peak() -> float:
    """Peak memory in MB; Linux tells that of a process apart from that of who started it."""
    try:
        with open("/proc/self/status", encoding="ascii") as file:
            peak = next(line for line in file if line.startswith("VmHWM"))
        return int(peak.split()[1]) / 1024
    except OSError:
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024


if "GELPUMP_PROFILE" in os.environ:
    _begin(os.environ["GELPUMP_PROFILE"])
