"""What a number costs: gelpump beside what one would use instead, and how the cost grows.

Outside the package and outside `rule all`: nothing here is needed for the paper.  See
`workflow/rules/performance.smk`, and `docs/performance.md`, which is made from here.
"""
