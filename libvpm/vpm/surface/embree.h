// Embree 3 or 4: the calls that differ between them, under one name each. No other file asks which version there is;
// CMake says it (VPM_EMBREE_MAJOR).
#pragma once

#ifndef VPM_EMBREE_MAJOR
#error "the build says which Embree there is: VPM_EMBREE_MAJOR"
#endif
#if VPM_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace vpm {

#if VPM_EMBREE_MAJOR >= 4

/// What belongs to a query. Callbacks get its address, so that what stands behind it reaches them.
using EmbreeContext = RTCRayQueryContext;
/// The flag of a scene whose queries may have a filter of their own.
inline constexpr RTCSceneFlags kEmbreeFilters = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

inline void init_context(EmbreeContext& context) { rtcInitRayQueryContext(&context); }

/// Looks along a ray. `filter` sees the hits of triangles, may refuse them, and says how far to look from then on.
inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRayHit& ray_hit) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.filter = filter;
  arguments.flags = RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER;
  rtcIntersect1(scene, &ray_hit, &arguments);
}

/// Does anything stop a ray?
inline void embree_occluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
}
/// The same of 16 rays that run side by side.
inline void embree_occluded(RTCScene scene, EmbreeContext& context, const int* valid, RTCRay16& rays) {
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &rays, &arguments);
}

#else

using EmbreeContext = RTCIntersectContext;
inline constexpr RTCSceneFlags kEmbreeFilters = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

inline void init_context(EmbreeContext& context) { rtcInitIntersectContext(&context); }

inline void embree_intersect(RTCScene scene, EmbreeContext& context, RTCFilterFunctionN filter, RTCRayHit& ray_hit) {
  context.filter = filter;
  rtcIntersect1(scene, &context, &ray_hit);
}

inline void embree_occluded(RTCScene scene, EmbreeContext& context, RTCRay& ray) {
  rtcOccluded1(scene, &context, &ray);
}
inline void embree_occluded(RTCScene scene, EmbreeContext& context, const int* valid, RTCRay16& rays) {
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, scene, &context, &rays);
}

#endif

}  // namespace vpm
