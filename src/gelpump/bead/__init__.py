"""Spherical beads, in the LENS and in the fully nonlinear model (section 2.1)."""
