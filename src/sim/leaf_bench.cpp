#include "sim/leaf_bench.h"

#include <omp.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "kernels/leaf_chain.h"
#include "kernels/leaf_motion.h"
#include "kernels/random.h"
#include "sim/engine.h"
#include "sim/leaf_field.h"

namespace windfall::sim {

namespace {

// A run is about a millisecond, shorter than what a busy machine takes away at once.
constexpr int kLeaves = 1 << 16;
constexpr int kSteps = 1;
constexpr float kStep = 1.f / 60;

/// The published design: a structure a leaf, which points to one of 1,024 sequences of five stages, each of which
/// points into a table of differences a sample; one angle. Indices and the search for the stage are corrected (note,
/// 1).
class PublishedLeaves {
 public:
  explicit PublishedLeaves(std::uint32_t count) : leaves_(count), sequences_(1024) {
    const LeafTraits leaf{1, kFlutterRate / 0.04f, 1, 0, 1};
    for (std::uint32_t motion = 0; motion < kLeafMotions; ++motion) {
      for (std::uint32_t k = 0; k < kSamples; ++k) {
        const float time = static_cast<float>(k) * (3.0f / kSamples);
        const MotionSample sample = motionAt(motion, leaf, time);
        table_[motion * kSamples + k] = vec4(sample.velocity * kStep, sample.tumbleTurns * kTwoPi);
      }
    }
    for (std::uint32_t i = 0; i < sequences_.size(); ++i) {
      float total = 0;
      std::uint32_t motion = firstMotion(hash(3, i));
      for (std::uint32_t k = 0; k < 5; ++k) {
        Stage& stage = sequences_[i].stages[k];
        stage = {motion, 0.2f + uniform(3, i, k + 1), uniform(3, i, k + 10)};
        total += stage.length;
        motion = nextMotion(motion, hash(3, i, k + 20));
      }
      for (Stage& stage : sequences_[i].stages) stage.length /= total;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      leaves_[i] = {vec3(uniform(4, i), 10, uniform(4, i, 1)), 0, uniform(4, i, 2), hash(4, i, 3) % 1024u};
    }
  }

  void step(vec3 wind) {
    const auto count = static_cast<std::int64_t>(leaves_.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < count; ++i) advance(leaves_[static_cast<std::size_t>(i)], wind);
  }

 private:
  static constexpr std::uint32_t kSamples = 512;
  struct Stage {
    std::uint32_t motion = 0;
    float length = 0, phase = 0;
  };
  struct Sequence {
    std::array<Stage, 5> stages;
  };
  struct Leaf {
    vec3 position{0};
    float angle = 0;
    float time = 0;
    std::uint32_t sequence = 0;
  };

  void advance(Leaf& leaf, vec3 wind) const {
    leaf.time += kStep / 10;
    if (leaf.time >= 1) leaf.time -= 1;
    float rest = leaf.time;
    const Sequence& sequence = sequences_[leaf.sequence];
    std::size_t k = 0;
    for (; k < 4; ++k) {
      if (rest < sequence.stages[k].length) break;
      rest -= sequence.stages[k].length;
    }
    const Stage& stage = sequence.stages[k];
    float at = rest / stage.length + stage.phase;
    if (at >= 1) at -= 1;
    const float place = std::fmin(std::fmax(at, 0.0f), 0.999999f) * (kSamples - 1);
    const auto index = static_cast<std::uint32_t>(place);
    const float part = place - static_cast<float>(index);
    const vec4* samples = table_.data() + stage.motion * kSamples + index;
    const vec4 sample = samples[0] * (1 - part) + samples[1] * part;
    leaf.position += vec3(sample) + wind * kStep;
    leaf.angle = sample.w;
    if (leaf.position.y < 0) leaf.position.y += 10;
  }

  std::vector<Leaf> leaves_;
  std::vector<Sequence> sequences_;
  std::array<vec4, kLeafMotions * kSamples> table_{};
};

/// Leaves in the air, from so high that none lands, each somewhere in its sequence.
struct Falling {
  SceneDescription scene;
  std::vector<vec4> air;
  WindView wind;
  std::unique_ptr<LeafField> field;
  double time = 0;

  explicit Falling(bool lattice) {
    scene.leaves.count = kLeaves;
    scene.leaves.spawnHeight = 1e4f;
    if (lattice) {
      for (std::uint32_t i = 0; i < 32 * 32 * 32; ++i) air.emplace_back(1 + uniform(5, i), 0, uniform(6, i), 0);
      wind = {air.data(), 32, 32, 32, vec3(-60, 9960, -60), vec3(0.25f)};
    }
    field = std::make_unique<LeafField>(scene);
    for (int k = 0; k < 120; ++k) step();
  }
  void step() {
    field->step(time, kStep, {}, wind);
    time += static_cast<double>(kStep);
  }
};

template <class Step>
Contender contender(std::string name, int threads, Step step) {
  Contender result;
  result.name = std::move(name) + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  result.items = static_cast<double>(kLeaves) * kSteps;
  result.run = [threads, step] {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    for (int k = 0; k < kSteps; ++k) step();
    omp_set_num_threads(before);
  };
  return result;
}

std::vector<Contender> stepContenders() {
  const auto still = std::make_shared<Falling>(false), windy = std::make_shared<Falling>(true);
  const auto published = std::make_shared<PublishedLeaves>(kLeaves);
  std::vector<Contender> all;
  std::vector<int> counts{1};
  if (omp_get_max_threads() > 1) counts.push_back(omp_get_max_threads());
  for (const int threads : counts) {
    all.push_back(contender("closed form, 3-D turn, still air", threads, [still] { still->step(); }));
    all.push_back(contender("closed form, 3-D turn, wind lattice", threads, [windy] { windy->step(); }));
    all.push_back(contender("published tables, one angle", threads, [published] { published->step(vec3(1, 0, 0)); }));
  }
  return all;
}

}  // namespace

std::vector<Benchmark> leafBenchmarks() {
  return {{"leaves.step", "65,536 falling leaves, a step of 1/60 s, beside the published kernel with corrected indices",
           "ns per leaf and step", 1e9, stepContenders}};
}

}  // namespace windfall::sim
