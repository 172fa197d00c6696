#include "model/plant/grow/self_organizing.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "model/plant/grow/draw.h"
#include "model/plant/grow/shadow_grid.h"

namespace windfall::model::growth {

namespace {

constexpr double kPi = std::numbers::pi, kGolden = 137.5 * kPi / 180;
constexpr int kMostNodes = 300'000;
enum Question : std::uint64_t { kAngle = 51, kAzimuth, kBole };

struct Metamer {
  dvec3 place, direction, up;
  int parent = -1, main = -1;
  int firstSide = -1, lastSide = -1, nextSide = -1;  ///< lateral branches, in the order of their birth
  std::uint32_t buds = 0;                            ///< lateral buds that sleep, a bit a slot
  int places = 0;                                    ///< lateral buds that there were
  int order = 0, year = 0, number = 0;               ///< `number` counts along the axis
  bool dead = false;
};

struct Bud {
  int node = 0;
  bool terminal = false;
  int slot = 0;
  double vigour = 0;
};

dvec3 turned(dvec3 v, dvec3 axis, double angle) {
  return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
         axis * (glm::dot(axis, v) * (1 - std::cos(angle)));
}

/// A unit vector across `direction`, as near to `up` as can be.
dvec3 across(dvec3 direction, dvec3 up) {
  dvec3 side = up - direction * glm::dot(direction, up);
  if (glm::dot(side, side) < 1e-12) side = std::abs(direction.x) < 0.9 ? dvec3(1, 0, 0) : dvec3(0, 0, 1);
  side -= direction * glm::dot(direction, side);
  return glm::normalize(side);
}

class Plant {
 public:
  Plant(const SelfOrganizingSettings& s, double height, quint64 seed)
      : s_(s),
        height_(height),
        seed_(seed),
        grid_(s.internode, 0.75 * height, 1.15 * height, s.density, s.falloff, s.shadowDepth) {
    Metamer root;
    root.place = dvec3(0);
    root.direction = dvec3(0, 1, 0);
    root.up = dvec3(1, 0, 0);
    root.places = std::min(s.basalBuds, 30);
    root.buds = (1u << static_cast<unsigned>(root.places)) - 1;
    nodes_.push_back(root);
  }

  void grow(int year) {
    measureLight();
    shed(year);
    shareVigour();
    shoot(year);
  }

  void apply(const GrowthEvent& event, int year) {
    const int node = findEventNode(event, nodes_.size(), 3 * s_.internode,
                                   [&](std::size_t i) { return nodes_[i].dead ? nullptr : &nodes_[i].place; });
    if (node < 0) return;
    if (event.prune) {
      if (node == 0) return;
      Metamer& stub = nodes_[at(nodes_[at(node)].parent)];
      if (stub.main == node) stub.main = -1;
      for (std::size_t i = at(node); i < nodes_.size(); ++i) {
        if (nodes_[i].dead || (i != at(node) && !nodes_[at(nodes_[i].parent)].dead)) continue;
        nodes_[i].dead = true;
        grid_.cast(nodes_[i].place, -1);
      }
      return;
    }
    int from = node;
    for (std::size_t k = 0; k < event.line.size(); ++k) {
      const dvec3 way = event.line[k] - nodes_[at(from)].place;
      if (!(glm::length(way) > 1e-9)) continue;
      from = append(from, event.line[k], glm::normalize(way), k > 0, year, true);
    }
  }

  SelfOrganized take() {
    SelfOrganized result;
    result.made = static_cast<int>(nodes_.size());
    result.full = full_;
    std::vector<char> keep;
    for (const Metamer& m : nodes_) {
      keep.push_back(m.dead || (m.parent >= 0 && !keep[at(m.parent)]) ? 0 : 1);
      const bool onward = m.parent >= 0 && nodes_[at(m.parent)].main == static_cast<int>(keep.size()) - 1;
      result.grown.add(m.place, m.parent, m.year, onward);
    }
    keepOnly(result.grown, keep);
    return result;
  }

 private:
  double light(const Metamer& m) const { return std::max(0.0, 1 - grid_.shade(m.place) + s_.density); }

