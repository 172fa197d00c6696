// What the growers can be told. Lengths in m, angles in degrees, time in years; the methods are in growers.md.
#pragma once

#include <QPointF>
#include <QString>
#include <QtGlobal>
#include <vector>

namespace windfall::model {

/// How a plant without a file comes to be.
enum class GrowMethod {
  Rule,               ///< trunk, limbs and twigs by rule (grower.h)
  SpaceColonization,  ///< branches reach for points in a crown volume (Runions et al. 2007)
  SelfOrganizing,     ///< buds compete for light (Palubicki et al. 2009)
  LSystem,            ///< rewriting rules (docs/lsystem.md)
};

/// The volume that space colonization fills.
struct CrownSettings {
  double base = 3.2;       ///< height of its lowest place, m
  double radius = 5;       ///< at its widest place, m
  double widest = 0.4;     ///< height of that place as a share of the crown
  double lowPower = 1.9;   ///< roundness below it: 1 cone, 2 ellipsoid, 3 box
  double highPower = 2.0;  ///< and above it
  /// A drawn outline instead of the formula: x is the distance from the axis as a share of `radius` (negative: the left
  /// side), y the height as a share of the crown. Empty: the formula.
  std::vector<QPointF> profile;
  bool operator==(const CrownSettings&) const = default;
};

/// growers.md, 1.7.
struct ColonizationSettings {
  CrownSettings crown;
  int points = 9000;         ///< attraction points
  double shell = 0.40;       ///< exponent of their distance from the axis: 0.5 even, less favours the shell
  double step = 0.20;        ///< length of a link, m
  double influence = 2.6;    ///< how far a point attracts, m
  double kill = 0.40;        ///< how near a branch uses a point up, m
  double upward = 0.06;      ///< pull upwards, of a unit vector
  double trunkTop = 4.6;     ///< the trunk is seeded up to here, m
  double trunkWander = 0.3;  ///< sideways part of the trunk's direction
  double noise = 0.3;        ///< random part of a branch's direction
  int lobes = 0;             ///< balls that clump the crown; 0: none
  double lobeSize = 0.36;    ///< their radius as a share of the crown's
  int stems = 1;
  double hangingLength = 0;  ///< of the shoots that weep from the tips, m; 0: none
  double hangingStep = 0.2;  ///< m
  double hangingShare = 0;   ///< share of the thin inner nodes that bear one too
  bool operator==(const ColonizationSettings&) const = default;
};

/// Which buds of an axis get its vigour.
enum class ResourceModel { BorchertHonda, Priority, Combined };
/// How buds stand around a shoot.
enum class BudArrangement { Alternate, Opposite, Whorled };

/// growers.md, 2.7.
struct SelfOrganizingSettings {
  double rate = 0.10;       ///< of the growth curve, 1/year
  double power = 1.2;       ///< of the growth curve (Richards)
  double internode = 0.22;  ///< m; also the edge of a voxel of light
  double vigour = 2.2;      ///< alpha: vigour a bud's light brings
  double leader = 0.52;     ///< lambda: below 0.5 shrub, above it tree
  ResourceModel model = ResourceModel::BorchertHonda;
  double density = 0.045;  ///< shadow that a metamer casts; more makes a thinner tree
  double falloff = 1.6;    ///< of the shadow with each voxel down
  int shadowDepth = 5;     ///< voxels
  BudArrangement arrangement = BudArrangement::Alternate;
  int buds = 1;              ///< at a node, or in a whorl
  double angle = 42;         ///< of a side shoot to its axis, degrees
  double light = 0.12;       ///< pull towards the light
  double upward = 0.05;      ///< pull upwards
  double level = 0;          ///< side branches stay level: 0 not at all
  bool sprays = false;       ///< side shoots lie left and right in the level plane
  double apical = 0.3;       ///< advantage of the end bud in the priority model
  int longestShoot = 5;      ///< metamers a year
  double pruning = 0.14;     ///< sigma: branches with less light than this for their size die
  double leastWeight = 0.5;  ///< of the priority model
  double favoured = 0.5;     ///< share of the buds that it favours
  double bole = 0;           ///< lowest limbs die below this share of the height
  double reach = 0.6;        ///< branches end at this share of the height from the trunk
  int basalBuds = 0;         ///< at the ground, for bushes
  bool operator==(const SelfOrganizingSettings&) const = default;
};

struct LSystemSettings {
  QString rules;       ///< in the language of docs/lsystem.md
  int iterations = 0;  ///< 0: as the rules say
  bool operator==(const LSystemSettings&) const = default;
};

/// The leaf that a plant wears while the artist has hung no leaf of their own on it.
enum class LeafLook { Ovate, Oak, Birch, Aspen, Willow, Maple, Fir, Pine, Bush, Herb };
enum class LeafArrangement { Alternate, Opposite, TwoRanked };

/// growers.md, 4 and 5.3.
struct FoliageSettings {
  bool leaves = true;  ///< false: bare, twigs stay
  LeafLook look = LeafLook::Ovate;
  double length = 0.08;      ///< of a blade, m
  int cluster = 6;           ///< leaves on a short shoot; 1: on the twig itself
  double leafyLength = 1.2;  ///< how far from the tips leaves stand, m
  LeafArrangement arrangement = LeafArrangement::Alternate;
  double petiole = 0.3;     ///< of the blade's length
  double droop = 0.3;       ///< how far blades hang
  double shoot = 0.32;      ///< length of a short shoot, m
  double amount = 1;        ///< share of the natural number
  double areaFactor = 0.5;  ///< area of a leaf of length 1
  double mostLayers = 6;    ///< largest leaf area over the crown's ground
  bool operator==(const FoliageSettings&) const = default;
};

enum class BarkLook { Plain, Oak, Birch, Aspen, Willow, Maple, Fir, Pine, Bush, Herb, Dead };

struct WoodSettings {
  double tipRadius = 0.0025;  ///< m
  BarkLook bark = BarkLook::Plain;
  double breakage = 0;  ///< share of a dead tree's twigs that fell
  bool operator==(const WoodSettings&) const = default;
};

}  // namespace windfall::model
