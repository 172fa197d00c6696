// Keeps a simulation in step with a document: assembles it as a job, and passes small edits on live.
#pragma once

#include <QObject>
#include <QPointer>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/scene/assemble.h"
#include "widgets/scene/simulation_controller.h"
#include "widgets/viewport/picking.h"
#include "widgets/workspace.h"

namespace windfall::widgets {

/// Which links of the simulation belong to a tree.
struct TreeSpan {
  model::AssetId tree;
  std::size_t firstLink = 0, linkCount = 0;
};

/// `source` gives the project to be simulated: the document's own, or one made of it (a plant alone); nothing where
/// there is nothing to show.
class SceneFeed : public QObject {
  Q_OBJECT
 public:
  using Source = std::function<std::optional<model::Project>()>;
  SceneFeed(const WorkspaceContext& context, SimulationController& controller, const QString& slot, Source source,
            QObject* parent = nullptr);

  /// Assembles anew. `restore`: goes on where the project's simulation stopped; otherwise starts at rest.
  void rebuild(bool restore);
  /// Follows a change of the document; false where it does not concern what is simulated.
  bool follow(const model::Change& change);

  const model::SceneAssembly* assembly() const { return assembly_ ? &assembly_->scene : nullptr; }
  bool isAssembling() const { return job_ != nullptr; }

  /// Of all trees, in the simulation's order.
  const std::vector<LinkCapsule>& capsules() const { return capsules_; }
  const std::vector<TreeSpan>& spans() const { return spans_; }
  /// Every link at rest, in the world.
  std::vector<mat4> restPose() const;
  std::vector<std::uint32_t> linksOf(const std::vector<model::AssetId>& trees) const;

 signals:
  void assembled();

 private:
  struct Assembly {
    model::SceneAssembly scene;
    std::shared_ptr<render::SceneContent> content;
  };
  void take(std::shared_ptr<Assembly> assembly, const model::Project& project, bool restore);
  std::vector<int> keptTrees(const model::SceneAssembly& scene, const model::Project& project) const;
  void passTrees(model::AssetId plant);
  void passLook(const model::Scene& scene);
  void passSettings(const model::Project& project);
  /// A number below 0 stands for as many as the trees have places for.
  sim::LeafSettings leavesOf(const model::Project& project) const;
  bool movesOnly(const model::Project& project) const;
  void place(const model::Project& project);
  bool usesLeaf(model::AssetId leaf) const;
  /// How each leaf's maps and ages are made.
  using Looks = std::vector<std::pair<model::MapParameters, model::AgeingParameters>>;
  static Looks looksOf(const model::Project& project);

  model::Document& document_;
  model::JobRunner& jobs_;
  std::shared_ptr<model::GeometryCache> shapes_;
  SimulationController& controller_;
  QString slot_;
  Source source_;
  std::shared_ptr<Assembly> assembly_;
  std::vector<model::TreePlacement> placements_;  ///< as assembled
  std::vector<LinkCapsule> capsules_;
  std::vector<TreeSpan> spans_;
  QPointer<model::Job> job_;
  bool restore_ = false;
  Looks looks_;           ///< as assembled
  bool adaptive_ = true;  ///< wood, as assembled
};

}  // namespace windfall::widgets
