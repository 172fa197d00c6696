#include "model/leaf/texture_bench.h"

#include <omp.h>

#include <QBuffer>
#include <memory>

#include "kernels/random.h"
#include "model/leaf/smoothing.h"
#include "model/leaf/stages.h"
#include "model/leaf/superpixel_pyramid.h"
#include "model/leaf/superpixels.h"
#include "model/leaf/thesis_stages.h"
#include "model/leaf/working_colours.h"
#include "model/sample/leaf_painter.h"

namespace windfall::model {

namespace {

constexpr int kSide = 1024;

Leaf benchLeaf() {
  Leaf leaf;
  QBuffer buffer(&leaf.photo.bytes);
  buffer.open(QIODevice::WriteOnly);
  paintLeafPhoto({LeafShape::Ovate, 0.3, 0.5}, 1, kSide).photo.save(&buffer, "PNG");
  leaf.photo.name = QStringLiteral("painted.png");
  leaf.parameters.synthesis.size = kSide;
  return leaf;
}

SynthesisParameters settings(bool guided, bool detail) {
  SynthesisParameters parameters;
  parameters.guided = guided;
  parameters.detail = detail;
  return parameters;
}

void complain(const Error& error) { qWarning("%s", error.message.c_str()); }

/// Another seed for a leaf that is known.
std::vector<sim::Contender> variants() {
  Progress progress;
  Result<LeafStages> computed = computeStages(benchLeaf(), Stage::Superpixels, progress);
  if (!computed) return {};
  const auto stages = std::make_shared<const LeafStages>(std::move(*computed));
  const auto make = [stages](bool guided, bool detail, int threads) {
    return [stages, guided, detail, threads] {
      const int before = omp_get_max_threads();
      if (threads > 0) omp_set_num_threads(threads);
      Progress unwatched;
      const Result<QImage> made = synthesize(*stages, *stages, settings(guided, detail), 1, unwatched);
      omp_set_num_threads(before);
      if (!made) complain(made.error());
    };
  };
  return {{"guided", make(true, true, 0)},
          {"guided, 1 thread", make(true, true, 1)},
          {"classic", make(false, false, 0)},
          {"classic with detail", make(false, true, 0)}};
}

constexpr int kLevels[] = {64, 256, 1024, 4096, 16384};

/// The thesis's stages where ours differ: distances, five levels of SLIC each on its own (a peer's, or ours), 100
/// sweeps; of both leaves.
void thesisStages(const LeafStages& stages, const SlicPeer* peer) {
  const QSize size = stages.grown.distance.size;
  for (const LeafStructure* structure : {&stages.grown, &stages.seen}) {
    std::vector<Tissue> types(structure->regions.values.size(), Tissue::Outside);
    for (size_t i = 0; i < types.size(); ++i) {
      if (structure->regions.values[i] > 0) {
        types[i] = structure->veinDistance.values[i] > 0 ? Tissue::Blade : Tissue::Vein;
      }
    }
    const QPoint root = stages.toWorking(stages.root).toPoint();
    labelCorrectingDistance(types, size, root, {});
    for (const int count : kLevels) {
      if (peer) {
        peer->run(structure->distance, count);
      } else {
        makeSuperpixels(structure->distance, structure->regions, count);
      }
    }
  }
  std::vector<float> colours = workingColours(stages);
  std::vector<unsigned char> mask(stages.grown.regions.values.size());
  for (size_t i = 0; i < mask.size(); ++i) mask[i] = stages.grown.regions.values[i] > 0;
  smoothGaussSeidel(colours, mask, size, 4);
}

/// From the photo to the first variant.
std::vector<sim::Contender> wholeLeaves(const std::vector<SlicPeer>& peers) {
  const auto leaf = std::make_shared<const Leaf>(benchLeaf());
  const auto make = [leaf](bool guided, bool detail) {
    return [leaf, guided, detail] {
      Progress progress;
      const Result<LeafStages> stages = computeStages(*leaf, Stage::Superpixels, progress);
      if (!stages) return complain(stages.error());
      const Result<QImage> made = synthesize(*stages, *stages, settings(guided, detail), 1, progress);
      if (!made) complain(made.error());
    };
  };
  Progress progress;
  Result<LeafStages> computed = computeStages(*leaf, Stage::Superpixels, progress);
  if (!computed) return {};
  const auto stages = std::make_shared<const LeafStages>(std::move(*computed));
  std::vector<sim::Contender> all{{"guided, photo to variant", make(true, true)},
                                  {"classic, photo to variant", make(false, false)},
                                  {"classic with detail, photo to variant", make(false, true)},
                                  {"only the thesis's distances, SLIC of 5 levels, 100 Gauss-Seidel sweeps",
                                   [stages] { thesisStages(*stages, nullptr); }}};
  for (const SlicPeer& peer : peers) {
    if (!peer.run) continue;
    all.push_back({"the same with " + peer.name + " on each level", [stages, peer] { thesisStages(*stages, &peer); }});
  }
  return all;
}

/// Five levels of superpixels of one leaf.
std::vector<sim::Contender> superpixelLevels(const std::vector<SlicPeer>& peers) {
  Progress progress;
  Result<LeafStages> computed = computeStages(benchLeaf(), Stage::Superpixels, progress);
  if (!computed) return {};
  const auto structure = std::make_shared<LeafStructure>(computed->grown);
  std::vector<sim::Contender> all{{"finest level, the others merged from it",
                                   [structure] {
                                     structure->superpixels =
                                         makeSuperpixels(structure->distance, structure->regions, kLevels[4]);
                                     buildSuperpixelPyramid(*structure, nullptr, 5);
                                   }},
                                  {"our SLIC on each level", [structure] {
                                     for (const int count : kLevels)
                                       makeSuperpixels(structure->distance, structure->regions, count);
                                   }}};
  for (const SlicPeer& peer : peers) {
    if (!peer.run) continue;
    all.push_back({peer.name + " on each level", [structure, peer] {
                     for (const int count : kLevels) peer.run(structure->distance, count);
                   }});
  }
  return all;
}

std::vector<sim::Contender> stagesBefore() {
  const auto leaf = std::make_shared<const Leaf>(benchLeaf());
  return {{"photo to superpixels", [leaf] {
             Progress progress;
             const Result<LeafStages> stages = computeStages(*leaf, Stage::Superpixels, progress);
             if (!stages) complain(stages.error());
           }}};
}

std::vector<sim::Contender> distances() {
  Progress progress;
  const Result<LeafStages> stages = computeStages(benchLeaf(), Stage::Regions, progress);
  if (!stages) return {};
  std::vector<Tissue> types(stages->grown.regions.values.size(), Tissue::Outside);
  for (size_t i = 0; i < types.size(); ++i) {
    if (stages->grown.regions.values[i] > 0) {
      types[i] = stages->grown.veinDistance.values[i] > 0 ? Tissue::Blade : Tissue::Vein;
    }
  }
  const auto shared = std::make_shared<const std::vector<Tissue>>(std::move(types));
  const QSize size = stages->grown.distance.size;
  const QPoint root = stages->toWorking(stages->root).toPoint();
  return {{"bucket queue", [=] { structuralDistance(*shared, size, root, {}); }, 1},
          {"thesis: label-correcting rounds", [=] { labelCorrectingDistance(*shared, size, root, {}); }, 1}};
}

std::vector<sim::Contender> smoothings() {
  const QSize size(kSide, kSide);
  const auto pixels = static_cast<size_t>(kSide) * kSide;
  const auto start = std::make_shared<std::vector<float>>(3 * pixels);
  for (size_t i = 0; i < start->size(); ++i) (*start)[i] = 100 * uniform(1, static_cast<std::uint32_t>(i));
  const auto mask = std::make_shared<const std::vector<unsigned char>>(pixels, static_cast<unsigned char>(1));
  return {{"red-black over-relaxation to 1e-5, w1 4",
           [=] {
             std::vector<float> values = *start;
             smooth(values, *mask, size, 4, sweepsFor(4));
           },
           1},
          {"thesis: 100 Gauss-Seidel sweeps", [=] {
             std::vector<float> values = *start;
             smoothGaussSeidel(values, *mask, size, 4);
           }}};
}

}  // namespace

std::vector<sim::Benchmark> textureBenchmarks(const std::vector<SlicPeer>& peers) {
  std::string absent;
  for (const SlicPeer& peer : peers) {
    if (!peer.run) absent += " (skipped: " + peer.name + ")";
  }
  return {
      {"leaf.time.variant", "A further variant of 1024 px", "s", 1, variants},
      {"leaf.time.whole", "A leaf of 1024 px from its photo" + absent, "s", 1, [peers] { return wholeLeaves(peers); }},
      {"leaf.time.stages", "From a photo of 1024 px to its superpixels", "s", 1, stagesBefore},
      {"leaf.time.distance", "Structural distance of 1024 px", "ms", 1e3, distances},
      {"leaf.time.superpixels", "Five levels of superpixels, 1024 px" + absent, "ms", 1e3,
       [peers] { return superpixelLevels(peers); }},
      {"leaf.time.smoothing", "Smoothing of 1024 x 1024 px, three channels", "ms", 1e3, smoothings}};
}

}  // namespace windfall::model
