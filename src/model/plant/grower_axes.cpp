#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernels/random.h"
#include "model/plant/frames.h"
#include "model/plant/grower_private.h"

namespace windfall::model::grower {

namespace {

constexpr float kPi = 3.14159265f;
constexpr float kGoldenAngle = 2.39996323f;
constexpr float kCrownBase = 0.2f;  ///< share of the height without limbs

vec3 wander(RandomSequence& random) {
  return {static_cast<float>(random.normal()), static_cast<float>(random.normal()),
          static_cast<float>(random.normal())};
}

/// The direction that leaves `along` by `angle`, turned about it by `azimuth`.
vec3 divert(vec3 along, float angle, float azimuth) {
  const quat frame = alongZ(along);
  return frame * vec3(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle));
}

/// How an axis bends as it grows.
struct Habit {
  float wander = 0;  ///< random turn of a step, rad
  float lift = 0;    ///< towards the light, a metre
  float sag = 0;     ///< under its own weight, a metre, at the base; fades to the tip
};

void growLine(Axis& axis, vec3 start, vec3 direction, float length, int links, const Habit& habit,
              RandomSequence& random) {
  const float step = length / static_cast<float>(links);
  axis.nodes.push_back(start);
  vec3 d = glm::normalize(direction);
  for (int i = 0; i < links; ++i) {
    axis.nodes.push_back(axis.nodes.back() + d * step);
    const float share = static_cast<float>(i + 1) / static_cast<float>(links);
    // The level part of the direction decides how much weight and light can turn it.
    const float level = std::hypot(d.x, d.z);
    d += vec3(0, (habit.lift * share - habit.sag * (1 - share)) * step * level, 0) + habit.wander * wander(random);
    d = glm::normalize(d);
  }
}

Axis growTrunk(const GrowerSettings& settings) {
  RandomSequence random(settings.seed, 1);
  Axis trunk;
  trunk.name = "trunk";
  const float height = static_cast<float>(settings.height);
  const int links = std::clamp(static_cast<int>(std::lround(settings.height / 0.55)), 6, 40);
  vec3 at(0), lean(0);
  trunk.nodes.push_back(at);
  for (int i = 0; i < links; ++i) {
    // A random walk of the lean that is pulled back to the vertical: gentle bows, no corners.
    lean = 0.82f * lean + 0.045f * vec3(static_cast<float>(random.normal()), 0, static_cast<float>(random.normal()));
    at += glm::normalize(vec3(0, 1, 0) + (i == 0 ? vec3(0) : lean)) * (height / static_cast<float>(links));
    trunk.nodes.push_back(at);
  }
  for (vec3& node : trunk.nodes) node.y *= height / trunk.nodes.back().y;
  return trunk;
}

std::string numbered(const char* kind, const std::string& of, int number) {
  char digits[16];
  std::snprintf(digits, sizeof digits, "%02d", number);
  return std::string(kind) + "." + (of.empty() ? "" : of + ".") + digits;
}

/// Limbs: longest low in the crown, steeper and shorter towards the top.
void growLimbs(const GrowerSettings& settings, std::vector<Axis>& axes) {
  const Axis trunk = axes.front();
  const auto links = static_cast<float>(trunk.nodes.size() - 1);
  const float height = static_cast<float>(settings.height);
  for (int i = 0; i < settings.limbs; ++i) {
    RandomSequence random(settings.seed, 100 + static_cast<std::uint32_t>(i));
    const float rise = (static_cast<float>(i) + 0.2f + 0.6f * static_cast<float>(random.uniform())) /
                       static_cast<float>(settings.limbs);
    const float share = kCrownBase + (0.96f - kCrownBase) * rise;
    const float place = share * links;
    Axis limb;
    limb.parent = 0;
    limb.parentLink = std::min(static_cast<int>(place), static_cast<int>(links) - 1);
    limb.parentShare = place - static_cast<float>(limb.parentLink);
    limb.order = 1;
    limb.name = numbered("limb", "", i);
    // A rounded crown: short at its base, widest at a quarter of it, closing towards the top.
    const float envelope = std::pow(1 - rise, 0.8f) * (0.62f + 0.38f * std::min(1.0f, rise / 0.22f));
    const float length = height * (0.09f + 0.40f * envelope) * static_cast<float>(random.uniform(0.85, 1.12));
    const float angle = static_cast<float>(settings.spread) * kPi / 180 * (1.18f - 0.55f * rise) *
                        static_cast<float>(random.uniform(0.9, 1.1));
    const float azimuth = kGoldenAngle * static_cast<float>(i) + static_cast<float>(random.uniform(-0.3, 0.3));
    const auto link = static_cast<std::size_t>(limb.parentLink);
    const vec3 direction = divert(curveTangent(trunk, link, limb.parentShare), angle, azimuth);
    const int count = std::clamp(static_cast<int>(std::lround(length / 0.36f)), 3, 14);
    growLine(limb, curvePoint(trunk, link, limb.parentShare), direction, length, count,
             {0.085f, 0.62f * (1 - 0.6f * rise), 0.30f * (1 - rise)}, random);
    axes.push_back(std::move(limb));
  }
}

/// Twigs on axes of the order before: closer to the tips, in the axis' own plane rather than above and below it.
void growTwigs(const GrowerSettings& settings, int order, std::vector<Axis>& axes) {
  const std::size_t existing = axes.size();
  for (std::size_t a = 0; a < existing; ++a) {
    if (axes[a].order != order - 1) continue;
    RandomSequence random(settings.seed + static_cast<std::uint64_t>(order) * 7919,
                          1000 + static_cast<std::uint32_t>(a));
    const Axis parent = axes[a];
    const auto links = static_cast<float>(parent.nodes.size() - 1);
    float length = 0;
    for (std::size_t i = 1; i < parent.nodes.size(); ++i) length += glm::length(parent.nodes[i] - parent.nodes[i - 1]);
    const float spacing = order == 2 ? 0.15f : 0.11f;
    const int count = std::max(2, static_cast<int>(length * 0.86f / spacing));
    for (int i = 0; i < count; ++i) {
      const float share = 0.14f + 0.84f * (static_cast<float>(i) + static_cast<float>(random.uniform(0.1, 0.9))) /
                                      static_cast<float>(count);
      const float place = share * links;
      Axis twig;
      twig.parent = static_cast<int>(a);
      twig.parentLink = std::min(static_cast<int>(place), static_cast<int>(links) - 1);
      twig.parentShare = place - static_cast<float>(twig.parentLink);
      twig.order = order;
      twig.name = numbered(order == 2 ? "twig" : "spray", parent.name.substr(parent.name.find('.') + 1), i);
      const float reach = std::clamp(0.22f + 0.50f * length * (1.08f - share), 0.15f, order == 2 ? 1.5f : 0.5f);
      const float grown = reach * static_cast<float>(random.uniform(0.7, 1.1));
      const float angle = static_cast<float>(random.uniform(0.6, 0.95));
      // Alternate sides of the level plane, with scatter; x of alongZ is level.
      const float azimuth = (i % 2 == 0 ? 0.0f : kPi) + static_cast<float>(random.normal()) * 0.75f;
      const auto link = static_cast<std::size_t>(twig.parentLink);
      const vec3 direction = divert(curveTangent(parent, link, twig.parentShare), angle, azimuth) + vec3(0, 0.12f, 0);
      const int pieces = std::clamp(static_cast<int>(std::lround(grown / 0.22f)), 1, 6);
      growLine(twig, curvePoint(parent, link, twig.parentShare), direction, grown, pieces, {0.09f, 0.5f, 0.3f}, random);
      axes.push_back(std::move(twig));
    }
  }
}

/// Derivative of the curve at a node, per unit of its link's parameter.
vec3 nodeTangent(const Axis& axis, std::size_t node) {
  const std::vector<vec3>& p = axis.nodes;
  const std::size_t last = p.size() - 1;
  const auto chord = [&](std::size_t i) { return p[i + 1] - p[i]; };
  const auto step = [&](std::size_t i) { return std::max(std::sqrt(glm::length(chord(i))), 1e-6f); };
  const auto blend = [&](std::size_t i) {
    const float before = step(i - 1), after = step(i);
    return (after * chord(i - 1) / before + before * chord(i) / after) / (before + after);
  };
  if (last == 1) return chord(0) / step(0);
  if (node == 0) return 1.5f * chord(0) / step(0) - 0.5f * blend(1);
  if (node == last) return 1.5f * chord(last - 1) / step(last - 1) - 0.5f * blend(last - 1);
  return blend(node);
}

}  // namespace

