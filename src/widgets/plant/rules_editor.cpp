#include "widgets/plant/rules_editor.h"

#include <QFontDatabase>
#include <QLabel>
#include <QPlainTextEdit>
#include <QTextBlock>
#include <QVBoxLayout>

#include "model/plant/grow/lsystem.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr int kPause = 350;  // ms without a key until the plant grows anew

}  // namespace

RulesEditor::RulesEditor(QWidget* parent) : QWidget(parent), text_(new QPlainTextEdit), state_(new QLabel) {
  text_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  text_->setLineWrapMode(QPlainTextEdit::NoWrap);
  text_->setTabChangesFocus(true);
  text_->setMinimumHeight(180);
  text_->setPlaceholderText("axiom: F\nF -> F[+F]F[-F]F");
  text_->setToolTip(tr("Rules of the L-system; the language is described in docs/lsystem.md"));
  text_->setAccessibleName(tr("Rules"));
  state_->setWordWrap(true);
  state_->setProperty("hint", true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kGrid);
  column->addWidget(text_);
  column->addWidget(state_);
  pause_.setSingleShot(true);
  pause_.setInterval(kPause);
  connect(&pause_, &QTimer::timeout, this, &RulesEditor::commit);
  connect(text_, &QPlainTextEdit::textChanged, this, [this] {
    check();
    if (text_->toPlainText() != shown_) pause_.start();
  });
}

void RulesEditor::show(const QString& rules) {
  if (rules == shown_ && (pause_.isActive() || rules == text_->toPlainText())) return;
  pause_.stop();
  shown_ = rules;
  ++stretch_;
  if (text_->toPlainText() != rules) text_->setPlainText(rules);
  check();
}

void RulesEditor::commit() {
  shown_ = text_->toPlainText();
  emit edited(shown_, QStringLiteral("rules %1").arg(stretch_));
}

void RulesEditor::check() {
  const std::string rules = text_->toPlainText().toStdString();
  const model::growth::Parsed parsed = model::growth::parseRules(rules);
  QList<QTextEdit::ExtraSelection> marks;
  marked_ = 0;
  problem_.clear();
  if (!parsed.errors.empty() && !rules.empty()) {
    const model::growth::RuleError& error = parsed.errors.front();
    problem_ = QString::fromStdString(error.text());
    marked_ = error.line;
    for (const model::growth::RuleError& each : parsed.errors) {
      QTextEdit::ExtraSelection mark;
      mark.cursor = QTextCursor(text_->document()->findBlockByNumber(each.line - 1));
      mark.format.setBackground(QColor(200, 60, 50, 90));
      mark.format.setProperty(QTextFormat::FullWidthSelection, true);
      marks.push_back(mark);
    }
  }
  text_->setExtraSelections(marks);
  state_->setText(!problem_.isEmpty() ? problem_
                                      : tr("%n rule(s)", nullptr, static_cast<int>(parsed.system.rules.size())));
}

}  // namespace windfall::widgets
