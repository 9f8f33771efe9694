"""Settings of the sequential linear programming that raises the minimum scaled Jacobian."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SLPConfig:
    """Settings of the algorithm. Radii are in lengths of the shortest edge at each node, values in scaled Jacobians.

    Parameters
    ----------
    initial_radius, max_radius, min_radius : float
        Of the trust region; below the last the algorithm ends.
    accept : float
        Share of the gain promised by the models that a step must bring.
    poor, good : float
        Shares below and above which the region shrinks and grows.
    shrink, grow : float
        Factors by which the radius shrinks and grows.
    active_band, min_active_band, max_active_band : float
        Nodes at corners whose values are within a band above the least move: its width in radii, and its bounds.
    max_slope : float
        How far the value of a corner can fall while its nodes go one radius.
    initial_corners, max_corners : int
        Corners whose nodes move at first, and at most: more where fewer bring nothing.
    no_gain : float
        Predicted gain that counts as zero.
    window : int
        Steps over which the gain is judged.
    min_gain, min_gain_acceptable : float
        Gain in these steps below which the algorithm ends; the second where the least is above `acceptable`.
    promise : float
        Share of that gain per step that a program has to promise where the least is above `acceptable`; less in a small
        trust region.
    acceptable : float
        Value from which on a corner is sound, so that small gains are not worth their time.
    min_multiplier : float
        From which on a corner is active; the sum of all is 1.
    return_step, min_return_step : float
        By how many radii, in mean edge lengths, a boundary outside its band is brought nearer at a time: less where the
        program has no solution, down to the second.
    return_loss : float
        By how much the least may be lower after such a step than its models say.
    return_window, return_pace : int, float
        Steps are too slow where so many programs have not brought the excess over the band below that share of it.
    return_tolerance, band_excess : float
        Shares of the band's width by which a boundary may exceed it: where the return to it ends, and where its result
        is judged, as the last steps may keep the band to rounding errors of the linear program only.
    """

    initial_radius: float = 0.1
    max_radius: float = 0.3
    min_radius: float = 1e-6
    accept: float = 0.1
    poor: float = 0.3
    good: float = 0.7
    shrink: float = 0.4
    grow: float = 2.0
    active_band: float = 4.0
    min_active_band: float = 0.01
    max_active_band: float = 0.1
    max_slope: float = 8.0
    initial_corners: int = 300
    max_corners: int = 600
    no_gain: float = 1e-6
    window: int = 10
    min_gain: float = 2e-4
    min_gain_acceptable: float = 1e-3
    promise: float = 1.0
    acceptable: float = 0.2
    min_multiplier: float = 1e-3
    return_step: float = 0.2
    min_return_step: float = 0.005
    return_loss: float = 0.01
    return_window: int = 20
    return_pace: float = 0.9
    return_tolerance: float = 1e-6
    band_excess: float = 1e-5


SLP = SLPConfig()