std::vector<Axis> growAxes(const GrowerSettings& settings) {
  std::vector<Axis> axes{growTrunk(settings)};
  if (settings.levels >= 2) growLimbs(settings, axes);
  for (int order = 2; order < settings.levels; ++order) growTwigs(settings, order, axes);
  int bone = 0;
  for (Axis& axis : axes) {
    axis.firstBone = bone;
    bone += static_cast<int>(axis.nodes.size()) - 1;
  }
  return axes;
}

vec3 curvePoint(const Axis& axis, std::size_t link, float t) {
  const vec3 a = axis.nodes[link], b = axis.nodes[link + 1];
  const float d = std::max(std::sqrt(glm::length(b - a)), 1e-6f);
  const vec3 u = nodeTangent(axis, link) * d, v = nodeTangent(axis, link + 1) * d;
  const float t2 = t * t, t3 = t2 * t;
  return a * (2 * t3 - 3 * t2 + 1) + u * (t3 - 2 * t2 + t) + b * (3 * t2 - 2 * t3) + v * (t3 - t2);
}

vec3 curveTangent(const Axis& axis, std::size_t link, float t) {
  const vec3 a = axis.nodes[link], b = axis.nodes[link + 1];
  const float d = std::max(std::sqrt(glm::length(b - a)), 1e-6f);
  const vec3 u = nodeTangent(axis, link) * d, v = nodeTangent(axis, link + 1) * d;
  const float t2 = t * t;
  return glm::normalize((a - b) * (6 * t2 - 6 * t) + u * (3 * t2 - 4 * t + 1) + v * (3 * t2 - 2 * t));
}

