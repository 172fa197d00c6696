// The window's frame: assets, palette, files, layout.
#include <QApplication>
#include <QFileInfo>
#include <QKeySequenceEdit>
#include <QLineEdit>
#include <QListWidget>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QtTest>

#include "app/editor.h"
#include "model/document/project_file.h"
#include "support/fbx_fixture.h"
#include "support/painted_leaf.h"
#include "support/suite.h"
#include "widgets/leaf/image_pane.h"
#include "widgets/leaf/leaf_workspace.h"
#include "widgets/leaf/stage_bar.h"
#include "widgets/look/look.h"
#include "widgets/main_window/asset_tree.h"
#include "widgets/main_window/command_palette.h"
#include "widgets/main_window/message_bar.h"
#include "widgets/main_window/project_files.h"
#include "widgets/main_window/shortcut_dialog.h"
#include "widgets/main_window/shortcut_table.h"

using namespace windfall;
using namespace windfall::widgets;

class MainWindowTest : public QObject {
  Q_OBJECT

  std::unique_ptr<app::Editor> editor_;

  MainWindow& window() { return editor_->window(); }
  model::Document& document() { return editor_->document(); }
  LeafWorkspace& leaf() { return *qobject_cast<LeafWorkspace*>(window().workspace(QStringLiteral("leaf"))); }
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) {
    QWidget* focus = QApplication::focusWidget();
    QTest::keyClick(focus ? focus : &window(), key, modifiers);
  }
  void dropFile(const QString& path) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path)});
    QDragEnterEvent enter(QPoint(400, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop(QPointF(400, 400), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window(), &drop);
  }

 private slots:
  void initTestCase() { applyLook(*qApp, Scheme::Dark); }

  void init() {
    QSettings().clear();
    editor_ = std::make_unique<app::Editor>();
    window().resize(1440, 900);
    window().show();
    QVERIFY(QTest::qWaitForWindowActive(&window()));
  }
  void cleanup() { editor_.reset(); }

  void anEmptyProjectSaysWhatToDoNext() {
    QVERIFY(editor_->settle(30));
    QVERIFY(window().grab().save(test::outputFolder() + "/window_welcome.png"));
    const QList<QPushButton*> buttons = window().centralWidget()->findChildren<QPushButton*>();
    QVERIFY(std::any_of(buttons.begin(), buttons.end(), [](const QPushButton* button) {
      return button->isVisible() && button->property("primary").toBool();
    }));
  }

  void renamingInPlaceIsOneUndoStep() {
    const model::AssetId id = document().addLeaf(test::paintedLeaf());
    document().undoStack().clear();
    AssetTree& assets = window().assets();
    assets.select(id);
    assets.setFocus();
    QTest::keyClick(&assets, Qt::Key_F2);
    auto* edit = assets.findChild<QLineEdit*>();
    QVERIFY(edit);
    QTest::keyClicks(edit, QStringLiteral("Oak of the lane"));
    QTest::keyClick(edit, Qt::Key_Return);
    QTRY_COMPARE(document().project().leaf(id)->name, QStringLiteral("Oak of the lane"));
    QCOMPARE(document().undoStack().count(), 1);
    press(Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(document().project().leaf(id)->name, QStringLiteral("painted"));
    QCOMPARE(assets.itemOf(id)->text(0), QStringLiteral("painted"));
  }

  void aCheckBoxHangsALeafOnATree() {
    const model::AssetId id = document().addLeaf(test::paintedLeaf());
    model::Plant plant;
    plant.name = QStringLiteral("birch");
    plant.grower = model::GrowerSettings();
    const model::AssetId birch = document().addPlant(plant);
    QTreeWidgetItem* row = window().assets().leafRow(birch, id);
    QVERIFY(row);
    QCOMPARE(row->checkState(0), Qt::Unchecked);
    row->setCheckState(0, Qt::Checked);
    QTRY_COMPARE(document().project().plant(birch)->leaves, std::vector<model::AssetId>{id});
    document().undoStack().undo();
    QVERIFY(document().project().plant(birch)->leaves.empty());
    QCOMPARE(window().assets().leafRow(birch, id)->checkState(0), Qt::Unchecked);
  }

  void assetsAreDuplicatedAndDeletedByKeys() {
    const model::AssetId id = document().addLeaf(test::paintedLeaf());
    AssetTree& assets = window().assets();
    assets.select(id);
    assets.setFocus();
    QTest::keyClick(&assets, Qt::Key_D, Qt::ControlModifier);
    QCOMPARE(document().project().leaves.size(), std::size_t(2));
    QTest::keyClick(&assets, Qt::Key_Delete);
    QCOMPARE(document().project().leaves.size(), std::size_t(1));
    QVERIFY(editor_->settle(30));
  }

  void thePaletteFindsAndRunsAnAction() {
    document().addLeaf(test::paintedLeaf());
    window().openWorkspace(QStringLiteral("leaf"));
    QVERIFY(editor_->settle(30));
    press(Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
    CommandPalette& palette = window().commands();
    QVERIFY(palette.isVisible());
    QTest::keyClicks(palette.input(), QStringLiteral("zm 100"));
    QCOMPARE(palette.list()->currentItem()->text(), QStringLiteral("Zoom to 100 %"));
    QVERIFY(window().grab().save(test::outputFolder() + "/window_palette.png"));
    QTest::keyClick(palette.input(), Qt::Key_Return);
    QVERIFY(!palette.isVisible());
    QCOMPARE(leaf().pane().zoom(), 1.0);
    press(Qt::Key_P, Qt::ControlModifier | Qt::ShiftModifier);
    QTest::keyClick(palette.input(), Qt::Key_Escape);
    QVERIFY(!palette.isVisible());
  }

  void fuzzySearchPrefersStartsOfWords() {
    QVERIFY(CommandPalette::score(QStringLiteral("sa"), QStringLiteral("Save As")) >
            CommandPalette::score(QStringLiteral("sa"), QStringLiteral("Mask eraser")));
    QVERIFY(CommandPalette::score(QStringLiteral("xyz"), QStringLiteral("Save")) < 0);
    QVERIFY(CommandPalette::score({}, QStringLiteral("Save")) >= 0);
  }

  void aDroppedPhotoBecomesALeaf() {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("lime.png"));
    QVERIFY(test::paintedLeafPhoto().save(path));
    dropFile(path);
    QTRY_COMPARE(document().project().leaves.size(), std::size_t(1));
    QCOMPARE(document().project().leaves[0].name, QStringLiteral("lime"));
    QVERIFY(editor_->settle(60));
    QCOMPARE(window().current()->id(), QStringLiteral("leaf"));
    QCOMPARE(leaf().pane().base().size(), QSize(480, 640));
  }

  void aDroppedFileThatIsNoPictureChangesNothing() {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("broken.png"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("no picture at all");
    file.close();
    dropFile(path);
    QTRY_VERIFY(window().messages().isError());
    QVERIFY(window().messages().text().contains(QStringLiteral("broken.png")));
    QVERIFY(document().project().leaves.empty());
    dropFile(folder.filePath(QStringLiteral("what.xyz")));
    QVERIFY(window().messages().text().startsWith(QStringLiteral("what.xyz")));
  }

  void aDroppedTreeThatCannotBeUsedIsToldInOneLine_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("told");
    QByteArray figure = test::fbxFixture(1, 1);
    QTest::newRow("cut off") << figure.left(figure.size() / 2) << "half.fbx"
                             << "half.fbx: is cut off";
    figure.replace("\"OO\",40,10", "\"OO\",40,20");
    QTest::newRow("no skeleton") << figure << "stone.fbx"
                                 << "has no armature";
    QTest::newRow("no glTF") << QByteArray("glTF is not this") << "tree.glb"
                             << "tree.glb: ";
    QTest::newRow("no plant") << QByteArray("AGRO") << "plant.prim"
                              << "plant.prim: ";
  }
  void aDroppedTreeThatCannotBeUsedIsToldInOneLine() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, name);
    QFETCH(QString, told);
    QTemporaryDir folder;
    QFile file(folder.filePath(name));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
    file.close();
    const model::Project before = document().project();
    dropFile(file.fileName());
    QTRY_VERIFY(window().messages().isError());
    const QString text = window().messages().text();
    QVERIFY2(text.contains(name) && text.contains(told) && !text.contains('\n'), qPrintable(text));
    QVERIFY(document().project() == before);
    QVERIFY(!window().isWindowModified());
  }

  void savingAndReopeningKeepsMarksAndView() {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("wood.windfall"));
    const model::AssetId id = document().addLeaf(test::paintedLeaf());
    window().openWorkspace(QStringLiteral("leaf"));
    leaf().show(id);
    leaf().setStage(model::Stage::Contour);
    QVERIFY(editor_->settle(60));
    document().setLeaf(id, &model::Leaf::root, std::optional<QPointF>(QPointF(250, 530)), model::Aspect::LeafRoot,
                       QStringLiteral("root"));
    leaf().pane().setView(2.5, {200, 300});
    QVERIFY(window().isWindowModified());
    QVERIFY(window().files().saveTo(path));
    QVERIFY(!window().isWindowModified());
    QVERIFY(window().windowTitle().startsWith(QStringLiteral("wood[*]")));

    editor_ = std::make_unique<app::Editor>();
    window().resize(1440, 900);
    window().show();
    window().files().openPath(path);
    QTRY_COMPARE(document().project().leaves.size(), std::size_t(1));
    QVERIFY(editor_->settle(60));
    QCOMPARE(document().project().leaf(id)->root, std::optional<QPointF>(QPointF(250, 530)));
    QCOMPARE(window().current()->id(), QStringLiteral("leaf"));
    QCOMPARE(leaf().pane().zoom(), 2.5);
    QCOMPARE(leaf().pane().center(), QPointF(200, 300));
    QVERIFY(leaf().stageBar().chip(model::Stage::Contour)->isChecked());
    QVERIFY(!window().isWindowModified());
  }

  void editsMadeWhileTheProjectIsWrittenStayUnsaved() {
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("wood.windfall"));
    document().addLeaf(test::paintedLeaf());
    window().files().startSaving(path);
    document().addLeaf(test::paintedLeaf());
    QTRY_COMPARE(document().path(), path);
    QVERIFY(window().isWindowModified());
    window().files().save();
    QTRY_VERIFY(!window().isWindowModified());
    model::Progress progress;
    QCOMPARE(model::readProject(path, progress)->leaves.size(), std::size_t(2));
  }

  void aFolderThatTakesNoFileIsToldAndTheEditsStayUnsaved() {
    QTemporaryDir folder;
    document().addLeaf(test::paintedLeaf());
    QVERIFY(!window().files().saveTo(folder.filePath(QStringLiteral("missing/wood.windfall"))));
    QVERIFY(window().messages().isError());
    QVERIFY(window().isWindowModified());
    QVERIFY(document().path().isEmpty());
  }

  void aProjectThatCannotBeReadChangesNothing() {
    document().addLeaf(test::paintedLeaf());
    document().undoStack().setClean();
    QTemporaryDir folder;
    const QString path = folder.filePath(QStringLiteral("bad.windfall"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("PK not really");
    file.close();
    window().files().openPath(path);
    QTRY_VERIFY(window().messages().isError());
    QCOMPARE(document().project().leaves.size(), std::size_t(1));
  }

  void tabHidesTheDocksWhileTheCanvasHasTheFocus() {
    document().addLeaf(test::paintedLeaf());
    window().openWorkspace(QStringLiteral("leaf"));
    QVERIFY(editor_->settle(30));
    leaf().pane().setFocus();
    QVERIFY(window().assets().isVisible());
    QTest::keyClick(&leaf().pane(), Qt::Key_Tab);
    QVERIFY(!window().assets().isVisible());
    QTest::keyClick(&leaf().pane(), Qt::Key_Tab);
    QVERIFY(window().assets().isVisible());
  }

  void keysAreChangedInTheDialogAndStayChanged() {
    const auto actionOf = [this](const QString& text) {
      const QList<QAction*> actions = window().allActions();
      const auto found = std::ranges::find_if(
          actions, [&](const QAction* action) { return QString(action->text()).remove(QLatin1Char('&')) == text; });
      return found == actions.end() ? nullptr : *found;
    };
    QVERIFY(actionOf(QStringLiteral("Keyboard Shortcuts…")));
    actionOf(QStringLiteral("Keyboard Shortcuts…"))->trigger();
    auto* dialog = window().findChild<ShortcutDialog*>();
    QVERIFY(dialog && QTest::qWaitForWindowExposed(dialog));
    QTest::keyClicks(dialog->search(), QStringLiteral("Full Screen"));
    QList<QTreeWidgetItem*> shown;
    for (QTreeWidgetItemIterator it(dialog->list(),
                                    QTreeWidgetItemIterator::NotHidden | QTreeWidgetItemIterator::NoChildren);
         *it; ++it) {
      shown << *it;
    }
    QCOMPARE(shown.size(), 1);
    dialog->list()->scrollToItem(shown[0]);
    QTest::mouseClick(dialog->list()->viewport(), Qt::LeftButton, {},
                      dialog->list()->visualItemRect(shown[0]).center());
    dialog->keys()->setFocus();
    QTest::keyClick(dialog->keys(), Qt::Key_S, Qt::ControlModifier);
    QVERIFY(dialog->grab().save(test::outputFolder() + "/window_shortcuts.png"));
    const QKeySequence key(QStringLiteral("Ctrl+S"));
    QTRY_COMPARE(actionOf(QStringLiteral("Full Screen"))->shortcut(), key);
    QVERIFY(actionOf(QStringLiteral("Save"))->shortcuts().isEmpty());
    dialog->close();

    editor_ = std::make_unique<app::Editor>();
    QCOMPARE(actionOf(QStringLiteral("Full Screen"))->shortcut(), key);
    QVERIFY(actionOf(QStringLiteral("Save"))->shortcuts().isEmpty());
    auto* table = window().findChild<ShortcutTable*>();
    table->resetAll();
    QCOMPARE(actionOf(QStringLiteral("Save"))->shortcut(), key);
    QCOMPARE(actionOf(QStringLiteral("Full Screen"))->shortcut(), QKeySequence(Qt::Key_F11));
  }

  void aKeyMayServeTwoWorkspacesButNotAWorkspaceAndTheWindow() {
    QAction everywhere(QStringLiteral("Everywhere")), one(QStringLiteral("One")), two(QStringLiteral("Two"));
    ShortcutTable table;
    table.add(&everywhere, QStringLiteral("File"));
    table.add(&one, QStringLiteral("Leaf"), QStringLiteral("leaf"));
    table.add(&two, QStringLiteral("Plant"), QStringLiteral("plant"));
    table.set(&one, {Qt::Key_B});
    table.set(&two, {Qt::Key_B});
    QCOMPARE(table.of(&one), QList<QKeySequence>{Qt::Key_B});
    QCOMPARE(table.of(&two), QList<QKeySequence>{Qt::Key_B});
    table.set(&everywhere, {Qt::Key_B});
    QVERIFY(table.of(&one).isEmpty() && table.of(&two).isEmpty());
  }

  void lookAtBothPalettes() {
    const model::AssetId id = document().addLeaf(test::paintedLeaf());
    window().openWorkspace(QStringLiteral("leaf"));
    leaf().show(id);
    leaf().setStage(model::Stage::Mask);
    QVERIFY(editor_->settle(60));
    window().messages().showMessage(QStringLiteral("atlas.png was not written: the disk is full"), true);
    for (const Scheme scheme : {Scheme::Light, Scheme::Dark}) {
      window().setScheme(scheme);
      QVERIFY(editor_->settle(30));
      QVERIFY(window().grab().save(test::outputFolder() +
                                   (scheme == Scheme::Dark ? "/window_dark.png" : "/window_light.png")));
      QCOMPARE(window().palette().color(QPalette::Window), colors(scheme).panel);
    }
  }
};

WINDFALL_SUITE(MainWindowTest)
#include "main_window.moc"
