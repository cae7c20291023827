"""All statements of the paper, in the order of their tables."""

from gelpump.statements import beads, flows, heat, materials, tubes
from gelpump.statements.statement import Collection

statements = Collection(
    [*materials.statements, *beads.statements, *tubes.statements, *flows.statements, *heat.printed]
)
