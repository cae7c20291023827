"""Thousands of tubes at once: sampled, solved in chunks, combined into one dataset."""
