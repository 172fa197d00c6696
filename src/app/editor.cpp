#include "app/editor.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QFileInfo>
#include <QSaveFile>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>

#include "app/cli/command.h"
#include "app/log.h"
#include "model/document/autosave.h"
#include "model/sample/sample_project.h"
#include "widgets/leaf/leaf_workspace.h"
#include "widgets/main_window/message_bar.h"
#include "widgets/main_window/project_files.h"
#include "widgets/plant/plant_workspace.h"
#include "widgets/scene/scene_workspace.h"
#include "widgets/viewport/viewport.h"

namespace windfall::app {

using widgets::MainWindow;
using widgets::Scheme;

Editor::Editor() : jobs_(std::make_unique<model::JobRunner>()) {
  const widgets::WorkspaceContext context{document_, *jobs_};
  window_ = std::make_unique<MainWindow>(context);
  // The tabs, in the order of the work.
  window_->addWorkspace(new widgets::LeafWorkspace(context, window_.get()));
  window_->addWorkspace(new widgets::PlantWorkspace(context, window_.get()));
  window_->addWorkspace(new widgets::SceneWorkspace(context, window_.get()));
  window_->files().setSampleMaker([](model::Progress& progress) { return model::sampleProject(progress); });
  window_->start();
}

Editor::~Editor() {
  jobs_->cancelAll();
  jobs_->waitForAll();
}

bool Editor::settle(double seconds) {
  QElapsedTimer clock;
  clock.start();
  // Twice in a row, with the events between: a finished job may start the next one.
  int quiet = 0;
  while (quiet < 3) {
    QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    quiet = window_->isSettled() ? quiet + 1 : 0;
    if (clock.elapsed() > 1000 * seconds) return false;
    QEventLoop loop;
    QTimer::singleShot(20, &loop, &QEventLoop::quit);
    loop.exec();
  }
  return true;
}

void Editor::startAutosave() {
  const std::vector<model::Recovery> left = model::findRecoveries();
  autosave_ = std::make_unique<model::Autosave>(document_);
  QObject::connect(autosave_.get(), &model::Autosave::failed, window_.get(),
                   [this](const QString& text) { window_->messages().showMessage(text, true); });
  if (left.empty()) return;
  const model::Recovery& recovery = left.front();
  const QString name = recovery.original.isEmpty() ? QCoreApplication::translate("Editor", "an unsaved project")
                                                   : QFileInfo(recovery.original).fileName();
  window_->messages().offer(
      QCoreApplication::translate("Editor", "Windfall ended unexpectedly; the work on %1 was kept").arg(name),
      QCoreApplication::translate("Editor", "Restore"), [this, recovery] {
        if (!window_->files().mayLeave()) return;
        model::Progress progress;
        const Status restored = autosave_->recover(recovery, progress);
        if (!restored) window_->messages().showMessage(QString::fromStdString(restored.error().message), true);
      });
}

namespace {

/// Shows, settles, grabs, writes: the picture is whole or absent.
int takeShot(const EditorOptions& options) {
  const Shot& shot = options.shot;
  Editor editor;
  MainWindow& window = editor.window();
  model::Progress progress;
  const Status loaded = editor.document().load(options.project, progress);
  if (!loaded) return fail(options.project, loaded.error());
  if (!window.workspace(shot.workspace)) {
    return fail({}, QCoreApplication::translate("Editor", "there is no workspace called %1").arg(shot.workspace));
  }
  window.openWorkspace(shot.workspace);
  window.setFixedSize(shot.size);
  window.show();
  if (!editor.settle(120)) {
    return fail(options.project, QCoreApplication::translate("Editor", "the window did not settle within 120 s"));
  }
  const QImage picture = window.grab().toImage();
  QSaveFile file(shot.file);
  if (!file.open(QIODevice::WriteOnly) || !picture.save(&file, "PNG") || !file.commit()) {
    return fail(shot.file, file.errorString());
  }
  return 0;
}

}  // namespace

int runEditor(int& argc, char** argv, const EditorOptions& options) {
  QCoreApplication::setOrganizationName(QStringLiteral("Windfall"));
  QCoreApplication::setApplicationName(QStringLiteral("windfall"));
  QCoreApplication::setApplicationVersion(QStringLiteral(WINDFALL_VERSION));
  QApplication application(argc, argv);
  const bool session = options.shot.file.isEmpty();
  // A shot shows the program as it comes, whatever the artist's own settings are.
  QTemporaryDir noSettings;
  if (!session) {
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, noSettings.path());
    QSettings().setValue(widgets::Viewport::kCoarseSetting, false);
  }
  const bool light = QSettings().value(QStringLiteral("look/light"), false).toBool() ||
                     qEnvironmentVariable("WINDFALL_LOOK") == QStringLiteral("light");
  widgets::applyLook(application, light ? Scheme::Light : Scheme::Dark);
  if (!session) return takeShot(options);

  startLog(options.verbose);
  qInfo("windfall %s", WINDFALL_VERSION);
  Editor editor;
  editor.startAutosave();
  editor.window().show();
  if (!options.project.isEmpty()) editor.window().files().openPath(options.project);
  return QApplication::exec();
}

}  // namespace windfall::app
