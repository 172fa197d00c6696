// Hand edits that growth goes on from: a pruned crown fills again, a drawn branch gets twigs.
#pragma once

#include <functional>

#include "model/plant/grow/colonization.h"
#include "model/plant/plant.h"

namespace windfall::model::growth {

/// Cuts and drawn branches that are older than the plant is now become events of its growth and are marked as done.
/// `roundAt`: the round at which the colony has a share of its size.
std::vector<GrowthEvent> eventsOfColonization(const GrowerSettings& settings, const std::vector<HandEdit>& edits,
                                              const std::function<int(double)>& roundAt, std::vector<char>& done);
/// The same for growth by years, whose nodes keep their places.
std::vector<GrowthEvent> eventsOfYears(const std::vector<HandEdit>& edits, int years, std::vector<char>& done);

}  // namespace windfall::model::growth
