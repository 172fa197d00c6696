// Shaping a grown plant by hand: the tools' host, their actions, the library of parts.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QObject>
#include <functional>
#include <memory>
#include <vector>

#include "model/plant/grow/part_library.h"
#include "widgets/fields/field_panel.h"
#include "widgets/scene/scene_feed.h"
#include "widgets/tools/shape_tools.h"

namespace windfall::widgets {

class ChoiceField;
class InfoField;
class Viewport;

class PlantShaping : public QObject, public ShapeToolHost {
  Q_OBJECT
 public:
  /// What it needs of its workspace.
  struct Surroundings {
    model::Document& document;
    Viewport& viewport;
    SceneFeed& feed;
    SimulationController& controller;
    std::function<model::AssetId()> plant;
    std::function<model::LoadedPlant()> loaded;
    std::function<std::vector<std::size_t>()> chosenLinks;
  };
  /// `select` and its tool join the exclusive group; the parts' group goes into `panel`.
  PlantShaping(const Surroundings& around, QAction* select, ViewportTool& selectTool, FieldPanel& panel,
               QObject* parent = nullptr);

  /// The tools' actions, without `select`.
  QList<QAction*> actions() const { return actions_; }
  void show();
  /// Where parts are kept; tests use a folder of their own.
  void setPartFolder(const QString& folder);
  /// Keeps the chosen branch, with all that it carries, in the library.
  void keepPart();
  const model::PartLibrary& library() const { return library_; }

  model::Document& document() override { return around_.document; }
  model::AssetId plant() const override { return around_.plant(); }
  const model::PlantGeometry* shapeable() override;
  std::optional<PickedBone> boneAt(const ViewportEvent& event) override;
  void highlight(const std::vector<std::size_t>& bones) override;
  const model::PlantPart* part() const override;

 signals:
  void message(const QString& text, bool isError);
  void status(const QString& text);

 private:
  void listParts();

  Surroundings around_;
  std::vector<std::unique_ptr<ShapeTool>> tools_;
  QAction* select_;     ///< what a tool falls back to
  QActionGroup group_;  ///< until the window puts the tools of all kinds into one
  QList<QAction*> actions_;
  model::PartLibrary library_;
  model::LoadedPlant held_;  ///< what shapeable() handed out
  FieldGroup* parts_;
  ChoiceField* choice_;
  InfoField* count_;
};

}  // namespace windfall::widgets
