#include "model/plant/fbx_check.h"

#include <QtEndian>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "model/plant/hierarchy.h"

namespace windfall::model {

namespace {

constexpr int kMostNested = 64;  // records within records; the format itself needs six

Error cutOff() { return Error{"is cut off"}; }
Error tooNested() { return Error{"nests its records more than 64 deep"}; }

/// The models of a file and who hangs on whom.
class Models {
 public:
  void add(std::int64_t id, QByteArrayView name) {
    if (indexOf_.emplace(id, names_.size()).second) names_.push_back(name.toByteArray());
  }
  void connect(std::int64_t child, std::int64_t parent) { links_.emplace_back(child, parent); }

  Result<int> levels() const {
    std::vector<std::ptrdiff_t> parent(names_.size(), -1);
    std::vector<char> placed(names_.size(), 0);
    for (const auto& [from, to] : links_) {
      const auto child = indexOf_.find(from), above = indexOf_.find(to);
      // What else is connected (clusters, materials, curves) makes no nodes; 0 is the scene.
      if (child == indexOf_.end() || (above == indexOf_.end() && to != 0)) continue;
      if (std::exchange(placed[child->second], 1)) return Error{nameOf(child->second) + " has two parents"};
      if (to != 0) parent[child->second] = static_cast<std::ptrdiff_t>(above->second);
    }
    return levelsOf(parent, [this](std::size_t i) { return nameOf(i); });
  }

 private:
  std::string nameOf(std::size_t i) const {
    return "node \"" + QString::fromUtf8(names_[i]).left(80).simplified().toStdString() + "\"";
  }

  std::vector<QByteArray> names_;
  std::unordered_map<std::int64_t, std::size_t> indexOf_;
  std::vector<std::pair<std::int64_t, std::int64_t>> links_;
};

/// The records of a binary file.
class BinaryWalk {
 public:
  explicit BinaryWalk(const QByteArray& bytes) : bytes_(bytes) {}

  Result<int> run() {
    if (bytes_.size() < kFirst) return cutOff();
    wide_ = qFromLittleEndian<quint32>(bytes_.constData() + 23) >= 7500;
    std::vector<qsizetype> ends;  // of the records that are open
    QByteArrayView section;
    for (qsizetype at = kFirst; at < bytes_.size();) {
      while (!ends.empty() && at == ends.back()) ends.pop_back();
      if (ends.empty() && bytes_.size() - at < head()) break;  // a file may end without its footer
      Record record;
      if (!read(at, record)) return cutOff();
      if (record.end == 0) {  // closes a list
        if (ends.empty()) break;
        at = ends.back();
        continue;
      }
      if (record.end < record.within || record.end > (ends.empty() ? bytes_.size() : ends.back())) return cutOff();
      if (ends.empty()) section = record.name;
      if (ends.size() == 1) note(section, record);
      if (record.within < record.end) {
        if (ends.size() >= kMostNested) return tooNested();
        ends.push_back(record.end);
      }
      at = record.within;
    }
    return models_.levels();
  }

 private:
  struct Record {
    qsizetype end = 0, values = 0, within = 0;  ///< places in the file
    QByteArrayView name;
  };
  static constexpr qsizetype kFirst = 27;
  qsizetype head() const { return wide_ ? 25 : 13; }

  qint64 word(qsizetype at) const {
    return wide_ ? static_cast<qint64>(qFromLittleEndian<quint64>(bytes_.constData() + at))
                 : qint64{qFromLittleEndian<quint32>(bytes_.constData() + at)};
  }

  bool read(qsizetype at, Record& record) const {
    if (bytes_.size() - at < head()) return false;
    const qsizetype size = wide_ ? 8 : 4;
    const qint64 end = word(at), valueBytes = word(at + 2 * size);
    const auto nameBytes = static_cast<uchar>(bytes_[at + 3 * size]);
    record.end = end;
    record.values = at + head() + nameBytes;
    if (end < 0 || valueBytes < 0 || record.values > bytes_.size() || valueBytes > bytes_.size() - record.values) {
      return false;
    }
    record.within = record.values + valueBytes;
    record.name = QByteArrayView(bytes_).sliced(at + head(), nameBytes);
    return true;
  }

