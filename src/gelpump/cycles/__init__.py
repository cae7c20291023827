"""Beads and tubes under a temperature that steps, ramps and cycles; tubes of any gel."""
