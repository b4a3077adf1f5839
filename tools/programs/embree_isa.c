// Loaded before Embree: makes it use the code of the instruction set that EMBREE_ISA names (sse2, sse4.2, avx, avx2,
// avx512), as on a processor that has no better. Embree itself reads no such variable.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

typedef void* (*NewDevice)(const char*);

void* rtcNewDevice(const char* config) {
  const char* isa = getenv("EMBREE_ISA");
  char text[256];
  snprintf(text, sizeof text, "%s%sisa=%s", config ? config : "", config ? "," : "", isa ? isa : "");
  NewDevice original = (NewDevice)dlsym(RTLD_NEXT, "rtcNewDevice");
  return original(text);
}