  bool number(qsizetype& at, qsizetype end, std::int64_t& value) const {
    if (end - at < 9 || bytes_[at] != 'L') return false;
    value = qFromLittleEndian<qint64>(bytes_.constData() + at + 1);
    at += 9;
    return true;
  }
  bool text(qsizetype& at, qsizetype end, QByteArrayView& value) const {
    if (end - at < 5 || bytes_[at] != 'S') return false;
    const qint64 size = qFromLittleEndian<quint32>(bytes_.constData() + at + 1);
    if (size > end - at - 5) return false;
    value = QByteArrayView(bytes_).sliced(at + 5, size);
    at += 5 + size;
    return true;
  }

  void note(QByteArrayView section, const Record& record) {
    qsizetype at = record.values;
    std::int64_t a = 0, b = 0;
    QByteArrayView kind;
    if (section == "Objects" && record.name == "Model") {
      // The class follows the name after two bytes that no name holds.
      if (number(at, record.within, a) && text(at, record.within, kind)) {
        models_.add(
            a, kind.first(std::max<qsizetype>(0, QByteArray::fromRawData(kind.data(), kind.size()).indexOf('\0'))));
      }
    } else if (section == "Connections" && record.name == "C") {
      if (text(at, record.within, kind) && kind == "OO" && number(at, record.within, a) &&
          number(at, record.within, b)) {
        models_.connect(a, b);
      }
    }
  }

  const QByteArray& bytes_;
  bool wide_ = false;
  Models models_;
};

/// Text, a statement a line: `Model: 30, "Model::lower", "LimbNode" {` and `C: "OO",30,0`.
Result<int> walkText(const QByteArray& bytes) {
  Models models;
  int depth = 0;
  QByteArrayView section;
  const QByteArrayView all(bytes);
  for (qsizetype start = 0; start < all.size();) {
    qsizetype stop = bytes.indexOf('\n', start);
    if (stop < 0) stop = all.size();
    const QByteArrayView line = all.sliced(start, stop - start).trimmed();
    start = stop + 1;
    if (line.startsWith(';')) continue;
    const QByteArray raw = QByteArray::fromRawData(line.data(), line.size());
    if (depth == 0) section = line.first(std::max<qsizetype>(0, raw.indexOf(':')));
    if (depth == 1 && section == "Objects" && line.startsWith("Model:")) {
      const QList<QByteArray> values = raw.mid(6).split(',');
      bool good = false;
      const qint64 id = values[0].trimmed().toLongLong(&good);
      QByteArray name = values.size() > 1 ? values[1].trimmed() : QByteArray();
      if (name.startsWith('"') && name.endsWith('"') && name.size() > 1) name = name.mid(1, name.size() - 2);
      if (name.startsWith("Model::")) name = name.mid(7);
      if (good) models.add(id, name);
    } else if (depth == 1 && section == "Connections" && line.startsWith("C:")) {
      const QList<QByteArray> values = raw.mid(2).split(',');
      bool first = false, second = false;
      const qint64 from = values.size() > 2 ? values[1].trimmed().toLongLong(&first) : 0;
      const qint64 to = values.size() > 2 ? values[2].trimmed().toLongLong(&second) : 0;
      if (first && second && values[0].trimmed() == "\"OO\"") models.connect(from, to);
    }
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') quoted = !quoted;
      if (!quoted) depth += c == '{' ? 1 : c == '}' ? -1 : 0;
      if (depth > kMostNested) return tooNested();
    }
  }
  if (depth > 0) return cutOff();
  return models.levels();
}

}  // namespace

Result<int> checkFbx(const QByteArray& bytes) {
  return bytes.startsWith("Kaydara FBX Binary") ? BinaryWalk(bytes).run() : walkText(bytes);
}

}  // namespace windfall::model
