// The sky's colours and the fit of the shadow map, without OpenGL.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "widgets/render/shadow_map.h"
#include "widgets/render/sky_model.h"

using namespace windfall;

namespace {
vec3 sunAt(float degrees) {
  const float angle = degrees * 0.0174532925f;
  return {std::cos(angle), std::sin(angle), 0};
}
const vec3 kAlbedo(0.13f, 0.1f, 0.035f);
}  // namespace

TEST_CASE("the zenith is blue and a low sun is redder and weaker than a high one") {
  const render::SkyLight high = render::computeSky(sunAt(60), kAlbedo), low = render::computeSky(sunAt(8), kAlbedo);
  const vec3 zenith = high.table.back();
  CHECK(zenith.z > 1.5f * zenith.x);
  CHECK(low.sun.x < high.sun.x);
  CHECK(low.sun.z / low.sun.x < 0.7f * high.sun.z / high.sun.x);
}

TEST_CASE("diffuse light from above exceeds that from below, and all of it is positive") {
  for (const float degrees : {3.f, 20.f, 45.f, 88.f}) {
    const render::SkyLight sky = render::computeSky(sunAt(degrees), kAlbedo);
    CAPTURE(degrees);
    if (degrees < 60) CHECK(sky.ambient[2].y > 0);  // under a zenith sun the lit ground may outshine the sky
    for (const vec3 normal : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(0, 0, -1)}) {
      const vec3 light =
          sky.ambient[0] + normal.x * sky.ambient[1] + normal.y * sky.ambient[2] + normal.z * sky.ambient[3];
      CHECK(light.x > 0);
      CHECK(light.y > 0);
      CHECK(light.z > 0);
    }
  }
}

TEST_CASE("what stands in the sphere and its shadow on the ground lie in the shadow map") {
  const vec3 center(3, 4, -2), toSun = glm::normalize(vec3(0.8f, 0.3f, 0.2f));
  const render::ShadowFit fit = render::fitShadow(center, 5, toSun, 1024);
  for (const vec3 offset : {vec3(4.9f, 0, 0), vec3(0, 4.9f, 0), vec3(0, 0, -4.9f), vec3(-2, 3, 2)}) {
    const vec3 top = center + offset, shadow = top - toSun * (top.y / toSun.y);
    const vec4 a = fit.toTexture * vec4(top, 1), b = fit.toTexture * vec4(shadow, 1);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(a[axis] > -1e-3f);
      CHECK(a[axis] < 1.001f);
      CHECK(b[axis] < 1.001f);
    }
    CHECK(b.z > a.z);
    CHECK(b.x == doctest::Approx(a.x).epsilon(1e-3));
  }
}

TEST_CASE("a shadow map that moves keeps its texels in place") {
  const vec3 toSun = glm::normalize(vec3(0.4f, 0.7f, 0.5f)), point(1, 2, 3);
  const vec4 a = render::fitShadow(vec3(0, 3, 0), 8, toSun, 1024).toTexture * vec4(point, 1);
  const vec4 b = render::fitShadow(vec3(0.37f, 3.1f, -0.21f), 8, toSun, 1024).toTexture * vec4(point, 1);
  for (int axis = 0; axis < 2; ++axis) {
    const float texels = (a[axis] - b[axis]) * 1024;
    CHECK(std::abs(texels - std::round(texels)) < 0.02f);
  }
}
