// The parts of the .prim reader.
#pragma once

#include <QByteArray>
#include <QtEndian>
#include <array>
#include <cstring>

#include "model/plant/prim_format.h"

namespace windfall::model::prim {

/// A place in the stream; reading past the end gives zeros and is remembered.
class Cursor {
 public:
  explicit Cursor(const QByteArray& bytes) : bytes_(bytes) {}
  std::uint8_t byte() {
    std::uint8_t value = 0;
    take(&value, 1);
    return value;
  }
  std::uint32_t count() {
    std::uint32_t value = 0;
    take(&value, 4);
    return qFromLittleEndian(value);
  }
  float number() {
    const std::uint32_t bits = count();
    float value = 0;
    std::memcpy(&value, &bits, 4);
    return value;
  }
  vec3 point() {
    const float x = number(), y = number(), z = number();
    return {x, y, z};
  }
  qsizetype left() const { return bytes_.size() - place_; }
  qsizetype place() const { return place_; }
  bool over() const { return over_; }

 private:
  void take(void* into, qsizetype size) {
    if (left() < size) {
      over_ = true;
      place_ = bytes_.size();
      return;
    }
    std::memcpy(into, bytes_.constData() + place_, static_cast<std::size_t>(size));
    place_ += size;
  }

  const QByteArray& bytes_;
  qsizetype place_ = 0;
  bool over_ = false;
};

/// Columns x, y, z and the origin.
struct Matrix {
  vec3 x{0}, y{0}, z{0}, t{0};
};
Matrix readMatrix(Cursor& in);

/// "plant 2 of 3: " and the like, for what goes wrong while `in` stands there.
Error endsHere(const std::string& where, const Cursor& in);

/// A count that the rest of the stream can hold at `smallest` bytes each, or why not.
Result<std::uint32_t> plausibleCount(Cursor& in, qsizetype smallest, const std::string& what);

Segment stemOf(float length, float radius, const Matrix& matrix);
LeafOrgan leafOf(const Matrix& matrix);

/// Versions 4 to 6.
Status readOrgans(Cursor& in, int version, PrimFile& file);
/// Versions 2 and 3.
Status readPrimitives(Cursor& in, int version, PrimFile& file);
/// Version 1.
Status readTriangles(Cursor& in, PrimFile& file);

/// Parents of the segments, leaves and buds from `firstSegment`, `firstLeaf`, `firstBud` on, which are of one plant:
/// the one whose tip is nearest to their base, if it touches it, or whose side does. Segments, leaves and buds that
/// have a parent already keep it.
struct Range {
  std::size_t segment = 0, leaf = 0, bud = 0;
};
void findParents(SkeletonGraph& graph, const Range& from);

}  // namespace windfall::model::prim
