#include <zip.h>

#include <QFile>
#include <QFileInfo>
#include <algorithm>

#include "model/document/archive.h"

namespace windfall::model {

namespace {

constexpr qint64 kChunk = 256 * 1024;
constexpr quint32 kFileTypeMask = 0170000, kSymbolicLink = 0120000;

Error wrong(const QString& message) { return Error{message.toStdString()}; }

/// Why a name may not stand in a project; empty where it may.
QString badName(const QString& name) {
  if (name.isEmpty()) return QStringLiteral("an entry has no name");
  const QString shown = name.left(80).replace(QLatin1Char('\n'), QLatin1Char(' '));
  if (name.startsWith('/') || (name.size() > 1 && name[1] == ':')) {
    return QStringLiteral("entry “%1” has an absolute path").arg(shown);
  }
  if (name.contains('\\')) return QStringLiteral("entry “%1” has a backslash in its name").arg(shown);
  const QStringList parts = name.split('/');
  if (parts.contains(QStringLiteral("..")) || parts.contains(QStringLiteral("."))) {
    return QStringLiteral("entry “%1” leads out of the file").arg(shown);
  }
  if (std::any_of(name.begin(), name.end(), [](QChar c) { return c < ' '; })) {
    return QStringLiteral("entry “%1” has a control character in its name").arg(shown);
  }
  return {};
}

}  // namespace

struct ArchiveReader::State {
  zip_t* zip = nullptr;
  std::map<QString, zip_uint64_t> places;
  ArchiveLimits limits;
  qint64 inflated = 0;
  ~State() {
    if (zip) zip_discard(zip);
  }
};

ArchiveReader::ArchiveReader(std::unique_ptr<State> state) : state_(std::move(state)) {}
ArchiveReader::ArchiveReader(ArchiveReader&&) noexcept = default;
ArchiveReader::~ArchiveReader() = default;

Result<ArchiveReader> ArchiveReader::open(const QString& path, const ArchiveLimits& limits) {
  const QFileInfo info(path);
  if (!info.exists()) return wrong(QStringLiteral("there is no such file"));
  if (!info.isFile()) return wrong(QStringLiteral("is not a file"));
  if (!info.isReadable()) return wrong(QStringLiteral("may not be read by you"));
  if (info.size() == 0) return wrong(QStringLiteral("is empty"));

  auto state = std::make_unique<State>();
  state->limits = limits;
  int code = 0;
  state->zip = zip_open(QFile::encodeName(path).constData(), ZIP_RDONLY, &code);
  if (!state->zip) {
    if (code == ZIP_ER_NOZIP || code == ZIP_ER_INCONS || code == ZIP_ER_EOF) {
      return wrong(QStringLiteral("is not a Windfall project, or only a part of one"));
    }
    zip_error_t error;
    zip_error_init_with_code(&error, code);
    const QString reason = QString::fromUtf8(zip_error_strerror(&error));
    zip_error_fini(&error);
    return wrong(QStringLiteral("cannot be opened: %1").arg(reason));
  }

  const qint64 count = zip_get_num_entries(state->zip, 0);
  if (count > limits.entries) {
    return wrong(QStringLiteral("has %1 entries, %2 at most are read").arg(count).arg(limits.entries));
  }
  for (zip_uint64_t i = 0; i < static_cast<zip_uint64_t>(count); ++i) {
    const char* raw = zip_get_name(state->zip, i, ZIP_FL_ENC_GUESS);
    const QString name = raw ? QString::fromUtf8(raw) : QString();
    if (const QString bad = badName(name); !bad.isEmpty()) return wrong(bad);
    zip_stat_t stat;
    if (zip_stat_index(state->zip, i, 0, &stat) != 0) return wrong(QStringLiteral("entry “%1” is damaged").arg(name));
    if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) && stat.encryption_method != ZIP_EM_NONE) {
      return wrong(QStringLiteral("entry “%1” is encrypted").arg(name));
    }
    zip_uint8_t system = 0;
    zip_uint32_t attributes = 0;
    zip_file_get_external_attributes(state->zip, i, 0, &system, &attributes);
    if (system == ZIP_OPSYS_UNIX && ((attributes >> 16) & kFileTypeMask) == kSymbolicLink) {
      return wrong(QStringLiteral("entry “%1” is a link").arg(name));
    }
    if (!state->places.emplace(name, i).second) return wrong(QStringLiteral("entry “%1” is there twice").arg(name));
  }
  return ArchiveReader(std::move(state));
}

QStringList ArchiveReader::names() const {
  QStringList names;
  for (const auto& [name, place] : state_->places) names << name;
  return names;
}

bool ArchiveReader::contains(const QString& name) const { return state_->places.contains(name); }

Result<QByteArray> ArchiveReader::read(const QString& name, qint64 limit, const Progress& progress) {
  const auto found = state_->places.find(name);
  if (found == state_->places.end()) return wrong(QStringLiteral("“%1” is missing in the file").arg(name));
  const qint64 allowed = std::min({limit, state_->limits.entrySize, state_->limits.totalSize - state_->inflated});
  const auto tooLarge = [&] {
    return wrong(QStringLiteral("“%1” is larger than the %2 bytes that are read").arg(name).arg(allowed));
  };
  zip_stat_t stat;
  if (zip_stat_index(state_->zip, found->second, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE)) {
    return wrong(QStringLiteral("“%1” is damaged").arg(name));
  }
  if (stat.size > static_cast<zip_uint64_t>(allowed)) return tooLarge();

  zip_file_t* file = zip_fopen_index(state_->zip, found->second, 0);
  if (!file) {
    const QString reason = QString::fromUtf8(zip_error_strerror(zip_get_error(state_->zip)));
    return wrong(QStringLiteral("“%1” cannot be read: %2").arg(name, reason));
  }
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> closing(file, zip_fclose);
  // The size in the header is a claim: memory grows only with the bytes that really come.
  QByteArray bytes;
  for (;;) {
    if (progress.cancelled()) return Error{"cancelled", true};
    const qint64 had = bytes.size();
    bytes.resize(had + kChunk);
    const zip_int64_t got = zip_fread(file, bytes.data() + had, kChunk);
    if (got < 0) return wrong(QStringLiteral("“%1” is damaged").arg(name));
    bytes.resize(had + got);
    if (bytes.size() > allowed) return tooLarge();
    if (bytes.size() > static_cast<qint64>(stat.size)) {
      return wrong(QStringLiteral("“%1” holds more than it says").arg(name));
    }
    if (got == 0) break;
  }
  if (bytes.size() != static_cast<qint64>(stat.size)) return wrong(QStringLiteral("“%1” is cut off").arg(name));
  state_->inflated += bytes.size();
  return bytes;
}

}  // namespace windfall::model
