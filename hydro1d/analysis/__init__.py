"""What a run says: transmission, fronts, arrival, openings, energy, quantities, outcomes."""
