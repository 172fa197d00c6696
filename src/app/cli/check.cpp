#include <cstdio>

#include "app/cli/commands.h"
#include "app/cli/interrupt.h"
#include "model/document/check_sources.h"
#include "model/document/project_file.h"

namespace windfall::app {

namespace {

QString counted(size_t count, const char* one, const char* many) {
  return QStringLiteral("%1 %2").arg(count).arg(QLatin1String(count == 1 ? one : many));
}

int check(const QString& path) {
  InterruptProgress progress;
  const Result<model::Project> project = model::readProject(path, progress);
  if (!project) return fail(path, project.error());
  const Result<QStringList> wrong = model::checkSources(*project, progress);
  if (!wrong) return fail(path, wrong.error());
  for (const QString& line : *wrong) fail(path, line);
  size_t variants = 0;
  for (const model::Leaf& leaf : project->leaves) variants += leaf.variants.size();
  const QString summary =
      QStringLiteral("%1 (%2), %3, %4 in the scene; schema %5; %6")
          .arg(counted(project->leaves.size(), "leaf", "leaves"), counted(variants, "texture", "textures"),
               counted(project->plants.size(), "plant", "plants"),
               counted(project->scene.trees.size(), "tree", "trees"))
          .arg(model::schemaVersion)
          .arg(wrong->isEmpty() ? QStringLiteral("sound")
                                : counted(static_cast<size_t>(wrong->size()), "fault", "faults"));
  std::printf("%s\n", qUtf8Printable(summary));
  return wrong->isEmpty() ? 0 : 1;
}

}  // namespace

void declareCheck(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("check", "Open a project as the editor would and say what is wrong with it");
  auto path = std::make_shared<std::string>();
  command->add_option("FILE.windfall", *path, "The project")->required();
  command->callback([path, &action] { action = [path] { return check(text(*path)); }; });
}

}  // namespace windfall::app
