#include <QApplication>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QtTest>

#include "support/suite.h"
#include "widgets/fields/choice_field.h"
#include "widgets/fields/dial_field.h"
#include "widgets/fields/field_panel.h"
#include "widgets/fields/number_field.h"
#include "widgets/fields/slider.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

using namespace windfall::widgets;

class Fields : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { applyLook(*qApp, Scheme::Dark); }

  void aDragIsOneGestureAndEndsFinished() {
    NumberField field(QStringLiteral("Wiggle"), {.minimum = 0, .maximum = 10, .defaultValue = 2});
    field.resize(300, 24);
    field.show();
    QVERIFY(QTest::qWaitForWindowExposed(&field));
    QSignalSpy edits(&field, &NumberField::edited);
    QStringList gestures;
    connect(&field, &NumberField::edited, this, [&] { gestures << field.gesture(); });
    Slider* slider = field.slider();
    QTest::mousePress(slider, Qt::LeftButton, {}, QPoint(20, 10));
    QTest::mouseMove(slider, QPoint(30, 10));
    QTest::mouseMove(slider, QPoint(slider->width() - 1, 10));
    QTest::mouseRelease(slider, Qt::LeftButton, {}, QPoint(slider->width() - 1, 10));
    QVERIFY(edits.size() >= 3);
    for (int i = 0; i + 1 < edits.size(); ++i) QCOMPARE(edits[i][1].toBool(), false);
    QCOMPARE(edits.last()[1].toBool(), true);
    QCOMPARE(edits.last()[0].toDouble(), 10.0);
    QCOMPARE(QSet<QString>(gestures.begin(), gestures.end()).size(), 1);
    QVERIFY(field.gesture() != gestures.first());
  }

  void settingAValueEmitsNothing() {
    NumberField field(QStringLiteral("A"), {.minimum = 0, .maximum = 1});
    QSignalSpy edits(&field, &NumberField::edited);
    field.setValue(0.5);
    field.setMixed();
    field.setValue(0.25);
    QCOMPARE(edits.size(), 0);
    QCOMPARE(field.box()->value(), 0.25);
  }

  void aTypedNumberIsOneEditEvenWithAComma() {
    NumberField field(QStringLiteral("A"), {.minimum = 0, .maximum = 10, .decimals = 1, .unit = QStringLiteral("m")});
    QSignalSpy edits(&field, &NumberField::edited);
    field.box()->selectAll();
    QTest::keyClicks(field.box(), QStringLiteral("3,5"));
    QTest::keyClick(field.box(), Qt::Key_Return);
    QCOMPARE(edits.size(), 1);
    QCOMPARE(edits[0][0].toDouble(), 3.5);
    QCOMPARE(field.box()->text(), QStringLiteral("3.5 m"));
  }

  void mixedShowsADashUntilANumberIsTyped() {
    NumberField field(QStringLiteral("A"), {.minimum = 0, .maximum = 10, .defaultValue = 4, .decimals = 0});
    field.setValue(4);
    field.setMixed();
    QCOMPARE(field.box()->text(), QStringLiteral("—"));
    QVERIFY(!field.resetButton()->isHidden());
    QSignalSpy edits(&field, &NumberField::edited);
    field.box()->selectAll();
    // The number below the dash already: an edit all the same, for the others of the selection.
    QTest::keyClicks(field.box(), QStringLiteral("4"));
    QTest::keyClick(field.box(), Qt::Key_Return);
    QCOMPARE(edits.size(), 1);
    QCOMPARE(edits[0][0].toDouble(), 4.0);
    QVERIFY(!field.isMixed());
  }

  void resetBringsTheDefaultBackAndHides() {
    NumberField field(QStringLiteral("A"), {.minimum = 0, .maximum = 10, .defaultValue = 4});
    QVERIFY(field.resetButton()->isHidden());
    field.setValue(7);
    QVERIFY(!field.resetButton()->isHidden());
    QSignalSpy edits(&field, &NumberField::edited);
    field.resetButton()->click();
    QCOMPARE(edits.size(), 1);
    QCOMPARE(edits[0][0].toDouble(), 4.0);
    QVERIFY(field.resetButton()->isHidden());
  }

  void logarithmicSliderReachesBothEnds() {
    NumberField field(QStringLiteral("E"),
                      {.minimum = 1e8, .maximum = 1e11, .defaultValue = 6e9, .decimals = 0, .logarithmic = true});
    field.setValue(1e8);
    QCOMPARE(field.slider()->position(), 0.0);
    field.setValue(1e11);
    QCOMPARE(field.slider()->position(), 1.0);
  }

  void wheelOverAnUnfocusedRowChangesNothing() {
    NumberField field(QStringLiteral("A"), {.minimum = 0, .maximum = 10, .defaultValue = 4});
    QSignalSpy edits(&field, &NumberField::edited);
    for (QWidget* target : {static_cast<QWidget*>(field.slider()), static_cast<QWidget*>(field.box())}) {
      QWheelEvent wheel(QPointF(5, 5), QPointF(5, 5), {}, QPoint(0, 120), Qt::NoButton, Qt::NoModifier,
                        Qt::NoScrollPhase, false);
      QApplication::sendEvent(target, &wheel);
    }
    QCOMPARE(edits.size(), 0);
  }

  void aClickOnAMixedCheckBoxMakesAllTrue() {
    CheckField field(QStringLiteral("On"), false);
    field.setMixed();
    QCOMPARE(field.box()->checkState(), Qt::PartiallyChecked);
    QSignalSpy edits(&field, &CheckField::edited);
    field.box()->click();
    QCOMPARE(edits.size(), 1);
    QCOMPARE(edits[0][0].toBool(), true);
  }

  void compassPointsWhereItIsClicked() {
    DialField field(QStringLiteral("Direction"), 0, true);
    QSignalSpy edits(&field, &DialField::edited);
    QTest::mouseClick(field.dial(), Qt::LeftButton, {}, QPoint(field.dial()->width() - 4, field.dial()->height() / 2));
    QCOMPARE(edits.last()[0].toDouble(), 90.0);
    QCOMPARE(edits.last()[1].toBool(), true);
  }

  void diceGivesTheSameSeedsEachTime() {
    SeedField a(QStringLiteral("Seed")), b(QStringLiteral("Seed"));
    a.dice()->click();
    b.dice()->click();
    QVERIFY(a.value() != 1);
    QCOMPARE(a.value(), b.value());
  }

  void iconsFollowPaletteAndState() {
    const QIcon brush = icon(QStringLiteral("brush"));
    QVERIFY(!brush.isNull());
    QVERIFY(icon(QStringLiteral("no such icon")).isNull());
    const auto shade = [](const QIcon& of, QIcon::State state) {
      const QImage image = of.pixmap(QSize(32, 32), QIcon::Normal, state).toImage();
      QColor strongest = Qt::transparent;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const QColor pixel = image.pixelColor(x, y);
          if (pixel.alpha() > strongest.alpha()) strongest = pixel;
        }
      }
      return strongest;
    };
    QVERIFY(shade(brush, QIcon::Off).lightness() > 180);
    QVERIFY(shade(brush, QIcon::On).green() > shade(brush, QIcon::On).blue() + 40);
    applyLook(*qApp, Scheme::Light);
    QVERIFY(shade(brush, QIcon::Off).lightness() < 80);
    applyLook(*qApp, Scheme::Dark);
  }

  // A picture to look at; also proves that a panel of every kind of row lays itself out without overlap.
  void rowsOfAllKindsLineUp() {
    for (const Scheme scheme : {Scheme::Dark, Scheme::Light}) {
      applyLook(*qApp, scheme);
      FieldPanel panel(QStringLiteral("test"));
      FieldGroup* wind = panel.addGroup(QStringLiteral("wind"), QStringLiteral("Wind"));
      auto* speed = wind->add(new NumberField(
          QStringLiteral("Speed at 10 m"),
          {.minimum = 0, .maximum = 40, .defaultValue = 5, .decimals = 1, .unit = QStringLiteral("m/s")}));
      speed->setValue(12);
      wind->add(new DialField(QStringLiteral("Blows to"), 120, true));
      auto* mixed = wind->add(new NumberField(QStringLiteral("A label too long for its column"),
                                              {.minimum = 0, .maximum = 1, .defaultValue = 0.4}));
      mixed->setMixed();
      FieldGroup* other = panel.addGroup(QStringLiteral("veins"), QStringLiteral("Veins"));
      auto* seed = other->add(new SeedField(QStringLiteral("Seed")));
      seed->setValue(4711);
      other->add(new CheckField(QStringLiteral("Gusts"), true))->setValue(true);
      other->add(new ChoiceField(QStringLiteral("Device"), {QStringLiteral("Automatic"), QStringLiteral("CPU")}, 0));
      other->add(new ColorField(QStringLiteral("Colour"), Qt::darkGreen))->setValue(QColor("#7fa650"));
      other->add(new InfoField(QStringLiteral("Picture")))->setValue(QStringLiteral("1024 × 768 px"));
      other->add(new TextField(QStringLiteral("Name")))->setValue(QStringLiteral("oak"));
      other->addButton(QStringLiteral("Draw new veins"), QStringLiteral("vein"));
      auto* primary = other->addButton(QStringLiteral("Make 8 variants"));
      primary->setProperty("primary", true);
      panel.resize(320, 520);
      panel.show();
      QVERIFY(QTest::qWaitForWindowExposed(&panel));
      QCOMPARE(speed->box()->mapTo(&panel, QPoint()).x(), seed->box()->mapTo(&panel, QPoint()).x());
      QCOMPARE(speed->slider()->mapTo(&panel, QPoint()).x(), mixed->slider()->mapTo(&panel, QPoint()).x());
      QVERIFY(panel.grab().save(windfall::test::outputFolder() +
                                (scheme == Scheme::Dark ? "/fields_dark.png" : "/fields_light.png")));
      other->header()->click();
      QVERIFY(other->isFolded());
      QVERIFY(!seed->isVisible());
      other->header()->click();
    }
  }

  // Every icon that the program ships, for looking at them together.
  void contactSheetOfIcons() {
    const QStringList files = QDir(QStringLiteral(":/icons")).entryList();
    QVERIFY(files.size() > 60);
    applyLook(*qApp, Scheme::Dark);
    QImage sheet(16 * 48, (int(files.size()) / 16 + 1) * 48, QImage::Format_RGB32);
    sheet.fill(colors(Scheme::Dark).panel);
    QPainter painter(&sheet);
    for (int i = 0; i < files.size(); ++i) {
      const QPixmap picture = icon(QFileInfo(files[i]).baseName()).pixmap(32, 32);
      QVERIFY2(!picture.isNull(), qPrintable(files[i]));
      painter.drawPixmap(i % 16 * 48 + 8, i / 16 * 48 + 8, picture);
    }
    painter.end();
    QVERIFY(sheet.save(windfall::test::outputFolder() + "/icons.png"));
  }
};

WINDFALL_SUITE(Fields)
#include "fields.moc"
