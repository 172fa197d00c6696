#include <algorithm>
#include <cmath>
#include <limits>

#include "model/plant/prim_private.h"

namespace windfall::model::prim {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Surface = std::vector<Triangle>;

Result<std::vector<std::vector<Surface>>> readGroup(Cursor& in, const std::string& kind) {
  const Result<std::uint32_t> entities = plausibleCount(in, 4, kind + "s");
  if (!entities) return entities.error();
  std::vector<std::vector<Surface>> group(*entities);
  for (std::size_t e = 0; e < group.size(); ++e) {
    const std::string where = kind + " " + std::to_string(e + 1);
    const Result<std::uint32_t> surfaces = plausibleCount(in, 1, "surfaces");
    if (!surfaces) return Error{where + ": " + surfaces.error().message};
    for (std::uint32_t s = 0; s < *surfaces; ++s) {
      Surface surface(in.byte());
      for (Triangle& triangle : surface) {
        for (std::uint32_t& index : triangle) index = in.count();
      }
      if (in.over()) return endsHere(where + ", surface " + std::to_string(s) + ": ", in);
      group[e].push_back(std::move(surface));
    }
  }
  return group;
}

/// The points of a surface, each once, in the order of the list.
std::vector<std::uint32_t> corners(const Surface& surface) {
  std::vector<std::uint32_t> all;
  for (const Triangle& triangle : surface) all.insert(all.end(), triangle.begin(), triangle.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Distance from a point to the nearest end of a stem of the plant.
float toNearestTip(vec3 point, const SkeletonGraph& graph, std::size_t firstSegment) {
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = firstSegment; i < graph.segments.size(); ++i) {
    nearest = std::min(nearest, glm::length(graph.segments[i].b - point));
  }
  return nearest;
}

/// Four corners are a leaf that hangs by an edge, or a bud that sits on a stem's end.
void addQuad(const std::vector<vec3>& quad, std::int32_t organ, std::size_t firstSegment, SkeletonGraph& graph) {
  const vec3 centre = 0.25f * (quad[0] + quad[1] + quad[2] + quad[3]);
  float nearest = toNearestTip(centre, graph, firstSegment);
  std::size_t edge = 4;
  for (std::size_t k = 0; k < 4; ++k) {
    const float distance = toNearestTip(0.5f * (quad[k] + quad[(k + 1) % 4]), graph, firstSegment);
    if (distance < nearest) nearest = distance, edge = k;
  }
  if (edge == 4) {
    BudOrgan bud;
    bud.plant = graph.plants, bud.organ = organ;
    bud.centre = centre;
    bud.radius = glm::length(quad[0] - centre) / std::sqrt(2.0f);
    graph.buds.push_back(bud);
    return;
  }
  LeafOrgan leaf;
  leaf.plant = graph.plants, leaf.organ = organ;
  leaf.base = 0.5f * (quad[edge] + quad[(edge + 1) % 4]);
  leaf.tip = 0.5f * (quad[(edge + 2) % 4] + quad[(edge + 3) % 4]);
  leaf.width = glm::length(quad[(edge + 1) % 4] - quad[edge]);
  const vec3 normal = glm::cross(leaf.tip - leaf.base, quad[edge] - quad[(edge + 1) % 4]);
  const float length = glm::length(normal);
  if (length > 1e-20f) leaf.normal = normal.y < 0 ? -normal / length : normal / length;
  graph.leaves.push_back(leaf);
}

void addPlant(const std::vector<Surface>& surfaces, const std::vector<vec3>& points, PrimFile& file) {
  SkeletonGraph& graph = file.graph;
  const Range from{graph.segments.size(), graph.leaves.size(), graph.buds.size()};
  std::vector<std::pair<std::int32_t, std::vector<vec3>>> quads;
  int odd = 0;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    std::vector<vec3> corner;
    for (const std::uint32_t index : corners(surfaces[i])) corner.push_back(points[index]);
    const auto organ = static_cast<std::int32_t>(i);
    if (surfaces[i].size() == 8 && corner.size() == 8) {
      // An open square tube: four corners below, four above; the writer sets them at radius times (+-1, +-1).
      Segment stem;
      stem.a = 0.25f * (corner[0] + corner[1] + corner[2] + corner[3]);
      stem.b = 0.25f * (corner[4] + corner[5] + corner[6] + corner[7]);
      stem.ra = stem.rb = glm::length(corner[0] - stem.a) / std::sqrt(2.0f);
      stem.plant = graph.plants, stem.organ = organ;
      graph.segments.push_back(stem);
    } else if (surfaces[i].size() == 2 && corner.size() == 4) {
      quads.emplace_back(organ, std::move(corner));
    } else {
      ++odd;
    }
  }
  // Bounded: quads are told apart by the stems' ends, and a stream can be made of nothing else.
  const bool few = static_cast<double>(quads.size()) * static_cast<double>(graph.segments.size() - from.segment) < 5e7;
  for (const auto& [organ, quad] : quads) addQuad(quad, organ, few ? from.segment : graph.segments.size(), graph);
  if (odd > 0) {
    file.warnings
        << QStringLiteral("plant %1: %2 surfaces are neither stem, leaf nor bud").arg(graph.plants + 1).arg(odd);
  }
  findParents(graph, from);
  ++graph.plants;
}

Status checkIndices(const std::vector<std::vector<Surface>>& group, const std::string& kind, std::size_t points) {
  for (std::size_t e = 0; e < group.size(); ++e) {
    for (std::size_t s = 0; s < group[e].size(); ++s) {
      for (const Triangle& triangle : group[e][s]) {
        for (const std::uint32_t index : triangle) {
          if (index < points) continue;
          return Error{kind + " " + std::to_string(e + 1) + ", surface " + std::to_string(s) + ": point " +
                       std::to_string(index) + " is not there"};
        }
      }
    }
  }
  return ok();
}

}  // namespace

Status readTriangles(Cursor& in, PrimFile& file) {
  if (file.version != 1) return ok();  // refused by the caller, in one place
  const Result<std::vector<std::vector<Surface>>> obstacles = readGroup(in, "obstacle");
  if (!obstacles) return obstacles.error();
  const Result<std::vector<std::vector<Surface>>> plants = readGroup(in, "plant");
  if (!plants) return plants.error();
  const Result<std::uint32_t> count = plausibleCount(in, 12, "points");
  if (!count) return count.error();
  std::vector<vec3> points(*count);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = in.point();
    if (!std::isfinite(points[i].x + points[i].y + points[i].z)) {
      return Error{"point " + std::to_string(i) + ": its place is no number"};
    }
  }
  if (const Status sound = checkIndices(*obstacles, "obstacle", points.size()); !sound) return sound;
  if (const Status sound = checkIndices(*plants, "plant", points.size()); !sound) return sound;
  for (const std::vector<Surface>& surfaces : *obstacles) {
    Obstacle obstacle;
    for (const Surface& surface : surfaces) {
      for (const Triangle& triangle : surface) {
        for (const std::uint32_t index : triangle) {
          obstacle.triangles.push_back(static_cast<std::uint32_t>(obstacle.points.size()));
          obstacle.points.push_back(points[index]);
        }
      }
    }
    file.graph.obstacles.push_back(std::move(obstacle));
  }
  for (const std::vector<Surface>& surfaces : *plants) addPlant(surfaces, points, file);
  return ok();
}

}  // namespace windfall::model::prim
