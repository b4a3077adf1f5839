"""What the same error costs: times read off curves of error against time, and ratios of two such times."""
import math
import statistics


def time_of(curve, error):
    """When a curve, (seconds, error) by rising seconds, first comes down to an error, and whether that is before its
    first point or after its last: there noise is taken to be all, which goes as 1 / seconds.

    Between points the curve is straight on logarithmic axes.
    """
    seconds, first = curve[0]
    if first <= error:
        return seconds * first / error, first < error
    for (t0, e0), (t1, e1) in zip(curve, curve[1:]):
        if e1 <= error:  # and e0 > error
            return t0 * (t1 / t0) ** (math.log(e0 / error) / math.log(e0 / e1)), False
    seconds, lowest = min(curve, key=lambda point: point[1])
    return seconds * lowest / error, True


def ratio_of(before, after):
    """The time of one curve over that of another, at the lowest error that both reach, and whether one of the times
    lies outside of its curve.

    Where both programs make the same pictures, pass by pass, and one is slower, that error is the end of the slower
    curve, and a point of the other wherever passes fall alike: the noise of errors has no part in the ratio.
    """
    before, after = sorted(before), sorted(after)
    error = max(min(e for _, e in curve) for curve in (before, after))
    (slow, slow_outside), (quick, quick_outside) = time_of(before, error), time_of(after, error)
    return slow / quick, slow_outside or quick_outside


def geometric_means(ratios):
    """The geometric mean over scenes of each pair, of lists of ratios, one for each scene."""
    return [statistics.geometric_mean(of_pair) for of_pair in zip(*ratios)]
