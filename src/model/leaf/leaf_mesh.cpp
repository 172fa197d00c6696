#include "model/leaf/leaf_mesh.h"

#include <QLineF>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/contour.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/leaf_hull_private.h"
#include "model/leaf/triangulation.h"

namespace windfall::model {

namespace {

constexpr double kFine = 1.0 / 256, kCoarse = 1.0 / 64;  // tolerances, shares of the long side
constexpr double kFineLikeness = 0.9905;                 // least intersection over union of the finest
constexpr int kFineRibs = 12, kCoarseRibs = 5;           // samples of the midrib
constexpr double kNarrow = 0.03;                         // of the long side: a blade this narrow needs no inner row

/// Pixels in both over pixels in either.
double likeness(const QImage& mask, const Polygon& polygon) {
  QImage drawn(mask.size(), QImage::Format_Grayscale8);
  drawn.fill(0);
  QPainter painter(&drawn);
  painter.setPen(Qt::NoPen);
  painter.setBrush(Qt::white);
  painter.drawPolygon(QPolygonF(QList<QPointF>(polygon.begin(), polygon.end())));
  painter.end();
  const cv::Mat1b own = grayView(mask), other = grayView(drawn);
  return cv::countNonZero(own & other) / std::max(1.0, static_cast<double>(cv::countNonZero(own | other)));
}

/// Pixels to leaf lengths, and the midrib.
class Frame {
 public:
  explicit Frame(const LeafMeshSource& source) : size_(source.image.size()) {
    pivot_ = at(source.pivot);
    length_ = std::max(1.0, std::clamp(source.pivot.y(), 0.1, 1.0) * size_.height());
    for (const QPointF& share : source.midrib) rib_.push_back(at(share));
    if (rib_.size() < 2) rib_ = {pivot_, {pivot_.x(), 0}};
    if (rib_.front().y() < rib_.back().y()) std::reverse(rib_.begin(), rib_.end());
  }

  /// x of the midrib in a row; straight on beyond its ends.
  double ribX(double y) const {
    if (y >= rib_.front().y()) return rib_.front().x();
    for (size_t i = 1; i < rib_.size(); ++i) {
      if (y < rib_[i].y()) continue;
      const double span = rib_[i - 1].y() - rib_[i].y();
      return span > 0 ? rib_[i].x() + (rib_[i - 1].x() - rib_[i].x()) * (y - rib_[i].y()) / span : rib_[i].x();
    }
    return rib_.back().x();
  }

  LeafVertex vertex(QPointF pixel) const {
    LeafVertex v;
    v.place = {static_cast<float>((pixel.x() - pivot_.x()) / length_),
               static_cast<float>((pivot_.y() - pixel.y()) / length_)};
    v.rib = static_cast<float>((pixel.x() - ribX(pixel.y())) / length_);
    v.uv = {static_cast<float>(pixel.x() / size_.width()), static_cast<float>(pixel.y() / size_.height())};
    return v;
  }
  QPointF pivot() const { return pivot_; }
  QPointF tip() const { return rib_.back(); }
  QPointF base() const { return rib_.front(); }