  void measureLight() {
    const std::size_t n = nodes_.size();
    light_.assign(n, 0), sum_.assign(n, 0), buds_.assign(n, 0), size_.assign(n, 0);
    for (std::size_t i = n; i-- > 0;) {
      const Metamer& m = nodes_[i];
      if (m.dead) continue;
      light_[i] = light(m);
      const int own = std::popcount(m.buds) + (m.main < 0 ? 1 : 0);
      sum_[i] += light_[i] * own, buds_[i] += own, size_[i] += 1;
      if (m.parent < 0) continue;
      const std::size_t p = at(m.parent);
      sum_[p] += sum_[i], buds_[p] += buds_[i], size_[p] += size_[i];
    }
  }

  void shed(int year) {
    const double tall = grownHeight(s_, height_, year);
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      Metamer& m = nodes_[i];
      if (m.dead) continue;
      const Metamer& parent = nodes_[at(m.parent)];
      bool dies = parent.dead;
      if (!dies && parent.main != static_cast<int>(i)) {
        dies = year - m.year >= 3 && sum_[i] / size_[i] < s_.pruning;
        const auto who = static_cast<std::uint64_t>(i) << 12u | static_cast<std::uint64_t>(year);
        dies = dies ||
               (m.order == 1 && year - m.year >= 3 && parent.place.y < s_.bole * tall && draw(seed_, who, kBole) < 0.5);
      }
      if (!dies) continue;
      m.dead = true;
      grid_.cast(m.place, -1);
    }
  }

  /// Items of the axis that starts at `start`, from its base to its tip, and the vigour that each is given.
  void shareAxis(int start, double vigour) {
    items_.clear(), targets_.clear(), byTopology_.clear();
    double v = vigour;
    for (int i = start; i >= 0; i = nodes_[at(i)].main) {
      const Metamer& m = nodes_[at(i)];
      const double own = light_[at(i)];
      double lateral = own * std::popcount(m.buds);
      for (int side = m.firstSide; side >= 0; side = nodes_[at(side)].nextSide) {
        if (!nodes_[at(side)].dead) lateral += sum_[at(side)];
      }
      const double main = m.main >= 0 ? sum_[at(m.main)] : own;
      const VigourShares shares = borchertHonda(v, main, lateral, s_.leader);
      const auto add = [&](const AxisItem& item, const Bud& target, double given) {
        items_.push_back(item), targets_.push_back(target), byTopology_.push_back(given);
      };
      for (int slot = 0; slot < m.places; ++slot) {
        if (m.buds & (1u << static_cast<unsigned>(slot))) {
          add({own, 1, false}, {i, false, slot, 0}, lateral > 0 ? shares.lateral * own / lateral : 0);
        }
      }
      for (int side = m.firstSide; side >= 0; side = nodes_[at(side)].nextSide) {
        const double light = sum_[at(side)];
        if (nodes_[at(side)].dead) continue;
        add({light, buds_[at(side)], false}, {side, false, -1, 0}, lateral > 0 ? shares.lateral * light / lateral : 0);
      }
      if (m.main < 0) add({own, 1, true}, {i, true, 0, 0}, shares.main);
      v = shares.main;
    }
    const bool trunk = nodes_[at(start)].order == 0;
    const double mix = s_.model == ResourceModel::BorchertHonda       ? 0
                       : s_.model == ResourceModel::Priority || trunk ? 1
                                                                      : 0;
    std::vector<double> given = byTopology_;
    if (mix > 0) given = byPriority(vigour, items_, s_);
    giveBack(given);
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      Bud bud = targets_[k];
      bud.vigour = given[k];
      if (bud.slot < 0 && !bud.terminal) {
        vigour_[at(bud.node)] = given[k];
      } else if (given[k] >= 1) {
        budsThatGrow_.push_back(bud);
      }
    }
  }

