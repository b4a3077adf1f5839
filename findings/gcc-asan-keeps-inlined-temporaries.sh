#!/usr/bin/env bash
# GCC 12.2 (Debian 12: g++-12 12.2.0-14+deb12u1): the address sanitizer and a class around one vector register.
#
# A class of one vector of four floats, whose operators are inline and take references, is what libraries of lanes are
# made of. Expected: with -O3 everything is inlined, no temporary has an address, and a sum of products costs what it
# costs of the vectors themselves, also under -fsanitize=address, which checks the loads and stores that are left. Seen:
# the temporaries stay in memory, as their lifetimes are marked there; the function asks the sanitizer for a stack of
# its own, marks each temporary when it begins and ends, and has 105 instructions instead of 29, at -O1 as at
# -O3. Of the vectors themselves nothing of that is left, nor of the class with
# -fno-sanitize-address-use-after-scope. Clang 14 makes the same of both.
#
# Needs root for apt-get, an x86-64 processor, and Debian 12.
set -euo pipefail
[ "$(uname -m)" = x86_64 ] || { echo "skipped: no x86-64"; exit 77; }
apt-get -q -y install binutils g++-12=12.2.0-14+deb12u1 clang-14=1:14.0.6-12 >/dev/null || { echo "skipped: no such package here"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat >lanes.cpp <<'END'
using Register = float __attribute__((vector_size(16)));
struct Lanes {
  Register four;
};
inline Lanes operator+(const Lanes& a, const Lanes& b) { return {a.four + b.four}; }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return {a.four * b.four}; }
template <class T>
void sum_of_products(const T* a, const T* b, T* to) { *to = *a * *b + *a * *a + *b * *b; }
extern "C" void of_registers(const Register* a, const Register* b, Register* to) { sum_of_products(a, b, to); }
extern "C" void of_class(const Lanes* a, const Lanes* b, Lanes* to) { sum_of_products(a, b, to); }
END
# What a compiler makes of both: the instructions, and whether it asks for a stack that is watched.
look() {
  echo "$*"
  "$@" -fsanitize=address -c lanes.cpp -o lanes.o
  for name in of_registers of_class; do
    objdump -dr --no-show-raw-insn --disassemble="$name" lanes.o >text
    echo "  $name: $([ "$(grep -cE '^ +[0-9a-f]+:.*[a-z]' text)" -gt 90 ] && echo more than 90 || echo at most 90) instructions," \
         "watched stack: $(grep -q __asan_stack_malloc text && echo yes || echo no)"
  done
}
{
  look g++-12 -O1
  look g++-12 -O3
  look g++-12 -O3 -fno-sanitize-address-use-after-scope
  look clang++-14 -O3
} | tee seen
cat >expected <<'END'
g++-12 -O1
  of_registers: at most 90 instructions, watched stack: no
  of_class: more than 90 instructions, watched stack: yes
g++-12 -O3
  of_registers: at most 90 instructions, watched stack: no
  of_class: more than 90 instructions, watched stack: yes
g++-12 -O3 -fno-sanitize-address-use-after-scope
  of_registers: at most 90 instructions, watched stack: no
  of_class: at most 90 instructions, watched stack: no
clang++-14 -O3
  of_registers: at most 90 instructions, watched stack: no
  of_class: at most 90 instructions, watched stack: no
END
diff expected seen
