// What an artist sets for wind and leaves; plain values with sensible defaults.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/math.h"

namespace windfall::sim {

/// How speed and direction follow time.
enum class WindCourse : std::int32_t { Steady, Curve, Recorded };

/// A point of the artist's curve; between two of them a smooth line that never overshoots.
struct WindKey {
  float time = 0;      ///< s
  float strength = 1;  ///< times the mean speed
  float turn = 0;      ///< degrees clockwise seen from above, on the wind's direction
  bool operator==(const WindKey&) const = default;
};

/// A row of a measured wind; linear between two.
struct WindRecord {
  float time = 0;     ///< s, from the first row
  float speed = 0;    ///< m/s at 10 m height
  float heading = 0;  ///< degrees clockwise from north (-Z): where it blows to
  bool operator==(const WindRecord&) const = default;
};

/// A fan that stands in the scene: a round jet.
struct Fan {
  vec3 position{0, 2, 0};   ///< m, middle of its outlet
  vec3 direction{1, 0, 0};  ///< it blows to; any length
  float strength = 12;      ///< m/s at the outlet
  float radius = 0.6f;      ///< m of the outlet
  float spread = 11;        ///< degrees between the axis and the jet's edge; 11 is that of a free jet
  bool on = true;
  bool operator==(const Fan&) const = default;
};

/// Wind over open ground or a stand (tree_dynamics.md, 8).
struct WindSettings {
  float speed = 5;            ///< mean at 10 m height, m/s
  vec3 direction{1, 0, 0};    ///< where it blows to; horizontal part is used
  float turbulence = 0.2f;    ///< standard deviation over mean, 0..0.6
  float gustStrength = 0.6f;  ///< travelling fronts: A of the note, 0..1.5
  float gustPeriod = 9;       ///< seconds between fronts
  float until = 1e30f;        ///< s; calm afterwards
  std::uint64_t seed = 1;
  float canopyHeight = 0;  ///< m, of a stand that the scene is part of; 0: open grass
  float shelter = 1;       ///< how much leaves slow the air behind them: 0 not at all, 1 as measured
  WindCourse course = WindCourse::Steady;
  bool repeat = true;               ///< curve and record start anew after their end
  std::vector<WindKey> curve;       ///< by time, used when the course is Curve
  std::vector<WindRecord> records;  ///< by time, used when the course is Recorded
  std::string recordName;           ///< of the file they came from
  std::vector<Fan> fans;            ///< at most 8 blow
  bool operator==(const WindSettings&) const = default;
};

/// Leaves that come loose and fall (falling_leaves.md; release by tree_dynamics.md, 9).
struct LeafSettings {
  std::int32_t count = 2000;  ///< leaves in the scene
  /// 0 green and firm .. 1 ready to drop; half-way a breeze takes about one leaf in a hundred each second.
  float season = 0.5f;
  float spawnHeight = 0;      ///< m; above 0: leaves start loose at this height over a disc instead of on the trees
  float massPerArea = 0.10f;  ///< kg/m2
  bool respawn = false;       ///< a leaf on the ground grows again at its place after a while
  bool operator==(const LeafSettings&) const = default;
};

/// How joints are solved (tree_dynamics.md).
enum class TreeMethod {
  Coupled,   ///< two-way coupled, prefactored (6): the default
  Analytic,  ///< each joint exact by itself, inertia frozen and calibrated by axis (5): fastest, any step
  Forces,    ///< own inertia and propagated forces (7): for comparison
  Literal    ///< the analytic form as published, without the repair of its frequencies: for comparison
};

/// "coupled", "analytic", "forces", "literal": as the command line and benchmarks name them; and back.
const char* nameOf(TreeMethod method);
std::optional<TreeMethod> treeMethodNamed(std::string_view name);

/// Links' solver.
struct SolverSettings {
  float step = 1.f / 60;            ///< fixed step, s
  float structuralDamping = 0.03f;  ///< modal ratio
  TreeMethod method = TreeMethod::Coupled;
  bool axisMotion = false;  ///< analytic: a branch feels how its base moves (5.9)
  bool operator==(const SolverSettings&) const = default;
};

}  // namespace windfall::sim
