#include "model/plant/detail_mesh.h"

#include <algorithm>
#include <cmath>

#include "kernels/detail_select.h"

namespace windfall::model {

namespace {

constexpr std::uint32_t kPiece = 32;  ///< runs of a chain that share a resolution
constexpr float kTipLength = 0.8f;    ///< of the radius
constexpr float kTipSeen = 0.5f;      ///< a tip is drawn where the tolerance is below this share of its radius
constexpr float kDomeSeen = 0.08f;    ///< and its dome
constexpr float kKidChord = 0.1f;     ///< of the radius: a parent's chord may leave its curve by (4.1)
constexpr float kTaper = 0.85f;       ///< radii at the ends of a piece near the camera (5)
constexpr double kDroppedSeen = 0.7;  ///< share of dropped chains that nothing hides
constexpr double kMostWidening = 1.5;
constexpr float kForever = 1e30f;
constexpr float kMostAxial = 3;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

class Builder {
 public:
  Builder(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves, const RingSet& set,
          const DetailSource& source)
      : graph_(graph), chains_(chains), curves_(curves), set_(set), source_(source), parts_(chains.chains.size()) {}

  DetailMesh run();

 private:
  /// What one chain adds; indices count from its first ring and entry.
  struct Part {
    std::vector<DetailRing> rings;
    std::vector<DetailEntry> entries;
    std::vector<DetailChain> pieces;
    float visible = 0;  ///< length outside the parent, m
    float area = 0;     ///< of its outline, m2
  };
  void build(std::size_t c);
  DetailRing ringOf(const Ring& from, std::size_t c, const Ring& before, const Ring& after) const;
  static void addTip(Part& part);
  void addPiece(Part& part, std::size_t c, std::uint32_t first, std::uint32_t last, bool tip) const;
  DetailEntry entryOf(const Part& part, const Ring* rings, const ChainCurve& curve, std::uint32_t a,
                      std::uint32_t b) const;
  void widen(DetailMesh& mesh) const;

