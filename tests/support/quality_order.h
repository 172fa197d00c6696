// Scores of every way to colour a leaf, for tests of their order.
#pragma once

#include <QImage>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "kernels/random.h"
#include "model/leaf/quality.h"
#include "model/leaf/quality_baselines.h"
#include "model/leaf/region_match.h"
#include "model/leaf/vein_profile.h"
#include "model/leaf/working_colours.h"

namespace windfall::test {

struct OrderEntry {
  double score = 0, copyIndex = 0;  ///< means over the seeds
  double diversity = 0;             ///< between seeds
};
using QualityOrder = std::map<std::string, OrderEntry>;

/// CIE L*a*b* (D65) of a picture, three floats a pixel.
inline std::vector<float> labOf(const QImage& image) {
  const auto linear = [](int byte) {
    const double v = byte / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const auto root = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  std::vector<float> lab;
  lab.reserve(3 * static_cast<size_t>(image.width()) * static_cast<size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const uchar* p = image.constScanLine(y) + 4 * x;
      const double r = linear(p[0]), g = linear(p[1]), b = linear(p[2]);
      const double fx = root((0.412453 * r + 0.357580 * g + 0.180423 * b) / 0.950456),
                   fy = root(0.212671 * r + 0.715160 * g + 0.072169 * b),
                   fz = root((0.019334 * r + 0.119193 * g + 0.950227 * b) / 1.088754);
      for (const double v : {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)}) lab.push_back(static_cast<float>(v));
    }
  }
  return lab;
}

inline model::SynthesisParameters methodOf(const std::string& name) {
  model::SynthesisParameters parameters;
  parameters.guided = name == "guided";
  if (name == "thesis") {
    parameters.asThesis = true, parameters.detail = false, parameters.variety = 0;
    parameters.levels = 5, parameters.candidates = 16, parameters.choices = 6;
  }
  return parameters;
}

/// "guided", "classic with detail", "thesis", the naive baselines by their names, and "mean with veins": one colour
/// with the example's vein profile laid on, which is what a score made of profiles alone would take for a leaf.
inline QualityOrder qualityOrder(const model::LeafStages& target, const model::LeafStages& example, int seeds) {
  const std::vector<float> colours = model::workingColours(example);
  const model::ScoredLeaf source{&example.seen, colours};
  const model::QualityReference reference(source);
  const std::vector<float> stretched =
      model::stretchRows(target.grown, model::workingAxis(target), source, model::workingAxis(example));
  QualityOrder order;
  const auto collect = [&](const std::string& name, const auto& make) {
    OrderEntry& entry = order[name];
    std::vector<float> before;
    for (int seed = 1; seed <= seeds; ++seed) {
      model::ScoredLeaf made{&target.grown, make(static_cast<quint64>(seed))};
      if (made.lab.empty()) continue;
      entry.score += reference.score(made).score() / seeds;
      entry.copyIndex += model::copyIndex(made, stretched) / seeds;
      if (!before.empty()) entry.diversity += model::diversity(made, before) / (seeds - 1);
      before = std::move(made.lab);
    }
  };
  for (const char* name : {"guided", "classic with detail", "thesis"}) {
    collect(name, [&](quint64 seed) {
      model::Progress progress;
      const Result<QImage> image = model::synthesize(target, example, methodOf(name), seed, progress);
      return image ? labOf(*image) : std::vector<float>{};
    });
  }
  for (const model::Baseline& baseline : model::naiveBaselines()) {
    collect(baseline.name, [&](quint64 seed) {
      RandomSequence random(seed, 211);
      const std::vector<int> match = model::matchRegions(target.grown, example.seen, random);
      return baseline.colour({target, example, colours, match, seed});
    });
  }
  collect("mean with veins", [&](quint64 seed) {
    const std::vector<float> mean = model::naiveBaselines().front().colour({target, example, colours, {}, seed});
    const model::VeinFrame to =
        model::findVeinFrame(target.grown, model::workingAxis(target)[0], model::workingAxis(target)[1]);
    const model::VeinFrame from =
        model::findVeinFrame(example.seen, model::workingAxis(example)[0], model::workingAxis(example)[1]);
    return model::restoreVeins({target.grown, to, mean}, {example.seen, from, colours});
  });
  return order;
}

}  // namespace windfall::test
