#!/usr/bin/env bash
# SciPy 1.10.1 (Debian 12: python3-scipy 1.10.1-2): cKDTree.query_ball_point() with eps, as a quicker gather of photons.
#
# Expected: an approximate search of a ball misses some of its points, so that with eps the answer is a part of the exact
# one, as query() with eps returns no fewer than k. Seen: it misses some and adds more. Whole boxes are taken in that end
# within r (1 + eps), and left out that begin beyond r / (1 + eps): of even points with eps = 1 a sixth of the ball is
# missing, and twice as many come back, up to 1.8 r away; with eps = 3 sixteen times as many. A density estimate by
# 4/3 pi r^3 is too large by that factor. The documentation says so of boxes; what it makes of the count has to be tried.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-scipy=1.10.1-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
/usr/bin/python3 - <<'END' | tee /dev/stderr | grep -c "as before" >/dev/null
import numpy
from scipy.spatial import cKDTree

points = numpy.random.default_rng(1).random((100_000, 3))
tree, centre, radius = cKDTree(points), numpy.full(3, 0.5), 0.1
exact = set(tree.query_ball_point(centre, radius))
good = True
for eps, times in ((0.5, 1.1), (1.0, 1.7), (3.0, 10.0)):
    found = set(tree.query_ball_point(centre, radius, eps=eps))
    farthest = numpy.linalg.norm(points[list(found)] - centre, axis=1).max() / radius
    print(f"eps {eps}: {len(exact - found)} missed, {len(found) / len(exact):.1f} times as many, up to {farthest:.1f} r")
    good &= len(found) > times * len(exact) and 1.0 < farthest <= 1.0 + eps and (eps > 1.0 or not exact <= found)
print("as before" if good else "another behaviour")
END