  const SkeletonGraph& graph_;
  const Chains& chains_;
  const std::vector<ChainCurve>& curves_;
  const RingSet& set_;
  const DetailSource& source_;
  std::vector<Part> parts_;
};

DetailRing Builder::ringOf(const Ring& from, std::size_t c, const Ring& before, const Ring& after) const {
  DetailRing out;
  out.position = from.position;
  out.radius = std::max(from.radius, 1e-5f);
  out.tangent = from.tangent;
  out.v = from.v;
  out.normal = from.normal;
  const float step = after.along - before.along;
  out.slope = step > 1e-7f ? std::clamp((after.radius - before.radius) / step, -2.0f, 2.0f) : 0;
  if (from.segment >= 0) {
    const std::int32_t link = source_.linkOfSegment.empty() ? from.segment : source_.linkOfSegment[at(from.segment)];
    out.link = static_cast<std::uint32_t>(std::max(link, 0));
  }
  const std::int32_t own = from.own >= 0 ? from.own : from.segment;
  if (own >= 0 && !source_.tint.empty()) out.tint = source_.tint[at(own)];
  if (from.flare > 0) out.reach = -source_.lobes * from.flare;
  const Pivot& pivot = curves_[c].pivot;
  const RingChain& chain = set_.chains[c];
  if (chains_.chains[c].parent >= 0 && chain.collarLength > 0 && from.along > 0.5f * chain.exit) {
    const vec3 arm = from.position - pivot.point, away = arm - pivot.tangent * glm::dot(arm, pivot.tangent);
    const float distance = glm::length(away);
    const float gap = (distance - pivot.radius) / chain.collarLength, reach = out.radius / chain.collarLength;
    if (distance > 1e-6f && gap - reach < 1) out.outwards = away / distance, out.gap = gap, out.reach = reach;
  }
  return out;
}

void Builder::addTip(Part& part) {
  const DetailRing end = part.rings.back();
  const auto index = static_cast<std::uint32_t>(part.rings.size()) - 1;
  const auto cap = [&](float x) {
    DetailRing ring = end;
    ring.position += end.tangent * (kTipLength * end.radius * x);
    ring.radius = end.radius * std::sqrt(std::max(0.0f, 1 - x * x));
    ring.slope = x < 1 ? -x / std::sqrt(1 - x * x) / kTipLength : -8;
    ring.v = end.v + barkRun(kTipLength * end.radius * x, end.radius, end.radius, 1);
    part.rings.push_back(ring);
  };
  cap(0.6f);
  cap(1);
  const auto add = [&](std::uint32_t a, std::uint32_t b, float from, float to) {
    DetailEntry entry;
    entry.ringA = a, entry.ringB = b, entry.from = from * end.radius, entry.to = to * end.radius;
    entry.radius = end.radius;
    part.entries.push_back(entry);
  };
  add(index, index + 1, 0, kDomeSeen);
  add(index + 1, index + 2, 0, kDomeSeen);
  add(index, index + 2, kDomeSeen, kTipSeen);
}

/// The piece of a curve between two rings that follow each other; nothing where there is none, below the ground.
struct Bend {
  float speedA = 1, speedB = 1;  ///< at its ends, in chords
  float sag = 0;                 ///< m
};

Bend bendOf(const ChainCurve& curve, const Ring& a, const Ring& b) {
  Bend bend;
  if (a.along < 0 || (a.span != b.span && a.t < 1)) return bend;
  const CurveSpan& span = curve.spans[at(b.span)];
  const float t0 = a.span == b.span ? a.t : 0, share = b.t - t0;
  const vec3 chord = b.position - a.position;
  const float length = glm::length(chord);
  if (!(length > 1e-7f)) return bend;
  bend.speedA = glm::length(span.derivative(t0)) * share / length;
  bend.speedB = glm::length(span.derivative(b.t)) * share / length;
  for (const float t : {0.25f, 0.5f, 0.75f}) {
    const vec3 off = span.point(t0 + share * t) - a.position;
    bend.sag = std::max(bend.sag, glm::length(off - chord * (glm::dot(off, chord) / (length * length))));
  }
  return bend;
}

DetailEntry Builder::entryOf(const Part& part, const Ring* rings, const ChainCurve& curve, std::uint32_t a,
                             std::uint32_t b) const {
  DetailEntry entry;
  entry.ringA = a, entry.ringB = b;
  bool kids = false;
  float speedA = 1, speedB = 1;
  for (std::uint32_t i = a; i < b; ++i) {
    const Bend bend = bendOf(curve, rings[i], rings[i + 1]);
    entry.sag = std::max(entry.sag, bend.sag);
    if (b == a + 1) speedA = bend.speedA, speedB = bend.speedB;
    kids = kids || rings[i].kids > 0;
  }
  const float ra = part.rings[a].radius, rb = part.rings[b].radius;
  entry.radius = std::max(ra, rb);
  float pieces = std::abs(std::log(rb / ra)) / -std::log(kTaper);
  if (kids) pieces = std::max(pieces, std::sqrt(entry.sag / (kKidChord * std::min(ra, rb))));
  const float axial = std::clamp(std::ceil(std::log2(std::max(pieces, 1.0f))), 0.0f, kMostAxial);
  entry.shape = detailShape(static_cast<std::uint32_t>(axial), speedA, speedB);
  return entry;
}

void Builder::addPiece(Part& part, std::size_t c, std::uint32_t first, std::uint32_t last, bool tip) const {
  const RingChain& chain = set_.chains[c];
  const Ring* rings = set_.rings.data() + chain.first;
  DetailChain piece;
  piece.firstEntry = static_cast<std::uint32_t>(part.entries.size());
  // Runs that stay the same over several levels are one entry.
  std::vector<std::vector<std::uint32_t>> kept(kDetailLevels);
  for (std::uint32_t k = 0; k < kDetailLevels; ++k) {
    if (k == 0) {
      for (std::uint32_t i = 0; i <= last - first; ++i) kept[0].push_back(i);
    } else {
      kept[k] = keptRings(rings + first, last - first + 1, detailTolerance(k), chain.collarLength / 6);
    }
  }
  for (std::uint32_t k = 0; k < kDetailLevels; ++k) {
    for (std::size_t i = 0; i + 1 < kept[k].size(); ++i) {
      const std::uint32_t a = kept[k][i], b = kept[k][i + 1];
      const auto has = [&](const std::vector<std::uint32_t>& level) {
        const auto found = std::lower_bound(level.begin(), level.end(), a);
        return found != level.end() && *found == a && found + 1 != level.end() && *(found + 1) == b;
      };
      if (k > 0 && has(kept[k - 1])) continue;
      std::uint32_t end = k + 1;
      while (end < kDetailLevels && has(kept[end])) ++end;
      const float from = detailTolerance(k);
      const float to = std::min(end < kDetailLevels ? detailTolerance(end) : kForever, std::max(part.visible, 1e-4f));
      if (from >= to) continue;
      DetailEntry entry = entryOf(part, rings, curves_[c], first + a, first + b);
      entry.from = from, entry.to = to;
      part.entries.push_back(entry);
    }
  }
  if (tip) addTip(part);
  piece.entryCount = static_cast<std::uint32_t>(part.entries.size()) - piece.firstEntry;
  const float half = 0.5f * (rings[first].along + rings[last].along);
  std::uint32_t middle = first;
  float widest = 0;
  for (std::uint32_t i = first; i <= last; ++i) {
    if (std::abs(rings[i].along - half) < std::abs(rings[middle].along - half)) middle = i;
    widest = std::max(widest, part.rings[i].radius);
  }
  piece.middle = middle;
  piece.radius =
      std::max(rings[last].along - rings[middle].along, rings[middle].along - rings[first].along) + 1.5f * widest;
  part.pieces.push_back(piece);
}

void Builder::build(std::size_t c) {
  const RingChain& chain = set_.chains[c];
  Part& part = parts_[c];
  const Segment& start = graph_.segments[chains_.links[chains_.chains[c].first]];
  if (chain.count < 2 || (start.kind == SegmentKind::Root && !source_.roots)) return;
  const Ring* rings = set_.rings.data() + chain.first;
  for (std::uint32_t i = 0; i < chain.count; ++i) {
    part.rings.push_back(ringOf(rings[i], c, rings[i > 0 ? i - 1 : 0], rings[std::min(i + 1, chain.count - 1)]));
    if (i > 0) part.area += (rings[i].along - rings[i - 1].along) * (part.rings[i].radius + part.rings[i - 1].radius);
  }
  part.visible = std::max(chain.length - chain.exit, 0.0f) + part.rings.back().radius;
  const std::uint32_t runs = chain.count - 1, pieces = (runs + kPiece - 1) / kPiece;
  for (std::uint32_t p = 0; p < pieces; ++p) {
    addPiece(part, c, runs * p / pieces, runs * (p + 1) / pieces, p + 1 == pieces);
  }
}

/// What straight runs lose on the curves and radii that they stand for is given back to what is thin; of what is
/// dropped with chains shorter than a tolerance a part, because twigs hide each other (6.4).
void Builder::widen(DetailMesh& mesh) const {
  for (std::uint32_t k = 1; k < kDetailLevels; ++k) {
    const float e = detailTolerance(k);
    double lost = 0, takes = 0;
    for (const Part& part : parts_) {
      if (part.rings.empty()) continue;
      if (part.visible <= e) {
        lost += kDroppedSeen * static_cast<double>(part.area);
        continue;
      }
      lost += static_cast<double>(part.area);
      for (const DetailEntry& entry : part.entries) {
        if (entry.from > e || entry.to <= e) continue;
        const DetailRing &a = part.rings[entry.ringA], &b = part.rings[entry.ringB];
        const float width = a.radius + b.radius, area = glm::distance(a.position, b.position) * width;
        lost -= static_cast<double>(area);
        takes += static_cast<double>(area * std::min(1.0f, 2 * e / width));
      }
    }
    mesh.widening[k] = takes > 0 ? static_cast<float>(std::clamp(lost / takes, 0.0, kMostWidening)) : 0;
  }
}

DetailMesh Builder::run() {
  const auto count = static_cast<std::int64_t>(parts_.size());
#pragma omp parallel for schedule(dynamic, 64) if (count > 64)
  for (std::int64_t c = 0; c < count; ++c) build(static_cast<std::size_t>(c));
  DetailMesh mesh;
  std::size_t rings = 0, entries = 0, pieces = 0;
  for (const Part& part : parts_) {
    rings += part.rings.size(), entries += part.entries.size(), pieces += part.pieces.size();
  }
  mesh.rings.reserve(rings), mesh.entries.reserve(entries), mesh.chains.reserve(pieces);
  for (const Part& part : parts_) {
    const auto firstRing = static_cast<std::uint32_t>(mesh.rings.size());
    const auto firstEntry = static_cast<std::uint32_t>(mesh.entries.size());
    for (DetailChain piece : part.pieces) {
      for (std::uint32_t i = 0; i < piece.entryCount; ++i) {
        DetailEntry entry = part.entries[piece.firstEntry + i];
        entry.ringA += firstRing, entry.ringB += firstRing;
        entry.chain = static_cast<std::uint32_t>(mesh.chains.size());
        mesh.entries.push_back(entry);
      }
      piece.middle += firstRing, piece.firstEntry += firstEntry;
      mesh.chains.push_back(piece);
    }
    mesh.rings.insert(mesh.rings.end(), part.rings.begin(), part.rings.end());
  }
  for (const DetailRing& ring : mesh.rings) mesh.links = std::max(mesh.links, ring.link + 1);
  widen(mesh);
  return mesh;
}

}  // namespace

DetailMesh makeDetail(const SkeletonGraph& graph, const Chains& chains, const std::vector<ChainCurve>& curves,
                      const RingSet& rings, const DetailSource& source) {
  return Builder(graph, chains, curves, rings, source).run();
}

namespace {

/// The table between its levels.
float at(const std::array<float, kDetailLevels>& table, float e) {
  for (std::uint32_t k = 1; k < kDetailLevels; ++k) {
    const float below = detailTolerance(k - 1), above = detailTolerance(k);
    if (e < above) return table[k - 1] + (table[k] - table[k - 1]) * (e - below) / (above - below);
  }
  return table[kDetailLevels - 1];
}

}  // namespace

DetailMesh scaled(DetailMesh mesh, float scale) {
  for (DetailRing& ring : mesh.rings) ring.position *= scale, ring.radius *= scale;
  for (DetailEntry& entry : mesh.entries) {
    entry.sag *= scale, entry.radius *= scale, entry.from *= scale;
    entry.to = std::min(entry.to * scale, kForever);
  }
  for (DetailChain& chain : mesh.chains) chain.radius *= scale;
  const auto table = mesh.widening;
  for (std::uint32_t k = 0; k < kDetailLevels; ++k) {
    mesh.widening[k] = at(table, detailTolerance(k) / scale);
  }
  return mesh;
}

}  // namespace windfall::model
