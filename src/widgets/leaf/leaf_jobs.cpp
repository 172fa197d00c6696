#include "widgets/leaf/leaf_jobs.h"

#include <QFile>
#include <QFileInfo>

#include "model/export/exporter.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/mask.h"
#include "model/leaf/mask_edit.h"
#include "model/leaf/variant.h"
#include "model/leaf/vein_tracing.h"

namespace windfall::widgets {

using model::Aspect;
using model::AssetId;
using model::Leaf;

QStringList photoEndings() {
  return {QStringLiteral("jpg"), QStringLiteral("jpeg"), QStringLiteral("png"), QStringLiteral("webp"),
          QStringLiteral("tif"), QStringLiteral("tiff"), QStringLiteral("bmp")};
}

LeafJobs::LeafJobs(model::Document& document, model::JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {}

void LeafJobs::openPhoto(const QString& path, AssetId replace) {
  const QString file = QFileInfo(path).fileName();
  jobs_.start<model::SourceFile>(
      tr("Opening %1").arg(file), QStringLiteral("photo:") + path,
      [path, file](model::Progress&) -> Result<model::SourceFile> {
        QFile source(path);
        if (!source.open(QIODevice::ReadOnly)) return Error{source.errorString().toStdString()};
        model::SourceFile photo{file, source.readAll()};
        // Decoded once here, so that what can't be read never becomes a leaf.
        const Result<QImage> image = model::readPhoto(photo);
        if (!image) return image.error();
        return photo;
      },
      [this, path, replace](model::SourceFile photo) {
        if (replace) {
          document_.setLeaf(replace, &Leaf::photo, std::move(photo), Aspect::LeafPhoto, tr("Replace photo"));
          emit photoOpened(replace);
          return;
        }
        Leaf leaf;
        leaf.name = QFileInfo(path).completeBaseName();
        leaf.photo = std::move(photo);
        emit photoOpened(document_.addLeaf(std::move(leaf)));
      });
}

void LeafJobs::makeVariants(AssetId id, int count, const model::LeafStages* known) {
  const Leaf* leaf = document_.project().leaf(id);
  if (!leaf) return;
  quint64 seed = 0;
  for (const model::Variant& variant : leaf->variants) seed = std::max(seed, variant.seed);
  Leaf snapshot = *leaf;
  snapshot.variants.clear();
  std::shared_ptr<const model::LeafStages> stages;
  if (known) {
    auto copy = std::make_shared<model::LeafStages>(*known);
    // Parameters of the choice of colours and shapes may be newer than the stages, which do not depend on them.
    copy->made = snapshot;
    stages = std::move(copy);
  }
  std::vector<Leaf> lenders;
  for (const AssetId lender : leaf->examples) {
    if (const Leaf* example = document_.project().leaf(lender)) {
      lenders.push_back(*example);
      lenders.back().variants.clear();
    }
  }
  emit variantsChanged(true);
  model::Job* job = jobs_.start<std::vector<model::Variant>>(
      tr("Making %n variants of %1", nullptr, count).arg(leaf->name), QStringLiteral("variants"),
      [snapshot = std::move(snapshot), lenders = std::move(lenders), stages, seed,
       count](model::Progress& progress) -> Result<std::vector<model::Variant>> {
        // The stages take about as long as one texture.
        const double parts = count + (stages ? 0 : 1) + double(lenders.size());
        double done = 0;
        model::LeafStages own;
        if (!stages) {
          Result<model::LeafStages> made = model::computeStages(snapshot, model::Stage::Superpixels, progress);
          if (!made) return made.error();
          own = std::move(*made);
          done = 1;
        }
        const model::LeafStages& of = stages ? *stages : own;
        std::vector<model::LeafStages> examples;
        for (const Leaf& lender : lenders) {
          Result<model::LeafStages> made = lender.id == snapshot.id
                                               ? Result<model::LeafStages>(of)
                                               : model::computeStages(lender, model::Stage::Superpixels, progress);
          if (!made) return Error{lender.name.toStdString() + ": " + made.error().message, made.error().cancelled};
          examples.push_back(std::move(*made));
          done += 1;
        }
        examples = model::lendersOf(of, std::move(examples));
        std::vector<model::Variant> variants;
        for (int i = 0; i < count; ++i) {
          progress.report(done / parts);
          if (progress.cancelled()) return Error{"cancelled", true};
          const quint64 mine = seed + 1 + quint64(i);
          Result<model::Variant> variant = model::makeVariant(of, examples, mine, progress);
          if (!variant) return variant.error();
          variants.push_back(std::move(*variant));
          done += 1;
        }
        return variants;
      },
      [this, id](std::vector<model::Variant> made) {
        const Leaf* now = document_.project().leaf(id);
        if (!now) return;
        const int added = int(made.size());
        std::vector<model::Variant> variants = now->variants;
        for (model::Variant& variant : made) variants.push_back(std::move(variant));
        document_.setLeaf(id, &Leaf::variants, variants, Aspect::LeafVariants, tr("Make %n variants", nullptr, added));
      });
  connect(job, &model::Job::finished, this, [this] { emit variantsChanged(false); });
}

void LeafJobs::loadVeins(const QString& path, AssetId id) {
  const Leaf* leaf = document_.project().leaf(id);
  if (!leaf) return;
  Leaf snapshot = *leaf;
  snapshot.variants.clear();
  jobs_.start<model::Veins>(
      tr("Reading veins of %1").arg(QFileInfo(path).fileName()), QStringLiteral("veins"),
      [snapshot = std::move(snapshot), path](model::Progress& progress) -> Result<model::Veins> {
        Result<model::SourceFile> source = model::readSourceFile(path);
        if (!source) return source.error();
        const Result<QImage> picture = model::readPhoto(*source);
        if (!picture) return picture.error();
        const Result<model::LeafStages> stages = model::computeStages(snapshot, model::Stage::Contour, progress);
        if (!stages) return stages.error();
        if (picture->size() != stages->photo.size()) {
          return Error{tr("%1×%2 pixels where the photo has %3×%4")
                           .arg(picture->width())
                           .arg(picture->height())
                           .arg(stages->photo.width())
                           .arg(stages->photo.height())
                           .toStdString()};
        }
        model::Veins veins = model::readVeinPicture(*picture, {stages->root, stages->tip, stages->petiole});
        if (veins.empty()) return Error{tr("no line in it").toStdString()};
        return veins;
      },
      [this, id](const model::Veins& veins) {
        document_.setLeaf(id, &Leaf::veins, veins, Aspect::LeafVeins, tr("Load veins"));
      });
}

void LeafJobs::splitLeaves(AssetId id, const QImage& mask) {
  const Leaf* leaf = document_.project().leaf(id);
  if (!leaf || mask.isNull()) return;
  jobs_.start<std::vector<QImage>>(
      tr("Looking for leaves in %1").arg(leaf->name), QStringLiteral("split"),
      [photo = leaf->photo, mask](model::Progress&) -> Result<std::vector<QImage>> {
        const Result<QImage> picture = model::readPhoto(photo);
        if (!picture) return picture.error();
        return model::separateLeaves(*picture, mask);
      },
      [this, id](const std::vector<QImage>& masks) {
        const Leaf* now = document_.project().leaf(id);
        if (!now) return;
        if (masks.size() < 2) return emit message(tr("There is one leaf in this photo."), false);
        const Leaf first = *now;
        document_.undoStack().beginMacro(tr("Separate %n leaves", nullptr, int(masks.size())));
        document_.paintMask(id, masks.front(), {}, tr("Separate leaves"));
        for (size_t i = 1; i < masks.size(); ++i) {
          Leaf another;
          another.name = first.name;
          another.photo = first.photo;
          another.mask = masks[i];
          another.ruler = first.ruler;
          another.bladeLength = first.bladeLength;
          another.parameters = first.parameters;
          document_.addLeaf(std::move(another));
        }
        document_.undoStack().endMacro();
        emit message(tr("%n leaves stand in the asset list now.", nullptr, int(masks.size())), false);
      });
}

void LeafJobs::offerSplit(AssetId id) {
  const Leaf* leaf = document_.project().leaf(id);
  if (!leaf || !leaf->mask.isNull()) return;
  jobs_.start<int>(
      tr("Looking for leaves in %1").arg(leaf->name), QStringLiteral("offer-split"),
      [photo = leaf->photo](model::Progress& progress) -> Result<int> {
        const Result<QImage> picture = model::readPhoto(photo);
        if (!picture) return picture.error();
        const Result<QImage> mask = model::automaticMask(*picture, {}, progress);
        // What is wrong with it is said where it is looked at.
        if (!mask) return 0;
        return static_cast<int>(model::separateLeaves(*picture, *mask).size());
      },
      [this](int count) {
        if (count < 2) return;
        emit message(
            tr("This photo shows %n leaves: Leaf › Separate Several Leaves makes an asset of each.", nullptr, count),
            false);
      });
}

void LeafJobs::exportAtlas(const QString& path) {
  const model::Exporter* exporter = model::findExporter(QStringLiteral("atlas"));
  if (!exporter) return;
  jobs_.start<QString>(
      tr("Exporting %1").arg(QFileInfo(path).fileName()), QStringLiteral("atlas"),
      [project = document_.project(), exporter, path](model::Progress& progress) -> Result<QString> {
        const Status written = exporter->write(project, {}, path, {}, progress);
        if (!written) return written.error();
        return path;
      },
      [this](const QString& written) { emit message(tr("Atlas written to %1").arg(written), false); });
}

}  // namespace windfall::widgets
