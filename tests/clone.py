"""A copy of the project in a folder of its own, in which tests build, edit and break things."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[1]
PARTS = ("Snakefile", "CITATION.cff", "config", "profiles", "workflow", "src")


class Clone:
    """The project's files at ``path``, and snakemake run there with the quick configuration."""

    def __init__(self, path: Path):
        self.path = path
        ignored = shutil.ignore_patterns("__pycache__", "*.egg-info")
        path.mkdir(parents=True)
        for part in PARTS:
            if (PROJECT / part).is_dir():
                shutil.copytree(PROJECT / part, path / part, ignore=ignored)
            else:
                shutil.copy2(PROJECT / part, path / part)

    def command(self, *arguments: str, config: str = "config/quick.yaml") -> list[str]:
        run = [sys.executable, "-m", "snakemake", "--cores", "2", *arguments]
        return [*run, "--configfile", config]

    def environment(self) -> dict[str, str]:
        # the clone's own package, not the installed one
        return os.environ | {"PYTHONPATH": str(self.path / "src"), "OMP_NUM_THREADS": "1"}

    def snakemake(self, *arguments: str, config: str = "config/quick.yaml"):
        return subprocess.run(
            self.command(*arguments, config=config),
            cwd=self.path,
            env=self.environment(),
            capture_output=True,
            text=True,
            timeout=1200,  # a build that hangs
            check=False,
        )

    def rules(self, *targets: str) -> set[str]:
        """Names of the rules that a run would execute."""
        result = self.snakemake("--dry-run", *targets)
        assert result.returncode == 0, result.stdout + result.stderr
        lines = (result.stdout + result.stderr).splitlines()
        named = [line.split()[-1].rstrip(":") for line in lines if line.startswith("rule ")]
        named += [line.split()[-1].rstrip(":") for line in lines if line.startswith("localrule ")]
        return set(named) - {"all"}
