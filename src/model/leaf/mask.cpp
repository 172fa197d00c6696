#include "model/leaf/mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/mask_strokes_private.h"

namespace windfall::model {

namespace {

constexpr int kWorkSide = 640;

/// Terms of a surface of second order; x and y in -1..1.
cv::Vec<double, 6> terms(double x, double y) { return {1, x, y, x * x, x * y, y * y}; }

/// The ground's colour as a smooth surface, fitted to what looks like ground and again to what it explains.
class Ground {
 public:
  explicit Ground(const cv::Mat3f& lab) : size_(lab.size()) {
    const cv::Vec3f start = borderColour(lab);
    for (int channel = 0; channel < 3; ++channel) surface_(channel, 0) = start[channel];
    double tolerance = 11;
    for (int round = 0; round < 10; ++round) tolerance = fit(lab, tolerance);
    noise_ = tolerance;
  }

  cv::Vec3f at(int x, int y) const {
    const cv::Vec<double, 6> t = terms(2.0 * x / size_.width - 1, 2.0 * y / size_.height - 1);
    const cv::Vec3d value = surface_ * t;
    return {static_cast<float>(value[0]), static_cast<float>(value[1]), static_cast<float>(value[2])};
  }
  double noise() const { return noise_; }

 private:
  /// The commonest colour along the border, where leaves seldom are.
  static cv::Vec3f borderColour(const cv::Mat3f& lab) {
    const int rim = std::max(2, std::min(lab.rows, lab.cols) / 12);
    std::vector<cv::Vec3f> pixels;
    for (int y = 0; y < lab.rows; ++y) {
      for (int x = 0; x < lab.cols; ++x) {
        if (x < rim || y < rim || x >= lab.cols - rim || y >= lab.rows - rim) pixels.push_back(lab(y, x));
      }
    }
    // Mean shift from the fullest cell of a coarse histogram.
    std::vector<int> cells(16 * 32 * 32);
    const auto cell = [](const cv::Vec3f& c) {
      const int l = std::clamp(static_cast<int>(c[0] / 6.5f), 0, 15);
      const int a = std::clamp(static_cast<int>((c[1] + 128) / 8), 0, 31),
                b = std::clamp(static_cast<int>((c[2] + 128) / 8), 0, 31);
      return (l * 32 + a) * 32 + b;
    };
    for (const cv::Vec3f& pixel : pixels) ++cells[static_cast<size_t>(cell(pixel))];
    const auto fullest = static_cast<int>(std::max_element(cells.begin(), cells.end()) - cells.begin());
    const int lightness = fullest / 1024, a = fullest / 32 % 32, b = fullest % 32;
    cv::Vec3f colour(6.5f * (static_cast<float>(lightness) + 0.5f), 8 * (static_cast<float>(a) + 0.5f) - 128,
                     8 * (static_cast<float>(b) + 0.5f) - 128);
    for (int round = 0; round < 8; ++round) {
      cv::Vec3d sum(0, 0, 0);
      int count = 0;
      for (const cv::Vec3f& pixel : pixels) {
        if (cv::norm(pixel - colour) > 14) continue;
        sum += cv::Vec3d(pixel[0], pixel[1], pixel[2]);
        ++count;
      }
      if (count == 0) break;
      colour = cv::Vec3f(static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
                         static_cast<float>(sum[2] / count));
    }
    return colour;
  }

  /// A row's share of the normal equations.
  struct Row {
    cv::Matx<double, 6, 6> normal = cv::Matx<double, 6, 6>::zeros();
    cv::Matx<double, 6, 3> right = cv::Matx<double, 6, 3>::zeros();
    std::vector<double> errors;
  };

  void addRow(const cv::Mat3f& lab, int y, double tolerance, Row& row) const {
    for (int x = 0; x < lab.cols; x += 2) {
      const cv::Vec<double, 6> t = terms(2.0 * x / size_.width - 1, 2.0 * y / size_.height - 1);
      const cv::Vec3d value = surface_ * t;
      const cv::Vec3f& pixel = lab(y, x);
      const double error = cv::norm(cv::Vec3d(pixel[0] - value[0], pixel[1] - value[1], pixel[2] - value[2]));
      if (error > tolerance) continue;
      row.errors.push_back(error);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) row.normal(i, j) += t[i] * t[j];
        for (int c = 0; c < 3; ++c) row.right(i, c) += t[i] * static_cast<double>(pixel[c]);
      }
    }
  }

