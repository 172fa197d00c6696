// Recorded motions of a plant: baked from the simulation, played, removed.
#pragma once

#include <QObject>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/plant/clip.h"
#include "model/scene/assemble.h"
#include "widgets/fields/field_panel.h"
#include "widgets/scene/simulation_worker.h"

class QPushButton;

namespace windfall::widgets {

class CheckField;
class ChoiceField;
class InfoField;
class NumberField;

class ClipPanel : public QObject {
  Q_OBJECT
 public:
  /// Adds its group to `panel`. `wind` gives that of this workspace's view.
  ClipPanel(model::Document& document, model::JobRunner& jobs, FieldPanel& panel,
            std::function<sim::WindSettings()> wind, QObject* parent = nullptr);

  void show(model::AssetId plant, const model::LoadedPlant& loaded);
  /// The clip that is chosen to be played; null: the simulation.
  std::shared_ptr<const model::Clip> chosen() const;
  /// What the viewport's simulation shows instead, for a clip of this plant.
  static std::shared_ptr<const ClipPlay> play(const std::shared_ptr<const model::Clip>& clip,
                                              const model::LoadedPlant& loaded);
  void bake();
  void remove();

 signals:
  /// Another motion was chosen, or the chosen one changed.
  void chosenChanged();
  void message(const QString& text, bool isError);

 private:
  std::vector<model::Clip> all() const;
  void showChoice();
  void keep(model::AssetId plant, model::Clip clip);

  model::Document& document_;
  model::JobRunner& jobs_;
  std::function<sim::WindSettings()> wind_;
  model::AssetId plant_;
  model::LoadedPlant loaded_;
  QStringList names_;
  QString chosenName_;
  ChoiceField* choice_;
  InfoField* about_;
  NumberField *length_, *rate_, *tolerance_;
  CheckField* loop_;
  QPushButton *bake_, *remove_;
};

}  // namespace windfall::widgets
