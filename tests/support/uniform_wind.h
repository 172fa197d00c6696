// Air that moves everywhere alike.
#pragma once

#include <array>

#include "kernels/wind.h"

namespace windfall::test {

struct UniformWind {
  explicit UniformWind(const vec3& velocity) { nodes.fill(vec4(velocity, 0)); }
  WindView view() const {
    WindView view;
    view.velocity = nodes.data();
    view.nx = view.ny = view.nz = 2;
    view.origin = vec3(-50);
    view.perMetre = vec3(0.01f);
    return view;
  }
  std::array<vec4, 8> nodes;
};

}  // namespace windfall::test
