#include "model/document/document.h"

#include <QCoreApplication>
#include <algorithm>

#include "model/document/asset_commands.h"
#include "model/document/mask_command.h"
#include "model/document/names.h"
#include "model/document/project_file.h"

namespace windfall::model {

namespace {

QString say(const char* text) { return QCoreApplication::translate("Document", text); }

/// Words of a kind of asset; QT_TRANSLATE_NOOP lets lupdate find them.
template <class T>
struct Words;
template <>
struct Words<Leaf> {
  static constexpr const char* name = QT_TRANSLATE_NOOP("Document", "Leaf");
  static constexpr const char* add = QT_TRANSLATE_NOOP("Document", "Add leaf “%1”");
};
template <>
struct Words<Plant> {
  static constexpr const char* name = QT_TRANSLATE_NOOP("Document", "Plant");
  static constexpr const char* add = QT_TRANSLATE_NOOP("Document", "Add plant “%1”");
};
template <>
struct Words<TreePlacement> {
  static constexpr const char* name = QT_TRANSLATE_NOOP("Document", "Tree");
  static constexpr const char* add = QT_TRANSLATE_NOOP("Document", "Place tree “%1”");
};

template <class T>
QStringList namesOf(const std::vector<T>& items, AssetId except = {}) {
  QStringList names;
  for (const T& item : items) {
    if (item.id != except) names << item.name;
  }
  return names;
}

}  // namespace

DocumentCommand::DocumentCommand(Document& document, const QString& text) : QUndoCommand(text), document_(document) {}
const Project& DocumentCommand::project() const { return document_.project_; }
Project& DocumentCommand::project() { return document_.project_; }
void DocumentCommand::announce(const Change& change) {
  ++document_.revision_;
  emit document_.changed(change);
}

Document::Document(QObject* parent) : QObject(parent) {
  connect(&undo_, &QUndoStack::cleanChanged, this, [this](bool clean) { emit modifiedChanged(!clean); });
}

// The stack says "clean" when it dies; nobody wants to hear that from a document that is half gone.
Document::~Document() { undo_.disconnect(this); }

void Document::open(Project project, const QString& path) {
  project_ = std::move(project);
  path_ = path;
  highestId_ = project_.nextId - 1;
  ++revision_;
  undo_.clear();
  emit changed({{}, Aspect::Everything, {}});
}

Status Document::load(const QString& path, Progress& progress) {
  Result<Project> read = readProject(path, progress);
  if (!read) return read.error();
  open(std::move(*read), path);
  return ok();
}

Status Document::save(const QString& path, Progress& progress) {
  if (Status written = writeProject(project_, path, progress); !written) return written;
  markSaved(path, revision_);
  return ok();
}

void Document::markSaved(const QString& path, quint64 revision) {
  path_ = path;
  if (revision == revision_) undo_.setClean();
}

void Document::paintMask(AssetId leaf, const QImage& after, QRect dirty, const QString& text) {
  const Leaf* target = project_.leaf(leaf);
  if (!target || after.isNull()) return;
  const QImage gray = after.convertToFormat(QImage::Format_Grayscale8);
  if (target->mask == gray) return;
  auto command = std::make_unique<PaintMask>(*this, leaf, gray, dirty, text);
  if (!command->isEmpty()) undo_.push(command.release());
}

AssetId Document::takeId() {
  highestId_ = std::max(highestId_ + 1, project_.nextId);
  return {highestId_};
}

template <class T>
AssetId Document::insert(T asset, qsizetype place) {
  asset.id = takeId();
  asset.name = uniqueName(asset.name, namesOf(assetsOf<T>(project_)), say(Words<T>::name));
  const QString text = say(Words<T>::add).arg(asset.name);
  const AssetId id = asset.id;
  undo_.push(new AddAsset<T>(*this, std::move(asset), place, id.value + 1, text));
  return id;
}

AssetId Document::addLeaf(Leaf leaf) {
  std::erase_if(leaf.examples, [this](AssetId example) { return !project_.leaf(example); });
  std::erase_if(leaf.regionPairs,
                [this](const RegionPair& pair) { return pair.example && !project_.leaf(pair.example); });
  return insert(std::move(leaf), qsizetype(project_.leaves.size()));
}

AssetId Document::addPlant(Plant plant) {
  std::erase_if(plant.leaves, [this](AssetId leaf) { return !project_.leaf(leaf); });
  return insert(std::move(plant), qsizetype(project_.plants.size()));
}

AssetId Document::addTree(TreePlacement tree) {
  if (!project_.plant(tree.plant)) return {};
  return insert(std::move(tree), qsizetype(project_.scene.trees.size()));
}

AssetId Document::duplicate(AssetId asset) {
  if (const Leaf* leaf = project_.leaf(asset)) return insert(Leaf(*leaf), leaf - project_.leaves.data() + 1);
  if (const Plant* plant = project_.plant(asset)) return insert(Plant(*plant), plant - project_.plants.data() + 1);
  if (const TreePlacement* tree = project_.tree(asset)) {
    return insert(TreePlacement(*tree), tree - project_.scene.trees.data() + 1);
  }
  return {};
}

void Document::rename(AssetId asset, const QString& name) {
  if (name.simplified().isEmpty()) return;
  const QString text = say(QT_TRANSLATE_NOOP("Document", "Rename to “%1”"));
  const auto renamed = [&]<class T>(T*, std::vector<T>& items) {
    const QString free = uniqueName(name, namesOf(items, asset), say(Words<T>::name));
    setProperty<T, QString>(asset, &T::name, free, Aspect::Assets, text.arg(free), {});
  };
  if (Leaf* leaf = project_.leaf(asset)) renamed(leaf, project_.leaves);
  if (Plant* plant = project_.plant(asset)) renamed(plant, project_.plants);
  if (TreePlacement* tree = project_.tree(asset)) renamed(tree, project_.scene.trees);
}

void Document::remove(AssetId asset) {
  const QString text = say(QT_TRANSLATE_NOOP("Document", "Remove “%1”"));
  if (const Leaf* leaf = project_.leaf(asset)) {
    undo_.push(new RemoveLeaf(*this, asset, text.arg(leaf->name)));
  } else if (const Plant* plant = project_.plant(asset)) {
    std::vector<AssetId> trees;
    for (const TreePlacement& tree : project_.scene.trees) {
      if (tree.plant == asset) trees.push_back(tree.id);
    }
    undo_.push(new RemoveTrees(*this, asset, trees, text.arg(plant->name)));
  } else if (const TreePlacement* tree = project_.tree(asset)) {
    undo_.push(new RemoveTrees(*this, {}, {asset}, text.arg(tree->name)));
  }
}

void Document::setView(const ViewState& view) {
  if (project_.view == view) return;
  project_.view = view;
  emit changed({{}, Aspect::View, {}});
}

void Document::setSimulation(const SimulationState& state) {
  if (project_.simulation == state) return;
  project_.simulation = state;
  emit changed({{}, Aspect::Simulation, {}});
}

void Document::setAtlas(const AtlasSettings& settings, const QString& text, const QString& merge) {
  setProperty<Project, AtlasSettings>({}, &Project::atlas, settings, Aspect::Atlas, text, merge);
}

}  // namespace windfall::model
