// The property edits of Document: one template serves them all.
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "model/document/command.h"
#include "model/document/document.h"

namespace windfall::model {

/// The thing that `id` names, or null; the scene is the only one of its kind.
template <class Owner>
Owner* findOwner(Project& project, AssetId id) {
  if constexpr (std::same_as<Owner, Leaf>) {
    return project.leaf(id);
  } else if constexpr (std::same_as<Owner, Plant>) {
    return project.plant(id);
  } else if constexpr (std::same_as<Owner, TreePlacement>) {
    return project.tree(id);
  } else if constexpr (std::same_as<Owner, Project>) {
    return &project;
  } else {
    static_assert(std::same_as<Owner, Scene>);
    return &project.scene;
  }
}

/// Sets one member of one thing. Steps of a drag (same thing, member and non-empty key) merge into one, and one that
/// comes back to its start drops out of the history.
template <class Owner, class T>
class SetProperty : public DocumentCommand {
 public:
  SetProperty(Document& document, AssetId id, T Owner::*member, T before, T after, Aspect aspect, const QString& text,
              const QString& merge)
      : DocumentCommand(document, text),
        id_(id),
        member_(member),
        before_(std::move(before)),
        after_(std::move(after)),
        aspect_(aspect),
        merge_(merge) {}

  void redo() override { assign(after_); }
  void undo() override { assign(before_); }
  int id() const override { return merge_.isEmpty() ? -1 : kMergeable; }

  bool mergeWith(const QUndoCommand* other) override {
    const auto* next = dynamic_cast<const SetProperty*>(other);
    if (!next || next->id_ != id_ || next->member_ != member_ || next->merge_ != merge_) return false;
    after_ = next->after_;
    setObsolete(after_ == before_);
    return true;
  }

 private:
  // QUndoStack asks mergeWith only where the ids are equal; the rest is compared there.
  static constexpr int kMergeable = 1;

  void assign(const T& value) {
    Owner* owner = findOwner<Owner>(project(), id_);
    if (!owner) return;
    owner->*member_ = value;
    announce({id_, aspect_, {}});
  }

  AssetId id_;
  T Owner::*member_;
  T before_, after_;
  Aspect aspect_;
  QString merge_;
};

template <class Owner, class T>
void Document::setProperty(AssetId id, T Owner::*member, T value, Aspect aspect, const QString& text,
                           const QString& merge) {
  const Owner* owner = findOwner<Owner>(project_, id);
  if (!owner) return;
  // References that lead nowhere must never enter the project: its file could not be read back.
  if constexpr (std::same_as<T, std::vector<AssetId>>) {
    std::erase_if(value, [this](AssetId leaf) { return !project_.leaf(leaf); });
  } else if constexpr (std::same_as<T, AssetId>) {
    if (!project_.plant(value)) return;
  }
  if (owner->*member == value) return;
  undo_.push(new SetProperty<Owner, T>(*this, id, member, owner->*member, std::move(value), aspect, text, merge));
}

template <class T>
void Document::setLeaf(AssetId id, T Leaf::*member, T value, Aspect aspect, const QString& text, const QString& merge) {
  setProperty<Leaf, T>(id, member, std::move(value), aspect, text, merge);
}

template <class T>
void Document::setPlant(AssetId id, T Plant::*member, T value, Aspect aspect, const QString& text,
                        const QString& merge) {
  setProperty<Plant, T>(id, member, std::move(value), aspect, text, merge);
}

template <class T>
void Document::setTree(AssetId id, T TreePlacement::*member, T value, const QString& text, const QString& merge) {
  setProperty<TreePlacement, T>(id, member, std::move(value), Aspect::SceneTrees, text, merge);
}

template <class T>
void Document::setScene(T Scene::*member, T value, Aspect aspect, const QString& text, const QString& merge) {
  setProperty<Scene, T>(AssetId{}, member, std::move(value), aspect, text, merge);
}

}  // namespace windfall::model