  /// Least squares over the pixels within `tolerance` of the surface; returns the next tolerance.
  double fit(const cv::Mat3f& lab, double tolerance) {
    // Row by row and summed in their order: the same for any number of threads.
    std::vector<Row> rows(static_cast<size_t>((lab.rows + 1) / 2));
#pragma omp parallel for schedule(static)
    for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
      addRow(lab, 2 * i, tolerance, rows[static_cast<size_t>(i)]);
    }
    cv::Matx<double, 6, 6> normal = cv::Matx<double, 6, 6>::zeros();
    cv::Matx<double, 6, 3> right = cv::Matx<double, 6, 3>::zeros();
    std::vector<double> errors;
    for (const Row& row : rows) {
      normal += row.normal;
      right += row.right;
      errors.insert(errors.end(), row.errors.begin(), row.errors.end());
    }
    if (errors.size() < 200) return tolerance;
    // A little of the flat solution, so that a ground seen only on one side is not extrapolated wildly.
    const double damping = 0.02 * normal(0, 0);
    for (int i = 1; i < 6; ++i) normal(i, i) += damping;
    cv::Matx<double, 6, 3> solution;
    if (!cv::solve(normal, right, solution, cv::DECOMP_CHOLESKY)) return tolerance;
    surface_ = solution.t();
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
    return std::clamp(3.0 * errors[errors.size() / 2], 6.0, 13.0);
  }

  cv::Size size_;
  cv::Matx<double, 3, 6> surface_ = cv::Matx<double, 3, 6>::zeros();
  double noise_ = 0;
};

/// One way to tell leaf from ground.
struct Measure {
  cv::Mat1f field;
  float threshold = 0;
  double separation = 0;  ///< between-class variance over variance
  double contrast = 0;    ///< difference of the class means
  double trust = 1;       ///< colour before lightness where both separate alike: a shadow has lightness only
  float lightness = 1;    ///< weight of lightness where the margin is set
};

/// Otsu's threshold on 0..the 99.5th percentile.
void threshold(Measure& measure) {
  std::vector<float> values(measure.field.begin(), measure.field.end());
  const auto top = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 995 / 1000);
  std::nth_element(values.begin(), top, values.end());
  const float high = std::max(*top, 1e-3f);
  std::array<double, 256> histogram{};
  for (const float value : measure.field) ++histogram[static_cast<size_t>(std::clamp(value / high, 0.f, 1.f) * 255)];
  double total = 0, sum = 0, squares = 0;
  for (size_t i = 0; i < 256; ++i) {
    total += histogram[i];
    sum += histogram[i] * static_cast<double>(i);
    squares += histogram[i] * static_cast<double>(i * i);
  }
  const double variance = squares / total - (sum / total) * (sum / total);
  double below = 0, belowSum = 0, best = -1;
  for (size_t i = 0; i < 255; ++i) {
    below += histogram[i];
    belowSum += histogram[i] * static_cast<double>(i);
    if (below == 0 || below == total) continue;
    const double low = belowSum / below, up = (sum - belowSum) / (total - below);
    const double between = below / total * (1 - below / total) * (up - low) * (up - low);
    if (between > best) {
      best = between;
      measure.threshold = static_cast<float>(static_cast<double>(i) + 0.5) / 255 * high;
      measure.contrast = (up - low) / 255 * high;
    }
  }
  measure.separation = variance > 0 ? best / variance : 0;
}

constexpr double kBar = 0.02;  ///< of the score: a bar is the leaf only where nothing else is

/// A ruler, a label, a strip of the table: long, and its rectangle is full. Blades of grass taper.
bool isBar(const cv::Mat1i& labels, int label, const cv::Rect& box, double area) {
  std::vector<cv::Point> places;
  cv::findNonZero(labels(box) == label, places);
  const cv::Size2f sides = cv::minAreaRect(places).size;
  const double shorter = std::min(sides.width, sides.height) + 1.0, longer = std::max(sides.width, sides.height) + 1.0;
  return longer > 3.5 * shorter && area > 0.88 * shorter * longer;
}

