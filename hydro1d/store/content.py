"""What stands in a file beside the records."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hydro1d.store.layout import Layout


@dataclass(frozen=True)
class Content:
    """What is known from the start."""

    layout: Layout
    deck_text: str
    resolved: dict[str, Any]
    attributes: dict[str, Any]
    created: str


@dataclass(frozen=True)
class More:
    """What is known when a file is completed."""

    attributes: dict[str, Any]
    maxima: dict[str, np.ndarray] = field(default_factory=dict)
    state: dict[str, np.ndarray] = field(default_factory=dict)
