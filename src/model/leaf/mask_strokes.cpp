// Pen strokes that a found mask took for parts of the leaf.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/mask_strokes_private.h"

namespace windfall::model {

namespace {

constexpr double kThin = 0.014;       // of the leaf's long side: what is at most twice so wide is thin
constexpr float kColoured = 10;       ///< chroma from which a leaf's colour tells it from ink
constexpr float kNeutral = 0.35f;     ///< of the leaf's chroma: below it a place has no colour
constexpr float kDark = 0.6f;         ///< of the leaf's lightness: grey petioles are lighter, black ink is not
constexpr float kBlue = -5;           ///< b: ink
constexpr float kPaperChroma = 15;    ///< of the ground: up to here its colour is the light's
constexpr double kLeastShare = 4e-4;  // of the leaf's area: what is smaller is an unevenness of the margin

/// Places at most so far from what `of` marks.
cv::Mat1b within(const cv::Mat1b& of, int reach) {
  if (cv::countNonZero(of) == 0) return cv::Mat1b::zeros(of.size());
  cv::Mat1f distance;
  cv::distanceTransform(~of, distance, cv::DIST_L2, 5);
  return distance <= static_cast<float>(reach);
}

}  // namespace

void dropStrokes(const cv::Mat3f& lab, cv::Mat1b& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  if (box.area() < 400) return;
  const int size = std::max(box.width, box.height), radius = std::max(2, static_cast<int>(kThin * size));
  const cv::Rect around = cv::Rect(box.x - radius, box.y - radius, box.width + 2 * radius, box.height + 2 * radius) &
                          cv::Rect({}, mask.size());
  cv::Mat1b leaf = mask(around);
  // Opening and widening by distances: as fast for a large radius.
  const cv::Mat1b blade = within(~within(~leaf, radius), radius);
  if (cv::countNonZero(blade) == 0) return;
  const cv::Mat1b wide = within(leaf, radius);
  const cv::Scalar ground = cv::mean(lab(around), ~wide), own = cv::mean(lab(around), blade);
  const bool paper = std::hypot(ground[1], ground[2]) < kPaperChroma && ground[0] > 1;
  // The light's colour is taken out.
  const auto colourOf = [&](float l, float a, float b) {
    const float share = paper ? l / static_cast<float>(ground[0]) : 0;
    return cv::Vec2f(a - share * static_cast<float>(ground[1]), b - share * static_cast<float>(ground[2]));
  };
  const cv::Vec2f green = colourOf(static_cast<float>(own[0]), static_cast<float>(own[1]), static_cast<float>(own[2]));
  const auto chroma = static_cast<float>(cv::norm(green));
  if (chroma < kColoured) return;
  cv::Mat3f smooth;
  cv::blur(lab(around), smooth, {3, 3});
  cv::Mat1b stroke(leaf.size(), static_cast<uchar>(0));
  for (int y = 0; y < leaf.rows; ++y) {
    for (int x = 0; x < leaf.cols; ++x) {
      if (!leaf(y, x) || blade(y, x)) continue;
      const cv::Vec3f& c = smooth(y, x);
      const cv::Vec2f colour = colourOf(c[0], c[1], c[2]);
      const bool black = cv::norm(colour) < kNeutral * chroma && c[0] < kDark * static_cast<float>(own[0]);
      stroke(y, x) = black || colour[1] < kBlue ? 255 : 0;
    }
  }
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(stroke, labels, stats, centres, 8);
  const double least = kLeastShare * cv::countNonZero(leaf);
  cv::Mat1b rest = leaf.clone();
  for (int i = 1; i < count; ++i) {
    if (stats(i, cv::CC_STAT_AREA) >= least) rest.setTo(0, labels == i);
  }
  // What holds leaflets together is no stroke.
  const int parts = cv::connectedComponentsWithStats(rest, labels, stats, centres, 8);
  for (int i = 1; i < parts; ++i) {
    const int area = stats(i, cv::CC_STAT_AREA);
    if (area > 0.05 * cv::countNonZero(leaf) && area < 0.9 * cv::countNonZero(rest)) return;
  }
  rest.copyTo(leaf);
}

}  // namespace windfall::model
