#!/usr/bin/env bash
# Little CMS 2.14 (Debian 12: liblcms2-dev 2.14-2+deb12u1): cmsWhitePointFromTemp(), the chromaticity of a temperature,
# as one gives lamps and flames their colour.
#
# Its header says: a black body's, from 4000 to 25,000 K. Expected: that of Planck's law, at 5000 K x 0.3451, y 0.3516.
# Seen: that of daylight (CIE's D series) of the temperature, at 5000 K x 0.3457, y 0.3587, which is greener by 0.007;
# at 4000 K it is 0.0071 greener. cmsTempFromWhitePoint() gives back 5000 K for that of 5000, and 6498 for that of 6500:
# the difference does not show in a round trip. Fires, of 1000 to 3000 K, are refused.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends liblcms2-dev=2.14-2+deb12u1 gcc >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >white.c <<'END'
#include <lcms2.h>
#include <math.h>
#include <stdio.h>

/* The chromaticity of a black body: the cubic of Kim et al. 2002, of 2222 to 4000 K and above; good to 0.0005. */
static void black_body(double t, double *x, double *y) {
  double u = 1000.0 / t;
  *x = t < 4000 ? ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910
                : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
  *y = t < 4000 ? ((-0.9549476 * *x - 1.37418593) * *x + 2.09137015) * *x - 0.16748867
                : ((3.0817580 * *x - 5.87338670) * *x + 3.75112997) * *x - 0.37001483;
}

/* CIE's daylight of 4000 to 7000 K. */
static void series(double t, double *x, double *y) {
  *x = -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063;
  *y = -3.0 * *x * *x + 2.870 * *x - 0.275;
}

int main(void) {
  double kelvin[] = {4000, 5000, 6500};
  int good = 1;
  for (int i = 0; i < 3; ++i) {
    cmsCIExyY white;
    double x, y, dx, dy, back = 0;
    if (!cmsWhitePointFromTemp(&white, kelvin[i])) return 1;
    cmsTempFromWhitePoint(&back, &white);
    black_body(kelvin[i], &x, &y);
    series(kelvin[i], &dx, &dy);
    printf("%.0f K: %.4f %.4f, black body %.4f %.4f, daylight %.4f %.4f; back %.0f K\n", kelvin[i], white.x, white.y, x, y,
           dx, dy, back);
    good &= hypot(white.x - dx, white.y - dy) < 1e-4 && hypot(white.x - x, white.y - y) > 0.003;
  }
  cmsCIExyY fire;
  int taken = cmsWhitePointFromTemp(&fire, 2000);
  printf("2000 K: %s\n", taken ? "taken" : "refused");
  return good && !taken ? 0 : 1;
}
END
gcc white.c -llcms2 -lm -o white
./white 2>/dev/null && echo "as before"
