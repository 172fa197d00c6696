// How a leaf turns from green to brown: pigments of one leaf, and the states of many by the days of autumn.
#pragma once

#include <QImage>
#include <array>

namespace windfall::model {

/// What decides on the colours and the pace of ageing.
struct AgeingParameters {
  double age = 0;           ///< of the textures themselves: 0 as photographed .. 1 brown and dry
  double temperature = 12;  ///< degrees Celsius, mean of the autumn's days: cold hurries
  double wetness = 0.5;     ///< 0 dry air .. 1 rain: dry air browns and curls
  double redness = 0.3;     ///< anthocyanin of the species: 0 birch .. 1 red maple
  double warmth = 0.3;      ///< of the yellow: 0 lemon .. 1 copper
  bool operator==(const AgeingParameters&) const = default;
};

/// How far each change has gone in one leaf, 0..1.
struct LeafAge {
  double fading = 0;     ///< chlorophyll lost
  double reddening = 0;  ///< anthocyanin made
  double browning = 0;   ///< tissue dead
  /// Curl and dullness, 0..1.
  double dryness(double wetness) const;
};

/// The way of one leaf: it fades, reddens if its species does, browns.
LeafAge leafAge(const AgeingParameters& parameters);

/// Shares of many leaves that are green, yellow, red and brown; their sum is 1.
using SeasonStates = std::array<double, 4>;

/// One day of the Markov chain green, yellow, red, brown: row = state now, rows sum to 1. Off-diagonals scale by
/// 2^((12 - T)/6), those to brown by the air's dryness, those to red by the species (leaf_textures.md, 10).
std::array<SeasonStates, 4> dailyChange(const AgeingParameters& parameters);

/// The states after so many days from all green; between whole days linear.
SeasonStates statesAfter(double days, const AgeingParameters& parameters);

/// Days of autumn at a scene's season 0..1.
double seasonDays(double season);

/// The leaf that stands at share `rank` of all by how early it turns: its age never runs backwards with the days, and
/// over all ranks the states are as `states` says.
LeafAge ageOfRank(double rank, const SeasonStates& states);

/// Target colours of a leaf, CIE Lab: yellow, red, brown.
std::array<std::array<float, 3>, 3> ageColours(const AgeingParameters& parameters);

/// The texture with its pigments aged: Lab is moved towards yellow, red, brown by the share of each at each place, the
/// leaf's own light and dark stay. `ageing`: LeafMaps::ageing, of the same size. RGBA8888 in and out; alpha stays.
QImage agedTexture(const QImage& texture, const QImage& ageing, const LeafAge& age, const AgeingParameters& parameters);

/// Mean Lab of the opaque pixels.
std::array<float, 3> meanLab(const QImage& texture);

/// Factors on linear RGB that turn the leaf's mean colour into yellow, red and brown: what a shader ages by.
std::array<std::array<float, 3>, 3> ageGains(const QImage& texture, const AgeingParameters& parameters);

}  // namespace windfall::model
