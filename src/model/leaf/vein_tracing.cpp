#include "model/leaf/vein_tracing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <queue>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/thinning_private.h"
#include "model/leaf/vein_curve.h"
#include "model/leaf/vein_extraction.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 640;
constexpr float kGapCost = 6;         // a step off the lines, in steps on them
constexpr int kLook = 9;              // px before and after a fork that tell where a vein goes on
constexpr double kWidestGap = 0.035;  // share of the picture's long side that is bridged

double length(QPointF v) { return std::hypot(v.x(), v.y()); }

/// The lines' middles as a tree of pixels that begins at the root.
class SkeletonTree {
 public:
  SkeletonTree(const cv::Mat1b& lines, cv::Point root)
      : skeleton_(thinned(lines)), before_(lines.size(), -1), reached_(lines.size(), 1e30f) {
    cv::distanceTransform(lines, radius_, cv::DIST_L2, cv::DIST_MASK_PRECISE);
    walk(root);
    measure();
  }

  /// Pixels in the order of their distance from the root along the lines.
  const std::vector<int>& order() const { return order_; }
  int parent(int pixel) const { return before_(at(pixel)); }
  /// Longest way from here outwards, px.
  float beyond(int pixel) const { return beyond_[static_cast<size_t>(pixel)]; }
  float radius(int pixel) const { return radius_(at(pixel)); }
  const std::vector<std::vector<int>>& children() const { return children_; }
  cv::Point at(int pixel) const { return {pixel % skeleton_.cols, pixel / skeleton_.cols}; }

  /// The child that goes on as the same vein: far, straight ahead, and wide. -1: the vein ends.
  int onwards(int pixel) const {
    const std::vector<int>& children = children_[static_cast<size_t>(pixel)];
    if (children.empty()) return -1;
    if (children.size() == 1) return children.front();
    int behind = pixel;
    for (int i = 0; i < kLook && parent(behind) >= 0; ++i) behind = parent(behind);
    const cv::Point2d back = cv::Point2d(at(pixel) - at(behind));
    int best = -1;
    double most = -1;
    for (const int child : children) {
      int ahead = child;
      for (int i = 0; i < kLook && !children_[static_cast<size_t>(ahead)].empty(); ++i) ahead = farthest(ahead);
      const cv::Point2d on = cv::Point2d(at(ahead) - at(pixel));
      const double both = cv::norm(on) * cv::norm(back);
      const double straight = both > 0 ? std::max(0.0, on.dot(back) / both) : 0.5;
      const double score = beyond(child) * (0.3 + 0.7 * straight) * std::sqrt(1.0 + radius(ahead));
      if (score > most) most = score, best = child;
    }
    return best;
  }

 private:
  int farthest(int pixel) const {
    const std::vector<int>& children = children_[static_cast<size_t>(pixel)];
    return *std::max_element(children.begin(), children.end(), [this](int a, int b) { return beyond(a) < beyond(b); });
  }

