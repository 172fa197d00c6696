#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <algorithm>

#include "model/document/durable_file.h"
#include "model/presets/preset.h"

// The resources of a static library are linked in only when they are asked for, outside any namespace.
static void initPresetResources() { Q_INIT_RESOURCE(presets); }

namespace windfall::model {

namespace {

constexpr qint64 kLargestFile = 1 << 20;

/// A file name for any name: its plain characters, and a hash that keeps "a/b" and "a:b" apart.
QString fileName(const Preset& preset) {
  QString plain;
  for (const QChar c : preset.name.toLower()) plain += c.isLetterOrNumber() ? c : QChar('-');
  const QByteArray hash = QCryptographicHash::hash(preset.name.toUtf8(), QCryptographicHash::Sha1).toHex().left(8);
  return QStringLiteral("%1-%2-%3.json").arg(preset.domain, plain.left(40), QString::fromLatin1(hash));
}

}  // namespace

Result<Preset> readPreset(const QString& path) {
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return Error{file.errorString().toStdString()};
  if (file.size() > kLargestFile) return Error{"is too large for a preset"};
  return presetFromJson(file.readAll());
}

PresetLibrary::PresetLibrary(const QString& folder)
    : folder_(!folder.isEmpty()
                  ? folder
                  : QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + QStringLiteral("/presets")) {
  initPresetResources();
  const auto readAll = [this](const QString& from, bool builtIn) {
    const QDir directory(from);
    for (const QString& name : directory.entryList({QStringLiteral("*.json")}, QDir::Files, QDir::Name)) {
      const QString path = directory.filePath(name);
      Result<Preset> preset = readPreset(path);
      if (!preset) {
        problems_.push_back(path + QStringLiteral(": ") + QString::fromStdString(preset.error().message));
        continue;
      }
      if (!builtIn) preset->file = path;
      presets_.push_back(*preset);
    }
  };
  readAll(QStringLiteral(":/windfall/presets"), true);
  readAll(folder_, false);
}

std::vector<Preset> PresetLibrary::of(const QString& domain) const {
  std::vector<Preset> found;
  std::copy_if(presets_.begin(), presets_.end(), std::back_inserter(found),
               [&](const Preset& preset) { return preset.domain == domain; });
  return found;
}

std::optional<Preset> PresetLibrary::find(const QString& domain, const QString& name) const {
  // Built-in ones stand first, so the last of a name is the artist's own.
  const auto found = std::find_if(presets_.rbegin(), presets_.rend(),
                                  [&](const Preset& preset) { return preset.domain == domain && preset.name == name; });
  return found == presets_.rend() ? std::nullopt : std::optional(*found);
}

Status PresetLibrary::save(Preset preset) {
  const Result<Preset> good = presetFromJson(presetToJson(preset));
  if (!good) return good.error();
  preset.name = good->name;
  if (!QDir().mkpath(folder_)) return Error{"the folder " + folder_.toStdString() + " cannot be made"};
  preset.file = QDir(folder_).filePath(fileName(preset));
  if (Status written = writeDurably(preset.file, presetToJson(preset)); !written) return written;
  std::erase_if(presets_, [&](const Preset& other) { return other.file == preset.file; });
  presets_.push_back(std::move(preset));
  return ok();
}

Result<Preset> PresetLibrary::import(const QString& path, const QString& domain) {
  const Result<Preset> preset = readPreset(path);
  if (!preset) return preset.error();
  if (preset->domain != domain) {
    return Error{QStringLiteral("is a preset of “%1”, not of “%2”").arg(preset->domain, domain).toStdString()};
  }
  if (const Status saved = save(*preset); !saved) return saved.error();
  return *find(domain, preset->name);
}

Status PresetLibrary::remove(const QString& domain, const QString& name) {
  const std::optional<Preset> preset = find(domain, name);
  if (!preset) return Error{"there is no such preset"};
  if (preset->file.isEmpty()) return Error{"is built in"};
  if (!QFile::remove(preset->file)) return Error{preset->file.toStdString() + ": cannot be removed"};
  std::erase(presets_, *preset);
  return ok();
}

}  // namespace windfall::model
