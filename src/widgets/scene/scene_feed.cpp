#include "widgets/scene/scene_feed.h"

#include <QPointer>
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "model/plant/live_edits.h"
#include "widgets/viewport/scene_content.h"
#include "widgets/viewport/scene_view.h"

namespace windfall::widgets {
namespace {

constexpr double kDegrees = std::numbers::pi / 180;

sim::Placement toPlacement(const model::TreePlacement& tree) {
  return {{tree.position.x(), tree.position.y(), tree.position.z()}, static_cast<float>(tree.heading * kDegrees)};
}

}  // namespace

SceneFeed::SceneFeed(const WorkspaceContext& context, SimulationController& controller, const QString& slot,
                     Source source, QObject* parent)
    : QObject(parent),
      document_(context.document),
      jobs_(context.jobs),
      shapes_(context.shapes),
      controller_(controller),
      slot_(slot),
      source_(std::move(source)) {}

void SceneFeed::rebuild(bool restore) {
  restore_ = restore || (job_ && restore_);
  const std::optional<model::Project> project = source_();
  if (project) looks_ = looksOf(*project), adaptive_ = project->scene.detail.adaptive;
  if (!project || project->scene.trees.empty()) {
    assembly_.reset();
    placements_.clear();
    capsules_.clear();
    spans_.clear();
    if (job_) job_->cancel();
    job_ = nullptr;
    controller_.clear();
    if (project) passSettings(*project);
    emit assembled();
    return;
  }
  model::Job* job = jobs_.start<std::shared_ptr<Assembly>>(
      tr("Preparing the scene"), slot_,
      [project = *project, shapes = shapes_](model::Progress& progress) -> Result<std::shared_ptr<Assembly>> {
        Result<model::SceneAssembly> scene = model::assembleScene(project, progress, shapes.get());
        if (!scene) return scene.error();
        auto assembly = std::make_shared<Assembly>();
        assembly->scene = std::move(*scene);
        assembly->content = std::make_shared<render::SceneContent>(makeContent(assembly->scene, project.scene, 0));
        // They are in the content now.
        for (model::LeafTexture& texture : assembly->scene.leafTextures) texture.maps = {};
        return assembly;
      },
      [self = QPointer<SceneFeed>(this), project = *project](std::shared_ptr<Assembly> assembly) {
        if (self) self->take(std::move(assembly), project, self->restore_);
      });
  job_ = job;
  connect(job, &model::Job::finished, this, [this, job] {
    if (job_ == job) job_ = nullptr;
  });
}

void SceneFeed::take(std::shared_ptr<Assembly> assembly, const model::Project& project, bool restore) {
  const std::vector<int> kept = restore ? std::vector<int>() : keptTrees(assembly->scene, project);
  assembly_ = std::move(assembly);
  placements_ = project.scene.trees;
  restore_ = false;
  capsules_.clear();
  spans_.clear();
  for (std::size_t i = 0; i < assembly_->scene.trees.size(); ++i) {
    const auto capsules = capsulesOf(*assembly_->scene.sim.trees[i].tree);
    spans_.push_back({assembly_->scene.trees[i], capsules_.size(), capsules.size()});
    capsules_.insert(capsules_.end(), capsules.begin(), capsules.end());
  }
  controller_.setScene(assembly_->scene.sim, assembly_->content, restore ? project.simulation.bytes : QByteArray(),
                       false, kept);
  // While the job ran the document may have moved on.
  if (const std::optional<model::Project> now = source_()) {
    for (const auto& [plant, loaded] : assembly_->scene.plants) {
      const model::Plant *before = project.plant(plant), *after = now->plant(plant);
      if (before && after && before->edits != after->edits) passTrees(plant);
    }
    if (movesOnly(*now) && now->scene.trees != placements_) place(*now);
    passSettings(*now);
  }
  emit assembled();
}

/// For each tree of a scene the one of the scene before that it is: same plant, same shape. Empty where none is.
std::vector<int> SceneFeed::keptTrees(const model::SceneAssembly& scene, const model::Project& project) const {
  std::vector<int> kept;
  bool any = false;
  for (std::size_t i = 0; assembly_ && i < scene.trees.size(); ++i) {
    const model::TreePlacement* tree = project.tree(scene.trees[i]);
    const auto old = std::find_if(placements_.begin(), placements_.end(), [&](const model::TreePlacement& before) {
      return tree != nullptr && before.id == tree->id && before.plant == tree->plant && before.scale == tree->scale;
    });
    int from = -1;
    if (old != placements_.end()) {
      const auto& trees = assembly_->scene.trees;
      const auto at = std::find(trees.begin(), trees.end(), old->id);
      const auto shapeIn = [&](const model::SceneAssembly& which) {
        const auto plant = which.plants.find(old->plant);
        return plant == which.plants.end() ? nullptr : plant->second.geometry;
      };
      const bool same = at != trees.end() && shapeIn(scene) && shapeIn(scene) == shapeIn(assembly_->scene);
      if (same) from = static_cast<int>(at - trees.begin());
    }
    any = any || from >= 0;
    kept.push_back(from);
  }
  return any ? kept : std::vector<int>();
}

bool SceneFeed::follow(const model::Change& change) {
  const std::optional<model::Project> project = source_();
  switch (change.aspect) {
    case model::Aspect::Everything:
      rebuild(true);
      return true;
    case model::Aspect::Assets:
    case model::Aspect::PlantSource:
    case model::Aspect::PlantLeaves:
      rebuild(false);
      return true;
    case model::Aspect::LeafVariants:
      if (!usesLeaf(change.asset)) return false;
      rebuild(false);
      return true;
    case model::Aspect::LeafParameters:
      // Only what changes the look of the textures; the simulation goes on where it was left.
      if (!project || !usesLeaf(change.asset) || looksOf(*project) == looks_) return false;
      rebuild(true);
      return true;
    case model::Aspect::SceneTrees:
      if (project && assembly_ && !job_ && movesOnly(*project)) {
        place(*project);
      } else {
        rebuild(false);
      }
      return true;
    case model::Aspect::PlantEdits:
      passTrees(change.asset);
      return true;
    case model::Aspect::Wind:
      if (project) controller_.setWind(project->scene.wind);
      return true;
    case model::Aspect::FallingLeaves:
      if (project) controller_.setLeaves(leavesOf(*project));
      return true;
    case model::Aspect::Solver:
      if (assembly_ && project) {
        assembly_->scene.sim.solver = project->scene.solver;
        controller_.setScene(assembly_->scene.sim, nullptr, {}, true);
      }
      return true;
    case model::Aspect::Light:
      if (project && project->scene.detail.adaptive != adaptive_) {
        // What adaptive wood stands for is not uploaded beside it.
        rebuild(true);
        return true;
      }
      if (project) passLook(project->scene);
      return true;
    default:
      return false;
  }
}

bool SceneFeed::usesLeaf(model::AssetId leaf) const {
  const std::optional<model::Project> project = source_();
  return project && std::any_of(project->plants.begin(), project->plants.end(), [&](const model::Plant& plant) {
           return std::find(plant.leaves.begin(), plant.leaves.end(), leaf) != plant.leaves.end();
         });
}

SceneFeed::Looks SceneFeed::looksOf(const model::Project& project) {
  Looks looks;
  for (const model::Leaf& leaf : project.leaves) {
    looks.emplace_back(leaf.parameters.maps, leaf.parameters.ageing);
  }
  return looks;
}

bool SceneFeed::movesOnly(const model::Project& project) const {
  return std::equal(project.scene.trees.begin(), project.scene.trees.end(), placements_.begin(), placements_.end(),
                    [](const model::TreePlacement& a, const model::TreePlacement& b) {
                      return a.id == b.id && a.plant == b.plant && a.scale == b.scale;
                    });
}

void SceneFeed::place(const model::Project& project) {
  bool moved = false;
  for (std::size_t i = 0; i < assembly_->scene.trees.size(); ++i) {
    const model::TreePlacement* tree = project.tree(assembly_->scene.trees[i]);
    if (tree == nullptr) continue;
    sim::Placement& placement = assembly_->scene.sim.trees[i].placement;
    const sim::Placement wanted = toPlacement(*tree);
    moved = moved || wanted.position != placement.position || wanted.heading != placement.heading;
    placement = wanted;
  }
  placements_ = project.scene.trees;
  if (moved) controller_.setScene(assembly_->scene.sim, nullptr, {}, true);
}

void SceneFeed::passTrees(model::AssetId plant) {
  const std::optional<model::Project> project = source_();
  if (!assembly_ || !project) return;
  const auto loaded = assembly_->scene.plants.find(plant);
  const model::Plant* edited = project->plant(plant);
  if (loaded == assembly_->scene.plants.end() || edited == nullptr) return;
  for (std::size_t i = 0; i < assembly_->scene.trees.size(); ++i) {
    const model::TreePlacement* tree = project->tree(assembly_->scene.trees[i]);
    if (tree == nullptr || tree->plant != plant) continue;
    auto& instance = assembly_->scene.sim.trees[i];
    instance.tree = model::withEdits(*instance.tree, *loaded->second.geometry, *loaded->second.bodies, edited->edits);
    controller_.setTree(i, instance.tree);
  }
}

sim::LeafSettings SceneFeed::leavesOf(const model::Project& project) const {
  sim::LeafSettings leaves = project.scene.leaves;
  if (leaves.count == model::kEveryLeaf && assembly_) {
    leaves.count = model::everyLeaf(assembly_->scene.sim.trees, leaves);
  }
  return leaves;
}

void SceneFeed::passLook(const model::Scene& scene) {
  controller_.setView(sunDirection(scene.light), static_cast<float>(scene.light.strength));
  controller_.setDetail(static_cast<float>(scene.detail.tolerance),
                        scene.detail.cards ? static_cast<float>(scene.detail.cardsBelow) : 0);
}

void SceneFeed::passSettings(const model::Project& project) {
  const model::Scene& scene = project.scene;
  passLook(scene);
  if (!assembly_) return;
  if (scene.wind != assembly_->scene.sim.wind) controller_.setWind(scene.wind);
  if (const sim::LeafSettings leaves = leavesOf(project); leaves != assembly_->scene.sim.leaves)
    controller_.setLeaves(leaves);
}

std::vector<mat4> SceneFeed::restPose() const {
  std::vector<mat4> pose;
  pose.reserve(capsules_.size());
  for (std::size_t i = 0; i < spans_.size(); ++i) {
    const sim::Placement& placement = assembly_->scene.sim.trees[i].placement;
    const mat4 matrix = glm::rotate(glm::translate(mat4(1), placement.position), placement.heading, vec3(0, 1, 0));
    pose.insert(pose.end(), spans_[i].linkCount, matrix);
  }
  return pose;
}

std::vector<std::uint32_t> SceneFeed::linksOf(const std::vector<model::AssetId>& trees) const {
  std::vector<std::uint32_t> links;
  for (const TreeSpan& span : spans_) {
    if (std::find(trees.begin(), trees.end(), span.tree) == trees.end()) continue;
    for (std::size_t i = 0; i < span.linkCount; ++i) links.push_back(static_cast<std::uint32_t>(span.firstLink + i));
  }
  return links;
}

}  // namespace windfall::widgets