  /// What a bud cannot use goes to the other items of its axis, by their light, once.
  void giveBack(std::vector<double>& given) const {
    double spare = 0, light = 0;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const bool bud = targets_[k].terminal || targets_[k].slot >= 0;
      if (bud && given[k] > s_.longestShoot) {
        spare += given[k] - s_.longestShoot;
      } else {
        light += items_[k].light;
      }
    }
    if (!(spare > 0) || !(light > 0)) return;
    for (std::size_t k = 0; k < given.size(); ++k) {
      const bool bud = targets_[k].terminal || targets_[k].slot >= 0;
      given[k] = bud && given[k] > s_.longestShoot ? s_.longestShoot : given[k] + spare * items_[k].light / light;
    }
  }

  void shareVigour() {
    vigour_.assign(nodes_.size(), 0);
    vigour_[0] = s_.vigour * sum_[0];
    budsThatGrow_.clear();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Metamer& m = nodes_[i];
      if (m.dead || (m.parent >= 0 && nodes_[at(m.parent)].main == static_cast<int>(i))) continue;
      shareAxis(static_cast<int>(i), vigour_[i]);
    }
  }

  int longest(int order) const { return std::max(2, s_.longestShoot - order); }

  /// Direction of the brightest of seven places ahead.
  dvec3 brightest(dvec3 place, dvec3 direction, dvec3 up, double length) const {
    const double ahead = 1.5 * length, tilt = 35 * kPi / 180;
    dvec3 best = direction;
    double bestShade = grid_.shade(place + ahead * direction) - 0.02;
    for (int k = 0; k < 6; ++k) {
      const dvec3 side = turned(up, direction, k * kPi / 3);
      const dvec3 probe = direction * std::cos(tilt) + side * std::sin(tilt);
      const double shade = grid_.shade(place + ahead * probe);
      if (shade < bestShade) bestShade = shade, best = probe;
    }
    return best;
  }

  /// Where a lateral bud points.
  dvec3 budDirection(const Bud& bud) const {
    const Metamer& m = nodes_[at(bud.node)];
    const auto who = static_cast<std::uint64_t>(bud.node) << 6u | static_cast<std::uint64_t>(bud.slot);
    const double angle = s_.angle * kPi / 180 * (0.85 + 0.3 * draw(seed_, who, kAngle));
    const double jitter = (draw(seed_, who, kAzimuth) - 0.5) * 0.1 * kPi;
    if (s_.sprays && m.order >= 1) {
      dvec3 level = glm::cross(dvec3(0, 1, 0), m.direction);
      level = glm::length(level) > 1e-6 ? glm::normalize(level) : m.up;
      const double side = (m.number + bud.slot) % 2 == 0 ? 1 : -1;
      return m.direction * std::cos(angle) + turned(level, m.direction, 0.5 * jitter) * (side * std::sin(angle));
    }
    double azimuth = 0;
    if (bud.node == 0 || s_.arrangement == BudArrangement::Whorled) {
      azimuth = kGolden * m.year + 2 * kPi * bud.slot / std::max(m.places, 1);
    } else if (s_.arrangement == BudArrangement::Opposite) {
      azimuth = 0.5 * kPi * m.number + kPi * bud.slot;
    } else {
      azimuth = kGolden * m.number + 2 * kPi * bud.slot / std::max(m.places, 1);
    }
    const dvec3 side = turned(m.up, m.direction, azimuth + jitter);
    return glm::normalize(m.direction * std::cos(angle) + side * std::sin(angle));
  }

  int append(int from, dvec3 place, dvec3 direction, bool onward, int year, bool budded) {
    Metamer m;
    const Metamer& parent = nodes_[at(from)];
    m.place = place;
    m.direction = direction;
    m.up = across(direction, parent.up);
    m.parent = from;
    m.order = parent.order + (onward ? 0 : 1);
    m.number = onward ? parent.number + 1 : 1;
    m.year = year;
    if (budded) {
      m.places = s_.arrangement == BudArrangement::Whorled ? (m.order == 0 ? s_.buds : 2) : s_.buds;
      m.places = std::clamp(m.places, 0, 30);
      m.buds = (1u << static_cast<unsigned>(m.places)) - 1;
    }
    const int node = static_cast<int>(nodes_.size());
    nodes_.push_back(m);
    Metamer& before = nodes_[at(from)];
    if (onward) {
      before.main = node;
    } else if (before.lastSide >= 0) {
      nodes_[at(before.lastSide)].nextSide = node, before.lastSide = node;
    } else {
      before.firstSide = before.lastSide = node;
    }
    pending_.push_back(node);
    return node;
  }

  void shoot(int year) {
    double top = 0;
    for (const Metamer& m : nodes_) {
      if (!m.dead) top = std::max(top, m.place.y);
    }
    const double tall = grownHeight(s_, height_, year);
    int leader = 1;
    for (const Bud& bud : budsThatGrow_) {
      if (bud.terminal && nodes_[at(bud.node)].order == 0) leader = std::min(static_cast<int>(bud.vigour), longest(0));
    }
    const double stretch = std::clamp(std::max(0.0, tall - top) / (leader * s_.internode), 0.15, 1.0);
    for (const Bud& bud : budsThatGrow_) {
      const int order = nodes_[at(bud.node)].order + (bud.terminal ? 0 : 1);
      const int count = std::min(static_cast<int>(bud.vigour), longest(order));
      double length = s_.internode * std::min(1.3, bud.vigour / count);
      length *= order > 0 ? 0.85 * std::max(stretch, 0.6) : stretch;
      dvec3 direction = bud.terminal ? nodes_[at(bud.node)].direction : budDirection(bud);
      if (!bud.terminal) nodes_[at(bud.node)].buds &= ~(1u << static_cast<unsigned>(bud.slot));
      int from = bud.node;
      for (int k = 0; k < count; ++k) {
        const Metamer& m = nodes_[at(from)];
        const dvec3 light = brightest(m.place, direction, across(direction, m.up), length);
        dvec3 pull = s_.upward * (order == 0 ? 2.0 : 1.0) * dvec3(0, 1, 0);
        if (order > 0 && s_.level > 0) {
          const dvec3 flat(direction.x, 0, direction.z);
          if (glm::length(flat) > 1e-6) pull += s_.level * glm::normalize(flat);
          pull.y -= s_.level * direction.y;
        }
        direction = glm::normalize(direction + s_.light * light + pull);
        const dvec3 place = m.place + length * direction;
        // Nothing grows above the curve, out of the crown's reach, or into the ground.
        if (place.y > tall + 1e-9 || place.y < 0.02 || std::hypot(place.x, place.z) > s_.reach * tall + 0.3) break;
        if (nodes_.size() >= kMostNodes) {
          full_ = true;
          break;
        }
        const bool last = k + 1 == count;
        const bool budded = s_.arrangement != BudArrangement::Whorled || last;
        from = append(from, place, direction, bud.terminal || k > 0, year, budded);
      }
    }
    castPending();
  }

  /// Shoots of a year see the light of its start, in whatever order they are made.
  void castPending() {
    for (const int node : pending_) grid_.cast(nodes_[at(node)].place, 1);
    pending_.clear();
  }

  const SelfOrganizingSettings& s_;
  double height_;
  quint64 seed_;
  ShadowGrid grid_;
  std::vector<Metamer> nodes_;
  std::vector<double> light_, sum_, buds_, size_, vigour_, byTopology_;
  std::vector<AxisItem> items_;
  std::vector<Bud> targets_, budsThatGrow_;
  std::vector<int> pending_;
  bool full_ = false;
};

}  // namespace

double grownHeight(const SelfOrganizingSettings& s, double height, double years) {
  return height * std::pow(1 - std::exp(-s.rate * std::max(years, 0.0)), s.power);
}

SelfOrganized selfOrganize(const SelfOrganizingSettings& settings, double height, int years, quint64 seed,
                           const std::vector<GrowthEvent>& events, Progress& progress) {
  Plant plant(settings, height, seed);
  std::size_t next = 0;
  for (int year = 1; year <= years && !progress.cancelled(); ++year) {
    while (next < events.size() && events[next].when < year) plant.apply(events[next++], year);
    plant.grow(year);
    progress.report(static_cast<double>(year) / years);
  }
  SelfOrganized result = plant.take();
  result.grown.length = years;
  return result;
}

}  // namespace windfall::model::growth
