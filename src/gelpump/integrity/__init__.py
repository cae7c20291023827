"""Checks of a finished build: its files, their conventions, and the numbers in them."""