  void walk(cv::Point root) {
    using Item = std::pair<float, int>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
    reached_(root) = 0;
    queue.emplace(0.f, root.y * skeleton_.cols + root.x);
    std::vector<int> settled;
    while (!queue.empty()) {
      const auto [distance, index] = queue.top();
      queue.pop();
      const cv::Point here = at(index);
      if (distance > reached_(here)) continue;
      settled.push_back(index);
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const cv::Point next = here + cv::Point(dx, dy);
          if (next.x < 0 || next.y < 0 || next.x >= skeleton_.cols || next.y >= skeleton_.rows) continue;
          const float way = distance + (dx != 0 && dy != 0 ? 1.4142f : 1.f) * (skeleton_(next) ? 1.f : kGapCost);
          if (way >= reached_(next)) continue;
          reached_(next) = way;
          before_(next) = index;
          queue.emplace(way, next.y * skeleton_.cols + next.x);
        }
      }
    }
    // Only what leads to a line is a vein; a line behind too wide a gap is none of this leaf's.
    const double widest = kWidestGap * std::max(skeleton_.cols, skeleton_.rows);
    std::vector<char> needed(static_cast<size_t>(skeleton_.total()), 0), cut(needed.size(), 0);
    std::vector<int> gap(needed.size(), 0);
    for (const int index : settled) {
      const int parent = before_(at(index));
      if (parent < 0) continue;
      const auto i = static_cast<size_t>(index), p = static_cast<size_t>(parent);
      gap[i] = skeleton_(at(index)) ? 0 : gap[p] + 1;
      cut[i] = cut[p] || (gap[i] > widest && p != static_cast<size_t>(settled.front()) && !nearRoot(index, settled));
    }
    for (size_t k = settled.size(); k-- > 0;) {
      const auto i = static_cast<size_t>(settled[k]);
      if (cut[i]) continue;
      if (skeleton_(at(settled[k]))) needed[i] = 1;
      const int parent = before_(at(settled[k]));
      if (needed[i] && parent >= 0) needed[static_cast<size_t>(parent)] = 1;
    }
    for (const int index : settled) {
      if (needed[static_cast<size_t>(index)]) order_.push_back(index);
    }
  }

  /// The way from the root to the first line may be longer than other gaps.
  bool nearRoot(int index, const std::vector<int>& settled) const {
    const cv::Point d = at(index) - at(settled.front());
    return std::hypot(d.x, d.y) < 0.12 * std::max(skeleton_.cols, skeleton_.rows);
  }

  void measure() {
    beyond_.assign(static_cast<size_t>(skeleton_.total()), 0);
    children_.assign(static_cast<size_t>(skeleton_.total()), {});
    for (size_t k = order_.size(); k-- > 0;) {
      const int index = order_[k], parent = before_(at(index));
      if (parent < 0) continue;
      const cv::Point d = at(index) - at(parent);
      const float step = d.x != 0 && d.y != 0 ? 1.4142f : 1.f;
      float& longest = beyond_[static_cast<size_t>(parent)];
      longest = std::max(longest, beyond_[static_cast<size_t>(index)] + step);
      children_[static_cast<size_t>(parent)].push_back(index);
    }
  }

  cv::Mat1b skeleton_;
  cv::Mat1i before_;
  cv::Mat1f reached_, radius_;
  std::vector<int> order_;
  std::vector<float> beyond_;
  std::vector<std::vector<int>> children_;
};

/// A pixel staircase as a calm line with points about `spacing` apart; the ends stay.
Polygon calmed(const Polygon& stairs, double spacing) {
  if (stairs.size() < 4) return {stairs.front(), stairs.back()};
  constexpr std::ptrdiff_t kReach = 4;
  const auto last = static_cast<std::ptrdiff_t>(stairs.size()) - 1;
  Polygon line{stairs.front()};
  for (std::ptrdiff_t i = 1; i < last; ++i) {
    const std::ptrdiff_t reach = std::min({kReach, i, last - i});
    QPointF sum;
    for (std::ptrdiff_t k = i - reach; k <= i + reach; ++k) sum += stairs[static_cast<size_t>(k)];
    const QPointF mean = sum / static_cast<double>(2 * reach + 1);
    if (length(mean - line.back()) >= spacing) line.push_back(mean);
  }
  line.push_back(stairs.back());
  return line;
}