struct Component {
  cv::Mat1b mask;
  double share = 0;  ///< of all that stands out
  bool bar = false;
};

/// The component that is most likely the leaf: no bar, large, near the middle, not running out of the picture.
Component bestComponent(const cv::Mat1b& foreground) {
  cv::Mat1i labels;
  cv::Mat1i stats;
  cv::Mat1d centres;
  const int count = cv::connectedComponentsWithStats(foreground, labels, stats, centres, 8);
  std::vector<int> onBorder(static_cast<size_t>(count), 0);
  for (int x = 0; x < labels.cols; ++x) {
    ++onBorder[static_cast<size_t>(labels(0, x))];
    ++onBorder[static_cast<size_t>(labels(labels.rows - 1, x))];
  }
  for (int y = 0; y < labels.rows; ++y) {
    ++onBorder[static_cast<size_t>(labels(y, 0))];
    ++onBorder[static_cast<size_t>(labels(y, labels.cols - 1))];
  }
  int best = 0;
  bool bestBar = false;
  double bestScore = 0, total = 0;
  for (int i = 1; i < count; ++i) {
    const double area = stats(i, cv::CC_STAT_AREA);
    const cv::Rect box(stats(i, cv::CC_STAT_LEFT), stats(i, cv::CC_STAT_TOP), stats(i, cv::CC_STAT_WIDTH),
                       stats(i, cv::CC_STAT_HEIGHT));
    const bool bar = area > 0.001 * static_cast<double>(labels.total()) && isBar(labels, i, box, area);
    if (onBorder[static_cast<size_t>(i)] == 0 && !bar) total += area;
    const double dx = centres(i, 0) / labels.cols - 0.5, dy = centres(i, 1) / labels.rows - 0.5;
    const double contact = onBorder[static_cast<size_t>(i)] / std::sqrt(area);
    const double score = (bar ? kBar : 1) * area * std::exp(-4 * (dx * dx + dy * dy)) * std::exp(-3 * contact);
    if (score > bestScore) {
      bestScore = score;
      best = i;
      bestBar = bar;
    }
  }
  // What runs out of the picture (a table's edge, a neighbour) says nothing about how scattered the rest is.
  const double area = best > 0 ? stats(best, cv::CC_STAT_AREA) : 0;
  if (best == 0) return {cv::Mat1b::zeros(foreground.size())};
  return {cv::Mat1b(labels == best), area / std::max(total, area), bestBar};
}

/// Puts the margin half-way between the colours of leaf and ground that are found around each place.
void settleMargin(cv::Mat3f lab, float lightness, cv::Mat1b& mask, int reach) {
  cv::multiply(lab, cv::Scalar(lightness, 1, 1), lab);
  const cv::Size window(8 * reach + 1, 8 * reach + 1);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * reach + 1, 2 * reach + 1});
  for (int round = 0; round < 2; ++round) {
    cv::Mat1b core, wide;
    cv::erode(mask, core, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
    cv::dilate(mask, wide, kernel);
    cv::Mat1b outside = ~wide;
    const auto localMean = [&](const cv::Mat1b& where, cv::Mat3f& mean, cv::Mat1f& weight) {
      cv::Mat3f part = cv::Mat3f::zeros(lab.size());
      lab.copyTo(part, where);
      where.convertTo(weight, CV_32F, 1 / 255.0);
      cv::boxFilter(part, mean, -1, window);
      cv::boxFilter(weight, weight, -1, window);
    };
    cv::Mat3f leaf, ground;
    cv::Mat1f leafWeight, groundWeight;
    localMean(core, leaf, leafWeight);
    localMean(outside, ground, groundWeight);
    cv::Mat1b narrow;
    cv::erode(mask, narrow, kernel);
    for (int y = 0; y < lab.rows; ++y) {
      for (int x = 0; x < lab.cols; ++x) {
        if (!wide(y, x) || narrow(y, x) || leafWeight(y, x) < 1e-3f || groundWeight(y, x) < 1e-3f) continue;
        const cv::Vec3f inner = leaf(y, x) / leafWeight(y, x), outer = ground(y, x) / groundWeight(y, x);
        const cv::Vec3f axis = inner - outer;
        const float length = axis.dot(axis);
        if (length < 25) continue;
        mask(y, x) = (lab(y, x) - outer).dot(axis) > 0.5f * length ? 255 : 0;
      }
    }
  }
}

