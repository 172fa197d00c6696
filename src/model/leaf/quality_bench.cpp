#include "model/leaf/quality_bench.h"

#include <QDir>
#include <QFileInfo>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "kernels/random.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/quality_baselines.h"
#include "model/leaf/region_match.h"
#include "model/leaf/working_colours.h"

namespace windfall::model {

namespace {

using Say = std::function<void(const std::string&)>;

/// A way to make textures, with its name in the table.
struct Method {
  std::string name;
  SynthesisParameters parameters;
};

std::vector<float> labOf(const QImage& image) {
  const cv::Mat3f lab = toLab(image);
  return {reinterpret_cast<const float*>(lab.datastart), reinterpret_cast<const float*>(lab.dataend)};
}

/// Means over seeds of what was made for one pair by one method.
class Collected {
 public:
  void add(const QualityTerms& terms, double copy) {
    terms_.push_back(terms);
    copy_ += copy;
  }
  void differ(double diversity) { diversity_ += diversity, ++compared_; }
  QualityRow row(const std::string& pair, const std::string& method) const {
    QualityRow row{pair, method, 0, 0, {}, 0, 0, 0};
    row.terms.coherence = row.terms.completeness = 0;
    const auto count = static_cast<double>(std::max<size_t>(1, terms_.size()));
    for (const QualityTerms& terms : terms_) {
      row.score += terms.score() / count;
      for (double QualityTerms::*term : kTerms) row.terms.*term += terms.*term / count;
    }
    for (const QualityTerms& terms : terms_) row.deviation += std::pow(terms.score() - row.score, 2) / count;
    row.deviation = std::sqrt(row.deviation);
    row.copyIndex = copy_ / count;
    row.diversity = compared_ > 0 ? diversity_ / compared_ : 0;
    return row;
  }

 private:
  static constexpr double QualityTerms::*kTerms[] = {
      &QualityTerms::colour,    &QualityTerms::texture,    &QualityTerms::patches,
      &QualityTerms::veins,     &QualityTerms::difference, &QualityTerms::bands,
      &QualityTerms::gradients, &QualityTerms::coherence,  &QualityTerms::completeness};
  std::vector<QualityTerms> terms_;
  double copy_ = 0, diversity_ = 0;
  int compared_ = 0;
};

class Bench {
 public:
  Bench(const QualityBenchOptions& options, const Say& say, Progress& progress)
      : options_(options), say_(say), progress_(progress) {}

  std::vector<QualityRow> run() {
    const QDir folder(options_.photos);
    QStringList names;
    for (const QString& file : folder.entryList({"*.jpg", "*.jpeg", "*.png"}, QDir::Files, QDir::Name)) names << file;
    if (options_.photos.isEmpty() || names.isEmpty()) {
      say_("leaf.quality: skipped, no photographs in \"" + options_.photos.toStdString() +
           "\" (--photos DIR or WINDFALL_PHOTOS)");
      return {};
    }
    const QString soybean = QStringLiteral("soybean_blue.jpg"), beech = QStringLiteral("beech_scan_a.jpg");
    say_(qualityHeading());
    for (const auto& [example, target] : {std::pair(soybean, beech), std::pair(beech, soybean)}) {
      if (names.contains(example) && names.contains(target)) {
        pair(example, target, true);
      } else {
        say_("skipped: " + example.toStdString() + " -> " + target.toStdString() + " (not in the folder)");
      }
    }
    QStringList others;
    for (const QString& name : names) {
      if (name != soybean && name != beech && stages(name)) others << name;
    }
    for (int i = 0; i < std::min<int>(options_.pairs, static_cast<int>(others.size())); ++i) {
      pair(others[i], others[(i + 1) % others.size()], false);
    }
    return std::move(rows_);
  }

 private:
  const LeafStages* stages(const QString& name) {
    if (const auto known = stages_.find(name); known != stages_.end()) return known->second ? &*known->second : nullptr;
    std::optional<LeafStages>& place = stages_[name];
    if (progress_.cancelled()) return nullptr;
    Result<SourceFile> source = readSourceFile(QDir(options_.photos).filePath(name));
    Leaf leaf;
    leaf.parameters.synthesis.size = options_.size;
    if (source) leaf.photo = std::move(*source);
    Result<LeafStages> made =
        source ? computeStages(leaf, Stage::Superpixels, progress_) : Result<LeafStages>(source.error());
    if (made) {
      place = std::move(*made);
    } else {
      say_("skipped: " + name.toStdString() + " (" + made.error().message + ")");
    }
    return place ? &*place : nullptr;
  }

