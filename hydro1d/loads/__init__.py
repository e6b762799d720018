"""Pressure pulses: one a file; the file's name is the word that stands in a deck."""
