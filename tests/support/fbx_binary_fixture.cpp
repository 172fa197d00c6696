#include "support/fbx_binary_fixture.h"

#include <QtEndian>
#include <cstring>

namespace windfall::test {

namespace {

template <class T>
void put(QByteArray& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

template <class T>
void putAll(QByteArray& bytes, char kind, const std::vector<T>& values) {
  const auto size = static_cast<qsizetype>(values.size() * sizeof(T));
  bytes.append(kind);
  put(bytes, static_cast<quint32>(values.size()));
  put(bytes, quint32{0});  // not compressed
  put(bytes, static_cast<quint32>(size));
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
}

constexpr qsizetype kHead = 13;  // end, values, their bytes, length of the name

}  // namespace

FbxRecord& FbxRecord::integer(int value) { return values_.append('I'), put(values_, value), ++count_, *this; }
FbxRecord& FbxRecord::id(qint64 value) { return values_.append('L'), put(values_, value), ++count_, *this; }
FbxRecord& FbxRecord::number(double value) { return values_.append('D'), put(values_, value), ++count_, *this; }

FbxRecord& FbxRecord::text(const QByteArray& value) {
  values_.append('S');
  put(values_, static_cast<quint32>(value.size()));
  values_.append(value);
  return ++count_, *this;
}

FbxRecord& FbxRecord::numbers(const std::vector<double>& values) {
  return putAll(values_, 'd', values), ++count_, *this;
}
FbxRecord& FbxRecord::integers(const std::vector<int>& values) { return putAll(values_, 'i', values), ++count_, *this; }

FbxRecord& FbxRecord::add(FbxRecord record) {
  within_.push_back(std::move(record));
  return within_.back();
}

QByteArray FbxRecord::bytes(qsizetype offset) const {
  QByteArray body = name_ + values_;
  for (const FbxRecord& record : within_) body += record.bytes(offset + kHead + body.size());
  if (!within_.empty()) body += QByteArray(kHead, '\0');
  QByteArray head;
  put(head, static_cast<quint32>(offset + kHead + body.size()));
  put(head, count_);
  put(head, static_cast<quint32>(values_.size()));
  put(head, static_cast<quint8>(name_.size()));
  return head + body;
}

QByteArray fbxBinary(const std::vector<FbxRecord>& records) {
  QByteArray file("Kaydara FBX Binary  \0\x1a\0", 23);
  put(file, quint32{7400});
  for (const FbxRecord& record : records) file += record.bytes(file.size());
  return file + QByteArray(kHead, '\0');
}

}  // namespace windfall::test
