#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/lending_private.h"
#include "model/leaf/margin_depth_private.h"

namespace windfall::model {

namespace {

constexpr double kWorkSide = 640;
constexpr double kBand = 0.03, kAround = 0.1;  // of the leaf's long side: what counts as margin, and as neighbourhood
constexpr double kNarrowBand = 0.25;           // of the inner radius at most
constexpr float kLeastContrast = 15;           ///< Delta E: below it leaf and ground look alike
constexpr double kLargestHole = 1e-3;          // of the leaf: a larger place is a lesion

constexpr float kDark = 0.82f;  ///< of a shadow's lightness

/// How far a colour must be from the leaf's around.
struct Likeness {
  float way;     ///< to the ground, share of the whole way
  float off;     ///< at most so far beside that way, share of its length
  float light;   ///< of the leaf's lightness: a shadow is darker
  float chroma;  ///< of the leaf's chroma: a shadow is greyer
};
/// At the margin surely; beside such a place; and where ground shows through a hole.
constexpr Likeness kSure{0.4f, 0.5f, 0.62f, 0.7f}, kBeside{0.2f, 0.6f, 0.82f, 0.85f}, kHole{0.75f, 0.35f, 0, 0};

cv::Mat ellipse(int reach) { return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1}); }

/// Mean colours of what `where` selects around every place; far from all of it, of it all.
struct Around {
  cv::Mat3f mean;
  cv::Mat1f weight;
  cv::Vec3f overall;
  bool known = false;  ///< there is some of it

  Around(const cv::Mat3f& lab, const cv::Mat1b& where, int reach) : known(cv::countNonZero(where) > 0) {
    const cv::Scalar all = cv::mean(lab, where);
    for (int c = 0; c < 3; ++c) overall[c] = static_cast<float>(all[c]);
    cv::Mat3f part = cv::Mat3f::zeros(lab.size());
    lab.copyTo(part, where);
    const cv::Size window(2 * reach + 1, 2 * reach + 1);
    cv::boxFilter(part, mean, -1, window, {-1, -1}, true, cv::BORDER_CONSTANT);
    where.convertTo(weight, CV_32F, 1 / 255.0);
    cv::boxFilter(weight, weight, -1, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  }
  cv::Vec3f at(int y, int x) const { return weight(y, x) > 1e-3f ? mean(y, x) / weight(y, x) : overall; }
};

/// Whether a colour lies on the way from the leaf's to the ground's.
bool looksLikeGround(const cv::Vec3f& colour, const cv::Vec3f& leaf, const cv::Vec3f& ground, const Likeness& wanted) {
  const cv::Vec3f axis = ground - leaf, own = colour - leaf;
  const float length = axis.dot(axis);
  if (length < kLeastContrast * kLeastContrast) return false;
  const float way = own.dot(axis) / length;
  const cv::Vec3f off = own - way * axis;
  return way >= wanted.way && off.dot(off) < wanted.off * wanted.off * length;
}

/// Darker and greyer than the leaf, or so dark that the colour which JPEG carries over from it tells nothing.
bool looksLikeShadow(const cv::Vec3f& colour, const cv::Vec3f& leaf, const Likeness& wanted) {
  const float light = wanted.light * leaf[0], chroma = std::hypot(leaf[1], leaf[2]);
  const float own = std::hypot(colour[1], colour[2]);
  return colour[0] < light && own < (colour[0] < kDark * light ? chroma : wanted.chroma * chroma);
}

/// Of the connected parts of `marks`, those with a place of more than 127 that are not larger than `largest`.
cv::Mat1b sureParts(const cv::Mat1b& marks, double largest) {
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(marks, labels, stats, centres, 8);
  std::vector<char> kept(static_cast<size_t>(count), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      const int label = labels(y, x);
      if (marks(y, x) > 127 && stats(label, cv::CC_STAT_AREA) <= largest) kept[static_cast<size_t>(label)] = 1;
    }
  }
  cv::Mat1b parts(marks.size());
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) parts(y, x) = kept[static_cast<size_t>(labels(y, x))] ? 255 : 0;
  }
  return parts;
}