double medianOf(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Veins traceVeins(const QImage& picture, QPointF root, QPointF origin, double scale) {
  const QImage gray = picture.convertToFormat(QImage::Format_Grayscale8);
  const cv::Mat1b lines = grayView(gray) > 110;
  if (cv::countNonZero(lines) == 0) return {};
  const QPointF place = (root - origin) * scale;
  const cv::Point start(std::clamp(static_cast<int>(std::lround(place.x())), 0, lines.cols - 1),
                        std::clamp(static_cast<int>(std::lround(place.y())), 0, lines.rows - 1));
  const SkeletonTree tree(lines, start);
  if (tree.order().size() < 2) return {};
  const auto toPhoto = [&](int pixel) {
    const cv::Point p = tree.at(pixel);
    return QPointF(p.x, p.y) / scale + origin;
  };
  struct Branch {
    int first;   ///< the pixel after the one where it leaves
    int parent;  ///< vein
    int order;
  };
  Veins veins;
  std::vector<Branch> open{{tree.order().front(), -1, 1}};
  const double mainLength = tree.beyond(tree.order().front());
  for (size_t next = 0; next < open.size(); ++next) {
    const Branch branch = open[next];
    Polygon stairs;
    std::vector<float> radii;
    std::vector<Branch> leaving;
    if (branch.parent >= 0) stairs.push_back(toPhoto(tree.parent(branch.first)));
    double walked = 0;
    for (int pixel = branch.first; pixel >= 0;) {
      stairs.push_back(toPhoto(pixel));
      radii.push_back(tree.radius(pixel));
      walked += 1;
      const int onwards = tree.onwards(pixel);
      for (const int child : tree.children()[static_cast<size_t>(pixel)]) {
        if (child == onwards) continue;
        const double far = tree.beyond(child);
        if (far < 5 + 2.5 * tree.radius(pixel)) continue;
        // What leaves near the root and goes far is another main vein.
        const bool main = branch.order == 1 && branch.parent < 0 && walked < 0.1 * mainLength && far > 0.5 * mainLength;
        leaving.push_back({child, static_cast<int>(veins.size()), main ? 1 : branch.order + 1});
      }
      pixel = onwards;
    }
    Vein vein;
    vein.order = branch.order;
    vein.parent = branch.parent;
    vein.points = calmed(stairs, 3 / scale);
    const size_t third = std::max<size_t>(1, radii.size() / 3);
    const auto part = static_cast<std::ptrdiff_t>(third);
    vein.startWidth = std::max(1.0, 2 * medianOf({radii.begin(), radii.begin() + part}) - 1) / scale;
    vein.endWidth = std::max(1.0, 2 * medianOf({radii.end() - part, radii.end()}) - 1) / scale;
    veins.push_back(std::move(vein));
    open.insert(open.end(), leaving.begin(), leaving.end());
  }
  veins.front().points.front() = root;
  return veins;
}

Veins readVeinPicture(const QImage& picture, const LeafAxis& axis) {
  QImage gray = picture.convertToFormat(QImage::Format_Grayscale8);
  if (cv::mean(grayView(gray))[0] > 127) gray.invertPixels();
  const double scale = std::min(1.0, 2.0 * kWorkSide / std::max(gray.width(), gray.height()));
  cv::Mat1b small;
  cv::resize(grayView(gray), small, {}, scale, scale, cv::INTER_AREA);
  // A line thinner than a pixel of the smaller picture must not fade away.
  if (scale < 1) small *= std::min(2.0, 1 / scale);
  return traceVeins(toGray(small), axis.root, {0, 0}, scale);
}

Veins photoVeins(const QImage& photo, const QImage& mask, QRect frame, const LeafAxis& axis, double detail) {
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(frame.width(), frame.height()));
  const QSize size(std::max(1, static_cast<int>(frame.width() * scale)),
                   std::max(1, static_cast<int>(frame.height() * scale)));
  const QImage sized = photo.copy(frame)
                           .scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                           .convertToFormat(QImage::Format_RGBA8888);
  const QImage leaf = mask.copy(frame).scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  std::vector<Tissue> types;
  for (int y = 0; y < size.height(); ++y) {
    for (int x = 0; x < size.width(); ++x) {
      types.push_back(leaf.constScanLine(y)[x] < 128 ? Tissue::Outside : Tissue::Blade);
    }
  }
  const QPointF root = (axis.root - frame.topLeft()) * scale;
  types = extractVeins(sized, std::move(types), root.toPoint(), detail);
  QImage lines(size, QImage::Format_Grayscale8);
  lines.fill(0);
  for (size_t i = 0; i < types.size(); ++i) {
    const int x = static_cast<int>(i) % size.width(), y = static_cast<int>(i) / size.width();
    if (types[i] == Tissue::Vein) lines.scanLine(y)[x] = 255;
  }
  Veins veins = traceVeins(lines, axis.root, frame.topLeft(), scale);
  if (!veins.empty() && axis.petiole.size() > 1) {
    std::vector<QPointF>& main = veins.front().points;
    main.insert(main.begin(), axis.petiole.begin(), axis.petiole.end() - 1);
  }
  return veins;
}

}  // namespace windfall::model
