#include "model/plant/grow/colonization.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/plant/grow/draw.h"

namespace windfall::model::growth {

namespace {

constexpr int kMostNodes = 300'000, kMostRounds = 4000;
enum Question : std::uint64_t { kTrunkX = 31, kTrunkZ, kNoise };

/// Points by cells of a grid: no collisions, no pointers (growers.md, 1.3).
class PointGrid {
 public:
  PointGrid(const std::vector<dvec3>& points, double cell) : cell_(cell) {
    lower_ = dvec3(1e300);
    dvec3 upper(-1e300);
    for (const dvec3& p : points) lower_ = glm::min(lower_, p), upper = glm::max(upper, p);
    for (int k = 0; k < 3; ++k) size_[k] = static_cast<int>((upper[k] - lower_[k]) / cell) + 1;
    start_.assign(at(size_[0]) * at(size_[1]) * at(size_[2]) + 1, 0);
    for (const dvec3& p : points) ++start_[cellOf(p) + 1];
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    std::vector<int> next(start_.begin(), start_.end() - 1);
    item_.resize(points.size());
    for (std::size_t a = 0; a < points.size(); ++a) item_[at(next[cellOf(points[a])]++)] = static_cast<int>(a);
  }

  template <class Visit>
  void around(dvec3 centre, double radius, Visit visit) const {
    int low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = std::max(static_cast<int>(std::floor((centre[k] - radius - lower_[k]) / cell_)), 0);
      high[k] = std::min(static_cast<int>(std::floor((centre[k] + radius - lower_[k]) / cell_)), size_[k] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        if (high[0] < low[0]) continue;
        const std::size_t row = (at(z) * at(size_[1]) + at(y)) * at(size_[0]);
        for (int i = start_[row + at(low[0])]; i < start_[row + at(high[0]) + 1]; ++i) visit(at(item_[at(i)]));
      }
    }
  }

 private:
  std::size_t cellOf(dvec3 p) const {
    std::size_t index[3];
    for (int k = 0; k < 3; ++k) {
      index[k] = at(std::clamp(static_cast<int>((p[k] - lower_[k]) / cell_), 0, size_[k] - 1));
    }
    return (index[2] * at(size_[1]) + index[1]) * at(size_[0]) + index[0];
  }

  double cell_;
  dvec3 lower_{0};
  int size_[3]{};
  std::vector<int> start_, item_;
};

class Colony {
 public:
  Colony(const ColonizationSettings& settings, std::vector<dvec3> points, const Grown& chain, quint64 seed)
      : s_(settings),
        points_(std::move(points)),
        grid_(points_, 0.5 * settings.influence),
        seed_(seed),
        kill_(std::max(settings.kill, 1.5 * settings.step)),
        alive_(points_.size(), 1),
        near_(points_.size(), -1),
        distance_(points_.size(), settings.influence * settings.influence) {
    out_.grown = chain;
    children_.resize(chain.size());
    gone_.assign(chain.size(), 0);
    for (std::size_t i = 1; i < chain.size(); ++i) children_[at(chain.parent[i])].push_back(static_cast<int>(i));
    scan(0);
  }

  /// One round; false when nothing happened any more.
  bool grow(int round) {
    Grown& g = out_.grown;
    const std::size_t before = g.size();
    std::vector<dvec3> sum(before, dvec3(0));
    std::vector<int> count(before, 0);
    for (std::size_t a = 0; a < points_.size(); ++a) {
      if (!alive_[a] || near_[a] < 0) continue;
      const dvec3 way = points_[a] - g.position[at(near_[a])];
      sum[at(near_[a])] += way / std::max(glm::length(way), 1e-12);
      ++count[at(near_[a])];
    }
    std::vector<char> given(before, 0);
    bool gaveUp = false;
    for (std::size_t j = 0; j < before && g.size() < kMostNodes; ++j) {
      if (count[j] == 0) continue;
      dvec3 direction = sum[j] / std::max(glm::length(sum[j]), 1e-12);
      // Noise depends on the node alone: repeats must fall onto each other, so that they are seen as such (1.4).
      const auto who = static_cast<std::uint64_t>(j);
      const dvec3 noise(draw(seed_, who, kNoise) - 0.5, draw(seed_, who, kNoise + 1) - 0.5,
                        draw(seed_, who, kNoise + 2) - 0.5);
      direction += dvec3(0, s_.upward, 0) + s_.noise * noise;
      const double length = glm::length(direction);
      const dvec3 q = g.position[j] + s_.step / std::max(length, 1e-12) * direction;
      const bool repeats = std::any_of(children_[j].begin(), children_[j].end(), [&](int child) {
        return glm::length(g.position[at(child)] - q) < 0.25 * s_.step;
      });
      if (glm::length(sum[j]) < 0.05 * count[j] || length < 1e-9 || repeats) {
        given[j] = 1, gaveUp = true;
        continue;
      }
      append(q, static_cast<int>(j), round);
    }
    if (gaveUp) {
      for (std::size_t a = 0; a < points_.size(); ++a) {
        if (alive_[a] && near_[a] >= 0 && given[at(near_[a])]) alive_[a] = 0, ++out_.unreachable;
      }
    }
    const bool grew = g.size() > before;
    if (grew) scan(before);
    return grew || gaveUp;
  }

