"""What the paper states, one finding a statement: computed here, judged by ``verdict``."""
