#include "model/leaf/stages.h"

#include <QElapsedTimer>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/axis.h"
#include "model/leaf/contour.h"
#include "model/leaf/distance.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/mask.h"
#include "model/leaf/regions.h"
#include "model/leaf/superpixels.h"
#include "model/leaf/vein_extraction.h"
#include "model/leaf/vein_growth.h"

namespace windfall::model {

namespace {

/// The mask in working size with a margin of about two pixels, smooth also where it was enlarged.
QImage softMask(const QImage& mask, QSize size) {
  cv::Mat1f field;
  grayView(mask).convertTo(field, CV_32F, 1 / 255.0);
  const double scale = static_cast<double>(size.width()) / mask.width();
  if (scale > 1) cv::GaussianBlur(field, field, {}, 0.6);
  cv::resize(field, field, {size.width(), size.height()}, 0, 0, scale > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
  const double sharpness = std::max(1.0, 0.6 * scale);
  cv::Mat1b alpha;
  field.convertTo(alpha, CV_8U, 255 * sharpness, 127.5 * (1 - sharpness));
  return toGray(alpha);
}

/// Reads a picture of veins drawn by the artist's curves into kinds of tissue.
std::vector<Tissue> tissueOf(const QImage& alpha, const QImage& veins) {
  const cv::Mat1b leaf = grayView(alpha), drawn = grayView(veins);
  std::vector<Tissue> types(static_cast<size_t>(leaf.rows) * static_cast<size_t>(leaf.cols));
  for (int y = 0; y < leaf.rows; ++y) {
    for (int x = 0; x < leaf.cols; ++x) {
      types[static_cast<size_t>(y) * static_cast<size_t>(leaf.cols) + static_cast<size_t>(x)] =
          leaf(y, x) < 128    ? Tissue::Outside
          : drawn(y, x) < 110 ? Tissue::Blade
                              : Tissue::Vein;
    }
  }
  return types;
}

/// The leaf's pixel nearest to a place.
QPoint nearestOnLeaf(const std::vector<Tissue>& types, QSize size, QPointF place) {
  QPoint best(0, 0);
  double least = 1e30;
  for (int y = 0; y < size.height(); ++y) {
    for (int x = 0; x < size.width(); ++x) {
      if (types[static_cast<size_t>(y) * static_cast<size_t>(size.width()) + static_cast<size_t>(x)] == Tissue::Outside)
        continue;
      const double dx = x - place.x(), dy = y - place.y();
      if (dx * dx + dy * dy < least) least = dx * dx + dy * dy, best = {x, y};
    }
  }
  return best;
}

class Computation {
 public:
  Computation(const Leaf& leaf, Progress& progress) : leaf_(leaf), progress_(progress) {}

  Result<LeafStages> run(Stage last) {
    using Step = Status (Computation::*)();
    struct Named {
      Stage stage;
      const char* name;
      Step step;
    };
    static constexpr Named kSteps[] = {
        {Stage::Photo, "photo", &Computation::photo},
        {Stage::Mask, "mask", &Computation::mask},
        {Stage::Contour, "contour", &Computation::contour},
        {Stage::Veins, "veins", &Computation::veins},
        {Stage::Distance, "distance", &Computation::distance},
        {Stage::Regions, "regions", &Computation::regions},
        {Stage::Superpixels, "superpixels", &Computation::superpixels},
    };
    for (const Named& named : kSteps) {
      if (named.stage > last) break;
      if (progress_.cancelled()) return Error{"cancelled", true};
      QElapsedTimer timer;
      timer.start();
      if (const Status status = (this->*named.step)(); !status) return status.error();
      result_.seconds[QString::fromLatin1(named.name)] = static_cast<double>(timer.nsecsElapsed()) * 1e-9;
      result_.reached = named.stage;
      progress_.report((static_cast<double>(named.stage) + 1) / std::size(kSteps));
    }
    return std::move(result_);
  }

 private:
  void setFrame(const QRect& frame) {
    result_.frame = frame;
    result_.scale =
        static_cast<double>(std::max(16, leaf_.parameters.synthesis.size)) / std::max(frame.width(), frame.height());
  }

  /// The mask's box with some ground around it.
  QRect leafFrame() const {
    const cv::Rect box = cv::boundingRect(grayView(result_.mask));
    const int margin = std::max(2, std::max(box.width, box.height) / 32);
    return QRect(box.x, box.y, box.width, box.height).adjusted(-margin, -margin, margin, margin) & result_.photo.rect();
  }

  Status photo() {
    Result<QImage> image = readPhoto(leaf_.photo);
    if (!image) return image.error();
    result_.photo = *image;
    setFrame(image->rect());
    return ok();
  }

  Status mask() {
    if (leaf_.mask.isNull()) {
      Progress part;
      Result<QImage> found = automaticMask(result_.photo, part);
      if (!found) return found.error();
      result_.mask = *found;
      return ok();
    }
    result_.mask = leaf_.mask.convertToFormat(QImage::Format_Grayscale8);
    if (result_.mask.size() != result_.photo.size()) return Error{"the mask does not have the photo's size"};
    cv::Mat1b white = grayView(result_.mask);
    cv::threshold(white, white, 127, 255, cv::THRESH_BINARY);
    if (cv::countNonZero(white) < 64) return Error{"no leaf found: the mask is empty"};
    return ok();
  }

  Status contour() {
    result_.border = traceBorder(result_.mask);
    if (result_.border.size() < 8) return Error{"no leaf found: the mask has no outline"};
    setFrame(leafFrame());
    const LeafAxis axis = findAxis(result_.mask, result_.border, leaf_.root);
    result_.root = axis.root;
    result_.tip = axis.tip;
    result_.petiole = axis.petiole;
    const double epsilon = leaf_.parameters.epsilon > 0
                               ? leaf_.parameters.epsilon
                               : std::max(result_.photo.width(), result_.photo.height()) / 256.0;
    result_.contour = simplifyClosed(mergeCollinear(result_.border), epsilon, axis.root, axis.tip);
    return ok();
  }

  Status veins() {
    result_.veins = leaf_.veins;
    if (result_.veins.empty()) {
      result_.veins =
          growVeins(result_.mask, result_.border, {result_.root, result_.tip, result_.petiole}, leaf_.parameters.veins);
    }
    return ok();
  }

  Status distance() {
    size_ = QSize(std::max(1, static_cast<int>(std::lround(result_.frame.width() * result_.scale))),
                  std::max(1, static_cast<int>(std::lround(result_.frame.height() * result_.scale))));
    result_.alpha = softMask(result_.mask.copy(result_.frame), size_);
    types_ = tissueOf(result_.alpha, drawVeins(result_.veins, size_, result_.frame.topLeft(), result_.scale));
    return measure(types_, result_.grown);
  }

  Status measure(const std::vector<Tissue>& types, LeafStructure& structure) {
    const QPoint source = nearestOnLeaf(types, size_, result_.toWorking(result_.root));
    structure.distance = normalised(structuralDistance(types, size_, source, leaf_.parameters.costs), size_, types);
    structure.veinDistance = veinDistanceField(types, size_);
    return ok();
  }

  Status regions() {
    std::vector<QPointF> markers;
    for (const QPointF& marker : leaf_.markers) markers.push_back(result_.toWorking(marker));
    if (markers.empty()) markers = automaticMarkers(types_, size_);
    result_.grown.regions = growRegions(types_, size_, markers);
    for (const QPointF& marker : markers) result_.markers.push_back(result_.toPhoto(marker));
    return ok();
  }

  Status superpixels() {
    const int count = leaf_.parameters.synthesis.superpixels;
    result_.grown.superpixels = makeSuperpixels(result_.grown.distance, result_.grown.regions, count);
    QImage sized = result_.photo.copy(result_.frame)
                       .scaled(size_, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                       .convertToFormat(QImage::Format_RGBA8888);
    const QPointF root = result_.toWorking(result_.root);
    const std::vector<Tissue> seen = extractVeins(sized, types_, root.toPoint());
    if (Status status = measure(seen, result_.seen); !status) return status;
    result_.seen.regions = growRegions(seen, size_, automaticMarkers(seen, size_));
    result_.seen.superpixels = makeSuperpixels(result_.seen.distance, result_.seen.regions, count);
    return ok();
  }

  const Leaf& leaf_;
  Progress& progress_;
  LeafStages result_;
  QSize size_;
  std::vector<Tissue> types_;
};

}  // namespace

Result<LeafStages> computeStages(const Leaf& leaf, Stage last, Progress& progress) {
  return Computation(leaf, progress).run(last);
}

}  // namespace windfall::model
