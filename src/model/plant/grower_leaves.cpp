#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/frames.h"
#include "model/plant/grower_private.h"
#include "model/plant/short_shoots.h"

namespace windfall::model::grower {

namespace {

constexpr float kGoldenAngle = 2.39996323f;
constexpr float kBlade = 0.08f;  ///< m
constexpr float kShootRadius = 0.0014f;
constexpr double kLeafArea = 0.65 * 0.6;  ///< of the squared blade length: 0.65 L W, W = 0.6 L
constexpr int kLeavesOnShoot = 6;

struct Shoot : ShortShoot {
  vec3 away{0};
};

void addLeaves(const Shoot& shoot, const Bone& bone, quint64 seed, std::uint32_t number, PlantGeometry& geometry) {
  const quat frame = alongZ(shoot.direction), boneFrame = alongZ(bone.tail - bone.head);
  for (int q = 0; q < kLeavesOnShoot; ++q) {
    const std::uint32_t id = number * kLeavesOnShoot + static_cast<std::uint32_t>(q);
    const float angle = kGoldenAngle * static_cast<float>(q) + 6.2831853f * uniform(seed, 31, number);
    const vec3 radial = frame * vec3(std::cos(angle), std::sin(angle), 0);
    const float along = shoot.length * (static_cast<float>(q) + 0.75f) / kLeavesOnShoot;
    const vec3 blade = glm::normalize(0.5f * shoot.direction + 0.8f * radial - vec3(0, 0.3f, 0));
    // Tilted to the light: upwards, and outwards from the crown.
    const vec3 scatter(uniform(seed, 32, id) - 0.5f, 0, uniform(seed, 33, id) - 0.5f);
    const float size = kBlade * (0.75f + 0.5f * uniform(seed, 34, id));
    sim::LeafSite site;
    site.link = static_cast<std::int32_t>(shoot.bone);
    const vec3 petiole = shoot.base + shoot.direction * along;
    site.position = glm::conjugate(boneFrame) * (petiole - bone.head);
    site.rotation =
        glm::conjugate(boneFrame) * leafRotation(blade, vec3(0, 1, 0) + 0.35f * shoot.away + 0.5f * scatter);
    site.size = size;
    geometry.leafSites.push_back(site);
  }
}

/// Metres of a link that bear shoots: all of the thin axes, the outer half of the limbs, the trunk's top.
float leafyLength(const Axis& axis, std::size_t link, int outermost) {
  const float share = (static_cast<float>(link) + 0.5f) / static_cast<float>(axis.nodes.size() - 1);
  const float from = axis.order >= 2 ? 0.0f : axis.order == 1 ? 0.6f : outermost == 0 ? 0.4f : 0.93f;
  return share < from ? 0 : glm::length(axis.nodes[link + 1] - axis.nodes[link]);
}

}  // namespace

void placeLeaves(const std::vector<Axis>& axes, double area, quint64 seed, int material, PlantGeometry& geometry) {
  int outermost = 0;
  for (const Axis& axis : axes) outermost = std::max(outermost, axis.order);
  double metres = 0;
  for (const Axis& axis : axes) {
    for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i)
      metres += static_cast<double>(leafyLength(axis, i, outermost));
  }
  if (!(metres > 0)) return;
  const double shoots = std::min(area / (kLeafArea * static_cast<double>(kBlade * kBlade)), 200'000.0) / kLeavesOnShoot;
  double carried = 0.5;
  std::uint32_t number = 0;
  std::vector<ShortShoot> bare;
  for (const Axis& axis : axes) {
    for (std::size_t i = 0; i + 1 < axis.nodes.size(); ++i) {
      const double wanted = shoots * static_cast<double>(leafyLength(axis, i, outermost)) / metres + carried;
      const int count = static_cast<int>(wanted);
      carried = wanted - count;
      const auto bone = static_cast<std::uint32_t>(axis.firstBone) + static_cast<std::uint32_t>(i);
      for (int k = 0; k < count; ++k, ++number) {
        const float share = (static_cast<float>(k) + uniform(seed, 35, number)) / static_cast<float>(count);
        const vec3 tangent = curveTangent(axis, i, share);
        const float angle = kGoldenAngle * static_cast<float>(number) + 0.5f * uniform(seed, 36, number);
        Shoot shoot;
        shoot.bone = bone;
        shoot.away = alongZ(tangent) * vec3(std::cos(angle), std::sin(angle), 0);
        shoot.direction = glm::normalize(0.64f * tangent + 0.77f * shoot.away + vec3(0, 0.15f, 0));
        shoot.length = 0.09f + 0.14f * uniform(seed, 37, number);
        shoot.base = curvePoint(axis, i, share);
        shoot.radius = kShootRadius;
        bare.push_back(shoot);
        addLeaves(shoot, geometry.bones[bone], seed, number, geometry);
      }
    }
  }
  addShortShoots(bare, material, geometry);
}

}  // namespace windfall::model::grower
