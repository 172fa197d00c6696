// A file that the project carries inside itself.
#pragma once

#include <QByteArray>
#include <QString>

#include "sim/result.h"

namespace windfall::model {

/// The bytes as they were read, so that the project opens anywhere. `name` is the file's name without folders.
struct SourceFile {
  QString name;
  QByteArray bytes;
  bool isEmpty() const { return bytes.isEmpty(); }
  bool operator==(const SourceFile&) const = default;
};

/// Reads a file as a source; a .gltf with the files that it names beside it. Errors without the file's name: it cannot
/// be opened, is empty, is a folder, is over 1 GiB.
Result<SourceFile> readSourceFile(const QString& path);

}  // namespace windfall::model
