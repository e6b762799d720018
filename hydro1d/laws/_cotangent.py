"""The cotangent by arithmetic alone: unlike the library's, a loop over many zones takes it many at a time."""

from __future__ import annotations


def cotangent(angle: float) -> tuple[float, float]:
    """cot φ and csc² φ = 1 + cot² φ for 0 < φ < π/2, to 3e-16 of csc φ.

    With h = φ/2 and P(h²) = h cot h, cot φ = (P/h − h/P)/2 and csc φ = (P/h + h/P)/2 share one division. P interpolates in
    the Chebyshev points of [0, (π/4)²]; its error is 1e-17.
    """
    half = 0.5 * angle
    u = half * half
    p = -2.103414238923041e-08 - 3.0998927871139093e-09 * u
    p = -2.201411401407174e-07 + u * p
    p = -2.1640110933684253e-06 + u * p
    p = -2.1377907019826758e-05 + u * p
    p = -2.1164019369096154e-04 + u * p
    p = -0.0021164021181135756 + u * p
    p = -0.022222222222139498 + u * p
    p = -0.33333333333333487 + u * p
    p = 1.0 + u * p
    scale = 0.5 / (half * p)
    cosecant = (p * p + u) * scale
    return (p * p - u) * scale, cosecant * cosecant