  void pair(const QString& exampleName, const QString& targetName, bool withBaselines) {
    const LeafStages *example = stages(exampleName), *target = stages(targetName);
    if (!example || !target || progress_.cancelled()) return;
    const std::string name = QFileInfo(exampleName).completeBaseName().toStdString() + " -> " +
                             QFileInfo(targetName).completeBaseName().toStdString();
    const std::vector<float> colours = workingColours(*example);
    const ScoredLeaf source{&example->seen, colours};
    const QualityReference reference(source);
    const double ceiling = diversityCeiling(source);
    const std::vector<float> stretched =
        stretchRows(target->grown, workingAxis(*target), source, workingAxis(*example));
    const auto collect = [&](const std::string& method, const std::function<std::vector<float>(quint64)>& make) {
      Collected collected;
      std::vector<float> before;
      for (int seed = 1; seed <= options_.seeds && !progress_.cancelled(); ++seed) {
        ScoredLeaf made{&target->grown, make(static_cast<quint64>(seed))};
        if (made.lab.empty()) continue;
        collected.add(reference.score(made), copyIndex(made, stretched));
        if (!before.empty()) collected.differ(diversity(made, before));
        before = std::move(made.lab);
      }
      if (progress_.cancelled()) return;
      rows_.push_back(collected.row(name, method));
      rows_.back().ceiling = ceiling;
      say_(qualityLine(rows_.back()));
    };
    for (const Method& method : methods(withBaselines)) {
      if (method.name.find(options_.method) == std::string::npos) continue;
      collect(method.name, [&](quint64 seed) {
        const Result<QImage> made = synthesize(*target, *example, method.parameters, seed, progress_);
        if (!made && !made.error().cancelled)
          say_("skipped: " + name + ", " + method.name + ": " + made.error().message);
        return made ? labOf(*made) : std::vector<float>{};
      });
    }
    if (!withBaselines) return;
    for (const Baseline& baseline : naiveBaselines()) {
      if (baseline.name.find(options_.method) == std::string::npos) continue;
      collect(baseline.name, [&](quint64 seed) {
        RandomSequence random(seed, 211);
        const std::vector<int> match = matchRegions(target->grown, example->seen, random);
        return baseline.colour({*target, *example, colours, match, seed});
      });
    }
  }

  static std::vector<Method> methods(bool withBaselines) {
    const auto classic = [](std::string name, int levels, int candidates, int choices, bool detail) {
      Method method{std::move(name), {}};
      method.parameters.guided = false;
      method.parameters.levels = levels;
      method.parameters.candidates = candidates;
      method.parameters.choices = choices;
      method.parameters.detail = detail;
      return method;
    };
    const SynthesisParameters ours;
    std::vector<Method> methods{{"guided", ours}};
    methods.push_back(classic("classic with detail", ours.levels, ours.candidates, ours.choices, true));
    if (!withBaselines) return methods;
    methods.push_back(classic("classic", ours.levels, ours.candidates, ours.choices, false));
    methods.push_back(classic("classic with detail, N 16 M 6", 5, 16, 6, true));
    methods.push_back(classic("thesis: 5 levels, N 16 M 6", 5, 16, 6, false));
    methods.back().parameters.asThesis = true;
    methods.back().parameters.variety = 0;
    methods.push_back({"guided, without guides", ours});
    methods.back().parameters.guideWeight = 0;
    return methods;
  }

  const QualityBenchOptions& options_;
  const Say& say_;
  Progress& progress_;
  std::map<QString, std::optional<LeafStages>> stages_;
  std::vector<QualityRow> rows_;
};

}  // namespace

std::string qualityHeading() {
  return "leaf.quality: Q = 100 (A B C D)^(1/4), means over seeds\n"
         "  example -> target                          method                           Q    +-     A     B     C     D"
         "    dC  band  grad   coh  comp  copy  diversity  of";
}

std::string qualityLine(const QualityRow& row) {
  char text[256];
  const QualityTerms& t = row.terms;
  std::snprintf(text, sizeof text,
                "  %-42s %-30s %5.1f %5.1f %5.2f %5.2f %5.2f %5.2f %5.1f %5.2f %5.2f %5.2f %5.2f %5.2f %6.1f %6.1f",
                row.pair.c_str(), row.method.c_str(), row.score, row.deviation, t.colour, t.texture, t.patches, t.veins,
                t.difference, t.bands, t.gradients, t.coherence, t.completeness, row.copyIndex, row.diversity,
                row.ceiling);
  return text;
}

std::string qualityJson(const QualityRow& row) {
  char text[640];
  const QualityTerms& t = row.terms;
  std::snprintf(
      text, sizeof text,
      R"({"pair": "%s", "method": "%s", "q": %.6g, "deviation": %.6g, "colour": %.6g, "texture": %.6g, )"
      R"("patches": %.6g, "veins": %.6g, "difference": %.6g, "bands": %.6g, "gradients": %.6g, )"
      R"("coherence": %.6g, "completeness": %.6g, "copyIndex": %.6g, "diversity": %.6g, "diversityCeiling": %.6g})",
      row.pair.c_str(), row.method.c_str(), row.score, row.deviation, t.colour, t.texture, t.patches, t.veins,
      t.difference, t.bands, t.gradients, t.coherence, t.completeness, row.copyIndex, row.diversity, row.ceiling);
  return text;
}

std::vector<QualityRow> benchQuality(const QualityBenchOptions& options, const Say& say, Progress& progress) {
  return Bench(options, say, progress).run();
}

}  // namespace windfall::model
