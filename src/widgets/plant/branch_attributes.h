// The attributes of the chosen branches: what was measured, and what can be tuned.
#pragma once

#include <functional>
#include <vector>

#include "model/document/document.h"
#include "model/scene/assemble.h"
#include "widgets/fields/field_panel.h"

class QLabel;
class QPushButton;
class QTimer;

namespace windfall::widgets {

class InfoField;
class NumberField;
struct NumberSpec;

/// Edits all chosen links at once, undoable; values that differ show as mixed.
class BranchAttributes : public QObject {
  Q_OBJECT
 public:
  /// Adds its groups to `panel`.
  BranchAttributes(model::Document& document, FieldPanel& panel, QObject* parent = nullptr);

  /// `tree` as simulated now; `links` are chosen.
  void show(model::AssetId plant, const model::LoadedPlant& loaded, std::shared_ptr<const sim::Tree> tree,
            std::vector<std::size_t> links, std::size_t branches);

  /// The values of the first chosen link to the clipboard, as text; and from there to all that are chosen.
  void copy() const;
  void paste();
  /// Pins what is chosen, or lets it go where all of it is pinned.
  void togglePinned();

 private:
  using Get = std::function<double(const model::LinkAttributes&)>;
  using Set = std::function<void(model::LinkAttributes&, double)>;
  void number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
              const QString& toolTip, Get get, Set set);
  void edit(const std::function<void(model::LinkAttributes&)>& change, const QString& text, const QString& merge);
  const QString& boneName(std::size_t link) const;
  void showMeasures(std::size_t branches);
  void addPinned(FieldGroup* group);
  void addAdvanced();
  void showFrequency();

  model::Document& document_;
  FieldPanel& panel_;
  QLabel* nothing_;
  std::vector<FieldGroup*> groups_;
  InfoField* frequency_ = nullptr;
  QTimer* frequencyTimer_;
  InfoField *what_, *length_, *radius_, *order_, *wood_, *leafMass_, *leafCount_, *leafArea_;
  QPushButton* resetAll_;
  std::vector<std::function<void(const std::vector<model::LinkAttributes>&)>> shows_;
  model::AssetId plant_;
  model::LoadedPlant loaded_;
  std::shared_ptr<const sim::Tree> tree_;
  std::vector<std::size_t> links_;
};

}  // namespace windfall::widgets
