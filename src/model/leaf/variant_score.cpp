#include "model/leaf/variant_score.h"

#include "model/leaf/image_cv_private.h"
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

}  // namespace

Result<std::vector<VariantScore>> scoreVariants(const Leaf& leaf, Progress& progress) {
  Leaf sized = leaf;
  sized.variants.clear();
  sized.parameters.synthesis.size = kSide;
  const Result<LeafStages> stages = computeStages(sized, Stage::Superpixels, progress);
  if (!stages) return stages.error();
  const ScoredLeaf example{&stages->seen, workingColours(*stages)};
  const QualityReference reference(example);
  const std::vector<float> stretched = stretchRows(stages->grown, workingAxis(*stages), example, workingAxis(*stages));
  const QSize size = stages->grown.distance.size;
  std::vector<VariantScore> scores;
  std::vector<float> before;
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    if (progress.cancelled()) return Error{"cancelled", true};
    progress.report(static_cast<double>(i) / static_cast<double>(leaf.variants.size()));
    ScoredLeaf made{&stages->grown, labOf(leaf.variants[i].image, size)};
    VariantScore score{reference.score(made).score(), copyIndex(made, stretched), 0};
    if (i > 0) score.diversity = diversity(made, before);
    if (i == 1) scores[0].diversity = score.diversity;
    scores.push_back(score);
    before = std::move(made.lab);
  }
  return scores;
}

}  // namespace windfall::model
