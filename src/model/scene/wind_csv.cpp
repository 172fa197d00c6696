#include "model/scene/wind_csv.h"

#include <QDateTime>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStringList>
#include <cmath>
#include <optional>

namespace windfall::model {

namespace {

constexpr qint64 kLargestFile = 64 << 20;
constexpr std::size_t kMostRows = 200'000;
constexpr double kFastest = 150;  // m/s, above any that was ever measured

Error wrong(qsizetype line, const QString& what) {
  return Error{QStringLiteral("line %1: %2").arg(line).arg(what).toStdString()};
}

/// What the columns are.
struct Columns {
  int time = 0, speed = 1, direction = 2;
  double toMetres = 1;
  bool to = false;  ///< directions say where it blows to
};

struct Table {
  QChar separator = ',';
  Columns columns;
  std::vector<std::pair<qsizetype, QStringList>> rows;  ///< with their line, counted from 1
};

QChar separatorOf(const QString& line) { return line.contains('\t') ? '\t' : line.contains(';') ? ';' : ','; }

QStringList cells(const QString& line, QChar separator) {
  QStringList parts = line.split(separator);
  for (QString& part : parts) {
    part = part.trimmed();
    if (part.size() >= 2 && part.startsWith('"') && part.endsWith('"')) part = part.mid(1, part.size() - 2).trimmed();
  }
  return parts;
}

std::optional<double> number(QString text, QChar separator) {
  if (separator != ',') text.replace(',', '.');
  bool good = false;
  const double value = text.toDouble(&good);
  return good && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Seconds; dates and clock times count from an arbitrary day.
std::optional<double> seconds(const QString& text, QChar separator) {
  if (const auto plain = number(text, separator)) return plain;
  const QTime clock =
      QTime::fromString(text, text.count(':') == 1 ? QStringLiteral("H:mm") : QStringLiteral("H:mm:ss"));
  if (clock.isValid()) return clock.msecsSinceStartOfDay() / 1000.0;
  QString iso = text;
  if (iso.size() > 10 && iso[10] == ' ') iso[10] = 'T';
  QDateTime date = QDateTime::fromString(iso, Qt::ISODateWithMs);
  if (!date.isValid()) return {};
  if (date.timeSpec() == Qt::LocalTime) date.setTimeSpec(Qt::UTC);  // summer time must not tear a record apart
  return static_cast<double>(date.toMSecsSinceEpoch()) / 1000;
}

double unitOf(const QString& name) {
  if (name.contains("km/h") || name.contains("kmh") || name.contains("kph")) return 1 / 3.6;
  if (name.contains("mph")) return 0.44704;
  static const QRegularExpression knots(QStringLiteral("\\b(kn|kt|kts|knots?)\\b"));
  return knots.match(name).hasMatch() ? 0.514444 : 1;
}

Result<Columns> named(const QStringList& header) {
  Columns columns;
  columns.time = columns.speed = columns.direction = -1;
  for (int i = 0; i < header.size(); ++i) {
    const QString name = header[i].toLower();
    const auto take = [&](int& column, std::initializer_list<const char*> words) {
      for (const char* word : words) {
        if (column < 0 && name.contains(QLatin1String(word))) {
          column = i;
          return true;
        }
      }
      return false;
    };
    if (take(columns.direction, {"dir", "heading", "azimuth", "blows"})) {
      static const QRegularExpression to(QStringLiteral("\\bto\\b|heading"));
      columns.to = to.match(name).hasMatch();
    } else if (take(columns.speed, {"speed", "velocity", "wind", "m/s"})) {
      columns.toMetres = unitOf(name);
    } else {
      take(columns.time, {"time", "date", "second"});
      if (columns.time < 0 && (name == "t" || name == "s")) columns.time = i;
    }
  }
  if (columns.time < 0) return Error{"its first line names no column \"time\""};
  if (columns.speed < 0) return Error{"its first line names no column \"speed\""};
  return columns;
}

Result<Table> readTable(const QString& text) {
  Table table;
  const QStringList lines = text.split('\n');
  bool first = true;
  for (qsizetype i = 0; i < lines.size(); ++i) {
    const QString line = lines[i].trimmed();
    if (line.isEmpty() || line.startsWith('#')) continue;
    if (std::exchange(first, false)) {
      table.separator = separatorOf(line);
      const QStringList header = cells(line, table.separator);
      if (!seconds(header.front(), table.separator)) {
        Result<Columns> columns = named(header);
        if (!columns) return columns.error();
        table.columns = *columns;
        continue;
      }
      if (header.size() < 2) return wrong(i + 1, QStringLiteral("has no speed beside its time"));
      if (header.size() < 3) table.columns.direction = -1;
    }
    if (table.rows.size() >= kMostRows) return Error{"has more than 200,000 rows"};
    table.rows.emplace_back(i + 1, cells(line, table.separator));
  }
  if (table.rows.empty()) return Error{"has no row of time, speed and direction"};
  return table;
}

}  // namespace

Result<std::vector<sim::WindRecord>> readWindCsv(const QByteArray& bytes) {
  if (bytes.contains('\0')) return Error{"is not a text file"};
  Result<Table> table = readTable(QString::fromUtf8(bytes.startsWith("\xef\xbb\xbf") ? bytes.mid(3) : bytes));
  if (!table) return table.error();
  const Columns& columns = table->columns;
  std::vector<sim::WindRecord> records;
  double start = 0;
  for (const auto& [line, row] : table->rows) {
    const auto cell = [&row = row](int column) { return column >= 0 && column < row.size() ? row[column] : QString(); };
    const auto quoted = [](const QString& text) {
      return text.isEmpty() ? QStringLiteral("is missing")
                            : QStringLiteral("\"%1\" is not a number").arg(text.left(40));
    };
    const auto time = seconds(cell(columns.time), table->separator);
    if (!time) return wrong(line, QStringLiteral("the time ") + quoted(cell(columns.time)));
    const auto speed = number(cell(columns.speed), table->separator);
    if (!speed) return wrong(line, QStringLiteral("the speed ") + quoted(cell(columns.speed)));
    const double metres = *speed * columns.toMetres;
    if (metres < 0 || metres > kFastest) {
      return wrong(line, QStringLiteral("a speed of %1 m/s cannot be").arg(metres));
    }
    double heading = 90;
    if (columns.direction >= 0) {
      const auto direction = number(cell(columns.direction), table->separator);
      if (!direction) return wrong(line, QStringLiteral("the direction ") + quoted(cell(columns.direction)));
      if (std::abs(*direction) > 360) return wrong(line, QStringLiteral("the direction is not from 0 to 360 degrees"));
      heading = *direction + (columns.to ? 0 : 180);
      heading -= 360 * std::floor(heading / 360);
    }
    if (records.empty()) start = *time;
    const double since = *time - start;
    if (!records.empty() && since <= static_cast<double>(records.back().time)) {
      return wrong(line, QStringLiteral("the time does not go on from the line before"));
    }
    if (since > 1e9) return wrong(line, QStringLiteral("the time lies more than 30 years after the first"));
    records.push_back({static_cast<float>(since), static_cast<float>(metres), static_cast<float>(heading)});
  }
  return records;
}

Status readWindFile(const QString& path, sim::WindSettings& wind) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return Error{file.errorString().toStdString()};
  if (file.size() > kLargestFile) return Error{"is larger than 64 MB"};
  Result<std::vector<sim::WindRecord>> records = readWindCsv(file.readAll());
  if (!records) return records.error();
  double sum = 0;
  for (const sim::WindRecord& record : *records) sum += static_cast<double>(record.speed);
  wind.speed = static_cast<float>(sum / static_cast<double>(records->size()));
  wind.course = sim::WindCourse::Recorded;
  wind.records = std::move(*records);
  wind.recordName = QFileInfo(path).fileName().toStdString();
  return ok();
}

}  // namespace windfall::model
