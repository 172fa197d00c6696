#include "model/leaf/variant.h"

namespace windfall::model {

Result<Variant> makeVariant(const LeafStages& of, std::span<const LeafStages> examples, quint64 seed,
                            Progress& progress) {
  LeafStages varied;
  const bool another = of.made.parameters.shape.vary;
  if (another) {
    Result<LeafStages> made = computeVariedStages(of, seed, progress);
    if (!made) return made.error();
    varied = std::move(*made);
  }
  const LeafStages& target = another ? varied : of;
  const LeafStages& example = examples.empty() ? of : examples[static_cast<size_t>(seed % examples.size())];
  Result<QImage> image = synthesize(target, example, of.made.parameters.synthesis, seed, progress);
  if (!image) return image.error();
  Variant variant;
  variant.seed = seed;
  variant.image = std::move(*image);
  variant.root = target.toVariant(target.root, variant.image.size());
  variant.tip = target.toVariant(target.tip, variant.image.size());
  return variant;
}

}  // namespace windfall::model
