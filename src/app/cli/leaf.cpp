#include <QElapsedTimer>
#include <QFileInfo>
#include <QImageReader>
#include <QStringList>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "app/cli/leaf_settings.h"
#include "model/export/compare_sheet.h"
#include "model/export/leaf_folder.h"
#include "model/leaf/joined_examples.h"
#include "model/leaf/marker_image.h"
#include "model/leaf/mask.h"
#include "model/leaf/mask_edit.h"
#include "model/leaf/stages.h"
#include "model/leaf/variant.h"
#include "model/leaf/vein_tracing.h"
#include "model/presets/preset.h"
#include "model/progress_part.h"

namespace windfall::app {

namespace {

struct LeafOptions {
  std::string photo, output, mask, veins, root, markers, ruler, mode = "guided";
  bool fillHoles = false, photoVeins = false, vary = false, inTurn = false;
  std::vector<std::string> examples, tips, settings;
  int which = 0;
  int variants = 2;
  int size = 1024;
  std::uint64_t seed = 1;
  std::string preset;
  std::optional<double> age, redness, relief, gloss;
  double temperature = model::AgeingParameters().temperature, wetness = model::AgeingParameters().wetness;
  double bladeLength = 100 * model::Leaf().bladeLength;
  bool compare = false;
};

/// What went wrong, and in which of the files.
struct Failure {
  QString file;
  Error error;
};

Result<QImage> readMarks(const QString& path, QSize wanted) {
  Result<model::SourceFile> source = model::readSourceFile(path);
  if (!source) return source.error();
  Result<QImage> image = model::readPhoto(*source);
  if (!image) return image.error();
  if (image->size() != wanted) {
    return Error{QStringLiteral("%1×%2 pixels where the photo has %3×%4")
                     .arg(image->width())
                     .arg(image->height())
                     .arg(wanted.width())
                     .arg(wanted.height())
                     .toStdString()};
  }
  return image->convertToFormat(QImage::Format_Grayscale8);
}

/// A preset by its name, the artist's own before a built-in one, or by its file.
Result<model::Preset> presetOf(const QString& nameOrFile) {
  if (nameOrFile.endsWith(QLatin1String(".json"))) return model::readPreset(nameOrFile);
  const model::PresetLibrary library;
  if (const auto found = library.find(QStringLiteral("leaf"), nameOrFile)) return *found;
  QStringList names;
  for (const model::Preset& preset : library.of(QStringLiteral("leaf"))) names << preset.name;
  return Error{("is no leaf preset; there are " + names.join(QStringLiteral(", "))).toStdString()};
}

/// Every number of "X,Y,…"; empty where one is none.
std::vector<double> numbersOf(const std::string& value) {
  std::vector<double> numbers;
  for (const QString& part : text(value).split(',')) {
    bool good = false;
    numbers.push_back(part.toDouble(&good));
    if (!good || !std::isfinite(numbers.back())) return {};
  }
  return numbers;
}

/// "X,Y", already checked.
QPointF pointOf(const std::string& value) {
  const std::vector<double> n = numbersOf(value);
  return {n[0], n[1]};
}

/// The mask of one of the leaves that a photo shows, 1: the largest.
Result<QImage> oneOfSeveral(const QImage& picture, const model::Leaf& leaf, int which) {
  QImage first = leaf.mask;
  if (first.isNull()) {
    model::Progress progress;
    Result<QImage> found = model::automaticMask(picture, leaf.parameters.mask, progress);
    if (!found) return found.error();
    first = std::move(*found);
  }
  std::vector<QImage> leaves = model::separateLeaves(picture, first);
  if (static_cast<size_t>(which) > leaves.size()) {
    return Error{"there is no leaf " + std::to_string(which) + " in it, only " + std::to_string(leaves.size())};
  }
  return std::move(leaves[static_cast<size_t>(which) - 1]);
}

/// The leaf asset that the options describe; `failure` says why there is none.
bool describeLeaf(const LeafOptions& options, model::Leaf& leaf, Failure& failure) {
  const QString photo = text(options.photo);
  const auto fails = [&](const QString& file, const Error& error) {
    failure = {file, error};
    return false;
  };
  Result<model::SourceFile> source = model::readSourceFile(photo);
  if (!source) return fails(photo, source.error());
  leaf.photo = std::move(*source);
  leaf.name = QFileInfo(photo).completeBaseName();
  leaf.bladeLength = options.bladeLength / 100;
  if (!options.preset.empty()) {
    const Result<model::Preset> preset = presetOf(text(options.preset));
    if (!preset) return fails(text(options.preset), preset.error());
    if (const Status applied = model::applyPreset(*preset, leaf.parameters); !applied) {
      return fails(text(options.preset), applied.error());
    }
  }
  const auto given = [](const std::optional<double>& from, double& to) { to = from.value_or(to); };
  given(options.age, leaf.parameters.ageing.age);
  given(options.redness, leaf.parameters.ageing.redness);
  given(options.relief, leaf.parameters.maps.relief);
  given(options.gloss, leaf.parameters.maps.gloss);
  leaf.parameters.ageing.temperature = options.temperature;
  leaf.parameters.ageing.wetness = options.wetness;
  leaf.parameters.synthesis.size = options.size;
  leaf.parameters.synthesis.guided = options.mode == "guided";
  if (options.mode == "thesis") {
    leaf.parameters.synthesis.asThesis = true;
    leaf.parameters.synthesis.levels = 5;
    leaf.parameters.synthesis.detail = false;
  }
  leaf.parameters.veins.seed = options.seed;
  leaf.parameters.veins.fromPhoto = options.photoVeins;
  leaf.parameters.mask.keepHoles = !options.fillHoles;
  leaf.parameters.shape.vary = options.vary;
  leaf.parameters.regions.mix = !options.inTurn;
  if (const Status set = setParameters(options.settings, leaf.parameters); !set) {
    return fails(QStringLiteral("--set"), set.error());
  }
  if (!options.ruler.empty()) {
    const std::vector<double> n = numbersOf(options.ruler);
    leaf.ruler = {QPointF(n[0], n[1]), QPointF(n[2], n[3]), n[4]};
  }
  const bool marked = !options.mask.empty() || !options.markers.empty() || !options.root.empty() ||
                      !options.tips.empty() || options.which > 0;
  if (!marked) return true;
  const Result<QImage> picture = model::readPhoto(leaf.photo);
  if (!picture) return fails(photo, picture.error());
  if (!options.mask.empty()) {
    const Result<QImage> mask = readMarks(text(options.mask), picture->size());
    if (!mask) return fails(text(options.mask), mask.error());
    leaf.mask = *mask;
  }
  if (options.which > 0) {
    Result<QImage> mask = oneOfSeveral(*picture, leaf, options.which);
    if (!mask) return fails(photo, mask.error());
    leaf.mask = std::move(*mask);
  }
  if (!options.markers.empty()) {
    const Result<QImage> spots = readMarks(text(options.markers), picture->size());
    if (!spots) return fails(text(options.markers), spots.error());
    leaf.markers = model::markersOf(*spots);
    if (leaf.markers.empty()) return fails(text(options.markers), Error{"no white spot in it: there are no markers"});
  }
  if (!options.root.empty()) {
    leaf.root = pointOf(options.root);
    if (!QRectF(picture->rect()).contains(*leaf.root)) return fails(photo, Error{"--root lies outside the picture"});
  }
  for (const std::string& tip : options.tips) {
    leaf.tips.push_back(pointOf(tip));
    if (!QRectF(picture->rect()).contains(leaf.tips.back())) {
      return fails(photo, Error{"--tip lies outside the picture"});
    }
  }
  return true;
}

/// "X1,Y1,X2,Y2,METRES".
std::string wrongRuler(const std::string& value) {
  const std::vector<double> n = numbersOf(value);
  const bool good = n.size() == 5 && n[4] > 0 && n[4] <= 1000 && (n[0] != n[2] || n[1] != n[3]);
  return good ? std::string() : "must be two different places in pixels and the metres between them, X1,Y1,X2,Y2,M";
}

/// Veins drawn elsewhere; they need the root of the leaf.
Result<model::Veins> readVeins(const QString& path, const model::Leaf& leaf, model::LeafStages& known,
                               model::Progress& progress) {
  Result<model::LeafStages> stages = model::computeStages(leaf, model::Stage::Contour, progress);
  if (!stages) return stages.error();
  known = std::move(*stages);
  const Result<QImage> picture = readMarks(path, known.photo.size());
  if (!picture) return picture.error();
  model::Veins veins = model::readVeinPicture(*picture, {known.root, known.tip, known.petiole});
  if (veins.empty()) return Error{"no line in it"};
  return veins;
}

/// "X,Y", two numbers.
std::string wrongPoint(const std::string& value) {
  return numbersOf(value).size() == 2 ? std::string() : "must be two numbers, X,Y in pixels of the photo";
}

int makeLeaf(const LeafOptions& options) {
  InterruptProgress progress;
  const QString photo = text(options.photo);
  model::Leaf leaf;
  Failure failure;
  if (!describeLeaf(options, leaf, failure)) return fail(failure.file, failure.error);

  model::ProgressPart shape(progress, 0, 0.4);
  model::LeafStages known;
  if (!options.veins.empty()) {
    Result<model::Veins> veins = readVeins(text(options.veins), leaf, known, shape);
    if (!veins) return fail(text(options.veins), veins.error());
    leaf.veins = std::move(*veins);
  }
  const Result<model::LeafStages> stages = model::computeStages(leaf, model::Stage::Superpixels, shape, &known);
  if (!stages) return fail(photo, stages.error());
  if (const Status good = model::checkMarkers(*stages); !good) return fail(text(options.markers), good.error());
  if (const int leaves = options.which > 0 ? 1 : model::leavesInMask(stages->mask); leaves > 1) {
    std::fprintf(stderr, "windfall: %s: shows %d leaves as one; --leaf 1 to %d takes one of them\n",
                 qUtf8Printable(photo), leaves, leaves);
  }
  QElapsedTimer clock;
  clock.start();
  std::map<QString, double> seconds;
  std::vector<model::LeafStages> examples;
  for (const std::string& file : options.examples) {
    Result<model::SourceFile> source = model::readSourceFile(text(file));
    if (!source) return fail(text(file), source.error());
    model::Leaf example;
    example.photo = std::move(*source);
    example.parameters = leaf.parameters;
    Result<model::LeafStages> its = model::computeStages(example, model::Stage::Superpixels, shape);
    if (!its) return fail(text(file), its.error());
    examples.push_back(std::move(*its));
  }
  examples = model::lendersOf(*stages, std::move(examples));
  if (!examples.empty()) seconds[QStringLiteral("examples")] = static_cast<double>(clock.nsecsElapsed()) * 1e-9;

  model::LeafFolder folder;
  folder.stages = &*stages;
  folder.bladeLength = stages->bladeLength;
  folder.parameters = leaf.parameters;
  for (int i = 0; i < options.variants; ++i) {
    QElapsedTimer timer;
    timer.start();
    const double share = 0.5 / options.variants;
    model::ProgressPart part(progress, 0.4 + i * share, 0.4 + (i + 1) * share);
    const auto index = static_cast<size_t>(i);
    const quint64 seed = options.seed + index;
    Result<model::Variant> variant = model::makeVariant(*stages, examples, seed, part);
    if (!variant) return fail(photo, variant.error());
    folder.seeds.push_back(seed);
    folder.variants.push_back(std::move(variant->image));
    folder.variantSeconds.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-9);
  }
  if (options.compare) {
    model::ProgressPart comparing(progress, 0.9, 0.95);
    clock.restart();
    Result<QImage> sheet = model::compareMethods(*stages, examples, leaf.parameters.synthesis, options.seed, comparing);
    if (!sheet) return fail(photo, sheet.error());
    folder.compare = std::move(*sheet);
    seconds[QStringLiteral("compare")] = static_cast<double>(clock.nsecsElapsed()) * 1e-9;
  }
  folder.otherSeconds = std::move(seconds);
  model::ProgressPart writing(progress, 0.95, 1);
  const Status written = model::writeLeafFolder(folder, text(options.output), writing);
  return written ? 0 : fail(text(options.output), written.error());
}

}  // namespace

