#!/usr/bin/env bash
# Highway 1.0.3 (Debian 12: libhwy-dev 1.0.3-3+deb12u1): the vectors that code gets without choosing at run time.
#
# Expected of g++ -march=x86-64-v3 vectors of 8 floats, of -march=x86-64-v4 vectors of 16, as those levels have AVX2 and
# AVX-512; at the least SSE4 of both, and the same of x86-64-v2. Seen: SSSE3 with 4 floats at all three levels, and with
# -march=haswell, without a warning. Highway's targets from SSE4 on also require AES and PCLMUL, which no level of the
# x86-64 ABI has; with -maes -mpclmul there are 8 and 16 lanes. So a program that is compiled for a level runs a quarter
# as wide as its processor and its flags allow.
#
# Needs root for apt-get, an x86-64 processor, and Debian 12. Nothing that is compiled for AVX is run.
set -euo pipefail
[ "$(uname -m)" = x86_64 ] || { echo "skipped: no x86-64"; exit 77; }
apt-get -q -y install g++ libhwy-dev=1.0.3-3+deb12u1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >target.cpp <<'END'
#include <hwy/highway.h>
// The preprocessor's and the compiler's answers, as text of the object file: HWY_LANES of float is a constant here.
static_assert(HWY_MAX_BYTES % sizeof(float) == 0);
template <int lanes> struct Lanes;
template <int target> struct Target;
Lanes<HWY_MAX_BYTES / sizeof(float)>* lanes_of_float;
Target<HWY_STATIC_TARGET == HWY_SSSE3 ? 3 : HWY_STATIC_TARGET == HWY_SSE4 ? 4 : HWY_STATIC_TARGET == HWY_AVX2 ? 256
       : HWY_STATIC_TARGET == HWY_AVX3 ? 512 : 0>* target;
int say(decltype(lanes_of_float), decltype(target)) { return 0; }
END
for flags in -march=x86-64-v2 -march=x86-64-v3 -march=haswell -march=x86-64-v4 "-march=x86-64-v3 -maes -mpclmul" \
             "-march=x86-64-v4 -maes -mpclmul"; do
  # shellcheck disable=SC2086
  g++ -std=c++17 $flags -c target.cpp -o target.o
  echo "$flags: $(nm -C target.o | sed -n 's/.* T say(Lanes<\(.*\)>\*, Target<\(.*\)>\*)/\1 floats, target \2/p')"
done | tee seen
cat >expected <<'END'
-march=x86-64-v2: 4 floats, target 3
-march=x86-64-v3: 4 floats, target 3
-march=haswell: 4 floats, target 3
-march=x86-64-v4: 4 floats, target 3
-march=x86-64-v3 -maes -mpclmul: 8 floats, target 256
-march=x86-64-v4 -maes -mpclmul: 16 floats, target 512
END
diff expected seen
