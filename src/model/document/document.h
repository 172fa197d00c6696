// A project being edited: its values, its undo history, one signal for every change.
#pragma once

#include <QObject>
#include <QString>
#include <QUndoStack>

#include "model/document/change.h"
#include "model/document/project.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// Reading is const; every change is a command on the undo stack, but for what is no edit (setView, setSimulation).
/// A call that names an id which does not exist does nothing. Lives on the GUI thread.
class Document : public QObject {
  Q_OBJECT
 public:
  explicit Document(QObject* parent = nullptr);
  ~Document() override;

  const Project& project() const { return project_; }
  QUndoStack& undoStack() { return undo_; }
  const QUndoStack& undoStack() const { return undo_; }
  bool isModified() const { return !undo_.isClean(); }
  /// Empty until saved or opened.
  QString path() const { return path_; }

  /// Replaces the project; the undo history starts anew.
  void open(Project project, const QString& path);
  /// Reads and opens; on error nothing changes.
  Status load(const QString& path, Progress& progress);
  Status save(const QString& path, Progress& progress);
  /// Saving in the background: a job writes a copy of the project, then says which revision went where. The document is
  /// clean only if nothing was edited meanwhile.
  void markSaved(const QString& path, quint64 revision);
  /// Counts edits, undone and redone ones too; equal revisions mean equal projects but for view and simulation.
  quint64 revision() const { return revision_; }

  /// Property edits. Consecutive edits with the same non-empty `merge` key become one undo step; an edit that ends
  /// where it began drops out.
  template <class T>
  void setLeaf(AssetId id, T Leaf::*member, T value, Aspect aspect, const QString& text, const QString& merge = {});
  template <class T>
  void setPlant(AssetId id, T Plant::*member, T value, Aspect aspect, const QString& text, const QString& merge = {});
  template <class T>
  void setTree(AssetId id, T TreePlacement::*member, T value, const QString& text, const QString& merge = {});
  template <class T>
  void setScene(T Scene::*member, T value, Aspect aspect, const QString& text, const QString& merge = {});

  void setAtlas(const AtlasSettings& settings, const QString& text, const QString& merge = {});

  /// A brush stroke: `after` becomes the leaf's mask. Only 64 px tiles that differ are kept, searched inside `dirty`
  /// (empty: everywhere); the first stroke on an automatic mask keeps the whole picture.
  void paintMask(AssetId leaf, const QImage& after, QRect dirty, const QString& text);

  /// Assets; each is one undo step and returns the new id, 0 where it cannot be (a tree of no plant). Names are made
  /// unique among their kind ("Oak", "Oak 2"); ids are never used again, not even after undo. The argument's own id is
  /// ignored. A duplicate stands behind its original and equals it but for id and name.
  AssetId addLeaf(Leaf leaf);
  AssetId addPlant(Plant plant);
  AssetId addTree(TreePlacement tree);
  AssetId duplicate(AssetId asset);
  void rename(AssetId asset, const QString& name);
  /// Removes a leaf, a plant (and its trees) or a tree; references to it are removed with it.
  void remove(AssetId asset);

  /// Not edits: saved with the project, no undo step, no modified mark.
  void setView(const ViewState& view);
  void setSimulation(const SimulationState& state);

 signals:
  void changed(const windfall::model::Change& change);
  void modifiedChanged(bool modified);

 private:
  friend class DocumentCommand;
  template <class Owner, class T>
  void setProperty(AssetId id, T Owner::*member, T value, Aspect aspect, const QString& text, const QString& merge);
  template <class T>
  AssetId insert(T asset, qsizetype place);
  AssetId takeId();

  Project project_;
  quint64 highestId_ = 0;  ///< ever given out here; undoing an addition lowers project_.nextId again
  QUndoStack undo_;
  QString path_;
  quint64 revision_ = 0;
};

}  // namespace windfall::model

#include "model/document/set_property.h"
