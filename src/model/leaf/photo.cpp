#include <QBuffer>
#include <QImageReader>

#include "model/leaf/picture_file.h"
#include "model/leaf/stages.h"

namespace windfall::model {

namespace {
constexpr qint64 kMostPixels = 120'000'000;
constexpr int kLeastSide = 16;
}  // namespace

Result<QImage> readPhoto(const SourceFile& file) {
  if (file.isEmpty()) return Error{"the picture is empty"};
  QByteArray bytes = file.bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::ReadOnly);
  QImageReader reader(&buffer);
  reader.setAutoTransform(true);
  reader.setDecideFormatFromContent(true);
  const QSize size = reader.size();
  if (!reader.canRead()) return Error{"not a picture that can be read (JPEG and PNG can)"};
  if (size.isValid() && static_cast<qint64>(size.width()) * size.height() > kMostPixels) {
    return Error{QStringLiteral("the picture has %1 × %2 pixels; at most 120 million can be used")
                     .arg(size.width())
                     .arg(size.height())
                     .toStdString()};
  }
  if (const Status whole = checkPictureFile(bytes); !whole) return whole.error();
  QImage image;
  if (!reader.read(&image)) return Error{"the picture is damaged: " + reader.errorString().toStdString()};
  if (image.width() < kLeastSide || image.height() < kLeastSide) {
    return Error{
        QStringLiteral("the picture has only %1 × %2 pixels").arg(image.width()).arg(image.height()).toStdString()};
  }
  return image.convertToFormat(QImage::Format_RGBA8888);
}

}  // namespace windfall::model
