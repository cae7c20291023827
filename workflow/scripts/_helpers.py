"""What every script does around its work: log what happens, and hold its rule to its word."""

import contextlib
import json
import logging
import os
import sys
import threading
import time
import traceback
from pathlib import Path

from gelpump import progress


@contextlib.contextmanager
def job(snakemake):
    """Run the body with its output, warnings and any traceback in the rule's log file.

    The job ends with its scheduler, even if that is killed: an orphan could otherwise give its
    outdated output the name of what a later run has made.

    Gives what the job is made from, for `netcdf.write` and `figures.style.save`, and leaves it,
    with the digests of what was made, in results/provenance, under the name of the log file.

    At the end every imported gelpump module must be among the rule's inputs: otherwise an edit of
    that module would not rerun the rule.  RuntimeError if one is not.
    """
    with (
        open(snakemake.log[0], "w", encoding="utf-8") as log,
        contextlib.redirect_stdout(log),
        contextlib.redirect_stderr(log),
    ):
        watch = progress.Watch(snakemake.log[0])
        threading.Thread(target=_end_with, args=(os.getppid(), watch), daemon=True).start()
        logging.basicConfig(stream=log, level=logging.INFO, format="%(levelname)s %(message)s")
        logging.captureWarnings(True)
        try:
            provenance = _provenance(snakemake)
            yield provenance
            _require_declared(snakemake.input.src)
            if snakemake.output:
                _leave_record(provenance.record(snakemake.output), Path(snakemake.log[0]))
        except SystemExit:  # a refusal in words, which Python prints
            raise
        except BaseException:
            traceback.print_exc()
            raise
        finally:
            watch.end()


def _end_with(scheduler, watch):
    while os.getppid() == scheduler:
        watch.write()
        time.sleep(0.1)
    os._exit(1)


def _provenance(snakemake):
    from gelpump.provenance import Provenance, digest, file_digests

    code = set(snakemake.input.src)
    script = Path(snakemake.scriptdir).resolve() / f"{snakemake.rule}.py"
    return Provenance(
        rule=snakemake.rule,
        wildcards=dict(snakemake.wildcards.items()),
        code=file_digests(code | {script.relative_to(Path.cwd().resolve()).as_posix()}),
        inputs=file_digests(set(snakemake.input) - code),
        config=digest(dict(snakemake.params.items())),
    )


def _leave_record(record, log):
    logs = Path("results/logs")
    path = logs.with_name("provenance") / log.relative_to(logs).with_suffix(".json")
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_name(f".{path.name}.partial")
    partial.write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    partial.replace(path)


def _require_declared(declared):
    imported = {
        Path(module.__file__).resolve()
        for name, module in list(sys.modules.items())
        if name.partition(".")[0] == "gelpump" and getattr(module, "__file__", None)
    }
    missing = imported - {Path(file).resolve() for file in declared}
    if missing:
        raise RuntimeError(
            "imported, but not among the modules that the rule declares: "
            + ", ".join(sorted(map(str, missing)))
        )
