#!/usr/bin/env bash
# GCC 12.2 (Debian 12: g++-12 12.2.0-14+deb12u1): vectors of 64 bytes by its own extension, compiled for AVX2.
#
# Such vectors are wider than the registers. The manual says that operations are then done on parts of the vector.
# Expected: a sum of 16 floats becomes two instructions, and so, with one more each, do a comparison and a choice by
# it. Seen: the sum does, and the comparison becomes 16 comparisons of single floats, which are taken out of the
# vectors and whose answers are put together again: more than a hundred instructions. Two vectors of 32 bytes take two
# comparisons.
#
# Needs root for apt-get, an x86-64 processor, and Debian 12. Nothing that is compiled for AVX2 is run.
set -euo pipefail
[ "$(uname -m)" = x86_64 ] || { echo "skipped: no x86-64"; exit 77; }
apt-get -q -y install binutils g++-12=12.2.0-14+deb12u1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >wide.cpp <<'END'
using Wide = float __attribute__((vector_size(64)));
using Mask = int __attribute__((vector_size(64)));
using Register = float __attribute__((vector_size(32)));
using RegisterMask = int __attribute__((vector_size(32)));
extern "C" void sum(const Wide& a, const Wide& b, Wide& c) { c = a + b; }
extern "C" void less(const Wide& a, const Wide& b, Mask& c) { c = a < b; }
extern "C" void less_by_halves(const Register (&a)[2], const Register (&b)[2], RegisterMask (&c)[2]) {
  c[0] = a[0] < b[0];
  c[1] = a[1] < b[1];
}
END
g++-12 -O3 -march=x86-64-v3 -Wno-psabi -c wide.cpp -o wide.o
for name in sum less less_by_halves; do
  objdump -d --no-show-raw-insn --disassemble="$name" wide.o >text
  echo "$name: $(grep -c $'\tvaddps' text || true) sums of registers," \
       "$(grep -cE $'\tvcmp[a-z]*ps' text || true) comparisons of registers," \
       "$(grep -cE $'\tvu?comiss|\tvcmp[a-z]*ss' text || true) of numbers," \
       "$([ "$(grep -cE '^ +[0-9a-f]+:' text)" -gt 100 ] && echo more than || echo within) 100 instructions"
done | tee seen
cat >expected <<'END'
sum: 2 sums of registers, 0 comparisons of registers, 0 of numbers, within 100 instructions
less: 0 sums of registers, 0 comparisons of registers, 16 of numbers, more than 100 instructions
less_by_halves: 0 sums of registers, 2 comparisons of registers, 0 of numbers, within 100 instructions
END
diff expected seen
