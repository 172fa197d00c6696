#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "kernels/random.h"
#include "model/leaf/distance.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/margin_depth_private.h"
#include "model/leaf/vein_fields_private.h"
#include "model/leaf/vein_growth.h"

namespace windfall::model {

namespace {

constexpr double kReference = 512;        // px, at which the note's constants are given
constexpr double kAreole = 11;            // px at that size: mean width of a field of the smallest veins
constexpr float kFar = 1e4f;              // where there is no vein at all
constexpr int kDrawnVein = 110;           // brightness from which a drawn pixel is vein
constexpr int kStructuralLongSide = 256;  // the structural distance is smooth: a small picture is enough

cv::Mat1f distanceTo(const cv::Mat1b& marked, double unit) {
  if (cv::countNonZero(marked) == 0) return cv::Mat1f(marked.size(), kFar);
  cv::Mat1f distance;
  cv::distanceTransform(~marked, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return distance / unit;
}

cv::Mat1b drawn(const Veins& veins, QSize size) {
  const QImage picture = drawVeins(veins, size, {0, 0}, 1);
  return grayView(picture) >= kDrawnVein;
}

/// Edges of the Voronoi cells of a jittered grid: the net that the smallest veins make.
cv::Mat1b areoles(cv::Size size, double spacing, quint64 seed) {
  cv::Mat1b sites(size, static_cast<uchar>(255));
  const int columns = static_cast<int>(size.width / spacing) + 1, rows = static_cast<int>(size.height / spacing) + 1;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto jitter = [&](std::uint32_t axis) {
        return 0.1 + 0.8 * uniform(seed, static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), axis);
      };
      const int x = static_cast<int>((column + jitter(1)) * spacing), y = static_cast<int>((row + jitter(2)) * spacing);
      if (x < size.width && y < size.height) sites(y, x) = 0;
    }
  }
  cv::Mat1f distance;
  cv::Mat1i cell;
  cv::distanceTransform(sites, distance, cell, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  cv::Mat1b edges(size, static_cast<uchar>(0));
  for (int y = 0; y + 1 < size.height; ++y) {
    for (int x = 0; x + 1 < size.width; ++x) {
      edges(y, x) = cell(y, x) != cell(y, x + 1) || cell(y, x) != cell(y + 1, x) ? 255 : 0;
    }
  }
  return edges;
}

cv::Mat1f structuralOf(const cv::Mat1b& leaf, const cv::Mat1b& veins, QPointF root) {
  const double scale = std::min(1.0, static_cast<double>(kStructuralLongSide) / std::max(leaf.cols, leaf.rows));
  cv::Mat1b small, vein;
  cv::resize(leaf, small, {}, scale, scale, cv::INTER_AREA);
  cv::resize(veins, vein, small.size(), 0, 0, cv::INTER_AREA);
  const QSize size(small.cols, small.rows);
  std::vector<Tissue> types(small.total());
  QPoint source(0, 0);
  double least = 1e30;
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      Tissue& type = types[static_cast<size_t>(y) * static_cast<size_t>(small.cols) + static_cast<size_t>(x)];
      type = small(y, x) < 128 ? Tissue::Outside : vein(y, x) < 60 ? Tissue::Blade : Tissue::Vein;
      const double distance = std::hypot(x - root.x() * scale, y - root.y() * scale);
      if (type != Tissue::Outside && distance < least) least = distance, source = {x, y};
    }
  }
  if (least > 1e29) return cv::Mat1f(leaf.size(), 0.0f);
  const ScalarField field = normalised(structuralDistance(types, size, source, {}), size, types);
  cv::Mat1f result(small.size());
  std::copy(field.values.begin(), field.values.end(), result.begin());
  cv::resize(result, result, leaf.size(), 0, 0, cv::INTER_LINEAR);
  return result;
}

}  // namespace

VeinFields veinFields(const QImage& image, const Veins& veins, QPointF root, quint64 seed) {
  VeinFields fields;
  const cv::Mat4b pixels = rgbaView(image);
  fields.unit = std::max(pixels.cols, pixels.rows) / kReference;
  cv::Mat1b alpha;
  cv::extractChannel(pixels, alpha, 3);
  fields.leaf = alpha >= 128;
  Veins large, small;
  for (const Vein& vein : veins) (vein.order <= 2 ? large : small).push_back(vein);
  const cv::Mat1b mainVeins = drawn(large, image.size());
  fields.mainVein = distanceTo(mainVeins, fields.unit);
  fields.smallVein = distanceTo(
      small.empty() ? areoles(pixels.size(), std::max(3.0, kAreole * fields.unit), seed) : drawn(small, image.size()),
      fields.unit);
  fields.margin = marginDepth(fields.leaf, cv::DIST_MASK_PRECISE) / fields.unit;
  fields.structural = structuralOf(fields.leaf, mainVeins, root);
  return fields;
}

cv::Mat1f smoothNoise(cv::Size size, double radius, quint64 seed) {
  // Drawn on a grid as coarse as the radius allows, which is quick and looks the same.
  const double step = std::max(1.0, radius / 1.5);
  const cv::Size grid(static_cast<int>(size.width / step) + 3, static_cast<int>(size.height / step) + 3);
  cv::Mat1f noise(grid);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      // The sum of four is near enough to a normal distribution once it is blurred.
      const std::uint32_t bits = hash(seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0x6e6f6973u);
      float sum = 0;
      for (std::uint32_t k = 0; k < 4; ++k) sum += static_cast<float>((bits >> (8 * k)) & 255u) / 255.0f - 0.5f;
      noise(y, x) = sum;
    }
  }
  cv::GaussianBlur(noise, noise, {}, radius / step, radius / step, cv::BORDER_REFLECT_101);
  if (step > 1) {
    cv::Mat1f large;
    cv::resize(noise, large,
               {static_cast<int>(std::ceil(grid.width * step)), static_cast<int>(std::ceil(grid.height * step))}, 0, 0,
               cv::INTER_CUBIC);
    noise = large;
  }
  noise = noise(cv::Rect(0, 0, size.width, size.height)).clone();
  cv::Scalar mean, deviation;
  cv::meanStdDev(noise, mean, deviation);
  return (noise - mean[0]) / std::max(1e-6, deviation[0]);
}

}  // namespace windfall::model
