#include "model/plant/sample_skeleton.h"

#include <algorithm>
#include <cmath>

#include "kernels/random.h"

namespace windfall::model {

namespace {

constexpr float kGolden = 2.39996323f;  ///< radians between successive side shoots

struct Shoot {
  std::int32_t parent = -1;
  vec3 from{0}, along{0, 1, 0};
  float length = 0, radius = 0;
  int links = 1, order = 0;
};

class Grower {
 public:
  Grower(std::uint64_t seed, const SampleShape& shape) : shape_(shape), random_(seed) {}

  SkeletonGraph grow() {
    add({-1, vec3(0), vec3(0.02f, 1, 0.01f), shape_.height, shape_.radius, shape_.links, 0});
    finishGraph(graph_);
    return std::move(graph_);
  }

 private:
  float jitter() { return static_cast<float>(random_.uniform(-1, 1)); }

  void add(const Shoot& shoot) {
    vec3 foot = shoot.from, along = glm::normalize(shoot.along);
    std::int32_t below = shoot.parent;
    const auto count = static_cast<float>(shoot.links);
    for (int i = 0; i < shoot.links; ++i) {
      const float share = static_cast<float>(i) / count;
      // Shoots turn up again, and wander.
      along = glm::normalize(along + vec3(jitter(), 0.7f + jitter(), jitter()) * (shoot.order == 0 ? 0.07f : 0.16f));
      const vec3 top = foot + along * (shoot.length / count);
      Segment segment;
      segment.a = foot, segment.b = top;
      segment.ra = shoot.radius * (1 - 0.8f * share), segment.rb = shoot.radius * (1 - 0.8f * (share + 1 / count));
      segment.parent = below;
      below = static_cast<std::int32_t>(graph_.segments.size());
      graph_.segments.push_back(segment);
      foot = top;
      if (shoot.order >= shape_.orders || i + 1 == shoot.links || (shoot.order == 0 && share < 0.15f)) continue;
      for (int k = 0; k < shape_.shoots; ++k) branch(shoot, i, k, share, foot, along, segment.rb, below);
    }
  }

  void branch(const Shoot& from, int link, int k, float share, vec3 foot, vec3 along, float radius,
              std::int32_t below) {
    const float around = kGolden * static_cast<float>(link) +
                         6.2831853f * static_cast<float>(k) / static_cast<float>(shape_.shoots) + 0.4f * jitter();
    const vec3 side = glm::normalize(glm::cross(along, vec3(std::cos(around), 0.31f, std::sin(around))));
    Shoot shoot;
    shoot.parent = below, shoot.from = foot, shoot.order = from.order + 1;
    shoot.along = side + along * (0.6f + 0.3f * jitter());
    shoot.length = from.length * (from.order == 0 ? 0.5f * (1.1f - 0.7f * share) : 0.35f) * (1 + 0.2f * jitter());
    shoot.radius = std::max(radius * shape_.taper, 4e-4f);
    shoot.links = std::max(2, from.links * (from.order == 0 ? 1 : 2) / 5);
    add(shoot);
  }

  const SampleShape shape_;
  RandomSequence random_;
  SkeletonGraph graph_;
};

}  // namespace

SkeletonGraph sampleSkeleton(std::uint64_t seed, const SampleShape& shape) { return Grower(seed, shape).grow(); }

}  // namespace windfall::model
