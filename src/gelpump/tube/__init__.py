"""Tubes that collapse: uniformly, or behind a pulse of heat that pumps water (section 3)."""
