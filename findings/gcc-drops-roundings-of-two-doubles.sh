#!/usr/bin/env bash
# GCC (Debian 12: g++-12 12.2.0-14+deb12u1, g++-11 11.3.0-12) on x86-64: a struct of two doubles, each of which is rounded
# to float by a cast.
#
# Expected: 0.1 becomes 0.100000001490116 at every level of optimisation, as no flag allows less exact arithmetic. Seen:
# from -O2 on (g++-11: -O3) the casts have no effect where the two doubles are made side by side: the superword
# vectorizer turns them into a conversion of a pair and back, and that is then left out altogether, -frounding-math or
# not. One double alone, a loop, and stores through a pointer are rounded. -fno-tree-slp-vectorize keeps the rounding,
# as does clang++-14. Code that rounds coordinates to single precision on purpose, to compare them with stored ones, so
# finds differences that depend on the flags.
#
# Needs root for apt-get, and Debian 12 on x86-64.
set -euo pipefail
apt-get -q -y install --no-install-recommends g++-12=12.2.0-14+deb12u1 g++-11=11.3.0-12 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >pair.cpp <<'END'
#include <cstdio>

struct Pair {
  double a, b;
};

__attribute__((noinline)) Pair rounded(const Pair& p) { return {static_cast<float>(p.a), static_cast<float>(p.b)}; }
__attribute__((noinline)) double rounded(double x) { return static_cast<float>(x); }

int main() {
  volatile double tenth = 0.1;
  const Pair pair = rounded(Pair{tenth, tenth});
  std::printf("two %.15f %.15f, one %.15f\n", pair.a, pair.b, rounded(tenth));
}
END
for compiler in g++-11 g++-12; do
  for flags in -O1 -O2 -O3 "-O3 -frounding-math" "-O3 -fno-tree-slp-vectorize"; do
    "$compiler" -std=c++17 $flags pair.cpp -o pair
    echo "$compiler $flags: $(./pair)"
  done
done | tee seen
diff - seen <<'END'
g++-11 -O1: two 0.100000001490116 0.100000001490116, one 0.100000001490116
g++-11 -O2: two 0.100000001490116 0.100000001490116, one 0.100000001490116
g++-11 -O3: two 0.100000000000000 0.100000000000000, one 0.100000001490116
g++-11 -O3 -frounding-math: two 0.100000000000000 0.100000000000000, one 0.100000001490116
g++-11 -O3 -fno-tree-slp-vectorize: two 0.100000001490116 0.100000001490116, one 0.100000001490116
g++-12 -O1: two 0.100000001490116 0.100000001490116, one 0.100000001490116
g++-12 -O2: two 0.100000000000000 0.100000000000000, one 0.100000001490116
g++-12 -O3: two 0.100000000000000 0.100000000000000, one 0.100000001490116
g++-12 -O3 -frounding-math: two 0.100000000000000 0.100000000000000, one 0.100000001490116
g++-12 -O3 -fno-tree-slp-vectorize: two 0.100000001490116 0.100000001490116, one 0.100000001490116
END
echo "as before"
