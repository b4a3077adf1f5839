#!/usr/bin/env bash
# Embree 3.13.5 (Debian 12: libembree-dev 3.13.5+dfsg-2): the distance to a triangle straight ahead.
#
# The triangle lies in the plane z = 0, and the ray comes from z = 1 along -z, so that every product and sum of the
# intersection is exact in float. Expected: a distance of 1, on any processor, at least with RTC_SCENE_FLAG_ROBUST.
# Seen on AMD processors (Zen 5, also Zen 3): 0.99999994 by the code for sse2, sse4.2, avx and avx2, and 1 by that for
# avx512, with and without the flag. Embree divides by an approximate reciprocal and a Newton step, which rounds the
# reciprocal of 1 to below 1; the approximation differs by instruction set and by the processor's maker. So the same
# program finds other distances on another machine, and t == 1 must not be asked for.
#
# Needs root for apt-get, an AMD processor with AVX-512, and Debian 12. Exit status 77 where it cannot be seen.
set -euo pipefail
grep -q AuthenticAMD /proc/cpuinfo && grep -qw avx512f /proc/cpuinfo || { echo "skipped: no AMD processor with AVX-512"; exit 77; }
apt-get -q -y install gcc libc6-dev libembree-dev=3.13.5+dfsg-2 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >distance.c <<'END'
#include <embree3/rtcore.h>
#include <stdio.h>
#include <string.h>

int main(int count, char** isa) {
  for (int robust = 0; robust < 2; ++robust)
    for (int i = 1; i < count; ++i) {
      char config[64];
      snprintf(config, sizeof config, "isa=%s", isa[i]);
      RTCDevice device = rtcNewDevice(config);
      RTCScene scene = rtcNewScene(device);
      rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
      RTCGeometry triangle = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
      const unsigned indices[] = {0, 1, 2};
      memcpy(rtcSetNewGeometryBuffer(triangle, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3), corners, 36);
      memcpy(rtcSetNewGeometryBuffer(triangle, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 1), indices, 12);
      rtcCommitGeometry(triangle);
      rtcAttachGeometry(scene, triangle);
      rtcCommitScene(scene);
      struct RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      struct RTCRayHit met;
      memset(&met, 0, sizeof met);
      met.ray.org_x = met.ray.org_y = 0.25f;
      met.ray.org_z = 1;
      met.ray.dir_z = -1;
      met.ray.tfar = 100;
      met.ray.mask = ~0u;
      met.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &met);
      printf("%s%s %.9g\n", robust ? "robust " : "", isa[i], met.ray.tfar);
    }
}
END
gcc distance.c -o distance -lembree3
./distance sse2 sse4.2 avx avx2 avx512 | tee seen
cat >expected <<'END'
sse2 0.99999994
sse4.2 0.99999994
avx 0.99999994
avx2 0.99999994
avx512 1
robust sse2 0.99999994
robust sse4.2 0.99999994
robust avx 0.99999994
robust avx2 0.99999994
robust avx512 1
END
diff expected seen
