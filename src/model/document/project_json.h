// A project as the text of project.json and the files beside it.
#pragma once

#include <QByteArray>
#include <functional>
#include <vector>

#include "model/document/archive.h"
#include "model/document/project.h"
#include "sim/result.h"

namespace windfall::model {

inline constexpr const char* kProjectEntry = "project.json";

/// All entries of the file, project.json first. Fails where the project breaks its own rules (see checkProject).
Result<std::vector<ArchiveEntry>> toEntries(const Project& project);

/// The reverse; `entry` gives the content of a file beside it.
Result<Project> fromJson(const QByteArray& json,
                         const std::function<Result<QByteArray>(const QString& name, qint64 limit)>& entry);

/// What fields alone can't say: ids are unique and below nextId, references lead to something, veins have no circle,
/// masks have their photo's size. Empty, or the first thing wrong ("plants[1].leaves: …").
QString checkProject(const Project& project);

}  // namespace windfall::model
