// What is known of each link of a plant, as numbers to be shown in colours.
#pragma once

#include <QString>
#include <vector>

#include "model/plant/bodies.h"

namespace windfall::model {

enum class PlantData { None, Water, Energy, Wood, Order, Chain, Radius, Stress };

/// Values of the links, in their order; NaN where nothing is known.
struct LinkData {
  std::vector<float> values;
  double low = 0, high = 1;  ///< of the scale
  QString unit;
  bool named = false;  ///< numbers that are names (chains): no scale
  bool known = false;  ///< at least one value
};

/// `pose`: each link's matrix from rest to now, for stress; empty: at rest.
LinkData linkData(PlantData what, const PlantGeometry& geometry, const PlantBodies& bodies, const sim::Tree& tree,
                  const std::vector<mat4>& pose);

/// Bending stress at a link's surface in Pa: E theta r / L with theta the turn against its parent
/// (tree_dynamics.md, 2.5).
std::vector<float> bendingStress(const sim::Tree& tree, const std::vector<mat4>& pose);

/// sRGB, 0xAABBGGRR; alpha 0 for NaN. Scales: brown to blue for water, black to yellow for energy and stress, green to
/// brown for wood, violet to yellow else.
std::uint32_t dataColor(PlantData what, const LinkData& data, float value);

}  // namespace windfall::model
