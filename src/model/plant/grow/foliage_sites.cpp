#include "model/plant/grow/foliage_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/random.h"
#include "model/plant/frames.h"
#include "model/plant/short_shoots.h"

namespace windfall::model::growth {

namespace {

constexpr float kGoldenAngle = 2.39996323f, kPi = std::numbers::pi_v<float>;
constexpr float kMeanArea = 1.02f;  ///< of leaves whose size spreads by a quarter
constexpr double kMostLeaves = 250'000;

/// Azimuth of leaf n in pairs, each crossing the one before.
float decussate(int n) {
  const int pair = n / 2;
  return 0.5f * kPi * static_cast<float>(pair) + kPi * static_cast<float>(n % 2);
}

class Foliage {
 public:
  Foliage(const Grown& grown, const AxisTree& tree, const FoliageSettings& settings, quint64 seed, int material,
          PlantGeometry& geometry)
      : grown_(grown), tree_(tree), s_(settings), seed_(seed), material_(material), geometry_(geometry) {}

  void place() {
    const std::vector<double> reach = reachOf(grown_);
    std::vector<double> leafy(grown_.size(), 0);
    double metres = 0;
    for (std::size_t i = 1; i < grown_.size(); ++i) {
      if (reach[i] >= s_.leafyLength) continue;
      leafy[i] = glm::length(grown_.position[i] - grown_.position[at(grown_.parent[i])]);
      metres += leafy[i];
    }
    if (!(metres > 0)) return;
    const int cluster = std::max(s_.cluster, 1);
    const double leaf = s_.areaFactor * s_.length * s_.length * static_cast<double>(kMeanArea);
    const double leaves = std::min(leafAreaOf(grown_, s_) / leaf, kMostLeaves);
    const double perMetre = leaves / cluster / metres;
    double carried = 0.5;
    // Along the axes, so that spacing carries on from link to link.
    for (const grower::Axis& axis : tree_.axes) {
      for (std::size_t link = 0; link + 1 < axis.nodes.size(); ++link) {
        const std::size_t node = at(tree_.nodeOf[at(axis.firstBone) + link]);
        if (!(leafy[node] > 0)) continue;
        const double wanted = perMetre * leafy[node] + carried;
        const int count = static_cast<int>(wanted);
        for (int k = 0; k < count; ++k) {
          const double share = std::clamp((k + 1 - carried) / std::max(wanted - carried, 1e-9), 0.0, 1.0);
          site(axis, link, static_cast<float>(share));
        }
        carried = wanted - count;
      }
    }
    addShortShoots(bare_, material_, geometry_);
  }

 private:
  float random(std::uint32_t question) const { return uniform(seed_, 90 + question, number_); }

  /// Azimuth of a site about its twig.
  float azimuth() const {
    const auto m = static_cast<float>(number_);
    const float jitter = 0.35f * (random(0) - 0.5f);
    switch (s_.arrangement) {
      case LeafArrangement::Opposite:
        return decussate(static_cast<int>(number_)) + jitter;
      case LeafArrangement::TwoRanked:
        return kPi * m + jitter;
      default:
        return kGoldenAngle * m + jitter;
    }
  }

  void site(const grower::Axis& axis, std::size_t link, float share) {
    const vec3 base = grower::curvePoint(axis, link, share), along = grower::curveTangent(axis, link, share);
    // x of alongZ is level: two-ranked twigs lie flat.
    const float angle = azimuth();
    const vec3 away = alongZ(along) * vec3(std::cos(angle), std::sin(angle), 0);
    const auto bone = static_cast<std::uint32_t>(axis.firstBone) + static_cast<std::uint32_t>(link);
    const float down = static_cast<float>(s_.droop);
    if (s_.cluster <= 1) {
      const vec3 tip = glm::normalize(0.64f * along + 0.77f * away - vec3(0, down, 0));
      leaf(bone, base, tip, vec3(0, 1, 0) + 0.3f * away, number_ * 16);
    } else {
      vec3 direction = 0.64f * along + 0.77f * away + vec3(0, 0.35f - 1.4f * down, 0);
      direction = glm::normalize(direction);
      const float length = static_cast<float>(s_.shoot) * (0.45f + 0.75f * random(1));
      const float radius = std::min(0.0016f, 0.6f * axis.radii[link + 1]);
      bare_.push_back({base, direction, length, radius, bone});
      cluster(bone, base, direction, length, away);
    }
    ++number_;
  }

