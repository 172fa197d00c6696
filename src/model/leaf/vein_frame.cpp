#include "model/leaf/vein_frame.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/vein_flow.h"

namespace windfall::model {

namespace {

constexpr double kSmooth = 6;          ///< px at 512: over which directions are averaged
constexpr float kLeastWeight = 0.02f;  ///< of the smallest veins; the others' is their standing

/// Second moments of the vein pixels around each pixel, and how the structural distance grows along them.
struct Tensors {
  cv::Mat1f count, xx, xy, yy, sx, sy;
};

Tensors gather(const cv::Mat1f& veins, const cv::Mat1f& distance, int radius) {
  const cv::Size size = veins.size();
  cv::Mat1f px(size), py(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      px(y, x) = static_cast<float>(x);
      py(y, x) = static_cast<float>(y);
    }
  }
  const auto sum = [&](const cv::Mat& values) {
    cv::Mat1d result;
    cv::boxFilter(values, result, CV_64F, {2 * radius + 1, 2 * radius + 1}, {-1, -1}, false, cv::BORDER_CONSTANT);
    return result;
  };
  const cv::Mat1f vx = veins.mul(px), vy = veins.mul(py), vs = veins.mul(distance);
  const cv::Mat1d n = sum(veins), mx = sum(vx), my = sum(vy), ms = sum(vs);
  const cv::Mat1d mxx = sum(vx.mul(px)), mxy = sum(vx.mul(py)), myy = sum(vy.mul(py)), msx = sum(vs.mul(px)),
                  msy = sum(vs.mul(py));
  Tensors t;
  for (cv::Mat1f* field : {&t.count, &t.xx, &t.xy, &t.yy, &t.sx, &t.sy}) field->create(size);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double c = n(y, x);
      t.count(y, x) = static_cast<float>(c);
      if (c < 2) continue;
      const double ax = mx(y, x) / c, ay = my(y, x) / c, as = ms(y, x) / c;
      t.xx(y, x) = static_cast<float>(mxx(y, x) / c - ax * ax);
      t.xy(y, x) = static_cast<float>(mxy(y, x) / c - ax * ay);
      t.yy(y, x) = static_cast<float>(myy(y, x) / c - ay * ay);
      t.sx(y, x) = static_cast<float>(msx(y, x) / c - as * ax);
      t.sy(y, x) = static_cast<float>(msy(y, x) / c - as * ay);
    }
  }
  return t;
}

/// Directions that turn slowly: small veins that bend and branch do not cut the texture between them into crumbs.
void smoothAngles(VeinFrame& frame, const cv::Mat1b& leaf) {
  const int width = leaf.cols, height = leaf.rows;
  const double sigma = kSmooth * std::max(width, height) / 512.0, step = std::max(1.0, sigma / 3);
  cv::Mat2f ways(height, width, cv::Vec2f(0, 0)), small;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      const float weight = leaf(y, x) ? frame.standing[i] + kLeastWeight : 0.f;
      ways(y, x) = cv::Vec2f(weight * std::cos(frame.angle[i]), weight * std::sin(frame.angle[i]));
    }
  }
  const cv::Size size(std::max(1, static_cast<int>(width / step)), std::max(1, static_cast<int>(height / step)));
  cv::resize(ways, small, size, 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(small, small, {}, sigma / step);
  cv::resize(small, ways, {width, height}, 0, 0, cv::INTER_LINEAR);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const cv::Vec2f& way = ways(y, x);
      if (!leaf(y, x) || way.dot(way) < 1e-9f) continue;
      frame.angle[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)] =
          std::atan2(way[1], way[0]);
    }
  }
}

}  // namespace

VeinFrame findVeinFrame(const LeafStructure& structure, QPointF root, QPointF tip) {
  const int width = structure.distance.size.width(), height = structure.distance.size.height();
  const size_t pixels = structure.distance.values.size();
  cv::Mat1f veins(height, width), distance(height, width, const_cast<float*>(structure.distance.values.data()));
  cv::Mat1b open(height, width), leaf(height, width);
  for (size_t i = 0; i < pixels; ++i) {
    const int y = static_cast<int>(i) / width, x = static_cast<int>(i) % width;
    const bool on = structure.regions.values[i] > 0;
    const bool vein = on && structure.veinDistance.values[i] <= 0;
    veins(y, x) = vein ? 1.f : 0.f;
    open(y, x) = vein ? 0 : 255;
    leaf(y, x) = on ? 255 : 0;
  }
  const int radius = std::max(3, std::max(width, height) / 90);
  const Tensors tensors = gather(veins, distance, radius);
  cv::Mat1f toVein, toMargin;
  cv::Mat1i nearest;
  cv::distanceTransform(open, toVein, nearest, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  cv::distanceTransform(leaf, toMargin, cv::DIST_L2, 5);
  // Half the width of a vein, at each of its pixels: how deep its middle lies near by.
  cv::Mat1f depth, half;
  cv::distanceTransform(~open, depth, cv::DIST_L2, 3);
  const int widest = 2 * std::max(2, std::max(width, height) / 100) + 1;
  cv::dilate(depth, half, cv::getStructuringElement(cv::MORPH_RECT, {widest, widest}));
  std::vector<float> halfOf(1, 0.f);
  const float fallback = static_cast<float>(std::atan2(tip.y() - root.y(), tip.x() - root.x()));
  std::vector<float> angleOf(1, fallback), standingOf(1, 0.f);
  const std::vector<float> flow = veinFlow(structure);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (open(y, x)) continue;
      const auto label = static_cast<size_t>(nearest(y, x));
      if (label >= angleOf.size())
        angleOf.resize(label + 1, fallback), standingOf.resize(label + 1, 0.f), halfOf.resize(label + 1, 0.f);
      halfOf[label] = half(y, x);
      standingOf[label] = std::sqrt(flow[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)]);
      if (tensors.count(y, x) < 3) continue;
      // The main direction of the vein pixels around, pointing to where the structural distance grows.
      float angle = 0.5f * std::atan2(2 * tensors.xy(y, x), tensors.xx(y, x) - tensors.yy(y, x));
      if (std::cos(angle) * tensors.sx(y, x) + std::sin(angle) * tensors.sy(y, x) < 0) angle += 3.14159265f;
      angleOf[label] = angle;
    }
  }
  double deepest = 1;
  cv::minMaxLoc(toMargin, nullptr, &deepest);
  VeinFrame frame;
  frame.longSide = std::max(width, height);
  frame.angle.resize(pixels);
  frame.side.resize(pixels);
  frame.reach.resize(pixels);
  frame.margin.resize(pixels);
  frame.standing.resize(pixels);
  const QPointF along = tip - root;
  for (size_t i = 0; i < pixels; ++i) {
    const int y = static_cast<int>(i) / width, x = static_cast<int>(i) % width;
    const auto label = static_cast<size_t>(nearest(y, x));
    frame.angle[i] = label < angleOf.size() ? angleOf[label] : fallback;
    frame.standing[i] = label < standingOf.size() ? standingOf[label] : 0;
    frame.side[i] = along.x() * (y - root.y()) - along.y() * (x - root.x()) >= 0 ? 1 : -1;
    frame.reach[i] =
        open(y, x) ? toVein(y, x) + (label < halfOf.size() ? halfOf[label] : 0.f) - 1 : half(y, x) - depth(y, x);
    frame.margin[i] = std::min(1.f, toMargin(y, x) / (0.5f * static_cast<float>(deepest)));
  }
  smoothAngles(frame, leaf);
  return frame;
}

}  // namespace windfall::model
