#include <limits>

#include "model/plant/prim_private.h"

namespace windfall::model::prim {

namespace {

constexpr std::int32_t kInvalid = std::numeric_limits<std::int32_t>::min();

/// What an entry of a plant's list became.
struct Entry {
  std::uint8_t kind = 0;  ///< 1 leaf, 2 stem, 3 bud
  std::int32_t parent = -1;
  std::int32_t index = -1;  ///< in the graph's list of that kind
};

OrganState readState(Cursor& in, int version, std::uint8_t kind) {
  OrganState state;
  state.water = in.number();
  state.energy = in.number();
  if (kind == 2) state.wood = in.number();
  if (version == 4) return state;
  if (kind == 1) state.irradiance = in.number();
  if (kind != 3) state.resources = in.number(), state.production = in.number();
  state.auxins = in.number();
  state.efficiency = in.number();
  return state;
}

Status readOrgan(Cursor& in, int version, std::int32_t plant, std::int32_t organ, const std::string& where,
                 SkeletonGraph& graph, Entry& entry) {
  const qsizetype start = in.place();
  entry.parent = static_cast<std::int32_t>(in.count());
  entry.kind = in.byte();
  if (entry.kind == 1) {
    LeafOrgan leaf = leafOf(readMatrix(in));
    leaf.plant = plant, leaf.organ = organ;
    leaf.state = readState(in, version, entry.kind);
    entry.index = static_cast<std::int32_t>(graph.leaves.size());
    graph.leaves.push_back(leaf);
  } else if (entry.kind == 2) {
    const float length = in.number(), radius = in.number();
    Segment stem = stemOf(length, radius, readMatrix(in));
    stem.plant = plant, stem.organ = organ;
    stem.state = readState(in, version, entry.kind);
    entry.index = static_cast<std::int32_t>(graph.segments.size());
    graph.segments.push_back(stem);
  } else if (entry.kind == 3) {
    BudOrgan bud;
    bud.centre = in.point();
    bud.radius = in.number();
    bud.plant = plant, bud.organ = organ;
    bud.state = readState(in, version, entry.kind);
    entry.index = static_cast<std::int32_t>(graph.buds.size());
    graph.buds.push_back(bud);
  } else if (!in.over()) {
    return Error{where + "unknown organ " + std::to_string(entry.kind) + " at byte " + std::to_string(start + 4)};
  }
  if (in.over()) return endsHere(where, in);
  return ok();
}

Status linkOrgans(const std::vector<Entry>& entries, std::int32_t plant, SkeletonGraph& graph, bool& lost) {
  const auto count = static_cast<std::int32_t>(entries.size());
  for (std::int32_t i = 0; i < count; ++i) {
    const Entry& entry = entries[static_cast<std::size_t>(i)];
    if (entry.parent == kInvalid) lost = true;
    if (entry.parent == -1 || entry.parent == kInvalid) continue;
    const std::string where = "plant " + std::to_string(plant + 1) + ", organ " + std::to_string(i) + ": ";
    if (entry.parent < 0 || entry.parent >= count) {
      return Error{where + "its parent " + std::to_string(entry.parent) + " is not there"};
    }
    if (entry.parent == i) return Error{where + "is its own parent"};
    const Entry& parent = entries[static_cast<std::size_t>(entry.parent)];
    if (parent.kind != 2) return Error{where + "its parent " + std::to_string(entry.parent) + " is no stem"};
    const auto index = static_cast<std::size_t>(entry.index);
    if (entry.kind == 1) graph.leaves[index].segment = parent.index;
    if (entry.kind == 2) graph.segments[index].parent = parent.index;
    if (entry.kind == 3) graph.buds[index].segment = parent.index;
  }
  return ok();
}

Status readRoots(Cursor& in, std::int32_t plant, const std::string& where, SkeletonGraph& graph) {
  const Result<std::uint32_t> roots = plausibleCount(in, 81, "roots");
  if (!roots) return Error{where + roots.error().message};
  const auto first = static_cast<std::int32_t>(graph.segments.size());
  const auto count = static_cast<std::int32_t>(*roots);
  for (std::int32_t i = 0; i < count; ++i) {
    const std::string here = where + "root " + std::to_string(i) + ": ";
    const auto parent = static_cast<std::int32_t>(in.count());
    const std::uint8_t kind = in.byte();
    const float length = in.number(), radius = in.number();
    Segment root = stemOf(length, radius, readMatrix(in));
    root.state.water = in.number();
    root.state.energy = in.number();
    root.state.wood = in.number();
    root.state.resources = in.number();
    root.state.production = in.number();
    if (in.over()) return endsHere(here, in);
    if (kind != 1) return Error{here + "unknown organ " + std::to_string(kind)};
    if (parent != -1 && parent != kInvalid && (parent < 0 || parent >= count)) {
      return Error{here + "its parent " + std::to_string(parent) + " is not there"};
    }
    root.kind = SegmentKind::Root;
    root.plant = plant, root.organ = i;
    root.parent = parent < 0 ? -1 : first + parent;
    graph.segments.push_back(root);
  }
  return ok();
}

}  // namespace

Status readOrgans(Cursor& in, int version, PrimFile& file) {
  if (version > 6) return ok();  // refused by the caller, in one place
  SkeletonGraph& graph = file.graph;
  const Result<std::uint32_t> plants = plausibleCount(in, version == 6 ? 8 : 4, "plants");
  if (!plants) return plants.error();
  for (std::uint32_t p = 0; p < *plants; ++p) {
    const auto plant = static_cast<std::int32_t>(p);
    const std::string where = "plant " + std::to_string(p + 1) + ": ";
    const Result<std::uint32_t> organs = plausibleCount(in, version == 4 ? 29 : 37, "organs");
    if (!organs) return Error{where + organs.error().message};
    const Range from{graph.segments.size(), graph.leaves.size(), graph.buds.size()};
    std::vector<Entry> entries(*organs);
    for (std::uint32_t i = 0; i < *organs; ++i) {
      const std::string here = "plant " + std::to_string(p + 1) + ", organ " + std::to_string(i) + ": ";
      const Status read = readOrgan(in, version, plant, static_cast<std::int32_t>(i), here, graph, entries[i]);
      if (!read) return read;
    }
    bool lost = false;
    if (const Status linked = linkOrgans(entries, plant, graph, lost); !linked) return linked;
    if (lost) {
      file.warnings
          << QStringLiteral("plant %1: organs without a valid parent were attached to what they touch").arg(p + 1);
      findParents(graph, from);
    }
    if (version == 6) {
      if (const Status roots = readRoots(in, plant, where, graph); !roots) return roots;
    }
    ++graph.plants;
  }
  return ok();
}

}  // namespace windfall::model::prim
