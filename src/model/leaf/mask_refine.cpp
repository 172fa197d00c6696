// Masks by GrabCut from the artist's scribbles.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/mask_edit.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 480;
constexpr int kRounds = 3;

void draw(cv::Mat1b& classes, const Scribble& scribble, double scale) {
  const uchar value = scribble.leaf ? cv::GC_FGD : cv::GC_BGD;
  const int width = std::max(1, static_cast<int>(std::lround(scribble.width * scale)));
  const auto at = [&](QPointF p) {
    return cv::Point(static_cast<int>(std::lround(p.x() * scale)), static_cast<int>(std::lround(p.y() * scale)));
  };
  for (size_t i = 0; i < scribble.points.size(); ++i) {
    cv::line(classes, at(scribble.points[i > 0 ? i - 1 : 0]), at(scribble.points[i]), value, width);
  }
}

}  // namespace

QImage refinedMask(const QImage& mask, const QImage& photo, const std::vector<Scribble>& scribbles) {
  if (photo.size() != mask.size() || scribbles.empty()) return mask;
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(photo.width(), photo.height()));
  cv::Mat3b rgb, small;
  cv::cvtColor(rgbaView(photo), rgb, cv::COLOR_RGBA2RGB);
  cv::resize(rgb, small, {}, scale, scale, cv::INTER_AREA);
  cv::Mat1b guess;
  cv::resize(grayView(mask), guess, small.size(), 0, 0, cv::INTER_AREA);
  const cv::Mat1b before = guess > 127;
  cv::Mat1b classes(before.size());
  for (int y = 0; y < classes.rows; ++y) {
    for (int x = 0; x < classes.cols; ++x) classes(y, x) = before(y, x) ? cv::GC_PR_FGD : cv::GC_PR_BGD;
  }
  for (const Scribble& scribble : scribbles) draw(classes, scribble, scale);
  const auto counts = [&](uchar sure, uchar perhaps) {
    return cv::countNonZero(classes == sure) + cv::countNonZero(classes == perhaps);
  };
  // GrabCut needs colours of both kinds.
  if (counts(cv::GC_FGD, cv::GC_PR_FGD) < 16 || counts(cv::GC_BGD, cv::GC_PR_BGD) < 16) return mask;
  cv::Mat leafColours, groundColours;
  cv::theRNG().state = 0x77696e64;  // GrabCut starts its clusters at random.
  cv::grabCut(small, classes, {}, leafColours, groundColours, kRounds, cv::GC_INIT_WITH_MASK);
  cv::Mat1b after(classes.size());
  for (int y = 0; y < classes.rows; ++y) {
    for (int x = 0; x < classes.cols; ++x) after(y, x) = (classes(y, x) & 1) != 0 ? 255 : 0;
  }
  // Keep to what the scribbles are about: parts that changed and touch one, or lie beside such a part.
  cv::Mat1b changed = after != before, drawn = cv::Mat1b::zeros(changed.size());
  cv::morphologyEx(changed, changed, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  for (const Scribble& scribble : scribbles) {
    cv::Mat1b one(changed.size(), static_cast<uchar>(cv::GC_PR_BGD));
    draw(one, {scribble.points, scribble.width, true}, scale);
    drawn |= one == cv::GC_FGD;
  }
  changed |= drawn;
  cv::Mat1i labels;
  const int count = cv::connectedComponents(changed, labels, 8);
  std::vector<char> meant(static_cast<size_t>(count), 0);
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      if (drawn(y, x)) meant[static_cast<size_t>(labels(y, x))] = 1;
    }
  }
  cv::Mat1b part(changed.size());
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      part(y, x) = labels(y, x) > 0 && meant[static_cast<size_t>(labels(y, x))] ? 255 : 0;
    }
  }
  cv::Mat1b smooth, where;
  cv::resize(after, smooth, {mask.width(), mask.height()}, 0, 0, cv::INTER_LINEAR);
  cv::resize(part, where, {mask.width(), mask.height()}, 0, 0, cv::INTER_LINEAR);
  cv::Mat1b result = grayView(mask).clone();
  const cv::Mat1b sides = smooth > 127;
  sides.copyTo(result, where > 127);
  return toGray(result);
}

}  // namespace windfall::model
