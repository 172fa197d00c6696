#include "model/leaf/stages.h"

#include <QElapsedTimer>
#include <QLineF>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "model/leaf/axis.h"
#include "model/leaf/contour.h"
#include "model/leaf/distance.h"
#include "model/leaf/image_cv_private.h"
#include "model/leaf/mask.h"
#include "model/leaf/petiole_region.h"
#include "model/leaf/regions.h"
#include "model/leaf/shape.h"
#include "model/leaf/soft_mask.h"
#include "model/leaf/superpixels.h"
#include "model/leaf/vein_extraction.h"
#include "model/leaf/vein_growth.h"
#include "model/leaf/vein_micro.h"
#include "model/leaf/vein_root.h"
#include "model/leaf/vein_tracing.h"

namespace windfall::model {

namespace {

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

/// The same kinds of tissue, read back from a measured structure: the vein distance is 0 on veins alone.
std::vector<Tissue> tissueOf(const LeafStructure& structure, const QImage& alpha) {
  const cv::Mat1b leaf = grayView(alpha);
  std::vector<Tissue> types(structure.veinDistance.values.size());
  auto opaque = leaf.begin();
  for (size_t i = 0; i < types.size(); ++i, ++opaque) {
    types[i] = *opaque < 128 ? Tissue::Outside : structure.veinDistance.values[i] > 0 ? Tissue::Blade : Tissue::Vein;
  }
  return types;
}

/// Whether the veins that part the blade are equal.
bool sameStructure(const Veins& a, const Veins& b) {
  const auto parts = [](const Vein& vein) { return vein.order <= kStructureOrder; };
  auto left = a.begin(), right = b.begin();
  for (;; ++left, ++right) {
    left = std::find_if(left, a.end(), parts);
    right = std::find_if(right, b.end(), parts);
    if (left == a.end() || right == b.end()) return left == a.end() && right == b.end();
    if (left->points != right->points || left->startWidth != right->startWidth || left->endWidth != right->endWidth) {
      return false;
    }
  }
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
  Computation(const Leaf& leaf, Progress& progress, const LeafStages* known)
      : leaf_(leaf), progress_(progress), known_(known) {}

  /// The shape alone, in a given frame: colours will come from elsewhere.
  void shapeOnly(const QRect& frame) { givenFrame_ = frame; }

  Result<LeafStages> run(Stage last) {
    using Step = Result<bool> (Computation::*)();
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
    result_.made = leaf_;
    result_.made.variants.clear();
    result_.bladeLength = leaf_.bladeLength;
    for (const Named& named : kSteps) {
      if (named.stage > last) break;
      if (progress_.cancelled()) return Error{"cancelled", true};
      QElapsedTimer timer;
      timer.start();
      const Result<bool> taken = (this->*named.step)();
      if (!taken) return taken.error();
      const QString name = QString::fromLatin1(named.name);
      if (*taken) {
        const auto before = known_->seconds.find(name);
        result_.seconds[name] = before == known_->seconds.end() ? 0 : before->second;
      } else {
        result_.seconds[name] = static_cast<double>(timer.nsecsElapsed()) * 1e-9;
        result_.computed.push_back(named.stage);
      }
      result_.reached = named.stage;
      progress_.report((static_cast<double>(named.stage) + 1) / std::size(kSteps));
    }
    return std::move(result_);
  }

 private:
  /// Whether `known_` has this stage at all.
  bool has(Stage stage) const { return known_ && known_->reached >= stage; }

  void setFrame(const QRect& frame) {
    result_.frame = frame;
    result_.scale =
        static_cast<double>(std::max(16, leaf_.parameters.synthesis.size)) / std::max(frame.width(), frame.height());
  }

  /// The mask's box with some ground around it, more where new outlines may be wider.
  QRect leafFrame() const {
    if (givenFrame_) return *givenFrame_;
    const cv::Rect box = cv::boundingRect(grayView(result_.mask));
    const double room = leaf_.parameters.shape.vary ? kShapeRoom : 1.0 / 32;
    const int margin = std::max(2, static_cast<int>(std::max(box.width, box.height) * room));
    return QRect(box.x, box.y, box.width, box.height).adjusted(-margin, -margin, margin, margin) & result_.photo.rect();
  }

  // Each step says whether it took the known result over.

  Result<bool> photo() {
    if (has(Stage::Photo) && known_->made.photo == leaf_.photo) {
      result_.photo = known_->photo;
      setFrame(result_.photo.rect());
      return true;
    }
    Result<QImage> image = readPhoto(leaf_.photo);
    if (!image) return image.error();
    result_.photo = *image;
    setFrame(image->rect());
    return false;
  }

  Result<bool> mask() {
    const bool samePhoto = has(Stage::Mask) && known_->photo.cacheKey() == result_.photo.cacheKey();
    if (samePhoto && known_->made.mask == leaf_.mask &&
        (!leaf_.mask.isNull() || known_->made.parameters.mask == leaf_.parameters.mask)) {
      result_.mask = known_->mask;
      return true;
    }
    if (leaf_.mask.isNull()) {
      Progress part;
      Result<QImage> found = automaticMask(result_.photo, leaf_.parameters.mask, part);
      if (!found) return found.error();
      result_.mask = *found;
    } else {
      if (leaf_.mask.size() != result_.photo.size()) return Error{"the mask does not have the photo's size"};
      const QImage gray = leaf_.mask.convertToFormat(QImage::Format_Grayscale8);
      const cv::Mat1b white = grayView(gray) > 127;
      if (cv::countNonZero(white) < 64) return Error{"no leaf found: the mask is empty"};
      result_.mask = toGray(white);
    }
    if (samePhoto && known_->mask == result_.mask) result_.mask = known_->mask;
    return false;
  }

  Result<bool> contour() {
    const bool sameMask = has(Stage::Contour) && known_->mask.cacheKey() == result_.mask.cacheKey();
    const bool sameAxis = sameMask && known_->photo.cacheKey() == result_.photo.cacheKey() &&
                          known_->made.root == leaf_.root && known_->made.tips == leaf_.tips;
    const double epsilon = leaf_.parameters.epsilon > 0
                               ? leaf_.parameters.epsilon
                               : std::max(result_.photo.width(), result_.photo.height()) / 256.0;
    result_.border = sameMask ? known_->border : traceBorder(result_.mask);
    if (result_.border.size() < 8) return Error{"no leaf found: the mask has no outline"};
    setFrame(leafFrame());
    if (sameAxis) {
      result_.root = known_->root;
      result_.tip = known_->tip;
      result_.petiole = known_->petiole;
    } else {
      if (leaf_.root && !QRectF(result_.photo.rect()).contains(*leaf_.root)) {
        return Error{"the root lies outside the picture"};
      }
      if (leaf_.root && !nearLeaf(*leaf_.root)) return Error{"the root lies outside the leaf"};
      LeafAxis axis = findAxis(result_.mask, result_.border, leaf_.root);
      if (!leaf_.root && axis.petiole.empty()) {
        axis = rootByVeins(result_.photo, result_.mask, result_.border, axis);
      }
      result_.root = axis.root;
      result_.tip = leaf_.tips.empty() ? axis.tip : leaf_.tips.front();
      result_.petiole = axis.petiole;
    }
    measureBlade();
    if (sameAxis && known_->made.parameters.epsilon == leaf_.parameters.epsilon) {
      result_.contour = known_->contour;
      return true;
    }
    result_.contour = simplifyClosed(mergeCollinear(result_.border), epsilon, result_.root, result_.tip);
    return false;
  }

  /// On the leaf, or beside it as far as a hand may miss: a tenth of its long side.
  bool nearLeaf(const QPointF& place) const {
    QRectF box;
    double nearest = 1e30;
    for (const QPointF& p : result_.border) {
      box |= QRectF(p, QSizeF(1, 1));
      nearest = std::min(nearest, QLineF(p, place).length());
    }
    return nearest <= 0.1 * std::max(box.width(), box.height()) ||
           grayView(result_.mask)(static_cast<int>(place.y()), static_cast<int>(place.x())) > 127;
  }

  void measureBlade() {
    const Ruler& ruler = leaf_.ruler;
    if (!ruler.isSet()) return;
    result_.bladeLength =
        ruler.metres * QLineF(result_.root, result_.tip).length() / QLineF(*ruler.from, *ruler.to).length();
  }

  Result<bool> veins() {
    const LeafAxis axis{result_.root, result_.tip, result_.petiole};
    const bool sameBase = has(Stage::Veins) && known_->mask.cacheKey() == result_.mask.cacheKey() &&
                          known_->root == axis.root && known_->petiole == axis.petiole && known_->tip == axis.tip &&
                          known_->made.tips == leaf_.tips;
    const bool sameMarks = sameBase && known_->made.veins == leaf_.veins;
    const VeinParameters& parameters = leaf_.parameters.veins;
    if (sameMarks && (!leaf_.veins.empty() || (known_->made.parameters.veins == parameters &&
                                               (!parameters.fromPhoto || known_->frame == result_.frame)))) {
      result_.veins = known_->veins;
      return true;
    }
    if (!leaf_.veins.empty()) {
      result_.veins = leaf_.veins;
    } else if (parameters.fromPhoto) {
      result_.veins = photoVeins(result_.photo, result_.mask, result_.frame, axis, parameters.detail);
      if (result_.veins.empty()) return Error{"the photo shows no veins; let them grow, or draw them"};
    } else {
      result_.veins = growVeins(result_.mask, result_.border, axis, leaf_.tips, parameters);
    }
    return false;
  }

  Result<bool> distance() {
    size_ = QSize(std::max(1, static_cast<int>(std::lround(result_.frame.width() * result_.scale))),
                  std::max(1, static_cast<int>(std::lround(result_.frame.height() * result_.scale))));
    const bool sameAlpha = has(Stage::Distance) && known_->mask.cacheKey() == result_.mask.cacheKey() &&
                           known_->frame == result_.frame && known_->scale == result_.scale;
    // Another leaf's shape lies over this photo: it tells nothing of its margin.
    const QImage photo = givenFrame_ ? QImage() : result_.photo.copy(result_.frame);
    result_.alpha = sameAlpha ? known_->alpha : softMask(result_.mask.copy(result_.frame), photo, size_);
    sameTissue_ = sameAlpha && sameStructure(known_->veins, result_.veins);
    sameDistance_ =
        sameTissue_ && known_->root == result_.root && known_->made.parameters.costs == leaf_.parameters.costs;
    if (sameDistance_) {
      result_.grown.distance = known_->grown.distance;
      result_.grown.veinDistance = known_->grown.veinDistance;
      return true;
    }
    types_ = tissueOf(result_.alpha,
                      drawVeins(result_.veins, size_, result_.frame.topLeft(), result_.scale, kStructureOrder));
    measure(types_, result_.grown);
    return false;
  }

  void measure(const std::vector<Tissue>& types, LeafStructure& structure) const {
    const QPoint source = nearestOnLeaf(types, size_, result_.toWorking(result_.root));
    structure.distance = normalised(structuralDistance(types, size_, source, leaf_.parameters.costs), size_, types);
    structure.veinDistance = veinDistanceField(types, size_);
  }

  Result<bool> regions() {
    if (sameTissue_ && has(Stage::Regions) && known_->made.markers == leaf_.markers && samePetiole()) {
      result_.grown.regions = known_->grown.regions;
      result_.markers = known_->markers;
      sameRegions_ = true;
      return true;
    }
    if (types_.empty()) types_ = tissueOf(result_.grown, result_.alpha);
    std::vector<QPointF> markers;
    for (const QPointF& marker : leaf_.markers) markers.push_back(result_.toWorking(marker));
    if (markers.empty()) markers = automaticMarkers(types_, size_);
    result_.grown.regions = growRegions(types_, size_, markers);
    setPetioleApart(result_.grown.regions, workingPetiole());
    for (const QPointF& marker : markers) result_.markers.push_back(result_.toPhoto(marker));
    return false;
  }

  bool samePetiole() const { return known_->petiole == result_.petiole; }

  std::vector<QPointF> workingPetiole() const {
    std::vector<QPointF> line;
    for (const QPointF& p : result_.petiole) line.push_back(result_.toWorking(p));
    return line;
  }

  Result<bool> superpixels() {
    const int count = leaf_.parameters.synthesis.superpixels;
    const bool sameCount = has(Stage::Superpixels) && known_->made.parameters.synthesis.superpixels == count;
    const bool sameGrown = sameCount && sameDistance_ && sameRegions_;
    if (sameGrown) result_.grown.superpixels = known_->grown.superpixels;
    // What the photo shows does not depend on the veins that were grown or drawn.
    const bool sameSeen = !givenFrame_ && has(Stage::Superpixels) &&
                          known_->photo.cacheKey() == result_.photo.cacheKey() &&
                          known_->alpha.cacheKey() == result_.alpha.cacheKey() && known_->root == result_.root &&
                          samePetiole() && known_->made.parameters.costs == leaf_.parameters.costs;
    if (sameSeen) result_.seen = known_->seen;
    const bool look = !sameSeen && !givenFrame_;
    QImage sized;
    if (look) {
      if (types_.empty()) types_ = tissueOf(result_.grown, result_.alpha);
      sized = result_.photo.copy(result_.frame)
                  .scaled(size_, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
                  .convertToFormat(QImage::Format_RGBA8888);
    }
    // The two structures know nothing of each other: a thread for each.
    LeafStructure* const structures[] = {&result_.grown, &result_.seen};
    const bool made[] = {!sameGrown, look || (sameSeen && !sameCount)};
#pragma omp parallel for schedule(static, 1)
    for (int n = 0; n < 2; ++n) {
      LeafStructure& structure = *structures[n];
      if (n == 1 && look) lookAt(sized, structure);
      if (made[n]) structure.superpixels = makeSuperpixels(structure.distance, structure.regions, count);
    }
    return sameGrown && (givenFrame_ || (sameSeen && sameCount));
  }

  /// The structure by the veins that the photo shows, but for superpixels.
  void lookAt(const QImage& sized, LeafStructure& structure) const {
    const std::vector<Tissue> seen = extractVeins(sized, types_, result_.toWorking(result_.root).toPoint());
    measure(seen, structure);
    structure.regions = growRegions(seen, size_, automaticMarkers(seen, size_));
    setPetioleApart(structure.regions, workingPetiole());
  }

  const Leaf& leaf_;
  Progress& progress_;
  const LeafStages* known_;
  std::optional<QRect> givenFrame_;
  LeafStages result_;
  QSize size_;
  std::vector<Tissue> types_;
  bool sameTissue_ = false, sameDistance_ = false, sameRegions_ = false;
};

}  // namespace

Result<LeafStages> computeStages(const Leaf& leaf, Stage last, Progress& progress, const LeafStages* known) {
  return Computation(leaf, progress, known).run(last);
}

Result<LeafStages> computeVariedStages(const LeafStages& of, quint64 seed, Progress& progress) {
  const Leaf varied = variedLeaf(of, seed);
  Computation computation(varied, progress, &of);
  computation.shapeOnly(of.frame);
  return computation.run(Stage::Superpixels);
}

}  // namespace windfall::model
