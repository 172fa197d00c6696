#include "widgets/leaf/variant_scores.h"

namespace windfall::widgets {

VariantScores::VariantScores(model::Document& document, model::JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {}

std::optional<model::VariantScore> VariantScores::of(const model::Variant& variant) const {
  const auto known = known_.find(variant.image.cacheKey());
  return known != known_.end() ? std::optional(known->second) : std::nullopt;
}

void VariantScores::want(model::AssetId id) {
  const model::Leaf* leaf = document_.project().leaf(id);
  if (!leaf) return;
  std::vector<qint64> keys;
  bool all = true;
  for (const model::Variant& variant : leaf->variants) {
    keys.push_back(variant.image.cacheKey());
    all = all && known_.count(keys.back()) > 0;
  }
  if (all) return;
  std::vector<model::Leaf> lenders;
  for (const model::AssetId lender : leaf->examples) {
    if (const model::Leaf* example = document_.project().leaf(lender)) {
      lenders.push_back(*example);
      lenders.back().variants.clear();
    }
  }
  jobs_.start<std::vector<model::VariantScore>>(
      tr("Scoring %n variants of %1", nullptr, int(keys.size())).arg(leaf->name), QStringLiteral("variant-scores"),
      [snapshot = *leaf, lenders = std::move(lenders)](model::Progress& progress) {
        return model::scoreVariants(snapshot, lenders, progress);
      },
      [this, keys](const std::vector<model::VariantScore>& scores) {
        for (std::size_t i = 0; i < keys.size() && i < scores.size(); ++i) known_[keys[i]] = scores[i];
        emit changed();
      });
}

}  // namespace windfall::widgets