/// What inside the mask is no leaf, 255; work pixels.
cv::Mat1b foreignPixels(const cv::Mat3f& lab, const cv::Mat1b& leaf) {
  const cv::Rect box = cv::boundingRect(leaf);
  const int size = std::max(box.width, box.height);
  cv::Mat1b ground;
  const cv::Mat1f depth = marginDepth(leaf, cv::DIST_MASK_3);
  const double inner = innerRadius(depth);
  const int band = std::max(3, static_cast<int>(std::min(kBand * size, kNarrowBand * inner)));
  cv::dilate(leaf, ground, ellipse(std::max(2, band / 4)));
  const int reach = std::max(4, static_cast<int>(kAround * size));
  const Around inside(lab, depth > 0.5f * static_cast<float>(band), reach), outside(lab, ~ground, reach);
  if (!inside.known) return cv::Mat1b::zeros(leaf.size());
  cv::Mat1b margins(leaf.size(), static_cast<uchar>(0)), holes(leaf.size(), static_cast<uchar>(0));
  for (int y = 0; y < leaf.rows; ++y) {
    for (int x = 0; x < leaf.cols; ++x) {
      if (!leaf(y, x)) continue;
      const cv::Vec3f own = inside.at(y, x);
      const auto dark = [&](const Likeness& wanted) { return looksLikeShadow(lab(y, x), own, wanted); };
      const auto is = [&](const Likeness& wanted) {
        return dark(wanted) || (outside.known && looksLikeGround(lab(y, x), own, outside.at(y, x), wanted));
      };
      if (depth(y, x) <= static_cast<float>(band)) {
        if (is(kBeside)) margins(y, x) = is(kSure) ? 255 : 127;
      } else {
        if (is(kHole)) holes(y, x) = 255;
        // A shadow may reach a little deeper.
        if (depth(y, x) <= 2 * static_cast<float>(band) && dark(kBeside)) margins(y, x) = 127;
      }
    }
  }
  cv::Mat1b foreign = sureParts(margins, 1e12) | sureParts(holes, std::max(2.0, kLargestHole * cv::countNonZero(leaf)));
  // Lenses and JPEG blocks carry its colour a little farther.
  cv::dilate(foreign, foreign, ellipse(1));
  return foreign;
}

/// The petiole as wide as the mask has it there.
cv::Mat1b petiolePixels(const cv::Mat1b& mask, const Polygon& petiole) {
  cv::Mat1b pixels(mask.size(), static_cast<uchar>(0));
  if (petiole.size() < 2) return pixels;
  cv::Mat1f depth;
  cv::distanceTransform(mask, depth, cv::DIST_L2, 3);
  const auto at = [&](const QPointF& p) {
    return cv::Point(std::clamp(static_cast<int>(p.x()), 0, mask.cols - 1),
                     std::clamp(static_cast<int>(p.y()), 0, mask.rows - 1));
  };
  std::vector<float> depths;
  for (const QPointF& p : petiole) depths.push_back(depth(at(p)));
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const int width = std::max(3, static_cast<int>(std::lround(3 * *middle)));
  for (size_t i = 1; i < petiole.size(); ++i) cv::line(pixels, at(petiole[i - 1]), at(petiole[i]), 255, width);
  return pixels;
}

}  // namespace

cv::Mat1b lendingPixels(const QImage& photo, const cv::Mat1b& mask, int margin, const Polygon& petiole) {
  cv::Mat1b solid;
  cv::erode(mask, solid, ellipse(margin), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat1b alpha;
  cv::extractChannel(rgbaView(photo), alpha, 3);
  // Under what is transparent no ground is seen.
  if (cv::countNonZero(alpha < 128) > 0) return cv::countNonZero(solid) > 0 ? solid : mask.clone();
  const double scale = std::min(1.0, kWorkSide / std::max(mask.cols, mask.rows));
  cv::Mat4b small;
  cv::resize(rgbaView(photo), small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat1b leaf, foreign;
  cv::resize(mask, leaf, small.size(), 0, 0, cv::INTER_AREA);
  cv::resize(foreignPixels(toLab(toRgba(small)), leaf > 127), foreign, mask.size(), 0, 0, cv::INTER_LINEAR);
  foreign = foreign > 127;
  foreign.setTo(0, petiolePixels(mask, petiole));
  const cv::Mat1b clean = solid & ~foreign;
  // A leaf that looks like its ground is judged by its mask alone.
  if (cv::countNonZero(clean) * 2 > cv::countNonZero(solid)) return clean;
  return cv::countNonZero(solid) > 0 ? solid : mask.clone();
}

}  // namespace windfall::model
