"""The page as a file: everything is on it, nothing is broken, and it is the same each time."""

import html
import json
import re

import pytest

from gelpump.report import markup
from gelpump.report.notation import from_plain, plain


@pytest.fixture(scope="module")
def text(page):
    return page.read_text(encoding="utf-8")


def without_data(text):
    return re.sub(
        r"<script.*?</script>|<style.*?</style>|data:image[^\"]*", "", text, flags=re.DOTALL
    )


def test_every_claim_and_disagreement_is_on_it(text, built):
    results = built.path / "results"
    for claim in json.loads((results / "claims.json").read_text()):
        row = text[text.index(f'id="claim-{claim["id"]}" data-status="{claim["status"]}"') :]
        row = row[: row.index("</tr>")]
        assert html.escape(claim["evidence"]) in row
        assert markup.html(from_plain(claim["statement"])) in row
    for entry in json.loads((results / "ledger.json").read_text()):
        assert f'id="ledger-{entry["id"]}"' in text
        assert entry["code"] in text


def test_it_is_small_and_complete(page, text):
    assert page.stat().st_size <= 8e6
    visible = without_data(text)
    for word in ("NaN", "undefined", ">None<", "nan ", "{%"):
        assert word not in visible, word
    assert not re.findall(r'(?:src|href)="https?:', visible)
    assert visible.count("<img ") == 22


def test_links_lead_somewhere(page, text):
    visible = without_data(text)
    ids = set(re.findall(r'\bid="([^"]+)"', visible))
    for link in re.findall(r'href="([^"]+)"', visible):
        if link.startswith("#"):
            assert link[1:] in ids, link
        elif not link.startswith("data:"):
            assert (page.parent / link).exists(), link


def test_it_is_the_same_each_time(page, text, built):
    result = built.snakemake("report_page", "--force")
    assert result.returncode == 0, result.stdout + result.stderr
    assert page.read_text(encoding="utf-8") == text
    # other tests share the build: its manifest must not be older than the page
    assert built.snakemake().returncode == 0


def test_text_is_escaped():
    assert markup.html(from_plain("a < b & <script>")) == "a &lt; b &amp; &lt;script&gt;"


@pytest.mark.parametrize(
    ("statement", "latex"),
    [
        ("Phi_1 at Z_C", r"\Phi_{1} at Z_{C}"),
        ("(1-ell)^-1.18", r"(1-\ell)^{-1.18}"),
        ("tau = 1e-4", r"\tau = 10^{-4}"),
        ("V_max", r"V_{\mathrm{max}}"),
        ("Pi~ and Phi_inf", r"\tilde{\Pi} and \Phi_{\infty}"),
        ("phi_0 -> 0", r"\phi_{0} → 0"),
        ("materials_ANB.nc and epsilon", "materials_ANB.nc and epsilon"),
    ],
)
def test_plain_statements_become_mathematics(statement, latex):
    assert plain(from_plain(statement)) == latex


def test_numbers_are_set_with_their_signs():
    assert markup.number("-2 ± 9e-16") == "−2\u00a0±\u00a09×10⁻¹⁶"
