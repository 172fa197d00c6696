// From settings to a finished skeleton, by whichever grower.
#pragma once

#include <QString>
#include <QStringList>
#include <vector>

#include "model/plant/grow/grown.h"
#include "model/plant/plant.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model::growth {

struct GrownSkeleton {
  Grown grown;  ///< with axes, radii, hand edits
  QStringList
      notes;  ///< what the artist should know: points out of reach, rules that were stopped, edits that found no place
  std::vector<int> lost;  ///< indices of hand edits that found no place
};

/// By the plant's grower, crown and hand edits. Errors: numbers that make no plant, an empty crown, rules that are
/// wrong ("rules 2:9: …").
Result<GrownSkeleton> growSkeleton(const Plant& plant, Progress& progress);

/// Size of a plant of `age` years as a share of the full-grown one: Richards' curve (growers.md, 2.5, 1.6).
double maturityShare(const GrowerSettings& settings);
double shareAt(const GrowerSettings& settings, double age);

/// Applies what is done on the finished skeleton; returns the indices of edits that found no place.
std::vector<int> applyEdits(Grown& grown, const std::vector<HandEdit>& edits, const std::vector<char>& done);
/// The same edit on a plant `scale` times as large.
void scaleEdit(HandEdit& edit, double scale);
/// The node that an edit means, or -1.
int findNode(const Grown& grown, const HandEdit& edit);

}  // namespace windfall::model::growth
