"""The same examples on every run, and no deadline, so that a slow machine changes nothing.

The last lines of a run say how many inputs were tried.
"""

import re

import pytest
from hypothesis import HealthCheck, settings

settings.register_profile(
    "reproducible",
    derandomize=True,
    deadline=None,
    max_examples=60,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
settings.load_profile("reproducible")

TRIED = "inputs tried"


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown(item):
    """Hypothesis's own count of what a test was called with; one for a test without it."""
    told = getattr(item, "hypothesis_statistics", "1 passing")
    counts = re.findall(r"(\d+) (?:passing|failing|invalid)", told)
    item.user_properties.append((TRIED, sum(map(int, counts))))


def pytest_terminal_summary(terminalreporter):
    reports = [report for each in terminalreporter.stats.values() for report in each]
    tried = [
        count
        for report in reports
        if getattr(report, "when", "") == "teardown"
        for name, count in report.user_properties
        if name == TRIED
    ]
    if tried:
        terminalreporter.write_line(f"{sum(tried)} hostile inputs tried in {len(tried)} tests")
