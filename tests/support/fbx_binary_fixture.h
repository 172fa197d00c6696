// Binary FBX 7.4, record by record, for files that the tests make themselves.
#pragma once

#include <QByteArray>
#include <QList>
#include <vector>

namespace windfall::test {

/// A record: its name, its values and what stands within it.
class FbxRecord {
 public:
  explicit FbxRecord(QByteArray name) : name_(std::move(name)) {}

  FbxRecord& integer(int value);
  FbxRecord& id(qint64 value);
  FbxRecord& number(double value);
  FbxRecord& text(const QByteArray& value);
  /// "name", then the class as FBX appends it.
  FbxRecord& object(const QByteArray& name, const QByteArray& kind) {
    return text(name + QByteArray("\0\1", 2) + kind);
  }
  FbxRecord& numbers(const std::vector<double>& values);
  FbxRecord& integers(const std::vector<int>& values);
  /// The record added.
  FbxRecord& add(FbxRecord record);

  /// Its bytes when it begins at `offset`.
  QByteArray bytes(qsizetype offset) const;

 private:
  QByteArray name_, values_;
  quint32 count_ = 0;
  std::vector<FbxRecord> within_;
};

/// The file that holds these records.
QByteArray fbxBinary(const std::vector<FbxRecord>& records);

}  // namespace windfall::test
