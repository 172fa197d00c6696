#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "kernels/random.h"
#include "model/leaf/classic.h"
#include "model/leaf/dilate.h"
#include "model/leaf/guided.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/octave_contrast.h"
#include "model/leaf/region_match.h"
#include "model/leaf/small_leaf.h"
#include "model/leaf/stages.h"
#include "model/leaf/tone_variety.h"
#include "model/leaf/vein_frame.h"
#include "model/leaf/vein_profile.h"
#include "model/leaf/working_colours.h"
#include "model/progress_part.h"

namespace windfall::model {

namespace {

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
                                 const std::vector<int>& match, double guideWeight, quint64 seed, Progress& progress) {
  const double length = QLineF(target.root, target.tip).length() * target.scale;
  const int levels = std::clamp(static_cast<int>(std::lround(std::log2(length / 128))) + 1, 1, 6);
  const int finest =
      std::clamp(static_cast<int>(std::floor(std::log2(std::max(1.0, example.scale * 1.2)))), 0, levels - 1);
  std::vector<double> factors;
  for (int n = levels - 1; n >= finest; --n) factors.push_back(std::exp2(n));
  // Of two leaves each thread takes one: nothing that follows depends on who did.
  VeinFrame frames[2];
  std::vector<PatchImage> images[2];
#pragma omp parallel for schedule(static, 1)
  for (int leaf = 0; leaf < 2; ++leaf) {
    frames[leaf] = leaf == 0 ? findVeinFrame(target.grown, target.toWorking(target.root), target.toWorking(target.tip))
                             : exampleFrame(example);
    images[leaf] = leaf == 0 ? makePatchImages(target.grown, frames[0], nullptr, factors)
                             : makePatchImages(example.seen, frames[1], colours.data(), factors);
  }
  const VeinFrame &targetFrame = frames[0], &lenderFrame = frames[1];
  std::vector<GuidedLevel> pyramid;
  for (size_t n = 0; n < factors.size(); ++n) pyramid.push_back({std::move(images[0][n]), std::move(images[1][n])});
  PatchImage last;
  last.width = pyramid.back().target.width;
  last.height = pyramid.back().target.height;
  last.leaf = pyramid.back().target.leaf;
  std::vector<float> result = synthesizeGuided(std::move(pyramid), match, guideWeight, seed, progress);
  if (result.empty()) return result;
  const QSize size = target.grown.distance.size;
  if (finest > 0) result = enlarged(std::move(result), last, {size.width(), size.height()});
  result = restoreContrast({target.grown, result}, {example.seen, colours});
  return restoreVeins({target.grown, targetFrame, result}, {example.seen, lenderFrame, colours});
}

/// Sets a variant off from others, as far as they are too like each other.
void varyTone(std::vector<float>& made, const LeafStages& target, const LeafStages& example,
              const std::vector<float>& colours, const SynthesisParameters& parameters, quint64 seed,
              Progress& progress) {
  const SmallVariants variants = smallVariants(target, example, colours, parameters, progress);
  const double factor = smallFactor(target.grown.distance.size);
  const TonePhase phase{target.toWorking(target.root), target.toWorking(target.tip)};
  const float strength = toneStrength(variants, {phase.root / factor, phase.tip / factor}, parameters.variety);
  addTone(made, target.grown.regions, variants.tones, phase, strength, seed);
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
  const bool thesis = !parameters.guided && parameters.asThesis;
  const std::vector<int> match = chooseRegions(target, example, random, thesis);
  progress.report(0.1);
  if (progress.cancelled()) return cancelled;
  ProgressPart making(progress, 0.1, 0.9);
  ProgressPart varying(progress, 0.9, 1);
  std::vector<float> result = parameters.guided
                                  ? guidedColours(target, example, colours, match, parameters.guideWeight, seed, making)
                                  : synthesizeClassic(target, example, colours, match, parameters, seed, making);
  if (progress.cancelled()) return cancelled;
  if (result.empty()) return Error{"the leaf is too small for a texture"};
  if (parameters.variety > 0) varyTone(result, target, example, colours, parameters, seed, varying);
  if (progress.cancelled()) return cancelled;

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
