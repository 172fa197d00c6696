#include "model/leaf/variant_score.h"

#include <algorithm>
#include <memory>

#include "model/leaf/image_cv_private.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/quality.h"
#include "model/leaf/quality_baselines.h"
#include "model/leaf/working_colours.h"

namespace windfall::model {

namespace {

constexpr int kSide = 512;  ///< px: what the score's lengths are meant for

std::vector<float> labOf(const QImage& image, QSize size) {
  const cv::Mat3f lab = toLab(
      image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).convertToFormat(QImage::Format_RGBA8888));
  return {reinterpret_cast<const float*>(lab.datastart), reinterpret_cast<const float*>(lab.dataend)};
}

LeafStages sizedStages(const Leaf& leaf, Progress& progress, Error& error) {
  Leaf sized = leaf;
  sized.variants.clear();
  sized.parameters.synthesis.size = kSide;
  Result<LeafStages> stages = computeStages(sized, Stage::Superpixels, progress);
  if (!stages) error = {leaf.name.toStdString() + ": " + stages.error().message, stages.error().cancelled};
  return stages ? std::move(*stages) : LeafStages{};
}

/// One example, and the photos that a texture could be a copy of.
struct Lender {
  ScoredLeaf example;
  std::unique_ptr<QualityReference> reference;
  std::vector<const LeafStages*> photos;
};

}  // namespace

Result<std::vector<VariantScore>> scoreVariants(const Leaf& leaf, std::span<const Leaf> lenders, Progress& progress) {
  Error error;
  const LeafStages own = sizedStages(leaf, progress, error);
  std::vector<LeafStages> photos;
  for (const Leaf& lender : lenders) {
    photos.push_back(lender.id == leaf.id ? own : sizedStages(lender, progress, error));
  }
  if (!error.message.empty()) return error;
  if (photos.empty()) photos.push_back(own);
  const std::vector<LeafStages> examples = lendersOf(own, photos);
  std::vector<Lender> known;
  for (const LeafStages& example : examples) {
    known.push_back({{&example.seen, workingColours(example)}, {}, {}});
    if (example.joined.empty()) {
      known.back().photos = {&example};
    } else {
      for (const LeafStages& photo : photos) known.back().photos.push_back(&photo);
    }
  }
  // The references keep where their examples stand.
  for (Lender& lender : known) lender.reference = std::make_unique<QualityReference>(lender.example);

  const QSize size = own.grown.distance.size;
  const bool vary = leaf.parameters.shape.vary;
  std::vector<VariantScore> scores;
  std::vector<float> before;
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    if (progress.cancelled()) return Error{"cancelled", true};
    progress.report(static_cast<double>(i) / static_cast<double>(leaf.variants.size()));
    const quint64 seed = leaf.variants[i].seed;
    LeafStages another;
    if (vary) {
      Result<LeafStages> varied = computeVariedStages(own, seed, progress);
      if (!varied) return varied.error();
      another = std::move(*varied);
    }
    const LeafStages& shape = vary ? another : own;
    const Lender& lender = known[static_cast<size_t>(seed % known.size())];
    ScoredLeaf made{&shape.grown, labOf(leaf.variants[i].image, size)};
    VariantScore score{lender.reference->score(made).score(), -1, 0};
    for (const LeafStages* photo : lender.photos) {
      const ScoredLeaf example{&photo->seen, workingColours(*photo)};
      const std::vector<float> stretched = stretchRows(shape.grown, workingAxis(shape), example, workingAxis(*photo));
      score.copyIndex = std::max(score.copyIndex, copyIndex(made, stretched));
    }
    if (i > 0) score.diversity = diversity(made, before);
    if (i == 1) scores[0].diversity = score.diversity;
    scores.push_back(score);
    before = std::move(made.lab);
  }
  return scores;
}

}  // namespace windfall::model
