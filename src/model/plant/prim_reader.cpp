#include <cmath>

#include "model/plant/prim_private.h"

namespace windfall::model {

namespace prim {

Matrix readMatrix(Cursor& in) {
  std::array<float, 12> m{};
  for (float& value : m) value = in.number();
  return {{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}, {m[3], m[7], m[11]}};
}

Error endsHere(const std::string& where, const Cursor& in) {
  return Error{where + "the file ends at byte " + std::to_string(in.place()) + ", in the middle of it"};
}

Result<std::uint32_t> plausibleCount(Cursor& in, qsizetype smallest, const std::string& what) {
  const qsizetype place = in.place();
  const std::uint32_t count = in.count();
  if (in.over())
    return Error{"byte " + std::to_string(place) + ": the file ends where the number of " + what + " should be"};
  if (static_cast<qsizetype>(count) > in.left() / smallest) {
    return Error{"byte " + std::to_string(place) + ": claims " + std::to_string(count) + " " + what + ", but only " +
                 std::to_string(in.left()) + " bytes follow"};
  }
  return count;
}

Segment stemOf(float length, float radius, const Matrix& matrix) {
  Segment s;
  s.a = matrix.t;
  // Not normalised: the writer places children with the vector as it is.
  s.b = vec3(glm::dvec3(matrix.t) + static_cast<double>(length) * glm::dvec3(matrix.y));
  s.length = length;
  s.ra = s.rb = radius;
  return s;
}

LeafOrgan leafOf(const Matrix& matrix) {
  LeafOrgan leaf;
  leaf.base = matrix.t - matrix.x;
  leaf.tip = matrix.t + matrix.x;
  leaf.width = 2 * glm::length(matrix.y);
  vec3 normal = matrix.z;
  if (!(glm::length(normal) > 1e-12f)) normal = glm::cross(matrix.x, matrix.y);
  const float length = glm::length(normal);
  leaf.normal = length > 1e-20f ? normal / length : vec3(0, 1, 0);
  return leaf;
}

}  // namespace prim

Result<PrimFile> readPrim(const QByteArray& bytes) {
  if (bytes.isEmpty()) return Error{"is empty"};
  prim::Cursor in(bytes);
  PrimFile file;
  file.version = in.byte();
  file.graph.plants = 0;
  Status status = file.version >= 4   ? prim::readOrgans(in, file.version, file)
                  : file.version >= 2 ? prim::readPrimitives(in, file.version, file)
                                      : prim::readTriangles(in, file);
  if (file.version < 1 || file.version > 6) {
    return Error{"is of version " + std::to_string(file.version) + "; Windfall reads .prim of versions 1 to 6"};
  }
  if (!status) return status.error();
  if (in.left() > 0) {
    file.warnings << QStringLiteral("%1 bytes at the end of the file belong to nothing").arg(in.left());
  }
  if (file.graph.plants == 0) return Error{"holds no plants"};
  if (file.graph.segments.empty() && file.graph.leaves.empty()) return Error{"holds no organs"};
  Result<SkeletonGraph> sorted = sortedGraph(std::move(file.graph));
  if (!sorted) return sorted.error();
  file.graph = std::move(*sorted);
  finishGraph(file.graph);
  return file;
}

}  // namespace windfall::model
