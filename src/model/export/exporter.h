// Writers of what others' tools read. A new format is one new file and one line in exporters.cpp.
#pragma once

#include <QJsonObject>
#include <QString>
#include <QStringList>
#include <memory>
#include <vector>

#include "model/document/project.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// What an exporter takes from a project.
enum class ExportSubject {
  Leaves,  ///< the kept variants of one leaf, or of all (asset 0)
  Plant,   ///< one plant
};

/// A number that an exporter asks for; whoever runs it shows a field, or an option of the command line.
struct ExportParameter {
  QString key;
  QString title;
  double initial = 0, low = 0, high = 0;
  bool whole = false;   ///< only whole numbers
  QStringList choices;  ///< translated; where it has any, the value is a place in it
  QString help;         ///< translated
};

class Exporter {
 public:
  virtual ~Exporter() = default;
  virtual QString id() const = 0;              ///< "atlas"
  virtual QString title() const = 0;           ///< translated, for menus
  virtual QStringList extensions() const = 0;  ///< of the main file, lower case, without the dot
  virtual ExportSubject subject() const = 0;
  virtual std::vector<ExportParameter> parameters() const { return {}; }

  /// Writes `path` and what belongs to it beside it, each file whole or not at all. `values` by parameter key; absent
  /// ones are initial. Never opens a dialog. Errors without the file's name.
  virtual Status write(const Project& project, AssetId asset, const QString& path, const QJsonObject& values,
                       Progress& progress) const = 0;
};

const std::vector<std::unique_ptr<Exporter>>& exporters();
/// Null where there is none of that id.
const Exporter* findExporter(const QString& id);

/// The value of a declared parameter, or its initial one; an error outside its limits.
Result<double> parameterValue(const Exporter& exporter, const QJsonObject& values, const QString& key);

}  // namespace windfall::model