 private:
  QPointF at(QPointF share) const { return {share.x() * size_.width(), share.y() * size_.height()}; }
  QSize size_;
  QPointF pivot_;
  double length_ = 1;
  std::vector<QPointF> rib_;
};

LeafMesh meshOf(const Frame& frame, const std::vector<QPointF>& points, const std::vector<std::uint32_t>& corners) {
  LeafMesh mesh;
  std::vector<std::uint32_t> number(points.size(), ~0u);
  for (size_t i = 0; i + 2 < corners.size(); i += 3) {
    std::array<std::uint32_t, 3> triangle{corners[i], corners[i + 1], corners[i + 2]};
    const QPointF a = points[triangle[1]] - points[triangle[0]], b = points[triangle[2]] - points[triangle[0]];
    const double area = a.x() * b.y() - a.y() * b.x();
    if (std::abs(area) < 1e-6) continue;
    // Rows count downwards: what is clockwise there is counter-clockwise on the leaf.
    if (area > 0) std::swap(triangle[1], triangle[2]);
    for (const std::uint32_t corner : triangle) {
      if (number[corner] == ~0u) {
        number[corner] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(frame.vertex(points[corner]));
      }
      mesh.indices.push_back(number[corner]);
    }
  }
  return mesh;
}

/// The run of the polygon through a place, along its row: left and right end.
std::pair<double, double> runThrough(const Polygon& polygon, QPointF place) {
  double left = -1e9, right = 1e9;
  for (size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const QPointF a = polygon[i], b = polygon[before];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const double x = (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()) + a.x();
    if (x <= place.x()) left = std::max(left, x);
    if (x > place.x()) right = std::min(right, x);
  }
  return {left, right};
}

bool crosses(const Polygon& polygon, QPointF from, QPointF to) {
  const QLineF line(from, to);
  for (size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    if (line.intersects(QLineF(polygon[before], polygon[i])) == QLineF::BoundedIntersection) return true;
  }
  return false;
}

LeafMesh contourMesh(const Frame& frame, const Polygon& contour, double side, int ribs, bool innerRow) {
  std::vector<QPointF> inside;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> lines;
  double top = 1e9, bottom = -1e9;
  for (const QPointF& p : contour) top = std::min(top, p.y()), bottom = std::max(bottom, p.y());
  const auto first = static_cast<std::uint32_t>(contour.size());
  int last = -1;
  for (int i = 0; i < ribs; ++i) {
    const double y = bottom + (top - bottom) * (i + 0.5) / ribs;
    const QPointF rib(frame.ribX(y), y);
    if (!contains(contour, rib)) {
      last = -1;
      continue;
    }
    const auto [left, right] = runThrough(contour, rib);
    // Slivers between the midrib and a margin next to it serve nobody.
    if (right - left < 0.5 * kNarrow * side) {
      last = -1;
      continue;
    }
    const auto index = first + static_cast<std::uint32_t>(inside.size());
    if (last >= 0 && !crosses(contour, inside[static_cast<size_t>(last) - first], rib)) {
      lines.emplace_back(static_cast<std::uint32_t>(last), index);
    }
    last = static_cast<int>(index);
    inside.push_back(rib);
    if (!innerRow) continue;
    for (const double end : {left, right}) {
      if (std::abs(end - rib.x()) > kNarrow * side) inside.emplace_back((end + rib.x()) / 2, y);
    }
  }
  const Triangulation triangles = triangulate(contour, inside, lines);
  return meshOf(frame, triangles.points, triangles.corners);
}

}  // namespace

Result<LeafMeshes> fitLeafMeshes(const LeafMeshSource& source) {
  if (source.image.isNull()) return Error{"the texture is empty"};
  const QImage image = source.image.convertToFormat(QImage::Format_RGBA8888);
  QImage mask(image.size(), QImage::Format_Grayscale8);
  for (int y = 0; y < image.height(); ++y) {
    const uchar* from = image.constScanLine(y);
    uchar* to = mask.scanLine(y);
    for (int x = 0; x < image.width(); ++x) to[x] = from[4 * x + 3] >= 128 ? 255 : 0;
  }
  Polygon border = traceBorder(mask);
  if (border.size() < 8) return Error{"the texture shows no leaf: nothing in it is opaque"};
  const Frame frame(source);
  // The border runs through the middles of pixels; the leaf ends half a pixel further out.
  border = outwards(mergeCollinear(border), 0.5);
  for (QPointF& p : border) p += QPointF(0.5, 0.5);
  const double side = std::max(image.width(), image.height());
  LeafMeshes meshes;
  const auto simplified = [&](double tolerance) {
    return simplifyClosed(border, tolerance * side, frame.base(), frame.tip());
  };
  // Toothed and lobed leaves have more margin for their area and need a closer fit.
  Polygon fine = simplified(kFine);
  for (double tolerance = kFine / 1.4; tolerance > kFine / 6 && likeness(mask, fine) < kFineLikeness;
       tolerance /= 1.4) {
    fine = simplified(tolerance);
  }
  meshes[0] = contourMesh(frame, fine, side, kFineRibs, true);
  meshes[1] = contourMesh(frame, simplified(kCoarse), side, kCoarseRibs, false);
  const Polygon hull = enclosingPolygon(border, 8, 1);
  std::vector<std::uint32_t> fan;
  for (std::uint32_t i = 1; i + 1 < hull.size(); ++i) fan.insert(fan.end(), {0, i, i + 1});
  meshes[2] = meshOf(frame, hull, fan);
  const double w = image.width(), h = image.height();
  meshes[3] = meshOf(frame, {{0, 0}, {w, 0}, {w, h}, {0, h}}, {0, 1, 2, 0, 2, 3});
  return meshes;
}

}  // namespace windfall::model
