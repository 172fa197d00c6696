#include "model/plant/plant_data.h"

#include <QCoreApplication>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernels/random.h"
#include "model/plant/skeleton_geometry.h"

namespace windfall::model {

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// The state of the organ that a link came from.
float stateOf(PlantData what, const Segment& s) {
  const float value = what == PlantData::Water    ? s.state.water
                      : what == PlantData::Energy ? s.state.energy
                                                  : s.state.wood;
  return value < 0 ? kUnknown : value;
}

using Scale = std::array<vec3, 5>;

Scale scaleOf(PlantData what) {
  switch (what) {
    case PlantData::Water:
      return {vec3(122, 72, 30), {201, 152, 84}, {224, 222, 200}, {98, 168, 210}, {24, 82, 168}};
    case PlantData::Wood:
      return {vec3(74, 160, 52), {150, 184, 70}, {196, 176, 96}, {158, 108, 62}, {92, 56, 34}};
    case PlantData::Energy:
    case PlantData::Stress:
      return {vec3(20, 12, 44), {110, 24, 110}, {204, 58, 84}, {248, 144, 52}, {252, 244, 164}};
    default:
      break;
  }
  return {vec3(68, 1, 84), {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}};
}

std::uint32_t packed(vec3 c) {
  const auto byte = [](float v) { return static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0f, 255.0f))); };
  return byte(c.x) | byte(c.y) << 8u | byte(c.z) << 16u | 0xff000000u;
}

}  // namespace

std::vector<float> bendingStress(const sim::Tree& tree, const std::vector<mat4>& pose) {
  std::vector<float> stress(tree.links.size(), 0);
  if (pose.size() < tree.links.size()) return stress;
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    const sim::Link& link = tree.links[i];
    const mat3 own(pose[i]), parent = link.parent < 0 ? mat3(1) : mat3(pose[static_cast<std::size_t>(link.parent)]);
    const quat turn = glm::quat_cast(glm::transpose(parent) * own);
    // A root's matrix holds the heading of the tree; only what tilts it bends.
    const float tilt = link.parent < 0 ? std::hypot(turn.x, turn.z) : std::hypot(turn.x, turn.y, turn.z);
    const float theta = 2 * std::atan2(tilt, std::abs(turn.w));
    stress[i] = link.youngsModulus * link.stiffnessScale * theta * link.radius / std::max(link.length, 1e-4f);
  }
  return stress;
}

LinkData linkData(PlantData what, const PlantGeometry& geometry, const PlantBodies& bodies, const sim::Tree& tree,
                  const std::vector<mat4>& pose) {
  LinkData data;
  const std::size_t count = bodies.tree.links.size();
  data.values.assign(count, kUnknown);
  if (what == PlantData::Stress) {
    data.values = bendingStress(tree, pose);
    data.unit = QStringLiteral("MPa");
    for (float& value : data.values) value *= 1e-6f;
  } else if (what == PlantData::Water || what == PlantData::Energy || what == PlantData::Wood) {
    data.unit = QStringLiteral("%");
    if (geometry.skeleton) {
      for (const Segment& s : geometry.skeleton->graph.segments) {
        const int link = s.bone < 0 ? -1 : bodies.linkOfBone[static_cast<std::size_t>(s.bone)];
        if (link >= 0) data.values[static_cast<std::size_t>(link)] = 100 * stateOf(what, s);
      }
    }
    data.high = 100;
  } else if (what != PlantData::None) {
    for (std::size_t i = 0; i < count; ++i) {
      const sim::Link& link = tree.links[i];
      data.values[i] = what == PlantData::Order   ? static_cast<float>(link.order + 1)
                       : what == PlantData::Chain ? static_cast<float>(link.chain)
                                                  : 1000 * link.radius;
    }
    if (what == PlantData::Radius) data.unit = QStringLiteral("mm");
    data.named = what == PlantData::Chain;
  }
  float low = std::numeric_limits<float>::max(), high = -low;
  for (const float value : data.values) {
    if (std::isnan(value)) continue;
    data.known = true;
    low = std::min(low, value), high = std::max(high, value);
  }
  if (!data.known) return data;
  if (what == PlantData::Order || what == PlantData::Radius)
    data.low = static_cast<double>(low), data.high = static_cast<double>(high);
  if (what == PlantData::Stress) data.low = 0, data.high = std::max(static_cast<double>(high), 0.1);
  if (data.high <= data.low) data.high = data.low + 1;
  return data;
}

std::uint32_t dataColor(PlantData what, const LinkData& data, float value) {
  if (std::isnan(value)) return 0;
  if (data.named) {
    // Hues a golden angle apart: neighbours by number differ.
    const float hue = std::fmod(value * 0.61803398f, 1.0f) * 6,
                bright = value < 0.5f ? 0.75f : 0.65f + 0.35f * uniform(9, static_cast<std::uint32_t>(value));
    const auto channel = [&](float shift) {
      const float h = std::fmod(hue + shift, 6.0f);
      return 255 * bright * (0.25f + 0.75f * std::clamp(std::abs(h - 3) - 1, 0.0f, 1.0f));
    };
    return packed({channel(0), channel(4), channel(2)});
  }
  const Scale scale = scaleOf(what);
  double t = (static_cast<double>(value) - data.low) / (data.high - data.low);
  // Radii span decades.
  if (what == PlantData::Radius && data.low > 0) {
    t = std::log(static_cast<double>(value) / data.low) / std::log(data.high / data.low);
  }
  const float place = 4 * static_cast<float>(std::clamp(t, 0.0, 1.0));
  const auto i = static_cast<std::size_t>(std::min(place, 3.0f));
  const float share = place - static_cast<float>(i);
  return packed(scale[i] * (1 - share) + scale[i + 1] * share);
}

}  // namespace windfall::model
