#!/usr/bin/env bash
# GLM 0.9.9.8 (Debian 12: libglm-dev 0.9.9.8+ds-6): small radiances packed as R11G11B10F.
#
# The format (OpenGL's and Vulkan's B10G11R11_UFLOAT) has floats without sign, with five bits of exponent: its least
# normal number is 2^-14 = 6.1e-5, below which it has subnormal ones down to 9.3e-10 and 3e-8 in blue. Expected of
# glm::packF2x11_1x10() and back: values to 1 or 2 %, and what is too small for that becomes 0 or the nearest subnormal.
# Seen: from 2^-14 to 1 all is well, 2^-15 becomes 0, and what is smaller comes back large: 2^-16 as 65536 (blue as -1,
# a number that the format does not have), 1e-6 as 4288, 1e-8 as 42.5. The exponent loses its sign. Only an exact 0
# stays 0: a shadow in which a little light is left becomes the brightest place of the picture.
set -euo pipefail
apt-get -q -y --no-install-recommends install libglm-dev=0.9.9.8+ds-6 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >pack.cpp <<'END'
#include <cstdio>
#include <initializer_list>

#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>

int main() {
  for (float value : {1.0f, 0x1p-14f, 0x1p-15f, 0x1p-16f, 1e-6f, 1e-8f, 0.0f}) {
    const glm::vec3 back = glm::unpackF2x11_1x10(glm::packF2x11_1x10(glm::vec3(value)));
    std::printf("%.3g -> red %.4g, blue %.4g\n", value, back.x, back.z);
  }
}
END
g++ -O1 -w pack.cpp -o pack
./pack | tee seen
cat >expected <<'END'
1 -> red 1, blue 1
6.1e-05 -> red 6.104e-05, blue 6.104e-05
3.05e-05 -> red 0, blue 0
1.53e-05 -> red 6.554e+04, blue -1
1e-06 -> red 4288, blue 4224
1e-08 -> red 42.5, blue 42
0 -> red 0, blue 0
END
diff expected seen
