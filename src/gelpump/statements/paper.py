"""All statements of the paper, in the order of their tables."""

from gelpump.statements import beads, flows, materials, tubes
from gelpump.statements.statement import Collection

statements = Collection(
    [*materials.statements, *beads.statements, *tubes.statements, *flows.statements]
)
