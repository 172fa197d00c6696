#include <QLineF>
#include <QTransform>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/atlas.h"
#include "model/leaf/dilate.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/linear_light_private.h"

namespace windfall::model {

namespace {

constexpr int kMargin = 2;       // px of transparency around a cropped leaf
constexpr int kVisible = 16;     // alpha that counts as leaf
constexpr double kStalk = 0.15;  // share of the blade's length: a run of pixels this narrow is petiole

/// Follows the leaf's pixels down from the root: the petiole's free end, or the root where there is none.
QPointF petioleEnd(const cv::Mat1b& alpha, QPointF root, double bladeLength) {
  QPointF end = root;
  int x = qRound(root.x());
  for (int y = qRound(root.y()); y >= 0 && y < alpha.rows; ++y) {
    const int slack = std::max(2, static_cast<int>(0.01 * bladeLength));
    int hit = -1;
    for (int d = 0; d <= slack && hit < 0; ++d) {
      for (const int candidate : {x - d, x + d}) {
        if (hit < 0 && candidate >= 0 && candidate < alpha.cols && alpha(y, candidate) >= kVisible) hit = candidate;
      }
    }
    if (hit < 0) break;
    int left = hit, right = hit;
    while (left > 0 && alpha(y, left - 1) >= kVisible) --left;
    while (right + 1 < alpha.cols && alpha(y, right + 1) >= kVisible) ++right;
    x = right - left < kStalk * bladeLength ? (left + right) / 2 : hit;
    end = QPointF(x, y);
  }
  return end;
}

}  // namespace

LeafTexture uprightTexture(const QString& name, const QImage& variant, QPointF root, QPointF tip, double bladeLength,
                           const Veins& veins) {
  LeafTexture texture;
  texture.name = name;
  if (variant.isNull()) return texture;
  const QImage source = spreadColours(variant);
  QLineF axis(root, tip);
  if (axis.length() < 1) axis.setP2(root + QPointF(0, -std::max(1, variant.height())));
  // QLineF counts angles counter-clockwise from the right; up is 90 degrees.
  const QTransform turn = QTransform().rotate(axis.angle() - 90);
  const QRectF turned = turn.mapRect(QRectF(QPointF(0, 0), QSizeF(source.size())));
  const QTransform toTurned = turn * QTransform::fromTranslate(-turned.left(), -turned.top());
  const cv::Matx23d matrix(toTurned.m11(), toTurned.m21(), toTurned.dx(), toTurned.m12(), toTurned.m22(),
                           toTurned.dy());
  cv::Mat4f rotated;
  cv::warpAffine(toLinear(source), rotated, matrix,
                 {static_cast<int>(std::ceil(turned.width())), static_cast<int>(std::ceil(turned.height()))},
                 cv::INTER_LINEAR, cv::BORDER_CONSTANT, cv::Scalar::all(0));
  cv::Mat1b alpha(rotated.size());
  for (int y = 0; y < rotated.rows; ++y) {
    for (int x = 0; x < rotated.cols; ++x) alpha(y, x) = cv::saturate_cast<uchar>(255 * rotated(y, x)[3]);
  }
  const cv::Mat1b leaf = alpha >= kVisible;
  cv::Rect box = cv::boundingRect(leaf);
  if (box.empty()) box = cv::Rect(0, 0, rotated.cols, rotated.rows);
  box = cv::Rect(box.x - kMargin, box.y - kMargin, box.width + 2 * kMargin, box.height + 2 * kMargin);
  const QPointF end = petioleEnd(alpha, toTurned.map(root), axis.length()) - QPointF(box.x, box.y);
  cv::Mat4f cropped(box.size(), cv::Vec4f::all(0));
  const cv::Rect inside = box & cv::Rect(0, 0, rotated.cols, rotated.rows);
  rotated(inside).copyTo(cropped(cv::Rect(inside.x - box.x, inside.y - box.y, inside.width, inside.height)));
  texture.image = spreadColours(fromLinear(cropped));
  texture.pivot = QPointF((end.x() + 0.5) / box.width, (end.y() + 0.5) / box.height);
  texture.toTexture = toTurned * QTransform::fromTranslate(-box.x, -box.y);
  texture.root = texture.toTexture.map(root);
  texture.veins = veins;
  for (Vein& vein : texture.veins) {
    for (QPointF& p : vein.points) p = texture.toTexture.map(p);
  }
  texture.metres = QSizeF(box.width, box.height) * (bladeLength / axis.length());
  return texture;
}

}  // namespace windfall::model