/// Lightness counts half: a hole may lie in the leaf's shadow.
float hueDistance(const cv::Vec3f& a, const cv::Vec3f& b) {
  const cv::Vec3f d = a - b;
  return std::sqrt(0.25f * d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/// Holes that look like ground stay; what only looks different (a pale midrib, a lesion, glare) is filled. `field` and
/// `lab` have the mask's size, `scale` work pixels of the ground are one of theirs.
void fillFalseHoles(const cv::Mat1f& field, float level, const cv::Mat3f& lab, const Ground& ground, double scale,
                    cv::Mat1b& mask) {
  cv::Mat1i labels, stats;
  cv::Mat1d centres;
  const cv::Mat1b background = ~mask;
  const int count = cv::connectedComponentsWithStats(background, labels, stats, centres, 4);
  std::vector<double> sum(static_cast<size_t>(count), 0);
  std::vector<cv::Vec3d> colour(static_cast<size_t>(count), cv::Vec3d(0, 0, 0));
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const auto label = static_cast<size_t>(labels(y, x));
      sum[label] += field(y, x);
      colour[label] += cv::Vec3d(lab(y, x));
    }
  }
  const double least = 1.2e-5 * mask.rows * mask.cols;
  for (int i = 1; i < count; ++i) {
    const int left = stats(i, cv::CC_STAT_LEFT), top = stats(i, cv::CC_STAT_TOP);
    const cv::Rect box(left, top, stats(i, cv::CC_STAT_WIDTH), stats(i, cv::CC_STAT_HEIGHT));
    if (left <= 0 || top <= 0 || box.br().x >= mask.cols || box.br().y >= mask.rows) continue;
    const double area = stats(i, cv::CC_STAT_AREA);
    bool filled = area < least || sum[static_cast<size_t>(i)] / area > 0.62 * level;
    if (!filled) {
      // Between ground and the leaf around it, its colour must lie on the ground's side.
      const int reach = std::max(3, std::min(box.width, box.height) / 2);
      const cv::Rect around = cv::Rect(box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach) &
                              cv::Rect(0, 0, mask.cols, mask.rows);
      const cv::Scalar mean = cv::mean(lab(around), mask(around));
      const cv::Vec3f leaf(static_cast<float>(mean[0]), static_cast<float>(mean[1]), static_cast<float>(mean[2]));
      const cv::Vec3f own(colour[static_cast<size_t>(i)] / area);
      const cv::Vec3f earth =
          ground.at(static_cast<int>(centres(i, 0) * scale), static_cast<int>(centres(i, 1) * scale));
      filled = hueDistance(own, earth) > 0.45f * hueDistance(leaf, earth);
    }
    if (filled) mask.setTo(255, labels == i);
  }
}

}  // namespace

QImage bareMask(const QImage& photo) {
  cv::Mat1b gray(photo.height(), photo.width());
  qint64 between = 0, border = 0, whiteBorder = 0;
  const cv::Mat4b pixels = rgbaView(photo);
  for (int y = 0; y < gray.rows; ++y) {
    for (int x = 0; x < gray.cols; ++x) {
      const cv::Vec4b& p = pixels(y, x);
      if (p[3] < 255 || std::max({p[0], p[1], p[2]}) - std::min({p[0], p[1], p[2]}) > 2) return {};
      gray(y, x) = p[1] > 127 ? 255 : 0;
      between += p[1] > 8 && p[1] < 247;
      if (x > 0 && y > 0 && x + 1 < gray.cols && y + 1 < gray.rows) continue;
      ++border;
      whiteBorder += p[1] > 127;
    }
  }
  const auto total = static_cast<double>(gray.total());
  const double white = cv::countNonZero(gray) / total;
  if (static_cast<double>(between) > 0.02 * total || white < 0.002 || white > 0.998) return {};
  if (2 * whiteBorder > border) gray = ~gray;
  return toGray(gray);
}