void declareLeaf(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("leaf", "Make leaf textures from a photo, and show every stage of the way");
  auto options = std::make_shared<LeafOptions>();
  command->add_option("PHOTO", options->photo, "Photo that gives the shape (JPEG, PNG)")->required();
  command->add_option("-o,--output", options->output, "Folder for the pictures and numbers")->required();
  command->add_option("--mask", options->mask, "Mask in the photo's size, white leaf; found without it");
  command->add_flag("--fill-holes", options->fillHoles, "Holes in the blade belong to the leaf");
  command->add_option("--veins", options->veins, "Lines in the photo's size, drawn elsewhere; grown without it");
  command->add_flag("--photo-veins", options->photoVeins, "The veins that the photo shows, instead of grown ones");
  command->add_flag("--vary", options->vary, "Every texture gets an outline and veins of its own");
  command
      ->add_option("--ruler", options->ruler,
                   "X1,Y1,X2,Y2,METRES: two places of the photo and their distance; the leaf's real size follows")
      ->check(CLI::Validator(wrongRuler, "X1,Y1,X2,Y2,METRES"));
  command->add_option("--root", options->root, "X,Y: where the petiole meets the blade, in pixels; found without it")
      ->check(CLI::Validator(wrongPoint, "X,Y"));
  command->add_option("--tip", options->tips, "X,Y: where a main vein ends; several for several; found without it")
      ->check(CLI::Validator(wrongPoint, "X,Y"))
      ->expected(1)
      ->take_all();
  command->add_option("--leaf", options->which, "Which of several leaves in the photo, 1: the largest")
      ->check(CLI::Range(1, 100));
  command->add_option("--markers", options->markers, "White spots in the photo's size, one a region; found without it");
  command
      ->add_option("--example", options->examples,
                   "Photo that gives the colours (default: PHOTO); of several every texture takes regions of all")
      ->expected(1)
      ->take_all();
  command->add_flag("--in-turn", options->inTurn, "Of several examples each texture takes one, in turn");
  command
      ->add_option("--mode", options->mode,
                   "guided: patches that lie along the veins; classic: superpixels, smoothed, with a layer of detail; "
                   "thesis: classic as the thesis has it")
      ->check(CLI::IsMember({"guided", "classic", "thesis"}))
      ->capture_default_str();
  command->add_option("--variants", options->variants, "How many textures")
      ->check(CLI::Range(0, 999))
      ->capture_default_str();
  command->add_option("--size", options->size, "Long side of the textures, px")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  command->add_option("--preset", options->preset, "Species: a leaf preset's name, or its file");
  command
      ->add_option(
          "--set", options->settings,
          "NAME=VALUE: any number of the inspector by its name in project.json, as veins.laterals=6, "
          "veins.mains=5, epsilon=3, costs.tissueTissue=10, shape.holes=2, synthesis.levels=5; may be repeated")
      ->check(CLI::Validator(wrongAssignment, "NAME=VALUE"))
      ->expected(1)
      ->take_all();
  command->add_option("--blade-length", options->bladeLength, "From root to tip in the real world, cm")
      ->check(CLI::Range(0.1, 500.0))
      ->capture_default_str();
  command->add_option("--relief", options->relief, "Strength of the normal map; 1 as measured, glossy leaves 0.5")
      ->check(CLI::Range(0.0, 10.0));
  command->add_option("--gloss", options->gloss, "0 dull .. 1 waxy: roughness")->check(CLI::Range(0.0, 1.0));
  command->add_option("--age", options->age, "0 as photographed .. 1 brown and dry")->check(CLI::Range(0.0, 1.0));
  command->add_option("--temperature", options->temperature, "Of the autumn's days, degrees Celsius")
      ->check(CLI::Range(-30.0, 40.0))
      ->capture_default_str();
  command->add_option("--wetness", options->wetness, "0 dry air .. 1 rain")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->add_option("--redness", options->redness, "0 turns yellow .. 1 turns red")->check(CLI::Range(0.0, 1.0));
  command->add_option("--seed", options->seed, "Seed of veins and textures")->capture_default_str();
  command->add_flag("--compare", options->compare,
                    "Write compare.png too: the photograph, and three seeds of either mode beside it");
  command->callback([options, &action] { action = [options] { return makeLeaf(*options); }; });
}

}  // namespace windfall::app
