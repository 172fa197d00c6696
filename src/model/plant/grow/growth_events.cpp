#include "model/plant/grow/growth_events.h"

#include <algorithm>
#include <cmath>

#include "model/plant/grow/grow_skeleton.h"

namespace windfall::model::growth {

namespace {

dvec3 toDouble(const QVector3D& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}

bool changesGrowth(const HandEdit& edit) { return edit.kind == HandEditKind::Prune || edit.kind == HandEditKind::Draw; }

/// Drawn lines in links of about the grower's own length.
std::vector<dvec3> resampled(const std::vector<QVector3D>& line, dvec3 from, double scale, double step) {
  std::vector<dvec3> result;
  dvec3 last = from;
  for (const QVector3D& point : line) {
    const dvec3 to = scale * toDouble(point);
    const double length = glm::length(to - last);
    if (length < 1e-6) continue;
    const int parts = std::clamp(static_cast<int>(std::lround(length / step)), 1, 1000);
    for (int k = 1; k <= parts; ++k) result.push_back(last + (to - last) * (static_cast<double>(k) / parts));
    last = to;
  }
  return result;
}

GrowthEvent eventOf(const HandEdit& edit, double when, double scale, double step) {
  GrowthEvent event;
  event.when = when;
  event.node = edit.node;
  event.place = scale * toDouble(edit.place);
  event.prune = edit.kind == HandEditKind::Prune;
  if (!event.prune) event.line = resampled(edit.line, event.place, scale, step);
  return event;
}

}  // namespace

std::vector<GrowthEvent> eventsOfColonization(const GrowerSettings& s, const std::vector<HandEdit>& edits,
                                              const std::function<int(double)>& roundAt, std::vector<char>& done) {
  std::vector<GrowthEvent> events;
  const int now = roundAt(maturityShare(s));
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const double share = shareAt(s, edits[i].age);
    const int round = roundAt(share);
    if (!changesGrowth(edits[i]) || round >= now) continue;
    // From the plant as it was drawn to the colony's own space; events happen before a round.
    events.push_back(eventOf(edits[i], round + 1, 1 / std::sqrt(share), s.colonization.step));
    done[i] = 1;
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const GrowthEvent& a, const GrowthEvent& b) { return a.when < b.when; });
  return events;
}

std::vector<GrowthEvent> eventsOfYears(const std::vector<HandEdit>& edits, int years, std::vector<char>& done) {
  std::vector<GrowthEvent> events;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const double year = std::round(edits[i].age);
    if (!changesGrowth(edits[i]) || year >= years) continue;
    events.push_back(eventOf(edits[i], year, 1, 0.2));
    done[i] = 1;
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const GrowthEvent& a, const GrowthEvent& b) { return a.when < b.when; });
  return events;
}

}  // namespace windfall::model::growth
