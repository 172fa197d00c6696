#include <algorithm>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/frames.h"
#include "model/plant/links_private.h"

namespace windfall::model {

namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }
constexpr float kGoldenAngle = 2.39996323f;
constexpr float kBlade = 0.08f;           ///< m
constexpr double kLeafArea = 0.65 * 0.6;  ///< of the squared blade length: 0.65 L W, W = 0.6 L
constexpr double kMostSites = 200'000;

}  // namespace

std::vector<sim::LeafSite> leafSitesOnTerminals(const std::vector<Bone>& bones, const std::vector<Branch>& branches,
                                                double leafArea) {
  const std::vector<char> terminal = terminalBranches(branches);
  double shares = 0;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    if (terminal[i]) shares += branches[i].baseRadius * branches[i].baseRadius;
  }
  std::vector<sim::LeafSite> sites;
  if (!(shares > 0)) return sites;
  const double total = std::min(leafArea / (kLeafArea * static_cast<double>(kBlade * kBlade)), kMostSites);
  std::uint32_t number = 0;
  double carried = 0.5;
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const Branch& branch = branches[i];
    if (!terminal[i] || !(branch.length > 0)) continue;
    const double perMetre = total * branch.baseRadius * branch.baseRadius / shares / branch.length;
    for (const int b : branch.bones) {
      const Bone& bone = bones[at(b)];
      const float length = glm::length(bone.tail - bone.head);
      const quat frame = alongZ(bone.tail - bone.head);
      const double wanted = perMetre * static_cast<double>(length) + carried;
      const int count = static_cast<int>(wanted);
      carried = wanted - count;
      for (int k = 0; k < count; ++k, ++number) {
        const float along = length * (static_cast<float>(k) + uniform(7, number, 0)) / static_cast<float>(count);
        const float angle = kGoldenAngle * static_cast<float>(number) + 0.35f * (uniform(7, number, 1) - 0.5f);
        const vec3 out(std::cos(angle), std::sin(angle), 0);
        const vec3 away = frame * out, ahead = frame * vec3(0, 0, 1);
        // A petiole, and the unresolved side shoot that it stands on.
        const float stalk = bone.radius + 0.02f + 0.10f * uniform(7, number, 2);
        const vec3 blade = 0.5f * ahead + 0.8f * away + vec3(0, -0.3f, 0);
        sim::LeafSite site;
        site.link = b;
        site.position = vec3(0, 0, along) + out * stalk;
        site.rotation = glm::conjugate(frame) * leafRotation(blade, vec3(0, 1, 0) + 0.25f * away);
        site.size = kBlade * (0.75f + 0.5f * uniform(7, number, 3));
        sites.push_back(site);
      }
    }
  }
  return sites;
}

}  // namespace windfall::model
