#include <QtEndian>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "model/plant/frames.h"
#include "model/plant/prim_format.h"

namespace windfall::model {

namespace {

constexpr float kThickness = 1e-4f;  ///< of a leaf, m

class Writer {
 public:
  void byte(std::uint8_t value) { bytes.append(static_cast<char>(value)); }
  void count(std::uint32_t value) {
    const std::uint32_t little = qToLittleEndian(value);
    bytes.append(reinterpret_cast<const char*>(&little), 4);
  }
  void number(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, 4);
    count(bits);
  }
  void matrix(vec3 x, vec3 y, vec3 z, vec3 t) {
    for (int row = 0; row < 3; ++row) {
      for (const vec3& column : {x, y, z, t}) number(column[row]);
    }
  }
  /// Length, radius and matrix: column y is the direction of growth.
  void stem(const Segment& s) {
    const glm::dvec3 along = glm::dvec3(s.b) - glm::dvec3(s.a);
    const float length = s.length > 0 ? s.length : static_cast<float>(glm::length(along));
    const vec3 y = length > 0 ? vec3(along / static_cast<double>(length)) : vec3(0, 1, 0);
    const quat frame = alongZ(y);
    number(length);
    number(s.ra);
    matrix(frame * vec3(1, 0, 0), y, -(frame * vec3(0, 1, 0)), s.a);
  }
  void leaf(const LeafOrgan& leaf) {
    const vec3 x = 0.5f * (leaf.tip - leaf.base);
    const vec3 side = glm::cross(leaf.normal, x);
    const float length = glm::length(side);
    const vec3 y = length > 1e-20f ? side * (0.5f * leaf.width / length) : vec3(0, 0, 0.5f * leaf.width);
    matrix(x, y, leaf.normal * (0.5f * kThickness), 0.5f * (leaf.base + leaf.tip));
  }
  void point(vec3 p) { number(p.x), number(p.y), number(p.z); }

  QByteArray bytes;
};

float share(float value) { return value < 0 ? 1 : std::min(value, 1.0f); }

/// What a plant's list holds at a place.
struct Organ {
  std::uint8_t kind = 0;  ///< 1 leaf, 2 stem, 3 bud
  std::size_t index = 0;  ///< in the graph's list
  std::int32_t organ = -1;
};

/// The organs of every plant: where the source had them, if it says so of all; else stems, leaves, buds.
std::vector<std::vector<Organ>> organsOf(const SkeletonGraph& graph) {
  std::vector<std::vector<Organ>> plants(static_cast<std::size_t>(graph.plants));
  const auto add = [&](std::uint8_t kind, std::size_t index, std::int32_t plant, std::int32_t organ) {
    if (plant >= 0 && plant < graph.plants) plants[static_cast<std::size_t>(plant)].push_back({kind, index, organ});
  };
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    if (s.kind != SegmentKind::Root) add(2, i, s.plant, s.organ);
  }
  for (std::size_t i = 0; i < graph.leaves.size(); ++i) add(1, i, graph.leaves[i].plant, graph.leaves[i].organ);
  for (std::size_t i = 0; i < graph.buds.size(); ++i) add(3, i, graph.buds[i].plant, graph.buds[i].organ);
  for (std::vector<Organ>& organs : plants) {
    if (std::any_of(organs.begin(), organs.end(), [](const Organ& o) { return o.organ < 0; })) continue;
    std::stable_sort(organs.begin(), organs.end(), [](const Organ& a, const Organ& b) { return a.organ < b.organ; });
  }
  return plants;
}

void writeState(Writer& out, const OrganState& state, std::uint8_t kind, int version) {
  out.number(share(state.water));
  out.number(share(state.energy));
  if (kind == 2) out.number(share(state.wood));
  if (version == 4) return;
  if (kind == 1) out.number(state.irradiance);
  if (kind != 3) out.number(state.resources), out.number(state.production);
  out.number(state.auxins);
  out.number(state.efficiency);
}

/// `number`: a segment's place in its plant's list.
void writeRoots(Writer& out, const SkeletonGraph& graph, const std::vector<std::size_t>& roots,
                const std::vector<std::int32_t>& number) {
  out.count(static_cast<std::uint32_t>(roots.size()));
  for (const std::size_t i : roots) {
    const Segment& s = graph.segments[i];
    out.count(static_cast<std::uint32_t>(s.parent < 0 ? -1 : number[static_cast<std::size_t>(s.parent)]));
    out.byte(1);
    out.stem(s);
    out.number(std::max(s.state.water, 0.0f));
    out.number(share(s.state.energy));
    out.number(share(s.state.wood));
    out.number(s.state.resources);
    out.number(s.state.production);
  }
}

void writePlant(Writer& out, const SkeletonGraph& graph, const std::vector<Organ>& organs,
                const std::vector<std::int32_t>& number, int version) {
  const auto parent = [&](std::int32_t segment) {
    out.count(static_cast<std::uint32_t>(segment < 0 ? -1 : number[static_cast<std::size_t>(segment)]));
  };
  out.count(static_cast<std::uint32_t>(organs.size()));
  for (const Organ& organ : organs) {
    if (organ.kind == 2) {
      const Segment& s = graph.segments[organ.index];
      if (version > 3) parent(s.parent);
      out.byte(2);
      out.stem(s);
      if (version > 3) writeState(out, s.state, 2, version);
    } else if (organ.kind == 1) {
      const LeafOrgan& leaf = graph.leaves[organ.index];
      if (version > 3) parent(leaf.segment);
      out.byte(version > 3 ? 1 : 8);
      out.leaf(leaf);
      if (version > 3) writeState(out, leaf.state, 1, version);
    } else {
      const BudOrgan& bud = graph.buds[organ.index];
      if (version > 3) parent(bud.segment);
      out.byte(version > 3 ? 3 : 4);
      out.point(bud.centre);
      out.number(bud.radius);
      if (version > 3) writeState(out, bud.state, 3, version);
    }
    if (version == 3) out.byte(organ.kind == 1 ? 1 : 0);
  }
}

}  // namespace

Result<QByteArray> writePrim(const SkeletonGraph& graph, int version) {
  if (version < 3 || version > 6) return Error{".prim is written as version 3, 4, 5 or 6"};
  const std::vector<std::vector<Organ>> plants = organsOf(graph);
  std::vector<std::vector<std::size_t>> roots(plants.size());
  std::vector<std::int32_t> number(graph.segments.size(), -1);
  for (const std::vector<Organ>& organs : plants) {
    for (std::size_t i = 0; i < organs.size(); ++i) {
      if (organs[i].kind == 2) number[organs[i].index] = static_cast<std::int32_t>(i);
    }
  }
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const Segment& s = graph.segments[i];
    if (s.kind != SegmentKind::Root || s.plant < 0 || s.plant >= graph.plants) continue;
    std::vector<std::size_t>& list = roots[static_cast<std::size_t>(s.plant)];
    number[i] = static_cast<std::int32_t>(list.size());
    list.push_back(i);
  }
  Writer out;
  out.byte(static_cast<std::uint8_t>(version));
  out.count(static_cast<std::uint32_t>(plants.size()));
  for (std::size_t p = 0; p < plants.size(); ++p) {
    writePlant(out, graph, plants[p], number, version);
    if (version == 6) writeRoots(out, graph, roots[p], number);
  }
  return out.bytes;
}

}  // namespace windfall::model
