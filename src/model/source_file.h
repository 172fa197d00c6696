// A file that the project carries inside itself.
#pragma once

#include <QByteArray>
#include <QString>

namespace windfall::model {

/// The bytes as they were read, so that the project opens anywhere. `name` is the file's name without folders.
struct SourceFile {
  QString name;
  QByteArray bytes;
  bool isEmpty() const { return bytes.isEmpty(); }
  bool operator==(const SourceFile&) const = default;
};

}  // namespace windfall::model
