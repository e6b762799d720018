"""The deck, the input of a run. `load_deck` reads one, `Deck` builds one in Python, with the same checks."""

from hydro1d.deck.load import load_deck
from hydro1d.deck.model import Deck
from hydro1d.deck.parts import Checkpoint, Layer, Output, Time
from hydro1d.deck.schema import deck_schema

__all__ = ["Checkpoint", "Deck", "Layer", "Output", "Time", "deck_schema", "load_deck"]
