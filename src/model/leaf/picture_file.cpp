#include "model/leaf/picture_file.h"

#include <QtEndian>
#include <boost/crc.hpp>

namespace windfall::model {

namespace {

const char* const kCutOff = "the picture is damaged: its file is cut off";

/// Length, type, data and checksum, until IEND.
Status checkPng(const QByteArray& bytes) {
  qsizetype at = 8;
  for (;;) {
    if (bytes.size() - at < 12) return Error{kCutOff};
    const qsizetype length = qFromBigEndian<quint32>(bytes.constData() + at);
    if (bytes.size() - at - 12 < length) return Error{kCutOff};
    boost::crc_32_type sum;
    sum.process_bytes(bytes.constData() + at + 4, static_cast<std::size_t>(length) + 4);
    if (sum.checksum() != qFromBigEndian<quint32>(bytes.constData() + at + 8 + length)) {
      return Error{"the picture is damaged: a part of it has changed since it was written"};
    }
    if (bytes.mid(at + 4, 4) == "IEND") return ok();
    at += 12 + length;
  }
}

/// The mark of the end must follow the last scan; inside a scan no byte FF stands before another mark.
Status checkJpeg(const QByteArray& bytes) {
  const qsizetype scan = bytes.lastIndexOf("\xff\xda");
  if (scan < 0 || bytes.indexOf("\xff\xd9", scan) < 0) return Error{kCutOff};
  return ok();
}

}  // namespace

Status checkPictureFile(const QByteArray& bytes) {
  if (bytes.startsWith("\x89PNG\r\n\x1a\n")) return checkPng(bytes);
  if (bytes.startsWith("\xff\xd8\xff")) return checkJpeg(bytes);
  return ok();
}

}  // namespace windfall::model
