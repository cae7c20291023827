"""Statements beyond the paper: what was derived and computed here, apart from the replication.

Their ids begin with ``beyond-``, ``separation-`` or ``heat-``.  What a statement expects, from a
closed form, a limit or another solver, stands where the paper's value would: ``paper={"value": ...,
"resolution": ...}``.  A statement whose dataset is not there is left out, so that a build of the
paper alone is whole.  The datasets are listed in ``BEYOND`` of workflow/rules/statements.smk.
"""

from gelpump.statements import cycles, heat, pumping, separation, truth
from gelpump.statements.statement import Collection

statements = Collection(
    [
        *pumping.statements,
        *cycles.statements,
        *truth.statements,
        *separation.statements,
        *heat.statements,
    ]
)
