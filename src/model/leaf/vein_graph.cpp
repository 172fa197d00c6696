#include "model/leaf/vein_graph.h"

#include <QLineF>
#include <algorithm>
#include <cmath>

#include "model/leaf/contour.h"

namespace windfall::model {

namespace {

constexpr int kHighestOrder = 4;

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

QPointF nearestOn(QPointF from, QPointF to, QPointF place) {
  const QPointF along = to - from;
  const double square = QPointF::dotProduct(along, along);
  const double t = square > 0 ? std::clamp(QPointF::dotProduct(place - from, along) / square, 0.0, 1.0) : 0;
  return from + t * along;
}

bool isPoint(const Veins& veins, int vein, int point) {
  return vein >= 0 && vein < static_cast<int>(veins.size()) && point >= 0 &&
         point < static_cast<int>(veins[static_cast<size_t>(vein)].points.size());
}

}  // namespace

std::optional<VeinPlace> nearestVein(const Veins& veins, QPointF to, double reach, int highestOrder) {
  std::optional<VeinPlace> best;
  for (size_t v = 0; v < veins.size(); ++v) {
    if (veins[v].order > highestOrder) continue;
    const std::vector<QPointF>& points = veins[v].points;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const QPointF at = nearestOn(points[i], points[i + 1], to);
      const double distance = length(at - to);
      if (distance > (best ? best->distance : reach)) continue;
      const bool second = length(points[i + 1] - to) < length(points[i] - to);
      best = VeinPlace{static_cast<int>(v), static_cast<int>(second ? i + 1 : i), static_cast<int>(i), distance, at};
    }
  }
  return best;
}

Veins editableVeins(const Veins& veins, double tolerance) {
  Veins result = veins;
  for (Vein& vein : result) {
    if (vein.points.size() > 2) vein.points = simplifyLine(vein.points, tolerance);
  }
  return result;
}

Veins withVein(Veins veins, std::vector<QPointF> points, double startWidth, double endWidth, double reach) {
  if (points.size() < 2) return veins;
  Vein vein;
  if (const std::optional<VeinPlace> start = nearestVein(veins, points.front(), reach, kHighestOrder - 1)) {
    vein.parent = start->vein;
    vein.order = std::min(kHighestOrder, veins[static_cast<size_t>(start->vein)].order + 1);
    points.front() = start->at;
  }
  vein.points = std::move(points);
  vein.startWidth = startWidth;
  vein.endWidth = endWidth;
  veins.push_back(std::move(vein));
  return veins;
}

Veins withMovedPoint(Veins veins, int vein, int point, QPointF to) {
  if (!isPoint(veins, vein, point)) return veins;
  std::vector<QPointF>& points = veins[static_cast<size_t>(vein)].points;
  const auto p = static_cast<size_t>(point);
  const QPointF from = points[p], way = to - from;
  // A child that leaves on one of the two pieces beside the point goes with it as far as it is near to the point.
  for (Vein& child : veins) {
    if (child.parent != vein || child.points.empty() || &child == &veins[static_cast<size_t>(vein)]) continue;
    double share = 0;
    for (const std::ptrdiff_t side : {-1, 1}) {
      const std::ptrdiff_t other = point + side;
      if (other < 0 || other >= static_cast<std::ptrdiff_t>(points.size())) continue;
      const QPointF end = points[static_cast<size_t>(other)];
      const QPointF at = nearestOn(from, end, child.points.front());
      const double piece = length(end - from);
      if (length(at - child.points.front()) > 3) continue;
      share = std::max(share, piece > 0 ? 1 - length(at - from) / piece : 1);
    }
    child.points.front() += share * way;
  }
  points[p] = to;
  return veins;
}

Veins withPoint(Veins veins, int vein, int segment, QPointF at) {
  if (!isPoint(veins, vein, segment) || !isPoint(veins, vein, segment + 1)) return veins;
  std::vector<QPointF>& points = veins[static_cast<size_t>(vein)].points;
  points.insert(points.begin() + segment + 1, at);
  return veins;
}

Veins withoutPoint(Veins veins, int vein, int point) {
  if (!isPoint(veins, vein, point)) return veins;
  std::vector<QPointF>& points = veins[static_cast<size_t>(vein)].points;
  if (points.size() <= 2) return withoutVein(veins, vein);
  points.erase(points.begin() + point);
  return veins;
}

Veins withoutVein(const Veins& veins, int vein) {
  if (vein < 0 || vein >= static_cast<int>(veins.size())) return veins;
  std::vector<int> moved(veins.size(), 0);
  const auto goes = [&](int index) {
    // Parents may stand behind their children.
    for (size_t steps = 0; index >= 0 && steps <= veins.size(); ++steps) {
      if (index == vein) return true;
      index = veins[static_cast<size_t>(index)].parent;
    }
    return false;
  };
  Veins result;
  for (size_t i = 0; i < veins.size(); ++i) {
    if (goes(static_cast<int>(i))) continue;
    moved[i] = static_cast<int>(result.size());
    result.push_back(veins[i]);
  }
  for (Vein& left : result) {
    if (left.parent >= 0) left.parent = moved[static_cast<size_t>(left.parent)];
  }
  return result;
}

Veins withWidth(Veins veins, int vein, double factor) {
  if (!isPoint(veins, vein, 0)) return veins;
  Vein& changed = veins[static_cast<size_t>(vein)];
  changed.startWidth = std::clamp(changed.startWidth * factor, 0.25, 1e4);
  changed.endWidth = std::clamp(changed.endWidth * factor, 0.25, 1e4);
  return veins;
}

Veins withOrder(Veins veins, int vein, int order) {
  if (!isPoint(veins, vein, 0)) return veins;
  const int by = std::clamp(order, 1, kHighestOrder) - veins[static_cast<size_t>(vein)].order;
  const Veins before = veins;
  for (size_t i = 0; i < veins.size(); ++i) {
    int index = static_cast<int>(i);
    for (size_t steps = 0; index >= 0 && index != vein && steps <= before.size(); ++steps) {
      index = before[static_cast<size_t>(index)].parent;
    }
    if (index == vein) veins[i].order = std::clamp(before[i].order + by, 1, kHighestOrder);
  }
  return veins;
}

}  // namespace windfall::model
