"""The ledger: where the paper disagrees with itself or with what follows from its equations."""
