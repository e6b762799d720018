"""Yes/no outcomes of a run by name: ``enhanced``, ``fully_crushed``, ``separated``, ``support_peak > 2 MPa``."""

import math
import operator
import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

from hydro1d.analysis.quantity import Quantity, applied_peak, parse_quantity, quantity_names, support_side
from hydro1d.components.units import convert, plain
from hydro1d.deck import Deck
from hydro1d.deck.messages import suggestion
from hydro1d.errors import DeckError
from hydro1d.store import Run

WORDS = ("enhanced", "fully_crushed", "separated")
_COMPARISON = re.compile(r"\s*(?P<quantity>[^<>=]+?)\s*(?P<sign>>=|<=|>|<)\s*(?P<value>[^<>=]+?)\s*")
_SIGNS: dict[str, Callable[[float, float], bool]] = {
    ">": operator.gt,
    ">=": operator.ge,
    "<": operator.lt,
    "<=": operator.le,
}
_GROWING = {
    "peak_support_stress": "peak_{side}_stress",
    "support_peak": "peak_{side}_stress",
    "peak_stress": "peak_stress",
}


class Outcome(NamedTuple):
    """An outcome: `quantity` compared with `bound` (SI). `text` is how it was written."""

    text: str
    quantity: Quantity
    sign: str
    bound: float

    def holds(self, value: float) -> bool:
        """Whether a value of the quantity means yes; NaN means no."""
        return not math.isnan(value) and _SIGNS[self.sign](value, self.bound)

    def of(self, run: Run, deck: Deck) -> bool:
        """Whether a run shows the outcome."""
        return self.holds(self.quantity.take(run, deck))

    def settled(self, deck: Deck) -> Callable[[Mapping[str, float]], bool] | None:
        """Test of a history row that is true once the outcome can no longer change to no; None if it always can.

        Peaks only grow, and a zone once crushed stays crushed, so these can end a run early and not change its answer.
        """
        name, bound = self.quantity.name, self.bound
        fixed = all(math.isfinite(layer.law.crushed_strain) for layer in deck.layers)
        if name == "fully_crushed" and fixed:
            return lambda row: row["uncrushed_fraction"] <= 0.0
        if name == "uncrushed_fraction" and self.sign in ("<", "<=") and fixed:
            return lambda row: self.holds(row["uncrushed_fraction"])
        if name == "enhanced":
            name, bound = "peak_support_stress", applied_peak(deck)
        elif name == "enhancement":
            name, bound = "peak_support_stress", bound * applied_peak(deck)
        if name in _GROWING and self.sign in (">", ">="):
            column = _GROWING[name].format(side=support_side(deck))
            return lambda row: _SIGNS[self.sign](row[column], bound)
        return None

    def check(self, deck: Deck) -> None:
        """Raise DeckError where the deck can never show the outcome."""
        if self.quantity.name in ("enhanced", "enhancement") and applied_peak(deck) <= 0.0:
            raise DeckError(f"{self.text}: no pressure is applied in this deck; use support_peak > VALUE")
        loose = any(hasattr(end, "mass") or not getattr(end, "bonded", True) for end in (deck.left, deck.right))
        if self.quantity.name == "separated" and not loose:
            raise DeckError(f"{self.text}: this deck has neither a striker nor a wall with bonded = false")


def parse_outcome(text: str) -> Outcome:
    """The outcome that ``text`` names. Raises DeckError for one that there is not."""
    word = str(text)[:200].strip()
    if word in WORDS:
        return Outcome(word, parse_quantity(word), ">", 0.5)
    match = _COMPARISON.fullmatch(word)
    allowed = f"{', '.join(WORDS)}, or QUANTITY > VALUE with >, >=, < or <="
    if match is None:
        near = suggestion(word, [*WORDS, *quantity_names()])
        raise DeckError(f"{word[:80]!r} is not an outcome{near}; allowed: {allowed}")
    try:
        quantity = parse_quantity(match["quantity"])
        return Outcome(word, quantity, match["sign"], convert(plain(match["value"]), quantity.units))
    except ValueError as error:
        raise DeckError(f"{word[:80]!r} is not an outcome: {error}") from None
