// Stable names of the things in a project.
#pragma once

#include <QHashFunctions>
#include <compare>

namespace windfall::model {

/// Names a leaf, a plant or a placed tree; unique in its project, never used again. 0 names nothing.
struct AssetId {
  quint64 value = 0;
  explicit operator bool() const { return value != 0; }
  auto operator<=>(const AssetId&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads <=>
};

inline size_t qHash(AssetId id, size_t seed = 0) { return ::qHash(id.value, seed); }

}  // namespace windfall::model
