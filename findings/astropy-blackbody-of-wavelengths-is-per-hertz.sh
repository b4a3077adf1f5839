#!/usr/bin/env bash
# Astropy 5.2.1 (Debian 12: python3-astropy 5.2.1-2+deb12u1): BlackBody of a temperature, asked at wavelengths, as a
# fire's colour is.
#
# Expected: at wavelengths the spectral radiance is per wavelength, at frequencies per frequency, as the argument has a
# unit that tells. Seen: it is per hertz at both, and of the same value at a wavelength and at its frequency. An integral
# over wavelengths of the plain numbers makes a flame of 1500 K too red: 650 over 450 nm is 234 in the place of 112, as
# the two differ by the square of the wavelength. The units say so, and are lost with .value. A scale with units of
# radiance per wavelength gives what was expected.
#
# Needs root for apt-get, and Debian 12.
set -euo pipefail
apt-get -q -y install --no-install-recommends python3-astropy=5.2.1-2+deb12u1 >/dev/null || { echo "skipped: no such package here"; exit 77; }
/usr/bin/python3 - <<'END' 2>/dev/null | tee /dev/stderr | grep -c "as before" >/dev/null
import astropy.units as u
from astropy.constants import c, h, k_B
from astropy.modeling.models import BlackBody

body = BlackBody(1500 * u.K)
red, blue = 650 * u.nm, 450 * u.nm


def planck(wavelength):
    x = (h * c / (wavelength * k_B * body.temperature)).to_value("")
    return (2 * h * c**2 / wavelength**5).to("W / (m2 nm)") / (2.718281828459045**x - 1) / u.sr


per_wavelength = BlackBody(1500 * u.K, scale=1 * u.W / (u.m**2 * u.sr * u.nm))
print("unit at a wavelength:", body(red).unit, "| at a frequency:", body((c / red).to(u.Hz)).unit)
print(f"red over blue: {(body(red) / body(blue)).value:.1f}, by wavelength {(planck(red) / planck(blue)).to_value(''):.1f},",
      f"with a scale {(per_wavelength(red) / per_wavelength(blue)).to_value(''):.1f}")
good = (body(red).unit == body((c / red).to(u.Hz)).unit and "Hz" in str(body(red).unit)
        and abs((body(red) / body(blue)).value / (planck(red) / planck(blue)).to_value("") - (650 / 450) ** 2) < 1e-3)
print("as before" if good else "another behaviour")
END
