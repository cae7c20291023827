"""Figures of the paper: one module each, which draws datasets and solves nothing."""
