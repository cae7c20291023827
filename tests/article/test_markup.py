"""Text and mathematics of the article, and the bytes of its PDF."""

import pytest

from gelpump.article.markup import mathematics, runs, typographic
from gelpump.article.telling import extent, listed
from gelpump.report.notation import from_plain
from gelpump.report.records import Claim, Disagreement, Figure


def figure(statuses, ledger=()):
    claims = [Claim(n, "", "", [], "", "", [], None, s, "") for n, s in enumerate(statuses)]
    ledger = [Disagreement("", "", [], [], [], "", "", each, "", "") for each in ledger]
    return Figure("fig03", 3, "", "", [], [], {}, None, claims, ledger)


@pytest.mark.parametrize(
    ("latex", "typst"),
    [
        (r"\phi_{0}", "φ_(0)"),
        (r"\tilde{\Pi}", "tilde(Π)"),
        (r"\Phi^{-1/3}", r"Φ^(−1\/3)"),
        (r"t_{\mathrm{BMJ}}", 't_(upright("BMJ"))'),
        (r"1.5\times 10^{-4}", "1.5× 10^(−4)"),
    ],
)
def test_mathematics(latex, typst):
    assert mathematics(latex) == typst


def test_unknown_mathematics_is_refused():
    with pytest.raises(ValueError, match="frac"):
        mathematics(r"\frac{1}{2}")
    with pytest.raises(ValueError, match="cannot set"):
        mathematics("a & b")


def test_text_is_set_as_a_printer_does():
    assert typographic('the "drying" bead\'s') == "the “drying” bead’s"
    assert ["math", "Φ_(1)"] in runs(from_plain("Phi_1 at Z_C"))


def test_enumerations():
    assert listed([]) == "none"
    assert listed([3]) == "3"
    assert listed([3, 4, 9]) == "3, 4 and 9"


@pytest.mark.parametrize(
    ("statuses", "found", "expected"),
    [
        (["reproduced", "qualitative"], [], "fully"),
        (["reproduced"], ["misprint"], "partly"),
        (["reproduced", "identity"], [], "fully"),
        (["reproduced", "deviates"], [], "partly"),
        (["deviates"], [], "not"),
        (["qualitative"], [], "nothing to compare"),
        ([], [], "nothing to compare"),
    ],
)
def test_the_extent_follows_from_the_verdicts(statuses, found, expected):
    assert extent(figure(statuses, found)) == expected
