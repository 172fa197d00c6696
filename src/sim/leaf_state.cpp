// The state of a field of leaves as bytes, and its hash.
#include <algorithm>
#include <cstring>
#include <string>

#include "kernels/leaf_arrays.h"
#include "sim/leaf_field.h"
#include "sim/leaf_storage.h"

namespace windfall::sim {

namespace {

constexpr std::uint32_t kMagic = 0x5641454c;  // "LEAV"
constexpr std::uint32_t kVersion = 1;

struct Header {
  std::uint32_t magic = kMagic, version = kVersion;
  std::uint32_t leaves = 0, links = 0;
  std::uint64_t scene = 0;    ///< fingerprint of what the state belongs to
  std::uint64_t payload = 0;  ///< hash of the bytes that follow
  double time = 0;
  float dt = 0;
  std::uint32_t stepNumber = 0;
};
static_assert(sizeof(Header) == 48);

/// Takes in 32-bit words one after the other.
class Mixer {
 public:
  void add(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const std::byte*>(data);
    for (std::size_t i = 0; i + 4 <= bytes; i += 4) {
      std::uint32_t word = 0;
      std::memcpy(&word, at + i, 4);
      value_ = (value_ ^ word) * 0x9ddfea08eb382d69u;
      value_ ^= value_ >> 29u;
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

template <class Visit>
void visitState(const LeafStorage& s, bool state, Visit&& visit) {
  LeafArrays arrays = s.arrays;
  visitArrays(arrays, s.links, [&](auto* pointer, std::uint32_t n, bool is) {
    if (is == state) visit(reinterpret_cast<std::byte*>(pointer), sizeof(*pointer) * n);
  });
}

std::uint64_t fingerprint(const LeafStorage& s) {
  Mixer mixer;
  mixer.add(&s.seed, sizeof(s.seed));
  visitState(s, false, [&](std::byte* data, std::size_t bytes) { mixer.add(data, bytes); });
  return mixer.value();
}

std::size_t stateBytes(const LeafStorage& s) {
  std::size_t total = 0;
  visitState(s, true, [&](std::byte*, std::size_t bytes) { total += bytes; });
  return total;
}

/// The totals agree with the leaves' states, and every state is one.
bool isSound(const LeafArrays& a) {
  std::uint32_t in[8] = {};
  for (std::uint32_t i = 0; i < a.count; ++i) {
    ++in[a.meta[i] & kStateMask];
    if (stateOf(a.meta[i]) == LeafState::Attached && a.link[i] == kLoose) return false;
  }
  const auto is = [](std::int32_t total, std::uint32_t counted) {
    return total >= 0 && static_cast<std::uint32_t>(total) == counted;
  };
  return in[4] + in[5] + in[6] + in[7] == 0 && is(a.totals->attached, in[0]) && is(a.totals->airborne, in[1]) &&
         is(a.totals->grounded, in[2] + in[3]);
}

}  // namespace

std::uint64_t LeafField::hash() const {
  fetch();
  Mixer mixer;
  visitState(*storage_, true, [&](std::byte* data, std::size_t bytes) { mixer.add(data, bytes); });
  return mixer.value();
}

std::vector<std::uint8_t> LeafField::save() const {
  fetch();
  const LeafStorage& s = *storage_;
  Header header{.leaves = s.arrays.count,
                .links = s.links,
                .scene = fingerprint(s),
                .payload = hash(),
                .time = s.time,
                .dt = s.dt,
                .stepNumber = s.stepNumber};
  std::vector<std::uint8_t> bytes(sizeof(Header) + stateBytes(s));
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::size_t at = sizeof(header);
  visitState(s, true, [&](std::byte* data, std::size_t size) {
    if (size > 0) std::memcpy(bytes.data() + at, data, size);
    at += size;
  });
  return bytes;
}

Status LeafField::restore(std::span<const std::uint8_t> bytes) {
  fetch();
  LeafStorage& s = *storage_;
  Header header;
  if (bytes.size() < sizeof(header)) return Error{"the state of the leaves is cut short"};
  std::memcpy(&header, bytes.data(), sizeof(header));
  if (header.magic != kMagic) return Error{"this is not a state of leaves"};
  if (header.version != kVersion) {
    return Error{"the state of the leaves has version " + std::to_string(header.version) + "; this program reads " +
                 std::to_string(kVersion)};
  }
  if (header.leaves != s.arrays.count || header.links != s.links || header.scene != fingerprint(s)) {
    return Error{"the state of the leaves belongs to another scene"};
  }
  if (bytes.size() != sizeof(header) + stateBytes(s)) return Error{"the state of the leaves has the wrong length"};
  // Read into a block of its own first, so that bad bytes change nothing.
  const auto memory = std::make_unique<std::byte[]>(leafBlockBytes(s.arrays.count, s.links) + 64);
  LeafStorage read;
  read.arrays = leafArraysIn(memory.get(), s.arrays.count, s.links);
  read.links = s.links;
  std::size_t at = sizeof(header);
  Mixer mixer;
  visitState(read, true, [&](std::byte* data, std::size_t size) {
    if (size > 0) std::memcpy(data, bytes.data() + at, size);
    mixer.add(data, size);
    at += size;
  });
  std::copy_n(s.arrays.link, s.arrays.count, read.arrays.link);
  if (mixer.value() != header.payload || !(header.time >= 0) || !(header.dt > 0) || !isSound(read.arrays)) {
    return Error{"the state of the leaves is damaged"};
  }
  std::vector<std::byte*> from;
  visitState(read, true, [&](std::byte* data, std::size_t) { from.push_back(data); });
  std::size_t k = 0;
  visitState(s, true, [&](std::byte* data, std::size_t size) {
    if (size > 0) std::memcpy(data, from[k], size);
    ++k;
  });
  s.time = header.time;
  s.dt = header.dt;
  s.stepNumber = header.stepNumber;
  ahead_ = true;
  return ok();
}

}  // namespace windfall::sim
