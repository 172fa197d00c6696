// Recorded wind from a table.
#pragma once

#include <QByteArray>
#include <vector>

#include "sim/result.h"
#include "sim/settings.h"

namespace windfall::model {

/// Rows of time, speed and direction, in that order or named by a first line ("time", "speed", "direction"; other
/// columns are left out). Fields are separated by commas, semicolons (then the comma may be the decimal point) or tabs;
/// lines that begin with # are left out. Time: seconds, a clock time (14:05:30) or a date with one
/// (2024-03-01T14:05:30); speed: m/s, or what its column says: "speed (km/h)", "[kn]", "[mph]"; direction: degrees
/// clockwise from north that the wind comes from, as stations report it; a column named "to" or "heading" says where it
/// blows to. Without one the wind blows to the east. Errors name the line.
Result<std::vector<sim::WindRecord>> readWindCsv(const QByteArray& bytes);

/// Reads a file into a wind: course, records, their name, and as mean speed that of the record.
Status readWindFile(const QString& path, sim::WindSettings& wind);

}  // namespace windfall::model
