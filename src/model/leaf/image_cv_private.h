// Between Qt's pictures and OpenCV's matrices; private to model.
#pragma once

#include <QImage>
#include <opencv2/core.hpp>

namespace windfall::model {

/// A view of a Grayscale8 picture; the picture must outlive it.
inline cv::Mat1b grayView(const QImage& image) {
  return {image.height(), image.width(), const_cast<uchar*>(image.constBits()),
          static_cast<size_t>(image.bytesPerLine())};
}

/// A view of an RGBA8888 picture, channels R, G, B, A; the picture must outlive it.
inline cv::Mat4b rgbaView(const QImage& image) {
  return {image.height(), image.width(), reinterpret_cast<cv::Vec4b*>(const_cast<uchar*>(image.constBits())),
          static_cast<size_t>(image.bytesPerLine())};
}

inline QImage toGray(const cv::Mat1b& field) {
  QImage image(field.cols, field.rows, QImage::Format_Grayscale8);
  field.copyTo(grayView(image));
  return image;
}

inline QImage toRgba(const cv::Mat4b& pixels) {
  QImage image(pixels.cols, pixels.rows, QImage::Format_RGBA8888);
  pixels.copyTo(rgbaView(image));
  return image;
}

/// CIE L*a*b* as floats of an RGBA8888 picture (sRGB).
cv::Mat3f toLab(const QImage& rgba);
/// And back, with an alpha channel.
QImage fromLab(const cv::Mat3f& lab, const cv::Mat1b& alpha);

}  // namespace windfall::model
