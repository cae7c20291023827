import pytest

pytest.importorskip("skfem", reason="the two-dimensional truth needs requirements-truth.txt")
