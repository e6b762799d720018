"""A column, its state, and the run through its output times."""
