// Leaves far away in exports: clusters as crossed cards, their pictures painted from the leaves themselves.
#pragma once

#include <QImage>
#include <cstdint>
#include <vector>

#include "model/export/plant_model.h"
#include "sim/leaf_clusters.h"

namespace windfall::model {

/// A cluster in the rest pose, plant space.
struct CardPlace {
  vec3 center{0};
  float radius = 0;  ///< m
  int bone = 0;
  std::vector<std::uint32_t> leaves;
};

/// Places of a tree's clusters without their bones; leaves are numbered as its sites.
std::vector<CardPlace> cardPlaces(const sim::LeafClusters& clusters);

/// Three squares through each cluster's middle, upright along x and z and lying, each with its own part of one
/// picture. Normals lead out of the crown's middle, which lights a card as the crown that it is part of.
LeafCards paintCards(const std::vector<LeafShape>& shapes, const std::vector<PlacedLeaf>& leaves,
                     const std::vector<CardPlace>& places);

}  // namespace windfall::model