  void apply(const GrowthEvent& event, int round) {
    Grown& g = out_.grown;
    const int node =
        findEventNode(event, g.size(), 3 * s_.step, [&](std::size_t i) { return gone_[i] ? nullptr : &g.position[i]; });
    if (node < 0) return;
    if (event.prune) {
      prune(at(node));
      return;
    }
    const std::size_t before = g.size();
    int from = node;
    for (const dvec3& place : event.line) from = append(place, from, round);
    scan(before);
  }

  Colonized take() {
    for (std::size_t a = 0; a < points_.size(); ++a) out_.left += alive_[a] != 0;
    std::vector<char> keep(out_.grown.size());
    std::transform(gone_.begin(), gone_.end(), keep.begin(), [](char gone) { return gone ? 0 : 1; });
    if (anyGone_) keepOnly(out_.grown, keep);
    return std::move(out_);
  }

 private:
  int append(dvec3 place, int from, int round) {
    const int node = out_.grown.add(place, from, round);
    children_.emplace_back();
    children_[at(from)].push_back(node);
    gone_.push_back(0);
    return node;
  }

  void scan(std::size_t first) {
    for (std::size_t j = first; j < out_.grown.size(); ++j) {
      if (gone_[j]) continue;
      const dvec3 place = out_.grown.position[j];
      grid_.around(place, s_.influence, [&](std::size_t a) {
        const dvec3 way = points_[a] - place;
        const double squared = glm::dot(way, way);
        if (squared >= distance_[a]) return;
        distance_[a] = squared, near_[a] = static_cast<int>(j);
        if (squared < kill_ * kill_) alive_[a] = 0;
      });
    }
  }

  /// The subtree goes; its points are free again and look for the nearest node that is left.
  void prune(std::size_t from) {
    if (from == 0) return;
    anyGone_ = true;
    const Grown& g = out_.grown;
    gone_[from] = 1;
    for (std::size_t i = from + 1; i < g.size(); ++i) {
      if (gone_[at(g.parent[i])]) gone_[i] = 1;
    }
    std::erase(children_[at(g.parent[from])], static_cast<int>(from));
    for (std::size_t a = 0; a < points_.size(); ++a) {
      if (near_[a] < 0 || !gone_[at(near_[a])]) continue;
      alive_[a] = 1, near_[a] = -1, distance_[a] = s_.influence * s_.influence;
    }
    scan(0);
  }

  const ColonizationSettings& s_;
  std::vector<dvec3> points_;
  PointGrid grid_;
  quint64 seed_;
  double kill_;
  std::vector<char> alive_, gone_;
  std::vector<int> near_;
  std::vector<double> distance_;
  std::vector<std::vector<int>> children_;
  bool anyGone_ = false;
  Colonized out_;
};

}  // namespace

Colonized colonize(const ColonizationSettings& settings, std::vector<dvec3> points, const Grown& chain, quint64 seed,
                   const std::vector<GrowthEvent>& events, Progress& progress) {
  const double all = static_cast<double>(std::max<std::size_t>(points.size(), 1));
  Colony colony(settings, std::move(points), chain, seed);
  std::size_t next = 0;
  int round = 1;
  // Events name rounds: `when` is one here.
  for (bool grew = true; (grew || next < events.size()) && round < kMostRounds; ++round) {
    if (progress.cancelled()) break;
    while (next < events.size() && events[next].when <= round) colony.apply(events[next++], round);
    grew = colony.grow(round);
    if (!grew && next < events.size()) round = std::max(round, static_cast<int>(events[next].when));
    progress.report(std::min(1.0, round / (20 + std::sqrt(all))));
  }
  Colonized result = colony.take();
  result.rounds = round - 1;
  result.grown.length = result.rounds;
  return result;
}

Result<Grown> seedTrunks(const ColonizationSettings& s, double height, const std::vector<dvec3>& points, quint64 seed) {
  Grown chain;
  chain.add(dvec3(0), -1, 0);
  const auto inReach = [&](dvec3 place) {
    return std::any_of(points.begin(), points.end(),
                       [&](const dvec3& p) { return glm::length(p - place) < s.influence; });
  };
  bool reaches = false;
  for (int stem = 0; stem < std::max(s.stems, 1); ++stem) {
    const double azimuth = 2 * std::numbers::pi * stem / std::max(s.stems, 1) + 0.7;
    const double lean = s.stems > 1 ? std::tan(20 * std::numbers::pi / 180) : 0;
    const dvec3 along = glm::normalize(dvec3(lean * std::cos(azimuth), 1, lean * std::sin(azimuth)));
    int from = 0;
    dvec3 place(0), direction = along;
    const int most = static_cast<int>(height / s.step) + 1;
    for (int k = 1; k <= most; ++k) {
      const auto who = static_cast<std::uint64_t>(stem) << 20u | static_cast<std::uint64_t>(k / 3);
      if (k % 3 == 0) {
        // Wanders, and comes back: the axis stands over the root.
        const dvec3 off(place.x - along.x / along.y * place.y, 0, place.z - along.z / along.y * place.y);
        direction = glm::normalize(
            along + s.trunkWander * dvec3(draw(seed, who, kTrunkX) - 0.5, 0, draw(seed, who, kTrunkZ) - 0.5) -
            0.25 * off);
      }
      const bool tall = place.y >= s.trunkTop - 1e-9;
      if (tall && (reaches = reaches || inReach(place))) break;
      place += s.step * direction;
      from = chain.add(place, from, 0, true);
    }
  }
  reaches = reaches || std::any_of(chain.position.begin(), chain.position.end(), inReach);
  if (!reaches) return Error{"the trunk does not reach the crown's points"};
  return chain;
}

}  // namespace windfall::model::growth
