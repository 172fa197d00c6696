#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "kernels/random.h"
#include "model/leaf/detail.h"
#include "model/leaf/dilate.h"
#include "model/leaf/guided.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/region_match.h"
#include "model/leaf/smoothing.h"
#include "model/leaf/stages.h"
#include "model/leaf/superpixels.h"
#include "model/leaf/vein_frame.h"
#include "model/leaf/working_colours.h"

namespace windfall::model {

namespace {

/// A colour a superpixel, painted and smoothed.
std::vector<float> smoothLayer(const LeafStructure& structure, const std::vector<SuperpixelMean>& colours, double w1) {
  const size_t pixels = structure.superpixels.values.size();
  std::vector<float> layer(3 * pixels, 0.f);
  std::vector<unsigned char> mask(pixels, 0);
  for (size_t i = 0; i < pixels; ++i) {
    const qint32 label = structure.superpixels.values[i];
    if (label <= 0) continue;
    mask[i] = 1;
    for (size_t c = 0; c < 3; ++c) layer[3 * i + c] = colours[static_cast<size_t>(label - 1)].lab[c];
  }
  // The kernel reaches sqrt(w1) pixels: the same look at another resolution needs its square.
  const double unit = std::max(structure.distance.size.width(), structure.distance.size.height()) / 512.0;
  const double weight = w1 * unit * unit;
  smooth(layer, mask, structure.distance.size, weight, sweepsFor(weight));
  return layer;
}

/// For each superpixel of the target one of the example's: of the nearest in structural and vein distance within the
/// matched region, drawn by chance (leaf_textures.md, 7).
std::vector<SuperpixelMean> chooseSuperpixels(const std::vector<SuperpixelMean>& target,
                                              const std::vector<SuperpixelMean>& example, const std::vector<int>& match,
                                              int candidates, RandomSequence& random) {
  std::vector<std::vector<int>> members(1);
  for (size_t k = 0; k < example.size(); ++k) {
    const auto region = static_cast<size_t>(std::max(0, example[k].region));
    if (region >= members.size()) members.resize(region + 1);
    members[region].push_back(static_cast<int>(k));
  }
  std::vector<int> everyone(example.size());
  for (size_t k = 0; k < everyone.size(); ++k) everyone[k] = static_cast<int>(k);
  std::vector<SuperpixelMean> chosen = target;
  std::vector<std::pair<float, int>> nearest;
  for (SuperpixelMean& mean : chosen) {
    const auto region = static_cast<size_t>(mean.region > 0 && mean.region <= static_cast<int>(match.size())
                                                ? match[static_cast<size_t>(mean.region - 1)]
                                                : 0);
    const std::vector<int>& pool =
        region > 0 && region < members.size() && !members[region].empty() ? members[region] : everyone;
    nearest.clear();
    for (const int k : pool) {
      const SuperpixelMean& other = example[static_cast<size_t>(k)];
      const float ds = mean.distance - other.distance, dg = mean.veinDistance - other.veinDistance;
      nearest.emplace_back(ds * ds + dg * dg, k);
    }
    const auto count = std::min<size_t>(static_cast<size_t>(std::max(1, candidates)), nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(count), nearest.end());
    const SuperpixelMean& source =
        example[static_cast<size_t>(nearest[random.below(static_cast<std::uint32_t>(count))].second)];
    std::copy(std::begin(source.lab), std::end(source.lab), std::begin(mean.lab));
  }
  return chosen;
}

/// Superpixels, smoothed, and the example's detail on top; Lab, three floats a pixel.
std::vector<float> classicColours(const LeafStages& target, const LeafStages& example,
                                  const std::vector<float>& colours, const std::vector<int>& match,
                                  const SynthesisParameters& parameters, RandomSequence& random, Progress& progress) {
  const std::vector<SuperpixelMean> exampleMeans = describeSuperpixels(example.seen, colours.data());
  const std::vector<SuperpixelMean> targetMeans = describeSuperpixels(target.grown, nullptr);
  if (exampleMeans.empty() || targetMeans.empty()) return {};
  std::vector<float> result =
      smoothLayer(target.grown, chooseSuperpixels(targetMeans, exampleMeans, match, parameters.candidates, random),
                  parameters.smoothing);
  progress.report(0.35);
  if (progress.cancelled()) return {};
  // What the example has beyond its own smooth layer is its detail.
  std::vector<float> detail = smoothLayer(example.seen, exampleMeans, parameters.smoothing);
  for (size_t i = 0; i < detail.size(); ++i) {
    detail[i] = example.seen.superpixels.values[i / 3] > 0 ? colours[i] - detail[i] : 0;
  }
  progress.report(0.5);
  const std::vector<float> fine = layDetail(target.grown, {&example.seen, &detail}, random, progress);
  for (size_t i = 0; i < result.size(); ++i) result[i] += fine[i];
  return result;
}

/// Three floats a pixel of a leaf, enlarged to `size`; what lies off the leaf takes the nearest colour first.
std::vector<float> enlarged(std::vector<float> colours, const PatchImage& level, cv::Size size) {
  const cv::Mat3f lab(level.height, level.width, reinterpret_cast<cv::Vec3f*>(colours.data()));
  cv::Mat1b leaf(level.height, level.width);
  for (int y = 0; y < leaf.rows; ++y) {
    for (int x = 0; x < leaf.cols; ++x) leaf(y, x) = level.leaf[level.at(x, y)] ? 255 : 0;
  }
  cv::Mat4b large;
  cv::resize(rgbaView(spreadColours(fromLab(lab, leaf))), large, size, 0, 0, cv::INTER_CUBIC);
  const cv::Mat3f result = toLab(toRgba(large));
  return {reinterpret_cast<const float*>(result.datastart), reinterpret_cast<const float*>(result.dataend)};
}

/// Patches of the example, coarse to fine; the coarsest leaf is about 128 pixels long. The finest level is as fine as
/// the example's photo: between its pixels there is nothing to find.
std::vector<float> guidedColours(const LeafStages& target, const LeafStages& example, const std::vector<float>& colours,
                                 const std::vector<int>& match, quint64 seed, Progress& progress) {
  const VeinFrame targetFrame =
      findVeinFrame(target.grown, target.toWorking(target.root), target.toWorking(target.tip));
  const VeinFrame exampleFrame =
      findVeinFrame(example.seen, example.toWorking(example.root), example.toWorking(example.tip));
  const double length = QLineF(target.root, target.tip).length() * target.scale;
  const int levels = std::clamp(static_cast<int>(std::lround(std::log2(length / 128))) + 1, 1, 6);
  const int finest =
      std::clamp(static_cast<int>(std::floor(std::log2(std::max(1.0, example.scale / 1.2)))), 0, levels - 1);
  std::vector<GuidedLevel> pyramid;
  for (int n = levels - 1; n >= finest; --n) {
    const double factor = std::exp2(n);
    pyramid.push_back({makePatchImage(target.grown, targetFrame, nullptr, factor),
                       makePatchImage(example.seen, exampleFrame, colours.data(), factor)});
  }
  if (finest == 0) return synthesizeGuided(std::move(pyramid), match, seed, progress);
  const PatchImage last = pyramid.back().target;
  std::vector<float> result = synthesizeGuided(std::move(pyramid), match, seed, progress);
  if (result.empty()) return result;
  const QSize size = target.grown.distance.size;
  return enlarged(std::move(result), last, {size.width(), size.height()});
}

}  // namespace

Result<QImage> synthesize(const LeafStages& target, const LeafStages& example, const SynthesisParameters& parameters,
                          quint64 seed, Progress& progress) {
  if (target.reached < Stage::Superpixels || example.reached < Stage::Superpixels) {
    return Error{"a texture needs the superpixels of both leaves"};
  }
  const Error cancelled{"cancelled", true};
  RandomSequence random(seed, 211);
  const std::vector<float> colours = workingColours(example);
  const std::vector<int> match = chooseRegions(target, example, random);
  progress.report(0.1);
  if (progress.cancelled()) return cancelled;
  std::vector<float> result = parameters.guided
                                  ? guidedColours(target, example, colours, match, seed, progress)
                                  : classicColours(target, example, colours, match, parameters, random, progress);
  if (progress.cancelled()) return cancelled;
  if (result.empty()) return Error{"the leaf is too small for a texture"};

  const QSize size = target.grown.distance.size;
  const cv::Mat3f lab(size.height(), size.width(), reinterpret_cast<cv::Vec3f*>(result.data()));
  const QImage opaque = fromLab(lab, cv::Mat1b(size.height(), size.width(), static_cast<uchar>(255)));
  cv::Mat4b pixels = rgbaView(opaque).clone();
  const cv::Mat1b alpha = grayView(target.alpha);
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      const bool leaf =
          target.grown.regions
              .values[static_cast<size_t>(y) * static_cast<size_t>(pixels.cols) + static_cast<size_t>(x)] > 0;
      pixels(y, x)[3] = leaf ? 255 : 0;
    }
  }
  pixels = rgbaView(spreadColours(toRgba(pixels))).clone();
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) pixels(y, x)[3] = alpha(y, x);
  }
  progress.report(1);
  return toRgba(pixels);
}

}  // namespace windfall::model
