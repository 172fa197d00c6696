#include <QBuffer>
#include <QDir>
#include <QFileInfo>
#include <QJsonDocument>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/document/durable_file.h"
#include "model/document/project_file.h"
#include "model/export/kept_textures.h"
#include "model/export/leaf_folder.h"
#include "model/leaf/atlas.h"

namespace windfall::app {

namespace {

struct AtlasOptions {
  std::string input, output;
  model::AtlasSettings settings;
};

Result<std::vector<model::LeafTexture>> texturesOf(const QString& path, model::Progress& progress) {
  if (QFileInfo(path).isDir()) return model::readLeafFolder(path);
  const Result<model::Project> project = model::readProject(path, progress);
  if (!project) return project.error();
  std::vector<model::LeafTexture> textures;
  for (const model::Leaf& leaf : project->leaves) {
    Result<std::vector<model::LeafTexture>> kept = model::keptTextures(leaf, progress);
    if (!kept) return Error{"leaf “" + leaf.name.toStdString() + "”: " + kept.error().message, kept.error().cancelled};
    for (model::LeafTexture& texture : *kept) textures.push_back(std::move(texture));
  }
  if (textures.empty()) return Error{"no variant is kept in it"};
  return textures;
}

int makeAtlas(const AtlasOptions& options) {
  InterruptProgress progress;
  const QString input = text(options.input), output = text(options.output);
  Result<std::vector<model::LeafTexture>> textures = texturesOf(input, progress);
  if (!textures) return fail(input, textures.error());
  const Result<model::Atlas> atlas = model::packAtlas(std::move(*textures), options.settings);
  if (!atlas) return fail(input, atlas.error());
  QByteArray png;
  QBuffer buffer(&png);
  if (!buffer.open(QIODevice::WriteOnly) || !atlas->image.save(&buffer, "PNG")) {
    return fail(output, QStringLiteral("the PNG cannot be made"));
  }
  QJsonObject description = model::describe(*atlas);
  description[QLatin1String("image")] = QStringLiteral("atlas.png");
  if (progress.cancelled()) return fail(output, Error{"cancelled", true});
  if (!QDir().mkpath(output)) return fail(output, QStringLiteral("the folder cannot be made"));
  const QDir folder(output);
  const std::pair<QString, QByteArray> files[] = {{"atlas.png", png},
                                                  {"atlas.json", QJsonDocument(description).toJson()}};
  for (const auto& [name, bytes] : files) {
    const QString path = folder.filePath(name);
    if (const Status written = model::writeDurably(path, bytes); !written) return fail(path, written.error());
  }
  return 0;
}

/// CLI11 knows no powers of two.
std::string wrongSize(const std::string& value) {
  bool number = false;
  const int size = text(value).toInt(&number);
  const bool power = number && size >= 64 && size <= 16384 && (size & (size - 1)) == 0;
  return power ? std::string() : "must be a power of two from 64 to 16384";
}

}  // namespace

void declareAtlas(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("atlas", "Pack leaf textures into one picture, with their places as JSON");
  auto options = std::make_shared<AtlasOptions>();
  command->add_option("PROJECT|DIR", options->input, "Project, or folder that windfall leaf wrote")->required();
  command->add_option("-o,--output", options->output, "Folder for atlas.png and atlas.json")->required();
  command->add_option("--size", options->settings.size, "Side of the atlas, px: a power of two")
      ->check(CLI::Validator(wrongSize, "POWER OF TWO"))
      ->capture_default_str();
  command->add_option("--padding", options->settings.padding, "Between leaves, px")
      ->check(CLI::Range(0, 512))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return makeAtlas(*options); }; });
}

}  // namespace windfall::app
