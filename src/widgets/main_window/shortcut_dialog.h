// Where the artist changes keys.
#pragma once

#include <QDialog>

#include "widgets/main_window/shortcut_table.h"

class QKeySequenceEdit;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace windfall::widgets {

/// A searchable list of all actions by menu; a key typed for the chosen one takes effect at once.
class ShortcutDialog : public QDialog {
  Q_OBJECT
 public:
  explicit ShortcutDialog(ShortcutTable& table, QWidget* parent);
  QTreeWidget* list() const { return list_; }
  QLineEdit* search() const { return search_; }
  QKeySequenceEdit* keys() const { return keys_; }

 private:
  void fill();
  void filter(const QString& text);
  void choose(QTreeWidgetItem* item);
  void assign();
  QAction* chosen() const;

  ShortcutTable& table_;
  QLineEdit* search_;
  QTreeWidget* list_;
  QKeySequenceEdit* keys_;
  QLabel* note_;
  QPushButton *clear_, *reset_;
};

}  // namespace windfall::widgets
