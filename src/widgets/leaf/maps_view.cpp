#include "widgets/leaf/maps_view.h"

#include "model/export/kept_textures.h"
#include "model/leaf/ageing.h"

namespace windfall::widgets {

namespace {

/// The fresh leaf's maps say where ageing comes first; the aged one's are shown.
QImage pictureOf(const QImage& variant, const model::Veins& veins, QPointF root, quint64 seed,
                 const model::LeafParameters& parameters, model::MapKind kind) {
  const model::LeafAge age = model::leafAge(parameters.ageing);
  model::MapSource source{variant, veins, root, seed, age.dryness(parameters.ageing.wetness)};
  model::LeafMaps maps = model::makeMaps(source, parameters.maps);
  if (parameters.ageing.age > 0) {
    source.image = model::agedTexture(variant, maps.ageing, age, parameters.ageing);
    if (kind != model::MapKind::Colour) maps = model::makeMaps(source, parameters.maps);
  }
  return model::mapPicture(source.image, maps, kind);
}

}  // namespace

MapsView::MapsView(model::Document& document, model::JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {}

void MapsView::show(model::AssetId id, int index, model::MapKind kind, const model::LeafStages* stages) {
  const model::Leaf* leaf = document_.project().leaf(id);
  if (!leaf || index < 0 || index >= int(leaf->variants.size())) return;
  const model::Variant& variant = leaf->variants[std::size_t(index)];
  if (variant.image.isNull()) return;
  const bool plain = kind == model::MapKind::Colour && leaf->parameters.ageing.age <= 0;
  Wish wish{quint64(variant.image.cacheKey()), leaf->parameters.maps, leaf->parameters.ageing, kind, {}, {}};
  if (stages && stages->reached >= model::Stage::Veins) {
    wish.veins = model::variantVeins(*stages, variant.image.size());
    wish.root = stages->toVariant(stages->root, variant.image.size());
  }
  if (wish == wish_ && !picture_.isNull()) return;
  wish_ = wish;
  if (plain || !stages) {
    running_ = 0;
    picture_ = MipImage(variant.image);
    emit changed();
    return;
  }
  const quint64 run = running_ = ++lastRun_;
  model::Job* job = jobs_.start<MipImage>(
      tr("Maps of %1").arg(leaf->name), QStringLiteral("leaf-maps"),
      [image = variant.image, seed = variant.seed, wish, parameters = leaf->parameters](model::Progress& progress) {
        const QImage picture = pictureOf(image, wish.veins, wish.root, seed, parameters, wish.kind);
        if (progress.cancelled()) return Result<MipImage>(Error{"cancelled", true});
        return Result<MipImage>(MipImage(picture));
      },
      [this, run](MipImage picture) {
        if (run != running_) return;
        picture_ = std::move(picture);
        emit changed();
      });
  connect(job, &model::Job::finished, this, [this, run] {
    if (run == running_) running_ = 0;
  });
}

}  // namespace windfall::widgets
