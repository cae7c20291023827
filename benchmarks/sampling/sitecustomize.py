"""Samples every Python process whose PYTHONPATH holds this folder; see `benchmarks.profile`.

Python imports this module by its name before anything else.  Every few milliseconds of CPU time the
stack of each thread is given the CPU time that the thread took since the last sample: a long call
into C is one heavy sample of the Python function that made it.  What was gathered is left in the
folder that GELPUMP_PROFILE names when the process ends.
"""

import atexit
import json
import os
import resource
import signal
import sys
import threading
import time

THREAD_START = threading.Thread.start
INTERVAL = 0.004  # s of CPU time; the kernel's clock does not tick much faster


def _begin(folder: str) -> None:
    start = latest = time.process_time()  # all of it was the interpreter's own start
    born, process, sampling = time.monotonic(), os.getpid(), 0.0
    busy = told = False
    main = threading.get_ident()
    clocks, own = {main: start}, 0.0  # CPU time of each thread when last seen; spent on seeing
    seconds: dict[tuple[str, ...], float] = {}

    def sample(_, frame):
        nonlocal latest, sampling, own, busy
        if busy:  # the next signal came before this one was done with
            return
        busy, now = True, time.process_time()
        frames = sys._current_frames() | ({main: frame} if frame else {})
        for thread, top in frames.items():
            if top.f_code.co_filename == threading.__file__:
                continue  # it waits: what it did before belongs to what it does next
            reached = time.clock_gettime(time.pthread_getcpuclockid(thread))
            spent = reached - clocks.get(thread, 0.0)
            clocks[thread] = reached
            spent = reached if spent < 0 else spent  # a new thread under an old one's name
            if thread == main:
                spent, own = spent - own, 0.0
            if spent <= 0.0:
                continue
            stack = []
            while top is not None:
                stack.append(f"{top.f_code.co_filename}:{top.f_code.co_name}")
                top = top.f_back
            key = tuple(reversed(stack))
            seconds[key] = seconds.get(key, 0.0) + spent
        latest = time.process_time()
        own += latest - now
        sampling += latest - now
        busy = False

    def leave():
        nonlocal told
        if told or os.getpid() != process:  # a fork tells of itself
            return
        told = True
        signal.setitimer(signal.ITIMER_PROF, 0)
        sample(None, None)
        seconds[()] = time.process_time() - start - sampling - sum(seconds.values())
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

    start_thread = THREAD_START

    def start_unasked(thread):
        # only the main thread answers signals, so the kernel must not send them to others
        signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGPROF])
        try:
            start_thread(thread)
        finally:
            if threading.get_ident() == main:
                signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGPROF])

    threading.Thread.start = start_unasked
    atexit.register(leave)
    os.register_at_fork(after_in_child=lambda: os.getppid() == process and _begin(folder))
    signal.signal(signal.SIGPROF, sample)
    # a thread that starts a process hands its mask on
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGPROF])
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