namespace {

/// Fills every hole of the mask.
void fillHoles(cv::Mat1b& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  cv::drawContours(mask, outlines, -1, 255, cv::FILLED);
}

Result<QImage> foundMask(const QImage& photo, Progress& progress) {
  if (photo.hasAlphaChannel()) {
    std::vector<cv::Mat1b> channels;
    cv::split(rgbaView(photo), channels);
    const cv::Mat1b opaque = channels[3] >= 128;
    const int covered = cv::countNonZero(opaque);
    if (covered < 16) return Error{"no leaf found: the picture is transparent"};
    if (covered < 0.98 * photo.width() * photo.height()) return toGray(opaque);
  }
  if (QImage bare = bareMask(photo); !bare.isNull()) return bare;
  const double scale = std::min(1.0, static_cast<double>(kWorkSide) / std::max(photo.width(), photo.height()));
  const cv::Mat3f full = toLab(photo);
  cv::Mat3f lab;
  cv::resize(full, lab, {}, scale, scale, cv::INTER_AREA);
  cv::GaussianBlur(lab, lab, {}, 0.8);
  progress.report(0.2);
  if (progress.cancelled()) return Error{"cancelled", true};

  const Ground ground(lab);
  std::array<Measure, 3> measures;
  for (Measure& measure : measures) measure.field.create(lab.size());
  measures[0].trust = 0.97;
  measures[1].trust = 1.02;
  measures[1].lightness = 0.25f;
  measures[2].lightness = 0.5f;
#pragma omp parallel for schedule(static)
  for (int y = 0; y < lab.rows; ++y) {
    for (int x = 0; x < lab.cols; ++x) {
      const cv::Vec3f d = lab(y, x) - ground.at(x, y);
      const float colour = std::hypot(d[1], d[2]);
      measures[0].field(y, x) = std::abs(d[0]);
      measures[1].field(y, x) = colour;
      // A shadow is darker and keeps the ground's colour: lightness counts for less.
      measures[2].field(y, x) = std::hypot(colour, 0.45f * d[0]);
    }
  }
  Measure* best = nullptr;
  double bestScore = 0, bestShare = 0;
  cv::Mat1b leaf;
  for (Measure& measure : measures) {
    threshold(measure);
    if (measure.contrast < 9) continue;
    cv::Mat1b foreground = measure.field > measure.threshold;
    const Component component = bestComponent(foreground);
    const double covered = static_cast<double>(cv::countNonZero(component.mask)) / (lab.rows * lab.cols);
    if (covered < 0.003 || covered > 0.97) continue;
    const double score = measure.separation * std::sqrt(component.share) * measure.trust * (component.bar ? kBar : 1);
    if (score > bestScore) {
      bestScore = score;
      bestShare = component.share;
      best = &measure;
      leaf = component.mask;
    }
  }
  if (!best || best->separation < 0.45 || bestShare < 0.12) {
    return Error{"no leaf found: nothing in the picture stands out from its ground"};
  }
  progress.report(0.5);
  if (progress.cancelled()) return Error{"cancelled", true};

  const float level = best->threshold + 0.25f * static_cast<float>(best->contrast);
  fillFalseHoles(best->field, level, lab, ground, 1, leaf);
  cv::Mat1b mask;
  cv::resize(leaf, mask, full.size(), 0, 0, cv::INTER_LINEAR);
  cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
  settleMargin(full.clone(), best->lightness, mask, std::max(2, static_cast<int>(std::lround(2.5 / scale))));
  dropStrokes(full, mask);
  mask = bestComponent(mask).mask;
  cv::Mat1f field;
  cv::resize(best->field, field, full.size(), 0, 0, cv::INTER_LINEAR);
  fillFalseHoles(field, level, full, ground, scale, mask);
  progress.report(1);
  return toGray(mask);
}

}  // namespace

Result<QImage> automaticMask(const QImage& photo, const MaskParameters& parameters, Progress& progress) {
  Result<QImage> mask = foundMask(photo, progress);
  if (!mask || parameters.keepHoles) return mask;
  cv::Mat1b filled = grayView(*mask).clone();
  fillHoles(filled);
  return toGray(filled);
}

}  // namespace windfall::model
