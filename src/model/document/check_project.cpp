#include <QBuffer>
#include <QImageReader>
#include <set>

#include "model/document/project_json.h"

namespace windfall::model {

namespace {

/// Size that the photo's header claims, turned as EXIF says; invalid where it can't be read.
QSize photoSize(const SourceFile& photo) {
  QBuffer buffer;
  buffer.setData(photo.bytes);
  buffer.open(QIODevice::ReadOnly);
  QImageReader reader(&buffer);
  const QSize size = reader.size();
  return reader.transformation().testFlag(QImageIOHandler::TransformationRotate90) ? size.transposed() : size;
}

/// The first vein that is its own ancestor or has no parent where it says so; -1 where all are well.
int strayVein(const Veins& veins) {
  enum : char { Unknown, Walking, Well };
  const int count = static_cast<int>(veins.size());
  std::vector<char> state(veins.size(), Unknown);
  const auto parentOf = [&veins](int vein) { return veins[static_cast<size_t>(vein)].parent; };
  for (int start = 0; start < count; ++start) {
    int vein = start;
    for (; vein != -1; vein = parentOf(vein)) {
      if (vein < 0 || vein >= count || state[static_cast<size_t>(vein)] == Walking) return start;
      if (state[static_cast<size_t>(vein)] == Well) break;
      state[static_cast<size_t>(vein)] = Walking;
    }
    for (int walked = start; walked != vein; walked = parentOf(walked)) state[static_cast<size_t>(walked)] = Well;
  }
  return -1;
}

QString pixels(QSize size) { return QStringLiteral("%1 × %2 px").arg(size.width()).arg(size.height()); }

QString checkLeaf(const Leaf& leaf, const QString& place) {
  if (const int vein = strayVein(leaf.veins); vein >= 0) {
    return QStringLiteral("%1.veins[%2].parent: leads nowhere").arg(place).arg(vein);
  }
  if (leaf.ruler.from.has_value() != leaf.ruler.to.has_value()) {
    return QStringLiteral("%1.ruler: has only one end").arg(place);
  }
  if (leaf.mask.isNull() || leaf.photo.isEmpty()) return {};
  const QSize photo = photoSize(leaf.photo);
  if (!photo.isValid() || photo == leaf.mask.size()) return {};
  return QStringLiteral("%1.mask: is %2, its photo %3").arg(place, pixels(leaf.mask.size()), pixels(photo));
}

}  // namespace

QString checkProject(const Project& project) {
  std::set<AssetId> seen, leaves, plants;
  QString wrong;
  const auto checkId = [&](AssetId id, const QString& place) {
    if (!wrong.isEmpty()) return;
    if (!id) wrong = place + QStringLiteral(".id: is missing");
    if (id.value >= project.nextId) {
      wrong = place + QStringLiteral(".id: is %1, not below nextId (%2)").arg(id.value).arg(project.nextId);
    }
    if (!seen.insert(id).second) wrong = place + QStringLiteral(".id: %1 is there twice").arg(id.value);
  };
  for (size_t i = 0; i < project.leaves.size(); ++i) {
    const QString place = QStringLiteral("leaves[%1]").arg(i);
    leaves.insert(project.leaves[i].id);
    checkId(project.leaves[i].id, place);
    if (wrong.isEmpty()) wrong = checkLeaf(project.leaves[i], place);
  }
  for (size_t i = 0; i < project.leaves.size(); ++i) {
    const auto known = [&](AssetId example, const char* list) {
      if (!wrong.isEmpty() || !example || leaves.contains(example)) return;
      wrong = QStringLiteral("leaves[%1].%2: there is no leaf %3").arg(i).arg(QLatin1String(list)).arg(example.value);
    };
    for (const AssetId example : project.leaves[i].examples) known(example, "examples");
    for (const RegionPair& pair : project.leaves[i].regionPairs) known(pair.example, "regionPairs");
  }
  for (size_t i = 0; i < project.plants.size(); ++i) {
    const QString place = QStringLiteral("plants[%1]").arg(i);
    plants.insert(project.plants[i].id);
    checkId(project.plants[i].id, place);
    for (const AssetId leaf : project.plants[i].leaves) {
      if (wrong.isEmpty() && !leaves.contains(leaf)) {
        wrong = place + QStringLiteral(".leaves: there is no leaf %1").arg(leaf.value);
      }
    }
  }
  for (size_t i = 0; i < project.scene.trees.size(); ++i) {
    const QString place = QStringLiteral("scene.trees[%1]").arg(i);
    const TreePlacement& tree = project.scene.trees[i];
    checkId(tree.id, place);
    if (wrong.isEmpty() && !plants.contains(tree.plant)) {
      wrong = place + QStringLiteral(".plant: there is no plant %1").arg(tree.plant.value);
    }
  }
  return wrong;
}

}  // namespace windfall::model
