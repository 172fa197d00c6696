#include "model/leaf/vein_micro.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/random.h"
#include "model/leaf/contour.h"
#include "model/leaf/vein_curve.h"

namespace windfall::model {

namespace {

constexpr int kMostRounds = 300, kMostNodes = 200'000, kPatience = 3;

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

/// Places in cells of a grid, found by nearness.
class PointGrid {
 public:
  PointGrid(QRectF box, double cell)
      : corner_(box.topLeft()),
        cell_(cell),
        columns_(static_cast<int>(box.width() / cell) + 1),
        rows_(static_cast<int>(box.height() / cell) + 1),
        cells_(static_cast<size_t>(columns_) * static_cast<size_t>(rows_)) {}

  void add(QPointF place, int index) { cells_[cellOf(column(place), row(place))].push_back({place, index}); }

  /// Calls `visit(index, place)` for everything within `radius`, and for some beyond.
  template <class Visit>
  void near(QPointF at, double radius, Visit visit) const {
    for (int y = std::max(0, row({0, at.y() - radius})); y <= std::min(rows_ - 1, row({0, at.y() + radius})); ++y) {
      for (int x = std::max(0, column({at.x() - radius, 0})); x <= std::min(columns_ - 1, column({at.x() + radius, 0}));
           ++x) {
        for (const auto& [place, index] : cells_[cellOf(x, y)]) visit(index, place);
      }
    }
  }

  /// Nearest of all, -1: there is none within `most`.
  int nearest(QPointF at, double most, double& distance) const {
    int best = -1;
    distance = most;
    for (double radius = cell_; best < 0 && radius < 2 * most; radius *= 2) {
      double least = std::min(radius, most);
      near(at, radius, [&](int index, QPointF place) {
        const double d = length(place - at);
        if (d < least) least = d, best = index;
      });
      distance = least;
    }
    return best;
  }

 private:
  int column(QPointF p) const { return std::clamp(static_cast<int>((p.x() - corner_.x()) / cell_), 0, columns_ - 1); }
  int row(QPointF p) const { return std::clamp(static_cast<int>((p.y() - corner_.y()) / cell_), 0, rows_ - 1); }
  size_t cellOf(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(columns_) + static_cast<size_t>(x);
  }

  QPointF corner_;
  double cell_;
  int columns_, rows_;
  std::vector<std::vector<std::pair<QPointF, int>>> cells_;
};

/// A node of a vein; those of the given veins have no parent here.
struct Node {
  QPointF place;
  int parent = -1;
  int vein = -1;  ///< index of the given vein
};

struct Source {
  QPointF place;
  double nearest = 1e30;  ///< of a node, so far
  int waiting = 0;        ///< rounds without getting nearer
};

class MicroGrower {
 public:
  MicroGrower(const QImage& mask, const VeinParameters& parameters, Veins& veins)
      : mask_(mask),
        veins_(veins),
        closed_(parameters.closed),
        random_(parameters.seed, 307),
        box_(leafBox()),
        size_(std::max(box_.width(), box_.height())),
        spacing_(std::max(3.0, parameters.microSpacing * size_)),
        step_(0.3 * spacing_),
        kill_(0.7 * spacing_),
        grid_(box_, spacing_) {}

  void grow() {
    for (size_t i = 0; i < veins_.size(); ++i) addGiven(static_cast<int>(i));
    given_ = nodes_.size();
    if (given_ == 0) return;
    sow();
    for (int round = 0; round < kMostRounds && !sources_.empty() && nodes_.size() < kMostNodes; ++round) {
      if (!advance()) break;
    }
    collect();
  }

