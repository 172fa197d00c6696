// Plants that were read or grown, kept while edits that leave their shape alone go on.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "model/plant/geometry.h"
#include "model/plant/plant.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// The last few shapes, by all of a plant's fields but those that never change its shape (names, link edits, leaves
/// hung on it). Safe to share between threads; two that ask for one shape at once may both make it.
class GeometryCache {
 public:
  explicit GeometryCache(std::size_t limit = 16) : limit_(limit) {}

  /// The kept shape, or `loadGeometry`'s. One with all its wood serves where none is needed. An error is not kept.
  Result<std::shared_ptr<const PlantGeometry>> load(const Plant& plant, Progress& progress,
                                                    WoodMesh wood = WoodMesh::Whole);

 private:
  struct Entry {
    Plant shape;
    std::shared_ptr<const PlantGeometry> geometry;
  };
  std::shared_ptr<const PlantGeometry> find(const Plant& shape, WoodMesh wood);

  std::size_t limit_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< newest first
};

}  // namespace windfall::model
