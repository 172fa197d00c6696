#include "model/plant/loose_vertices.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace windfall::model {

namespace {

constexpr int kCells = 96;  // along the longest side

/// Vertices by the cubes of a grid that they lie in.
class Grid {
 public:
  Grid(const std::vector<Vertex>& vertices, const std::vector<char>& left) : vertices_(vertices) {
    vec3 high(-1e30f);
    for (const Vertex& vertex : vertices) {
      low_ = glm::min(low_, vertex.position);
      high = glm::max(high, vertex.position);
    }
    const vec3 size = high - low_;
    edge_ = std::max(std::max({size.x, size.y, size.z}) / kCells, 1e-6f);
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
      if (!left[v]) cells_[keyOf(cellOf(vertices[v].position))].push_back(v);
    }
  }

  bool isEmpty() const { return cells_.empty(); }

  std::uint32_t nearest(const vec3& place) const {
    const glm::ivec3 centre = cellOf(place);
    std::uint32_t best = 0;
    float distance = 1e30f;
    // Cells farther than the best so far cannot hold a nearer one.
    for (int ring = 0; ring <= kCells + 1 && static_cast<float>(ring - 1) * edge_ < distance; ++ring) {
      eachAround(centre, ring, [&](const std::vector<std::uint32_t>& cell) {
        for (const std::uint32_t v : cell) {
          const float d = glm::distance(vertices_[v].position, place);
          if (d < distance || (d == distance && v < best)) distance = d, best = v;
        }
      });
    }
    return best;
  }

 private:
  glm::ivec3 cellOf(const vec3& place) const { return glm::ivec3((place - low_) / edge_); }
  static std::uint32_t keyOf(const glm::ivec3& cell) {
    return static_cast<std::uint32_t>((cell.z * (kCells + 2) + cell.y) * (kCells + 2) + cell.x);
  }

  template <class Visit>
  void eachAround(const glm::ivec3& centre, int ring, const Visit& visit) const {
    const glm::ivec3 from = glm::max(centre - ring, glm::ivec3(0)), to = glm::min(centre + ring, glm::ivec3(kCells));
    for (int z = from.z; z <= to.z; ++z) {
      for (int y = from.y; y <= to.y; ++y) {
        const bool shell = std::abs(z - centre.z) == ring || std::abs(y - centre.y) == ring;
        for (int x = from.x; x <= to.x; ++x) {
          if (!shell && std::abs(x - centre.x) != ring) continue;
          const auto cell = cells_.find(keyOf({x, y, z}));
          if (cell != cells_.end()) visit(cell->second);
        }
      }
    }
  }

  const std::vector<Vertex>& vertices_;
  vec3 low_{1e30f};
  float edge_ = 1;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

void holdLooseVertices(PlantGeometry& geometry, const std::vector<std::uint32_t>& loose) {
  if (loose.empty()) return;
  std::vector<char> left(geometry.vertices.size(), 0);
  for (const std::uint32_t v : loose) left[v] = 1;
  const Grid grid(geometry.vertices, left);
  if (grid.isEmpty()) return;
  for (const std::uint32_t v : loose) {
    Vertex& vertex = geometry.vertices[v];
    const Vertex& holder = geometry.vertices[grid.nearest(vertex.position)];
    vertex.bones = holder.bones;
    vertex.weights = holder.weights;
  }
}

}  // namespace windfall::model