  void cluster(std::uint32_t bone, vec3 base, vec3 direction, float length, vec3 away) {
    if (!s_.leaves) return;
    const quat frame = alongZ(direction);
    const bool tuft = s_.look == LeafLook::Pine;
    const float spin = 2 * kPi * random(2);
    for (int q = 0; q < s_.cluster; ++q) {
      const float turn = s_.arrangement == LeafArrangement::Opposite    ? decussate(q)
                         : s_.arrangement == LeafArrangement::TwoRanked ? kPi * static_cast<float>(q)
                                                                        : kGoldenAngle * static_cast<float>(q);
      const vec3 radial = frame * vec3(std::cos(turn + spin), std::sin(turn + spin), 0);
      // Needles of a pine stand in a brush at the shoot's end; other leaves along it.
      const float place = (static_cast<float>(q) + 0.75f) / static_cast<float>(s_.cluster);
      const float along = tuft ? length * (0.55f + 0.45f * place) : length * place;
      const float spread = tuft ? 0.75f - 0.3f * place : 0.8f;
      const vec3 blade =
          glm::normalize((tuft ? 0.8f : 0.5f) * direction + spread * radial - vec3(0, static_cast<float>(s_.droop), 0));
      const vec3 scatter(random(3) - 0.5f, 0, uniform(seed_, 95, number_ * 16 + static_cast<std::uint32_t>(q)) - 0.5f);
      const vec3 up = tuft ? direction + 0.2f * scatter : vec3(0, 1, 0) + 0.35f * away + 0.6f * scatter;
      leaf(bone, base + direction * along, blade, up, number_ * 16 + static_cast<std::uint32_t>(q));
    }
  }

  void leaf(std::uint32_t bone, vec3 base, vec3 blade, vec3 up, std::uint32_t id) {
    if (!s_.leaves) return;
    const Bone& carrier = geometry_.bones[bone];
    const quat back = glm::conjugate(alongZ(carrier.tail - carrier.head));
    sim::LeafSite site;
    site.link = static_cast<std::int32_t>(bone);
    site.size = static_cast<float>(s_.length) * (0.75f + 0.5f * uniform(seed_, 96, id));
    site.position = back * (base - carrier.head);
    site.rotation = back * leafRotation(blade, up);
    geometry_.leafSites.push_back(site);
  }

  const Grown& grown_;
  const AxisTree& tree_;
  const FoliageSettings& s_;
  quint64 seed_;
  int material_;
  PlantGeometry& geometry_;
  std::vector<ShortShoot> bare_;
  std::uint32_t number_ = 0;
};

void placeGiven(const Grown& grown, const AxisTree& tree, PlantGeometry& geometry) {
  for (const GivenLeaf& given : grown.leaves) {
    const int bone = std::max(tree.boneOf[at(given.node)], 0);
    const Bone& carrier = geometry.bones[at(bone)];
    const quat back = glm::conjugate(alongZ(carrier.tail - carrier.head));
    sim::LeafSite site;
    site.link = bone;
    site.size = static_cast<float>(std::clamp(given.length, 1e-3, 10.0));
    site.position = back * (vec3(given.position) - carrier.head);
    site.rotation = back * leafRotation(vec3(given.direction), vec3(given.up));
    geometry.leafSites.push_back(site);
  }
}

}  // namespace

double leafAreaOf(const Grown& grown, const FoliageSettings& foliage) {
  double crown = 0, stems = 0;
  for (std::size_t i = 0; i < grown.size(); ++i) {
    crown = std::max(crown, std::hypot(grown.position[i].x, grown.position[i].z));
    if (grown.parent[i] == 0) stems += grown.radius[i] * grown.radius[i];
  }
  const double pipe = 2000 * std::numbers::pi * std::max(stems, grown.radius[0] * grown.radius[0]);
  return foliage.amount * std::min(pipe, foliage.mostLayers * std::numbers::pi * crown * crown);
}

void placeFoliage(const Grown& grown, const AxisTree& tree, const FoliageSettings& foliage, quint64 seed, int material,
                  PlantGeometry& geometry) {
  if (!grown.leaves.empty()) {
    if (foliage.leaves) placeGiven(grown, tree, geometry);
    return;
  }
  if (foliage.length > 1e-4 && foliage.amount > 0) Foliage(grown, tree, foliage, seed, material, geometry).place();
}

}  // namespace windfall::model::growth
