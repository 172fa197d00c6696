#include "widgets/main_window/command_palette.h"

#include <QAction>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QVBoxLayout>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

constexpr int kShortcut = Qt::UserRole + 1;
constexpr int kPlace = Qt::UserRole + 2;

QString plain(QString text) { return text.remove(QLatin1Char('&')); }

/// The menu that the action stands in: "Edit".
QString placeOf(const QAction* action) {
  for (const QObject* owner : action->associatedObjects()) {
    if (const auto* menu = qobject_cast<const QMenu*>(owner)) return plain(menu->title());
  }
  return {};
}

/// Name on the left, menu and shortcut muted on the right.
class RowDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyledItemDelegate::paint(painter, option, index);
    const QString shortcut = index.data(kShortcut).toString();
    const QString place = index.data(kPlace).toString();
    painter->save();
    painter->setPen(colors(option.palette).muted);
    QRect right = option.rect.adjusted(0, 0, -8, 0);
    painter->drawText(right, Qt::AlignRight | Qt::AlignVCenter, shortcut);
    right.setRight(right.right() - 112);
    painter->drawText(right, Qt::AlignRight | Qt::AlignVCenter, place);
    painter->restore();
  }
};

}  // namespace

CommandPalette::CommandPalette(QWidget* parent)
    : QFrame(parent), input_(new QLineEdit(this)), list_(new QListWidget(this)) {
  setObjectName(QStringLiteral("commandPalette"));
  setStyleSheet(
      QStringLiteral("#commandPalette { background: palette(base); border: 1px solid palette(mid); "
                     "border-radius: 8px; } #commandPalette QListWidget { background: palette(base); }"));
  setFixedSize(560, 380);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(2 * kGrid, 2 * kGrid, 2 * kGrid, 2 * kGrid);
  column->setSpacing(2 * kGrid);
  input_->setPlaceholderText(tr("Find an action…"));
  input_->setMinimumHeight(28);
  list_->setItemDelegate(new RowDelegate(list_));
  list_->setIconSize({16, 16});
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setFocusPolicy(Qt::NoFocus);
  column->addWidget(input_);
  column->addWidget(list_, 1);
  input_->installEventFilter(this);
  connect(input_, &QLineEdit::textChanged, this, &CommandPalette::refresh);
  connect(list_, &QListWidget::itemClicked, this, &CommandPalette::run);
  hide();
}

void CommandPalette::open(const QList<QAction*>& actions) {
  actions_.clear();
  for (QAction* action : actions) actions_ << action;
  input_->clear();
  refresh();
  move((parentWidget()->width() - width()) / 2, std::max(40, (parentWidget()->height() - height()) / 4));
  show();
  raise();
  input_->setFocus(Qt::ShortcutFocusReason);
}

int CommandPalette::score(const QString& pattern, const QString& text) {
  int total = 0, last = -2;
  qsizetype at = 0;
  for (const QChar letter : pattern) {
    if (letter.isSpace()) continue;
    const qsizetype found = text.indexOf(letter, at, Qt::CaseInsensitive);
    if (found < 0) return -1;
    // A run of letters or the start of a word says more than a letter somewhere.
    if (found == last + 1) total += 8;
    if (found == 0 || !text[found - 1].isLetterOrNumber()) total += 6;
    total -= int(found - at) / 4;
    last = int(found);
    at = found + 1;
  }
  return std::max(0, total - int(text.size()) / 16 + 4);
}

void CommandPalette::refresh() {
  list_->clear();
  std::vector<std::pair<int, int>> order;
  for (int i = 0; i < actions_.size(); ++i) {
    if (!actions_[i]) continue;
    const int fit = score(input_->text(), plain(actions_[i]->text()) + QLatin1Char(' ') + placeOf(actions_[i]));
    if (fit >= 0) order.emplace_back(-fit, i);
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [fit, index] : order) {
    const QAction* action = actions_[index];
    auto* item = new QListWidgetItem(action->icon(), plain(action->text()), list_);
    item->setData(Qt::UserRole, index);
    item->setData(kShortcut, action->shortcut().toString(QKeySequence::NativeText));
    item->setData(kPlace, placeOf(action));
    if (!action->isEnabled()) item->setFlags(Qt::NoItemFlags);
  }
  for (int i = 0; i < list_->count(); ++i) {
    if (!(list_->item(i)->flags() & Qt::ItemIsEnabled)) continue;
    list_->setCurrentRow(i);
    break;
  }
}

void CommandPalette::run() {
  const QListWidgetItem* item = list_->currentItem();
  if (!item || !(item->flags() & Qt::ItemIsEnabled)) return;
  const QPointer<QAction> action = actions_.value(item->data(Qt::UserRole).toInt());
  hide();
  parentWidget()->setFocus();
  if (action) action->trigger();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::FocusOut) {
    hide();
  } else if (event->type() == QEvent::KeyPress || event->type() == QEvent::ShortcutOverride) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    const bool ours = key == Qt::Key_Escape || key == Qt::Key_Return || key == Qt::Key_Enter || key == Qt::Key_Up ||
                      key == Qt::Key_Down;
    if (!ours) return QFrame::eventFilter(watched, event);
    event->accept();
    if (event->type() == QEvent::ShortcutOverride) return true;
    if (key == Qt::Key_Escape) {
      hide();
      parentWidget()->setFocus();
    } else if (key == Qt::Key_Up || key == Qt::Key_Down) {
      const int rows = list_->count();
      if (rows > 0) list_->setCurrentRow((list_->currentRow() + (key == Qt::Key_Up ? rows - 1 : 1)) % rows);
    } else {
      run();
    }
    return true;
  }
  return QFrame::eventFilter(watched, event);
}

}  // namespace windfall::widgets
