#include "model/leaf/patch_image.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace windfall::model {

namespace {

/// A vein's middle, and what lies beside it at a like distance in pixels, however wide apart the veins are.
constexpr float kRidge = 0.6f, kRidgeWidth = 1.5f, kHalo = 1.2f, kHaloReach = 5;  // px at 512
constexpr float kStanding = 1, kPetiole = 1;                                      ///< weights beside the other guides
constexpr float kOffLeaf = 24.5f;  ///< squared: the cost of a pixel where a patch reaches off the leaf

cv::Mat1f shrunk(const std::vector<float>& values, const cv::Mat1f& weight, cv::Size full, cv::Size size,
                 const cv::Mat1f& small) {
  const cv::Mat1f field(full.height, full.width, const_cast<float*>(values.data()));
  cv::Mat1f result;
  cv::resize(field.mul(weight), result, size, 0, 0, cv::INTER_AREA);
  return result / cv::max(small, 1e-4);
}

}  // namespace

namespace {

/// What every level is made of, in full size.
struct Fields {
  cv::Mat1f weight, line, standing;
};

Fields fieldsOf(const LeafStructure& structure, const VeinFrame& frame) {
  const cv::Size full(structure.distance.size.width(), structure.distance.size.height());
  Fields fields{cv::Mat1f(full), cv::Mat1f(full), cv::Mat1f(full)};
  const float unit = static_cast<float>(frame.longSide) / 512;
  for (int y = 0; y < full.height; ++y) {
    for (int x = 0; x < full.width; ++x) {
      const size_t i = static_cast<size_t>(y) * static_cast<size_t>(full.width) + static_cast<size_t>(x);
      const float reach = std::max(0.f, frame.reach[i]) / unit, near = std::exp(-reach / kHaloReach),
                  across = reach / kRidgeWidth;
      fields.weight(y, x) = structure.regions.values[i] > 0 ? 1.f : 0.f;
      fields.line(y, x) = kRidge * std::exp(-0.5f * across * across) + kHalo * near;
      fields.standing(y, x) = kStanding * near * frame.standing[i];
    }
  }
  return fields;
}

PatchImage levelOf(const Fields& fields, const LeafStructure& structure, const VeinFrame& frame, const float* lab,
                   double factor) {
  const cv::Size full = fields.weight.size();
  const cv::Size size(std::max(1, static_cast<int>(std::lround(full.width / factor))),
                      std::max(1, static_cast<int>(std::lround(full.height / factor))));
  const cv::Mat1f& weight = fields.weight;
  cv::Mat1f small, line, standing;
  cv::resize(weight, small, size, 0, 0, cv::INTER_AREA);
  const cv::Mat1f distance = shrunk(structure.distance.values, weight, full, size, small);
  const cv::Mat1f vein = shrunk(structure.veinDistance.values, weight, full, size, small);
  const cv::Mat1f margin = shrunk(frame.margin, weight, full, size, small);
  cv::resize(fields.line, line, size, 0, 0, cv::INTER_AREA);
  cv::resize(fields.standing, standing, size, 0, 0, cv::INTER_AREA);
  cv::Mat3f colours = cv::Mat3f::zeros(size);
  if (lab) {
    const cv::Mat3f source(full.height, full.width, reinterpret_cast<cv::Vec3f*>(const_cast<float*>(lab)));
    cv::resize(source, colours, size, 0, 0, cv::INTER_AREA);
  }

  PatchImage image;
  image.width = size.width;
  image.height = size.height;
  image.stride = size.width + 2 * kPatchPadding;
  image.pixels.assign(static_cast<size_t>(image.stride) * static_cast<size_t>(size.height + 2 * kPatchPadding),
                      {0, 0, 0, kOffLeaf});
  const size_t count = static_cast<size_t>(size.width) * static_cast<size_t>(size.height);
  image.guides.resize(count);
  image.leaf.resize(count);
  image.angle.resize(count);
  image.side.resize(count);
  image.region.resize(count);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const size_t i = image.at(x, y);
      const int fx = std::min(full.width - 1, static_cast<int>((x + 0.5) * full.width / size.width));
      const int fy = std::min(full.height - 1, static_cast<int>((y + 0.5) * full.height / size.height));
      const size_t j = static_cast<size_t>(fy) * static_cast<size_t>(full.width) + static_cast<size_t>(fx);
      image.leaf[i] = small(y, x) > 0.5f;
      image.guides[i] = {
          distance(y, x), std::min(1.f, vein(y, x)), 0.5f * margin(y, x), line(y, x), standing(y, x), 0, 0, 0};
      if (structure.regions.petiole > 0 && structure.regions.values[j] == structure.regions.petiole) {
        image.guides[i].petiole = kPetiole;
      }
      const double turns = frame.angle[j] / (2 * std::numbers::pi);
      image.angle[i] = static_cast<std::uint8_t>(static_cast<int>(std::lround((turns - std::floor(turns)) * 64)) & 63);
      image.side[i] = frame.side[j];
      image.region[i] = structure.regions.values[j];
      const cv::Vec3f& colour = colours(y, x);
      image.pixels[image.padded(x, y)] = {colour[0], colour[1], colour[2], image.leaf[i] ? 0.f : kOffLeaf};
    }
  }
  return image;
}

}  // namespace

std::vector<PatchImage> makePatchImages(const LeafStructure& structure, const VeinFrame& frame, const float* lab,
                                        const std::vector<double>& factors) {
  const Fields fields = fieldsOf(structure, frame);
  std::vector<PatchImage> images;
  for (const double factor : factors) images.push_back(levelOf(fields, structure, frame, lab, factor));
  return images;
}

}  // namespace windfall::model
