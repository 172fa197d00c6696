// The zip container of project files: read with suspicion, written with equal bytes for equal content.
#pragma once

#include <QByteArray>
#include <QString>
#include <QStringList>
#include <map>
#include <memory>
#include <vector>

#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model {

/// What a hostile file may cost at most. Sizes are bytes after inflating, counted as they come.
struct ArchiveLimits {
  qint64 entries = 20'000;
  qint64 entrySize = qint64(1) << 30;
  qint64 totalSize = qint64(4) << 30;
};

/// An archive opened for reading. Names that lead out of it, appear twice, are links or encrypted are refused at once;
/// contents are inflated only when asked for.
class ArchiveReader {
 public:
  static Result<ArchiveReader> open(const QString& path, const ArchiveLimits& limits = {});
  ArchiveReader(ArchiveReader&&) noexcept;
  ~ArchiveReader();

  QStringList names() const;
  bool contains(const QString& name) const;
  /// The content; never more than `limit` bytes and what is left of the whole archive's allowance.
  Result<QByteArray> read(const QString& name, qint64 limit, const Progress& progress);

 private:
  struct State;
  explicit ArchiveReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct ArchiveEntry {
  QString name;  ///< relative, '/' between folders
  QByteArray bytes;
  bool store = false;  ///< already compressed (PNG, JPEG, …)
};

/// The bytes of a zip with these entries in this order; no clock, no user, no machine in them.
Result<QByteArray> packArchive(const std::vector<ArchiveEntry>& entries, Progress& progress);

}  // namespace windfall::model
