"""Beads that separate into two phases: sharp fronts, diffuse ones, and what they rest on."""
