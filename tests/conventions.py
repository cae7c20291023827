"""The public checker of CF metadata, where it can be installed."""

import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest


def require_cf(paths: Iterable[Path | str]) -> None:
    """Every dataset passes the strict checks of CF-1.11."""
    pytest.importorskip("compliance_checker", reason="cf-units has no wheels here")
    files = list(map(str, paths))
    checker = Path(sys.executable).with_name("compliance-checker")
    result = subprocess.run(
        [checker, "--test=cf:1.11", "--criteria=strict", *files],
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 0, result.stdout[-4000:] + result.stderr[-2000:]
    assert result.stdout.count("All tests passed!") == len(files), result.stdout[-4000:]
