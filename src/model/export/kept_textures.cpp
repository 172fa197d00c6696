#include "model/export/kept_textures.h"

#include <algorithm>

#include "model/leaf/stages.h"

namespace windfall::model {

Veins variantVeins(const LeafStages& stages, QSize variant) {
  Veins veins = stages.veins;
  const double scale = static_cast<double>(variant.width()) / std::max(1, stages.frame.width());
  for (Vein& vein : veins) {
    for (QPointF& p : vein.points) p = stages.toVariant(p, variant);
    vein.startWidth *= scale;
    vein.endWidth *= scale;
  }
  return veins;
}

Result<std::vector<LeafTexture>> keptTextures(const Leaf& leaf, Progress& progress) {
  const auto wanted = [](const Variant& variant) { return variant.keep && !variant.image.isNull(); };
  std::vector<LeafTexture> textures;
  if (std::none_of(leaf.variants.begin(), leaf.variants.end(), wanted)) return textures;
  const Result<LeafStages> stages = computeStages(leaf, Stage::Veins, progress);
  if (!stages) return stages.error();
  for (size_t i = 0; i < leaf.variants.size(); ++i) {
    const Variant& variant = leaf.variants[i];
    if (!wanted(variant)) continue;
    if (progress.cancelled()) return Error{"cancelled", true};
    // A variant that knows its own places stays right when the leaf's marks are edited after it was made.
    const QSize size = variant.image.size();
    LeafTexture texture = uprightTexture(QStringLiteral("%1 %2").arg(leaf.name).arg(i + 1, 3, 10, QLatin1Char('0')),
                                         variant.image, variant.root.value_or(stages->toVariant(stages->root, size)),
                                         variant.tip.value_or(stages->toVariant(stages->tip, size)),
                                         stages->bladeLength, variantVeins(*stages, size));
    if (const Status dressed = dressTexture(texture, leaf.parameters, variant.seed); !dressed) return dressed.error();
    textures.push_back(std::move(texture));
  }
  return textures;
}

}  // namespace windfall::model
