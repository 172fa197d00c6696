#include <cmath>

#include "model/plant/frames.h"
#include "model/plant/prim_private.h"

namespace windfall::model::prim {

namespace {

constexpr std::uint8_t kDisk = 1, kCylinder = 2, kSphere = 4, kRectangle = 8;
constexpr int kSides = 24;

struct Primitive {
  std::uint8_t type = 0;
  Matrix matrix;  ///< of a sphere: t alone
  float length = 0, radius = 0;
  bool sensor = false;
};

Status readPrimitive(Cursor& in, int version, const std::string& where, Primitive& p) {
  const qsizetype start = in.place();
  p.type = in.byte();
  if (p.type == kDisk || p.type == kRectangle) {
    p.matrix = readMatrix(in);
  } else if (p.type == kCylinder) {
    p.length = in.number();
    p.radius = in.number();
    p.matrix = readMatrix(in);
  } else if (p.type == kSphere) {
    p.matrix.t = in.point();
    p.radius = in.number();
  } else if (!in.over()) {
    return Error{where + "unknown primitive " + std::to_string(p.type) + " at byte " + std::to_string(start)};
  }
  if (version == 3) p.sensor = in.byte() != 0;
  if (in.over()) return endsHere(where, in);
  return ok();
}

void addFan(Obstacle& obstacle, const std::vector<vec3>& outline) {
  const auto first = static_cast<std::uint32_t>(obstacle.points.size());
  obstacle.points.insert(obstacle.points.end(), outline.begin(), outline.end());
  for (std::uint32_t i = 1; i + 1 < outline.size(); ++i) {
    obstacle.triangles.insert(obstacle.triangles.end(), {first, first + i, first + i + 1});
  }
}

void addToObstacle(const Primitive& p, Obstacle& obstacle) {
  const Matrix& m = p.matrix;
  const auto angle = [](int i) { return 6.2831853f * static_cast<float>(i % kSides) / kSides; };
  std::vector<vec3> outline;
  if (p.type == kRectangle) {
    addFan(obstacle, {m.t - m.x - m.y, m.t + m.x - m.y, m.t + m.x + m.y, m.t - m.x + m.y});
  } else if (p.type == kDisk) {
    for (int i = 0; i < kSides; ++i) outline.push_back(m.t + m.x * std::cos(angle(i)) + m.y * std::sin(angle(i)));
    addFan(obstacle, outline);
  } else if (p.type == kCylinder) {
    const vec3 up = m.y * p.length;
    for (int i = 0; i < kSides; ++i) {
      const vec3 a = p.radius * (m.x * std::cos(angle(i)) - m.z * std::sin(angle(i)));
      const vec3 b = p.radius * (m.x * std::cos(angle(i + 1)) - m.z * std::sin(angle(i + 1)));
      addFan(obstacle, {m.t + a, m.t + b, m.t + b + up, m.t + a + up});
      outline.push_back(m.t + up + a);
    }
    addFan(obstacle, outline);
  } else {
    const auto ball = [&](int i, int k) {
      const float around = 6.2831853f * static_cast<float>(i % 12) / 12, up = 3.1415927f * static_cast<float>(k) / 6;
      return m.t + p.radius * vec3(std::sin(up) * std::cos(around), std::cos(up), -std::sin(up) * std::sin(around));
    };
    for (int k = 0; k < 6; ++k) {
      for (int i = 0; i < 12; ++i) addFan(obstacle, {ball(i, k), ball(i, k + 1), ball(i + 1, k + 1), ball(i + 1, k)});
    }
  }
}

/// Version 3 mixes obstacles and plants: plants alone have sensors, and no plant has a flat part that senses nothing.
bool looksLikeObstacle(const std::vector<Primitive>& surfaces) {
  bool flat = false, sensor = false;
  for (const Primitive& p : surfaces) {
    sensor = sensor || p.sensor;
    flat = flat || p.type == kDisk || p.type == kRectangle;
  }
  return flat && !sensor;
}

void addPlant(const std::vector<Primitive>& surfaces, SkeletonGraph& graph) {
  const Range from{graph.segments.size(), graph.leaves.size(), graph.buds.size()};
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const Primitive& p = surfaces[i];
    const auto organ = static_cast<std::int32_t>(i);
    if (p.type == kCylinder) {
      Segment stem = stemOf(p.length, p.radius, p.matrix);
      stem.plant = graph.plants, stem.organ = organ;
      graph.segments.push_back(stem);
    } else if (p.type == kSphere) {
      BudOrgan bud;
      bud.plant = graph.plants, bud.organ = organ;
      bud.centre = p.matrix.t, bud.radius = p.radius;
      graph.buds.push_back(bud);
    } else {
      LeafOrgan leaf = leafOf(p.matrix);
      leaf.plant = graph.plants, leaf.organ = organ;
      graph.leaves.push_back(leaf);
    }
  }
  findParents(graph, from);
  ++graph.plants;
}

}  // namespace

Status readPrimitives(Cursor& in, int version, PrimFile& file) {
  const qsizetype smallest = version == 3 ? 18 : 17;
  const int groups = version == 2 ? 2 : 1;
  for (int group = 0; group < groups; ++group) {
    const bool obstacles = version == 2 && group == 0;
    const std::string kind = obstacles ? "obstacle" : version == 2 ? "plant" : "entity";
    const Result<std::uint32_t> entities = plausibleCount(in, 4, version == 3 ? "entities" : kind + "s");
    if (!entities) return entities.error();
    for (std::uint32_t e = 0; e < *entities; ++e) {
      const std::string where = kind + " " + std::to_string(e + 1);
      const Result<std::uint32_t> count = plausibleCount(in, smallest, "surfaces");
      if (!count) return Error{where + ": " + count.error().message};
      std::vector<Primitive> surfaces(*count);
      for (std::uint32_t i = 0; i < *count; ++i) {
        const Status read = readPrimitive(in, version, where + ", surface " + std::to_string(i) + ": ", surfaces[i]);
        if (!read) return read;
      }
      if (obstacles || (version == 3 && looksLikeObstacle(surfaces))) {
        Obstacle obstacle;
        for (const Primitive& p : surfaces) addToObstacle(p, obstacle);
        file.graph.obstacles.push_back(std::move(obstacle));
      } else {
        addPlant(surfaces, file.graph);
      }
    }
  }
  return ok();
}

}  // namespace windfall::model::prim
