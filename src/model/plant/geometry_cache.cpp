#include "model/plant/geometry_cache.h"

#include <algorithm>

#include "model/plant/import.h"

namespace windfall::model {

namespace {

/// What is left out here can never change a shape; a new field counts as one that can.
Plant shapeOf(const Plant& plant) {
  Plant shape = plant;
  shape.id = {};
  shape.name.clear();
  shape.edits.clear();
  shape.clips.clear();
  shape.leaves.clear();
  shape.leafDensity = 1;
  return shape;
}

}  // namespace

std::shared_ptr<const PlantGeometry> GeometryCache::find(const Plant& shape, WoodMesh wood) {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
    return (entry.geometry->wood == WoodMesh::Whole || wood == WoodMesh::Left) && entry.shape == shape;
  });
  if (found == entries_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found);
  return found->geometry;
}

Result<std::shared_ptr<const PlantGeometry>> GeometryCache::load(const Plant& plant, Progress& progress,
                                                                 WoodMesh wood) {
  Plant shape = shapeOf(plant);
  if (auto kept = find(shape, wood)) return kept;
  Result<PlantGeometry> made = loadGeometry(plant, progress, wood);
  if (!made) return made.error();
  auto geometry = std::make_shared<const PlantGeometry>(std::move(*made));
  const std::lock_guard lock(mutex_);
  entries_.push_front({std::move(shape), geometry});
  if (entries_.size() > limit_) entries_.pop_back();
  return geometry;
}

}  // namespace windfall::model
