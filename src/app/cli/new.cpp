#include <QDir>
#include <QFileInfo>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/document/project_file.h"
#include "model/sample/new_project.h"
#include "model/sample/sample_project.h"

namespace windfall::app {

namespace {

struct NewOptions {
  std::string output;
  std::vector<std::string> photos, plants;
  int variants = 4;
};

Result<model::Project> makeProject(const NewOptions& options, model::Progress& progress) {
  if (options.photos.empty() && options.plants.empty()) return model::sampleProject(progress);
  std::vector<model::SourceFile> photos, plants;
  const auto readAll = [](const std::vector<std::string>& paths, std::vector<model::SourceFile>& files) -> Status {
    for (const std::string& path : paths) {
      Result<model::SourceFile> file = model::readSourceFile(text(path));
      if (!file) return Error{path + ": " + file.error().message};
      files.push_back(std::move(*file));
    }
    return ok();
  };
  if (const Status read = readAll(options.photos, photos); !read) return read.error();
  if (const Status read = readAll(options.plants, plants); !read) return read.error();
  return model::projectFromFiles(photos, plants, options.variants, progress);
}

int create(const NewOptions& options) {
  const QString output = text(options.output);
  // Said before minutes of work, not after.
  const QFileInfo target(output);
  if (target.isDir()) return fail(output, QStringLiteral("is a folder"));
  if (!target.absoluteDir().exists()) return fail(output, QStringLiteral("its folder does not exist"));
  InterruptProgress progress;
  const Result<model::Project> project = makeProject(options, progress);
  if (!project) return fail(QString(), project.error());
  if (const Status written = model::writeProject(*project, output, progress); !written) {
    return fail(output, written.error());
  }
  return 0;
}

}  // namespace

void declareNew(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("new", "Make a project from photos and plants, or the sample project");
  auto options = std::make_shared<NewOptions>();
  command->add_option("-o,--output", options->output, "The project to write (FILE.windfall)")->required();
  command->add_option("--photo", options->photos, "Photo of a leaf; may be given again");
  command->add_option("--plant", options->plants, "Plant file; may be given again");
  command->add_option("--variants", options->variants, "New textures for each photo")->check(CLI::Range(0, 999));
  command->callback([options, &action] { action = [options] { return create(*options); }; });
}

}  // namespace windfall::app
