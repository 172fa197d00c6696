#include "model/plant/bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/engine.h"

namespace windfall::model {

namespace {

constexpr double kLongest = 120, kFastest = 240;  // s, samples a second
constexpr double kBlend = 2.5;                    // s, at most 40 % of the clip

double angleBetween(const quat& a, const quat& b) {
  const double product = std::abs(static_cast<double>(glm::dot(a, b)));
  // Near 1 the arc cosine is noise: sine of half the angle instead.
  const quat d = glm::conjugate(a) * b;
  const double sine = std::sqrt(static_cast<double>(d.x * d.x + d.y * d.y + d.z * d.z));
  return 2 * std::atan2(sine, product);
}

float smooth(float t) { return t * t * (3 - 2 * t); }

/// Rotation of every link against its parent link, of one moment.
std::vector<quat> relative(const std::vector<mat4>& pose, const sim::Tree& tree) {
  std::vector<quat> world(pose.size()), result(pose.size());
  for (std::size_t i = 0; i < pose.size(); ++i) {
    world[i] = glm::normalize(glm::quat_cast(mat3(pose[i])));
    const int parent = tree.links[i].parent;
    result[i] =
        parent < 0 ? world[i] : glm::normalize(glm::conjugate(world[static_cast<std::size_t>(parent)]) * world[i]);
  }
  return result;
}

Status check(const BakeSettings& settings, const PlantBodies& bodies) {
  if (bodies.tree.links.empty()) return Error{"has no branch that could move"};
  if (!(settings.length >= 0.1 && settings.length <= kLongest)) return Error{"a clip is 0.1 to 120 seconds long"};
  if (!(settings.rate >= 1 && settings.rate <= kFastest)) return Error{"a clip has 1 to 240 samples a second"};
  if (!(settings.tolerance >= 0 && settings.tolerance <= 90)) return Error{"the tolerance is 0 to 90 degrees"};
  if (!(settings.warmUp >= 0 && settings.warmUp <= 600)) return Error{"the time before a clip is 0 to 600 seconds"};
  return ok();
}

}  // namespace

void reduceKeys(ClipTrack& track, double tolerance) {
  const std::size_t count = track.times.size();
  if (count < 3 || track.rotations.size() != count) return;
  std::vector<char> kept(count, 0);
  kept.front() = kept.back() = 1;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, count - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t at = 0;
    for (std::size_t i = a + 1; i < b; ++i) {
      const float share = (track.times[i] - track.times[a]) / (track.times[b] - track.times[a]);
      const double angle = angleBetween(glm::slerp(track.rotations[a], track.rotations[b], share), track.rotations[i]);
      if (angle > worst) worst = angle, at = i;
    }
    if (at == 0) continue;
    kept[at] = 1;
    open.emplace_back(a, at);
    open.emplace_back(at, b);
  }
  ClipTrack reduced;
  reduced.bone = track.bone;
  for (std::size_t i = 0; i < count; ++i) {
    if (!kept[i]) continue;
    reduced.times.push_back(track.times[i]);
    reduced.rotations.push_back(track.rotations[i]);
    if (!track.shifts.empty()) reduced.shifts.push_back(track.shifts[i]);
  }
  track = std::move(reduced);
}

Result<Clip> bakeClip(const PlantGeometry& geometry, const PlantBodies& bodies, const BakeSettings& settings,
                      Progress& progress) {
  if (const Status status = check(settings, bodies); !status) return status.error();
  const sim::Tree& tree = bodies.tree;
  sim::SceneDescription scene;
  auto alone = std::make_shared<sim::Tree>(tree);
  alone->sites.clear();
  scene.trees.push_back({alone, {}});
  scene.wind = settings.wind;
  scene.wind.fans.clear();
  scene.solver = settings.solver;
  scene.leaves.count = 0;
  Result<std::unique_ptr<sim::Engine>> made = sim::Engine::create(std::move(scene), sim::Device::Cpu);
  if (!made) return made.error();
  sim::Engine& engine = **made;

  const auto samples = static_cast<std::size_t>(std::lround(settings.length * settings.rate));
  const double interval = settings.length / static_cast<double>(samples);
  const auto blend =
      settings.looping ? static_cast<std::size_t>(std::min(kBlend, 0.4 * settings.length) / interval) : std::size_t{0};
  const double whole = settings.warmUp + interval * static_cast<double>(samples + blend);
  const double step = static_cast<double>(settings.solver.step);
  double simulated = 0;
  const auto advance = [&](double seconds) {
    for (double left = seconds; left > 0; left -= 4 * step) {
      if (progress.cancelled()) return false;
      engine.advance(std::min(left, 4 * step));
    }
    simulated += seconds;
    progress.report(0.95 * simulated / whole);
    return true;
  };
  if (!advance(settings.warmUp)) return Error{"cancelled", true};
  std::vector<std::vector<quat>> frames;
  std::vector<mat4> pose(engine.linkCount());
  for (std::size_t f = 0; f <= samples + blend; ++f) {
    if (f > 0 && !advance(interval)) return Error{"cancelled", true};
    engine.write(pose, {});
    frames.push_back(relative(pose, tree));
  }
  // At its start the clip is what would follow its end, and becomes its own first seconds.
  for (std::size_t f = 0; f < blend; ++f) {
    const float share = smooth(static_cast<float>(f) / static_cast<float>(blend));
    for (std::size_t i = 0; i < pose.size(); ++i)
      frames[f][i] = glm::slerp(frames[samples + f][i], frames[f][i], share);
  }
  if (settings.looping) frames[samples] = frames[0];

  Clip clip;
  clip.name = settings.name;
  clip.length = settings.length;
  clip.rate = settings.rate;
  clip.looping = settings.looping;
  for (std::size_t i = 0; i < pose.size(); ++i) {
    ClipTrack track;
    track.bone = geometry.bones[static_cast<std::size_t>(bodies.boneOfLink[i])].name;
    for (std::size_t f = 0; f <= samples; ++f) {
      track.times.push_back(static_cast<float>(static_cast<double>(f) * interval));
      quat q = frames[f][i];
      if (f > 0 && glm::dot(q, track.rotations.back()) < 0) q = -q;
      track.rotations.push_back(q);
    }
    track.times.back() = static_cast<float>(settings.length);
    if (settings.looping) track.rotations.back() = track.rotations.front();
    reduceKeys(track, settings.tolerance * std::numbers::pi / 180);
    clip.tracks.push_back(std::move(track));
  }
  progress.report(1);
  return clip;
}

}  // namespace windfall::model
