"""What the paper states, what was computed of it, and the one status that follows.

A statement is a function of the ``Evidence`` whose docstring says it; it is written in the module
of its subject, beneath a line with its id, its place and the evidence it rests on:

    @states("tc-hht", "appendix A, figure 14", "data/materials_HHT.nc: fold_temperature")
    def transition_of_hht(e):
        '''Temperature at which the HHT gel jumps (on swelling, on drying).'''
        return Computed(...)

``paper.statements`` has them in the order of the tables, ``beyond.statements`` what goes beyond the
paper; claims, ledger and figure numbers are the views of ``views`` and ``numbers``.
"""
