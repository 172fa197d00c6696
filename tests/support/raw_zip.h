// Zip files written byte by byte, so that tests can lie in every header.
#pragma once

#include <QByteArray>
#include <QList>
#include <QtEndian>

namespace windfall::test {

struct RawEntry {
  QByteArray name;
  QByteArray content;
  bool deflate = false;
  qint64 claimedSize = -1;     ///< uncompressed size in the headers; -1: the truth
  quint16 flags = 0x0800;      ///< UTF-8 names; 1: encrypted
  quint32 unixMode = 0100644;  ///< 0120777: a symbolic link
  bool wrongChecksum = false;
};

inline quint32 crc32Of(const QByteArray& bytes) {
  quint32 crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<quint8>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xEDB88320U : 0U);
  }
  return ~crc;
}

inline QByteArray rawZip(const QList<RawEntry>& entries) {
  QByteArray file, directory;
  const auto put16 = [](QByteArray& to, quint64 value) {
    const auto little = qToLittleEndian(static_cast<quint16>(value));
    to.append(reinterpret_cast<const char*>(&little), 2);
  };
  const auto put32 = [](QByteArray& to, quint64 value) {
    const auto little = qToLittleEndian(static_cast<quint32>(value));
    to.append(reinterpret_cast<const char*>(&little), 4);
  };
  for (const RawEntry& entry : entries) {
    QByteArray data = entry.content;
    if (entry.deflate) {
      // qCompress: four bytes of length, a zlib header of two, the deflated bytes, a checksum of four.
      data = qCompress(entry.content, 6);
      data = data.mid(6, data.size() - 10);
    }
    const quint64 size = static_cast<quint64>(entry.claimedSize < 0 ? entry.content.size() : entry.claimedSize);
    const quint32 crc = crc32Of(entry.content) ^ (entry.wrongChecksum ? 1U : 0U);
    const qsizetype place = file.size();
    const auto common = [&](QByteArray& to) {
      put16(to, 20), put16(to, entry.flags), put16(to, entry.deflate ? 8 : 0), put16(to, 0), put16(to, 0x21);
      put32(to, crc), put32(to, static_cast<quint64>(data.size())), put32(to, size);
      put16(to, static_cast<quint64>(entry.name.size())), put16(to, 0);
    };
    put32(file, 0x04034b50), common(file);
    file += entry.name + data;
    put32(directory, 0x02014b50), put16(directory, 0x0314), common(directory);
    put16(directory, 0), put16(directory, 0), put16(directory, 0);
    put32(directory, quint64(entry.unixMode) << 16), put32(directory, static_cast<quint64>(place));
    directory += entry.name;
  }
  const qsizetype start = file.size();
  file += directory;
  put32(file, 0x06054b50), put32(file, 0);
  put16(file, static_cast<quint64>(entries.size())), put16(file, static_cast<quint64>(entries.size()));
  put32(file, static_cast<quint64>(directory.size())), put32(file, static_cast<quint64>(start)), put16(file, 0);
  return file;
}

}  // namespace windfall::test