void addBones(const std::vector<Axis>& axes, PlantGeometry& geometry) {
  for (const Axis& axis : axes) {
    for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
      char digits[16];
      std::snprintf(digits, sizeof digits, axis.order == 0 ? ".%03d" : ".%02d", static_cast<int>(i));
      Bone bone;
      bone.name = QString::fromStdString(axis.name + digits);
      bone.parent = i > 0             ? static_cast<int>(geometry.bones.size()) - 1
                    : axis.parent < 0 ? -1
                                      : axes[static_cast<std::size_t>(axis.parent)].firstBone + axis.parentLink;
      bone.head = axis.nodes[i];
      bone.tail = axis.nodes[i + 1];
      bone.radius = 0.5f * (axis.radii[i] + axis.radii[i + 1]);
      geometry.bones.push_back(bone);
    }
  }
}

void setRadii(std::vector<Axis>& axes, float baseRadius) {
  constexpr double kTip = 0.0022, kExponent = 2.4;
  std::vector<std::vector<int>> children(axes.size());
  for (std::size_t a = 1; a < axes.size(); ++a)
    children[static_cast<std::size_t>(axes[a].parent)].push_back(static_cast<int>(a));
  const auto base = [&](double tau) {
    for (std::size_t a = axes.size(); a-- > 0;) {
      Axis& axis = axes[a];
      const std::size_t links = axis.nodes.size() - 1;
      axis.radii.assign(links + 1, static_cast<float>(kTip));
      for (std::size_t i = links; i-- > 0;) {
        const double length = static_cast<double>(glm::length(axis.nodes[i + 1] - axis.nodes[i]));
        double sum = std::pow(static_cast<double>(axis.radii[i + 1]) + tau * length, kExponent);
        for (const int child : children[a]) {
          const Axis& side = axes[static_cast<std::size_t>(child)];
          if (static_cast<std::size_t>(side.parentLink) != i) continue;
          const double reach = tau * static_cast<double>(side.parentShare) * length;
          sum += std::pow(static_cast<double>(side.radii[0]) + reach, kExponent);
        }
        axis.radii[i] = static_cast<float>(std::pow(sum, 1 / kExponent));
      }
    }
    return static_cast<double>(axes[0].radii[0]);
  };
  double low = 0, high = 0.05;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (base(middle) < static_cast<double>(baseRadius) ? low : high) = middle;
  }
  // Where many tips meet a thin trunk, or few a stout one, the whole tree is scaled to the base that was asked for.
  const float scale = baseRadius / static_cast<float>(base(low));
  for (Axis& axis : axes) {
    for (float& radius : axis.radii) radius *= scale;
  }
}

}  // namespace windfall::model::grower