 private:
  QRectF leafBox() const {
    int left = mask_.width(), right = 0, top = mask_.height(), bottom = 0;
    for (int y = 0; y < mask_.height(); ++y) {
      const uchar* row = mask_.constScanLine(y);
      for (int x = 0; x < mask_.width(); ++x) {
        if (row[x] < 128) continue;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
    }
    return left <= right ? QRectF(left, top, right - left + 1, bottom - top + 1) : QRectF(0, 0, 1, 1);
  }

  bool onLeaf(QPointF p) const {
    const QPoint at = p.toPoint();
    return mask_.valid(at) && mask_.constScanLine(at.y())[at.x()] > 127;
  }

  void addNode(const Node& node) {
    grid_.add(node.place, static_cast<int>(nodes_.size()));
    nodes_.push_back(node);
  }

  void addGiven(int vein) {
    const Polygon line = throughPoints(veins_[static_cast<size_t>(vein)].points);
    double since = step_;
    for (size_t i = 0; i < line.size(); ++i) {
      if (i > 0) since += length(line[i] - line[i - 1]);
      if (since < step_ && i + 1 < line.size()) continue;
      since = 0;
      if (box_.contains(line[i])) addNode({line[i], -1, vein});
    }
  }

  /// Sources at least a birth distance from each other and from the veins, as many as find room.
  void sow() {
    const double birth = 0.6 * spacing_;
    PointGrid sown(box_, spacing_);
    const auto tries = static_cast<int>(std::min(400'000.0, 6 * box_.width() * box_.height() / (birth * birth)));
    for (int i = 0; i < tries; ++i) {
      const QPointF p(random_.uniform(box_.left(), box_.right()), random_.uniform(box_.top(), box_.bottom()));
      if (!onLeaf(p)) continue;
      double distance = 0;
      if (grid_.nearest(p, birth, distance) >= 0 || sown.nearest(p, birth, distance) >= 0) continue;
      sown.add(p, i);
      sources_.push_back({p});
    }
  }

  /// Nodes that a source pulls: its nearest, or (closed) its relative neighbours.
  void pulled(const Source& source, double nearestDistance, int nearest, std::vector<int>& result) const {
    result.assign(1, nearest);
    if (!closed_) return;
    const double reach = 1.6 * nearestDistance + 2 * step_;
    std::vector<std::pair<double, int>> around;
    grid_.near(source.place, reach, [&](int index, QPointF place) {
      const double d = length(place - source.place);
      if (d <= reach) around.emplace_back(d, index);
    });
    std::sort(around.begin(), around.end());
    for (const auto& [distance, index] : around) {
      if (index == nearest) continue;
      const QPointF place = nodes_[static_cast<size_t>(index)].place;
      // Neighbours unless another node is nearer to both.
      const bool hidden = std::any_of(around.begin(), around.end(), [&, d = distance](const auto& other) {
        return other.first < d && length(nodes_[static_cast<size_t>(other.second)].place - place) < d;
      });
      if (!hidden) result.push_back(index);
      if (result.size() >= 5) break;
    }
  }

  /// One round: sources pull, nodes grow, reached sources go. False: nothing grew.
  bool advance() {
    const size_t before = nodes_.size();
    std::vector<std::pair<int, QPointF>> pulls;
    std::vector<int> neighbours;
    for (Source& source : sources_) {
      double distance = 0;
      const int nearest = grid_.nearest(source.place, 3 * size_, distance);
      if (nearest < 0) continue;
      pulled(source, distance, nearest, neighbours);
      for (const int node : neighbours) {
        const QPointF way = source.place - nodes_[static_cast<size_t>(node)].place;
        const double far = length(way);
        if (far > kill_) pulls.emplace_back(node, way / far);
      }
      source.waiting = distance < source.nearest - 1e-6 ? 0 : source.waiting + 1;
      source.nearest = std::min(source.nearest, distance);
    }
    std::stable_sort(pulls.begin(), pulls.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (size_t i = 0; i < pulls.size();) {
      const int node = pulls[i].first;
      QPointF sum;
      for (; i < pulls.size() && pulls[i].first == node; ++i) sum += pulls[i].second;
      // Opposite pulls cancel: such a node would swing to and fro.
      if (length(sum) < 0.2) continue;
      const QPointF place = nodes_[static_cast<size_t>(node)].place + step_ * sum / length(sum);
      double distance = 0;
      if (!onLeaf(place) || grid_.nearest(place, 0.5 * step_, distance) >= 0) continue;
      addNode({place, node, -1});
    }
    reach();
    return nodes_.size() > before || !sources_.empty();
  }

  void reach() {
    std::vector<Source> left;
    std::vector<int> neighbours;
    for (Source& source : sources_) {
      double distance = 0;
      const int nearest = grid_.nearest(source.place, 3 * size_, distance);
      if (nearest < 0 || source.waiting >= kPatience) continue;
      if (distance >= kill_) {
        left.push_back(source);
        continue;
      }
      if (!closed_) continue;
      pulled(source, distance, nearest, neighbours);
      const bool all = std::all_of(neighbours.begin(), neighbours.end(), [&](int node) {
        return length(nodes_[static_cast<size_t>(node)].place - source.place) < 1.2 * kill_;
      });
      if (!all) {
        left.push_back(source);
        continue;
      }
      // The veins that came from different sides meet in the source: a loop.
      if (neighbours.size() > 1) {
        for (const int node : neighbours) addNode({source.place, node, -1});
      }
    }
    sources_ = std::move(left);
  }

  /// Cuts the trees of new nodes into veins: each goes on into the branch that serves most.
  void collect() {
    const size_t count = nodes_.size();
    std::vector<int> served(count, 1), heavy(count, -1);
    for (size_t i = count; i-- > given_;) {
      const auto parent = static_cast<size_t>(nodes_[i].parent);
      served[parent] += served[i];
    }
    for (size_t i = given_; i < count; ++i) {
      const auto parent = static_cast<size_t>(nodes_[i].parent);
      if (parent < given_) continue;
      int& best = heavy[parent];
      if (best < 0 || served[i] > served[static_cast<size_t>(best)]) best = static_cast<int>(i);
    }
    std::vector<int> veinOf(count, -1);
    for (size_t i = 0; i < given_; ++i) veinOf[i] = nodes_[i].vein;
    const double unit = size_ / 512;
    for (size_t i = given_; i < count; ++i) {
      const auto parent = static_cast<size_t>(nodes_[i].parent);
      if (parent >= given_ && heavy[parent] == static_cast<int>(i)) continue;
      Vein vein;
      vein.parent = veinOf[parent];
      const bool tertiary = parent < given_ && served[i] * step_ > 3 * spacing_;
      vein.order = tertiary ? kTertiaryOrder : kMicroOrder;
      vein.startWidth = (tertiary ? 1.1 : 0.7) * unit;
      vein.endWidth = 0.5 * unit;
      vein.points.push_back(nodes_[parent].place);
      for (int node = static_cast<int>(i); node >= 0; node = heavy[static_cast<size_t>(node)]) {
        vein.points.push_back(nodes_[static_cast<size_t>(node)].place);
        veinOf[static_cast<size_t>(node)] = static_cast<int>(veins_.size());
      }
      veins_.push_back(std::move(vein));
    }
  }

  const QImage& mask_;
  Veins& veins_;
  bool closed_;
  RandomSequence random_;
  QRectF box_;
  double size_, spacing_, step_, kill_;
  std::vector<Node> nodes_;
  size_t given_ = 0;
  PointGrid grid_;
  std::vector<Source> sources_;
};

}  // namespace

void growMicroVeins(const QImage& mask, const VeinParameters& parameters, Veins& veins) {
  MicroGrower(mask, parameters, veins).grow();
}

}  // namespace windfall::model
