// How good made textures are: the score's terms for pairs of photographs (leaf_textures.md, 11).
#pragma once

#include <QString>
#include <functional>
#include <string>
#include <vector>

#include "model/leaf/quality.h"
#include "model/progress.h"

namespace windfall::model {

struct QualityBenchOptions {
  QString photos;      ///< folder with photographs of leaves
  std::string method;  ///< only those with this in their name
  int seeds = 4;
  int pairs = 6;   ///< besides the two named ones
  int size = 512;  ///< long side, px
};

/// One method on one pair, means over the seeds.
struct QualityRow {
  std::string pair, method;  ///< "soybean_blue -> beech_scan_a", "guided"
  double score = 0, deviation = 0;
  QualityTerms terms;
  double copyIndex = 0;
  double diversity = 0;  ///< CIE76 between seeds
  double ceiling = 0;    ///< of the diversity, by the example (diversityCeiling)
};

/// The line above rows, and one row for people.
std::string qualityHeading();
std::string qualityLine(const QualityRow& row);
/// One JSON object of a row.
std::string qualityJson(const QualityRow& row);

/// Example to target: soybean_blue and beech_scan_a both ways with all baselines, then other photographs of the folder
/// in a ring, each the example of the next. What cannot be read is told to `say` by name and left out, so is the
/// whole where there is no folder.
std::vector<QualityRow> benchQuality(const QualityBenchOptions& options,
                                     const std::function<void(const std::string& line)>& say, Progress& progress);

}  // namespace windfall::model
