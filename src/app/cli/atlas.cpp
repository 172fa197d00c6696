#include <QFileInfo>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/document/project_file.h"
#include "model/export/atlas_files.h"
#include "model/export/kept_textures.h"
#include "model/export/leaf_folder.h"
#include "model/leaf/atlas.h"

namespace windfall::app {

namespace {

struct AtlasOptions {
  std::string input, output, packer = "plain", size = "auto";
  model::AtlasSettings settings;
  bool noRotation = false, mipFiles = false;
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
  model::AtlasSettings settings = options.settings;
  settings.size = options.size == "auto" ? 0 : text(options.size).toInt();
  settings.rotate = !options.noRotation;
  settings.packer = *model::packerOf(text(options.packer));
  const Result<model::Atlas> atlas = model::packAtlas(std::move(*textures), settings);
  if (!atlas) return fail(input, atlas.error());
  const QString stem = QStringLiteral("atlas");
  const Result<std::vector<model::NamedBytes>> files = model::atlasFiles(*atlas, settings, stem, options.mipFiles);
  if (!files) return fail(output, files.error());
  if (progress.cancelled()) return fail(output, Error{"cancelled", true});
  const Status written = model::writeTogether(output, *files, model::staleAtlasFiles(stem, *files));
  return written ? 0 : fail(output, written.error());
}

/// CLI11 knows no powers of two.
std::string wrongSize(const std::string& value) {
  if (value == "auto" || value == "0") return {};
  bool number = false;
  const int size = text(value).toInt(&number);
  const bool power = number && size >= 64 && size <= 16384 && (size & (size - 1)) == 0;
  return power ? std::string() : "must be auto or a power of two from 64 to 16384";
}

}  // namespace

void declareAtlas(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("atlas", "Pack leaf textures into one picture, with their places as JSON");
  auto options = std::make_shared<AtlasOptions>();
  command->add_option("PROJECT|DIR", options->input, "Project, or folder that windfall leaf wrote")->required();
  command->add_option("-o,--output", options->output, "Folder for atlas.png, its maps and atlas.json")->required();
  command
      ->add_option(
          "--size", options->size,
          "Side of the atlas, px: a power of two, or auto: the smallest that holds the leaves as large as wanted")
      ->check(CLI::Validator(wrongSize, "auto|POWER OF TWO"))
      ->capture_default_str();
  command
      ->add_option("--leaf-size", options->settings.leafPixels,
                   "Wanted long side of the largest leaf, px; 0: as its texture was made")
      ->check(CLI::Range(0, 8192))
      ->capture_default_str();
  command->add_option("--padding", options->settings.padding, "Between leaves at least, px")
      ->check(CLI::Range(0, 2048))
      ->capture_default_str();
  command
      ->add_option("--mips", options->settings.mipLevels,
                   "Mip levels that must stay free of neighbours: 8 px between leaves, doubled for each")
      ->check(CLI::Range(0, 12))
      ->capture_default_str();
  command
      ->add_option("--packer", options->packer,
                   "Maps for whom: plain (a file each), gltf, unity or unreal (channels packed their way)")
      ->check(CLI::IsMember({"plain", "gltf", "unity", "unreal"}))
      ->capture_default_str();
  command->add_flag("--no-rotation", options->noRotation, "Leaves never lie on their side");
  command->add_flag("--mip-files", options->mipFiles, "Also write the colour's mip levels, coverage kept");
  command->callback([options, &action] { action = [options] { return makeAtlas(*options); }; });
}

}  // namespace windfall::app
