// The vector types of every layer, usable in host and device code.
#pragma once

#if defined(__CUDACC__)
#include <cuda.h>  // before GLM, which asks for CUDA_VERSION
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20012
#define WINDFALL_HD __host__ __device__ __forceinline__
#elif defined(__GNUC__) && defined(__OPTIMIZE__)
// Inlined for certain: a loop's versions for other instruction sets (targets.h) end where a call begins.
#define WINDFALL_HD inline __attribute__((always_inline))
#define GLM_FORCE_INLINE
#else
#define WINDFALL_HD inline
#endif

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#if defined(__CUDACC__)
#pragma nv_diagnostic pop
#endif

namespace windfall {

using glm::mat3;
using glm::mat4;
using glm::quat;
using glm::vec2;
using glm::vec3;
using glm::vec4;

static_assert(sizeof(vec3) == 12 && sizeof(vec4) == 16 && sizeof(quat) == 16 && sizeof(mat4) == 64,
              "host, device and OpenGL share these layouts");

}  // namespace windfall
