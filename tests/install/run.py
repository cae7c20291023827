"""The library as others install it: wheel and sdist, in empty environments, without Snakemake.

``python tests/install/run.py`` builds both, installs the wheel with the newest versions allowed,
the sdist with the oldest (oldest.txt), and runs smoke.py in each from an empty folder, and with the
newest the tutorial.  The plugins of Snakemake, packages of their own, are built, installed and
imported.
"""

import os
import subprocess
import sys
import tempfile
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
PROJECT = HERE.parents[1]
PLUGINS = sorted((PROJECT / "plugins").iterdir())


def run(*command: str | Path, cwd: Path) -> str:
    """Standard output of a command; SystemExit with all it said if it fails."""
    result = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    if result.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    return result.stdout


def environment(folder: Path) -> Path:
    """The interpreter of a new, empty environment."""
    venv.create(folder, with_pip=True)
    return folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def built(folder: Path) -> tuple[Path, Path, list[Path]]:
    """Wheel and sdist of the library, and the wheels of the plugins."""
    python = environment(folder / "build")
    run(python, "-m", "pip", "install", "-q", "build", cwd=folder)
    dist = folder / "dist"
    run(python, "-m", "build", "--outdir", dist, PROJECT, cwd=folder)
    for plugin in PLUGINS:
        run(python, "-m", "build", "--wheel", "--outdir", dist, plugin, cwd=folder)
    wheel, sdist = (next(dist.glob(each)) for each in ("gelpump*.whl", "gelpump*.gz"))
    return wheel, sdist, sorted(dist.glob("snakemake*.whl"))


def smoke(folder: Path, name: str, *what: str | Path) -> str:
    """What smoke.py says where ``what`` was installed."""
    python = environment(folder / name)
    run(python, "-m", "pip", "install", "-q", *what, cwd=folder)
    empty = folder / f"{name}-empty"
    empty.mkdir()
    return f"{name}: {run(python, HERE / 'smoke.py', cwd=empty).strip()}"


def tutorial(folder: Path, wheel: Path) -> str:
    """The tutorial's last line, from an empty folder, in the environment of the newest versions."""
    python = folder / "newest" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    run(python, "-m", "pip", "install", "-q", f"{wheel}[design]", cwd=folder)
    absent = "import importlib.util as u; assert u.find_spec('snakemake') is None"
    run(python, "-c", absent, cwd=folder)
    empty = folder / "tutorial-empty"
    empty.mkdir()
    return run(python, PROJECT / "docs/tutorial.py", cwd=empty).splitlines()[-1]


def main() -> None:
    """Build, install, try."""
    with tempfile.TemporaryDirectory(prefix="install-") as scratch:
        folder = Path(scratch)
        wheel, sdist, plugins = built(folder)
        print(smoke(folder, "newest", wheel), flush=True)
        print("tutorial:", tutorial(folder, wheel), flush=True)
        print(smoke(folder, "oldest", sdist, "-c", HERE / "oldest.txt"), flush=True)
        python = environment(folder / "plugins")
        run(python, "-m", "pip", "install", "-q", *plugins, cwd=folder)
        imported = "import snakemake_logger_plugin_gelpump.screen, snakemake_executor_plugin_warm"
        run(python, "-c", imported, cwd=folder)
        print("plugins:", *(plugin.name for plugin in plugins))


if __name__ == "__main__":
    sys.exit(main())
