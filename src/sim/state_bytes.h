// Bytes of a saved state: written in order, read with every size checked.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "sim/result.h"

namespace windfall::sim {

/// Collects plain values, little-endian as the machine is.
class ByteWriter {
 public:
  template <class T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&v);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof(T));
  }
  /// The count, then the elements.
  template <class T>
  void values(std::span<const T> all) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(all.size()));
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(all.data());
    bytes_.insert(bytes_.end(), bytes, bytes + all.size_bytes());
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads what ByteWriter wrote; once something does not fit, every further read fails.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  bool value(T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (failed_ || bytes_.size() < sizeof(T)) return fail();
    std::memcpy(&v, bytes_.data(), sizeof(T));
    bytes_ = bytes_.subspan(sizeof(T));
    return true;
  }
  /// Reads exactly all.size() elements; another stored count fails.
  template <class T>
  bool values(std::span<T> all) {
    std::uint64_t count = 0;
    if (!value(count) || count != all.size() || bytes_.size() < all.size_bytes()) return fail();
    if (!all.empty()) std::memcpy(all.data(), bytes_.data(), all.size_bytes());
    bytes_ = bytes_.subspan(all.size_bytes());
    return true;
  }
  /// A block of bytes whose stored count fits into what is left.
  bool block(std::span<const std::uint8_t>& all) {
    std::uint64_t count = 0;
    if (!value(count) || count > bytes_.size()) return fail();
    all = bytes_.first(static_cast<std::size_t>(count));
    bytes_ = bytes_.subspan(static_cast<std::size_t>(count));
    return true;
  }
  bool atEnd() const { return !failed_ && bytes_.empty(); }

 private:
  bool fail() {
    failed_ = true;
    return false;
  }
  std::span<const std::uint8_t> bytes_;
  bool failed_ = false;
};

/// FNV-1a over bytes, 64 bits; `start` chains several pieces.
inline constexpr std::uint64_t kHashStart = 1469598103934665603ull;
inline std::uint64_t hashBytes(const void* data, std::size_t size, std::uint64_t start = kHashStart) {
  const auto* bytes = static_cast<const std::uint8_t*>(data);
  std::uint64_t h = start;
  for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 1099511628211ull;
  return h;
}

}  // namespace windfall::sim
