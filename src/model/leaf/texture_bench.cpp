#include "model/leaf/texture_bench.h"

#include <omp.h>

#include <QBuffer>
#include <memory>

#include "model/leaf/stages.h"
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

std::vector<sim::Contender> textures() {
  Progress progress;
  Result<LeafStages> computed = computeStages(benchLeaf(), Stage::Superpixels, progress);
  if (!computed) return {};
  const auto stages = std::make_shared<const LeafStages>(std::move(*computed));
  const auto make = [stages](bool guided, int threads) {
    return [stages, guided, threads] {
      const int before = omp_get_max_threads();
      if (threads > 0) omp_set_num_threads(threads);
      SynthesisParameters parameters;
      parameters.guided = guided;
      Progress unwatched;
      const Result<QImage> made = synthesize(*stages, *stages, parameters, 1, unwatched);
      omp_set_num_threads(before);
      if (!made) qWarning("%s", made.error().message.c_str());
    };
  };
  return {{"guided", make(true, 0)},
          {"guided, 1 thread", make(true, 1)},
          {"classic (thesis, with detail)", make(false, 0)}};
}

std::vector<sim::Contender> stagesBefore() {
  const auto leaf = std::make_shared<const Leaf>(benchLeaf());
  return {{"photo to superpixels", [leaf] {
             Progress progress;
             const Result<LeafStages> stages = computeStages(*leaf, Stage::Superpixels, progress);
             if (!stages) qWarning("%s", stages.error().message.c_str());
           }}};
}

}  // namespace

std::vector<sim::Benchmark> textureBenchmarks() {
  return {{"textures", "Leaf textures of 1024 px", "s per texture", 1, textures},
          {"leaf-stages", "From a photo of 1024 px to its superpixels", "s per photo", 1, stagesBefore}};
}

}  // namespace windfall::model
