#include "widgets/look/look.h"

#include <QApplication>
#include <QFile>
#include <QIcon>
#include <QProxyStyle>
#include <QToolTip>

#include "widgets/look/language.h"

static void initResources() { Q_INIT_RESOURCE(resources); }

namespace windfall::widgets {

namespace {

/// Fusion, the same on every desktop: no desktop's icons on the buttons of dialogs.
class Style : public QProxyStyle {
 public:
  Style() : QProxyStyle(QStringLiteral("Fusion")) {}
  int styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                QStyleHintReturn* data) const override {
    if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
    return QProxyStyle::styleHint(hint, option, widget, data);
  }
};

QPalette makePalette(const Colors& c) {
  QPalette palette;
  palette.setColor(QPalette::Window, c.panel);
  palette.setColor(QPalette::WindowText, c.text);
  palette.setColor(QPalette::Base, c.field);
  palette.setColor(QPalette::AlternateBase, c.panel);
  palette.setColor(QPalette::Text, c.text);
  palette.setColor(QPalette::PlaceholderText, c.muted);
  palette.setColor(QPalette::Button, c.panel);
  palette.setColor(QPalette::ButtonText, c.text);
  palette.setColor(QPalette::BrightText, c.error);
  palette.setColor(QPalette::Highlight, c.accent);
  palette.setColor(QPalette::HighlightedText, c.onAccent);
  palette.setColor(QPalette::Link, c.accent);
  palette.setColor(QPalette::LinkVisited, c.accent);
  palette.setColor(QPalette::ToolTipBase, c.field);
  palette.setColor(QPalette::ToolTipText, c.text);
  palette.setColor(QPalette::Light, c.hover);
  palette.setColor(QPalette::Midlight, c.hover);
  palette.setColor(QPalette::Mid, c.border);
  palette.setColor(QPalette::Dark, c.canvas);
  palette.setColor(QPalette::Shadow, c.canvas);
  for (const QPalette::ColorRole role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    QColor faint = c.muted;
    faint.setAlphaF(0.6f);
    palette.setColor(QPalette::Disabled, role, faint);
  }
  palette.setColor(QPalette::Disabled, QPalette::Highlight, c.border);
  return palette;
}

QString makeStyleSheet(const Colors& c) {
  QFile file(QStringLiteral(":/look.qss"));
  if (!file.open(QIODevice::ReadOnly)) return {};
  QString sheet = QString::fromUtf8(file.readAll());
  const std::pair<const char*, QColor> names[] = {
      {"@canvas", c.canvas},     {"@panel", c.panel},       {"@field", c.field},     {"@hover", c.hover},
      {"@border", c.border},     {"@text", c.text},         {"@muted", c.muted},     {"@accent", c.accent},
      {"@onAccent", c.onAccent}, {"@selected", c.selected}, {"@warning", c.warning}, {"@error", c.error}};
  for (const auto& [name, color] : names) {
    sheet.replace(QString::fromLatin1(name) + QLatin1Char(';'), color.name() + QLatin1Char(';'));
  }
  const bool dark = c.panel.lightness() < 128;
  sheet.replace(QStringLiteral("@scheme;"), dark ? QStringLiteral("dark") : QStringLiteral("light"));
  return sheet;
}

}  // namespace

const Colors& colors(Scheme scheme) {
  static const Colors dark{.canvas = "#151817",
                           .panel = "#1f2322",
                           .field = "#2a2f2d",
                           .hover = "#343a37",
                           .border = "#3a413e",
                           .text = "#e1e7e2",
                           .muted = "#95a099",
                           .accent = "#a6d67b",
                           .onAccent = "#16200f",
                           .selected = "#36472d",
                           .warning = "#e8b85a",
                           .error = "#f0857a"};
  static const Colors light{.canvas = "#d5dad5",
                            .panel = "#eceeeb",
                            .field = "#ffffff",
                            .hover = "#e4e9e3",
                            .border = "#ccd3cb",
                            .text = "#1e2621",
                            .muted = "#5f6b63",
                            .accent = "#3d8a3a",
                            .onAccent = "#ffffff",
                            .selected = "#d3e8cd",
                            .warning = "#9a6700",
                            .error = "#b3382c"};
  return scheme == Scheme::Dark ? dark : light;
}

const Colors& colors(const QPalette& palette) {
  return colors(palette.color(QPalette::Window).lightness() < 128 ? Scheme::Dark : Scheme::Light);
}

void applyLook(QApplication& application, Scheme scheme) {
  initResources();
  installPlurals(application);
  const Colors& c = colors(scheme);
  // The palette first: a style sheet polishes widgets with what it finds.
  application.setStyleSheet({});
  application.setStyle(new Style);
  application.setPalette(makePalette(c));
  QToolTip::setPalette(makePalette(c));
  application.setStyleSheet(makeStyleSheet(c));
}

}  // namespace windfall::widgets
