// The steps of the grower.
#pragma once

#include <QImage>
#include <string>
#include <vector>

#include "model/plant/geometry.h"
#include "model/plant/plant.h"

namespace windfall::model::grower {

/// An axis in growth: a line of nodes, one bone between two.
struct Axis {
  int parent = -1;           ///< axis that it leaves
  int parentLink = 0;        ///< link of the parent that it leaves
  float parentShare = 0;     ///< where on that link, 0..1
  int order = 0;             ///< 0 trunk
  std::string name;          ///< of its bones, without their number
  std::vector<vec3> nodes;   ///< m
  std::vector<float> radii;  ///< m, a value a node
  int firstBone = 0;
};

/// The axes, parents before children: trunk, limbs at the golden angle, twigs. Radii are left to setRadii.
std::vector<Axis> growAxes(const GrowerSettings& settings);

/// Bones from the axes: one a link, parents before children; their first bones are known.
void addBones(const std::vector<Axis>& axes, PlantGeometry& geometry);

/// Pipe model with taper (growers.md, 5.1): r_p^n = sum of (r_c + tau l_c)^n with n = 2.4, tau such that the trunk's
/// base has `baseRadius`.
void setRadii(std::vector<Axis>& axes, float baseRadius);

/// Point of an axis' smooth curve (centripetal Hermite, plant_meshing.md, 2.1) on a link at a share 0..1.
vec3 curvePoint(const Axis& axis, std::size_t link, float share);
/// Its unit tangent there.
vec3 curveTangent(const Axis& axis, std::size_t link, float share);

/// The surface of the axes (skeleton_geometry.h), bound to bones that stand already; its scale must be 1. Stems thinner
/// than `barkFrom` (m) are drawn without a picture. No triangles where `geometry.wood` says so.
void buildBark(const std::vector<Axis>& axes, PlantGeometry& geometry, const SurfaceSettings& surface = {},
               float barkFrom = 0);

/// Short shoots, a part of this material, on the outer axes and the leaves on them; `area` is the one-sided area
/// wanted, m2.
void placeLeaves(const std::vector<Axis>& axes, double area, quint64 seed, int material, PlantGeometry& geometry);

/// Smooth value noise -1..1 that repeats after `width` by `height` cells.
float tileNoise(quint64 seed, float x, float y, int width, int height);
/// Distance to the border between plates, in cells, of Worley's cellular noise (1996) that repeats.
float tilePlates(quint64 seed, float x, float y, int width, int height);

/// A tile of bark that repeats in both directions: fissured ridges, sRGB.
QImage barkTexture(quint64 seed);

}  // namespace windfall::model::grower
