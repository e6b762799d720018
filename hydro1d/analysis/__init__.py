"""Results of a run: transmission, fronts, arrival, openings, energy, quantities, outcomes."""
