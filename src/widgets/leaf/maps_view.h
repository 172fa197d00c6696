// The maps of one variant, and how it ages, computed in the background as they are looked at.
#pragma once

#include <QObject>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/maps_picture.h"
#include "model/leaf/stages.h"
#include "widgets/leaf/mip_image.h"

namespace windfall::widgets {

/// Old pictures stay until new ones are there; a newer wish makes an older one stale.
class MapsView : public QObject {
  Q_OBJECT
 public:
  MapsView(model::Document& document, model::JobRunner& jobs, QObject* parent = nullptr);

  /// `stages` up to the veins; null: not known yet, then only the variant itself can be shown.
  void show(model::AssetId leaf, int variant, model::MapKind kind, const model::LeafStages* stages);
  const MipImage& picture() const { return picture_; }
  bool isComputing() const { return running_ != 0; }

 signals:
  void changed();

 private:
  struct Wish {
    quint64 variant = 0;  ///< cache key of its picture
    model::MapParameters maps;
    model::AgeingParameters ageing;
    model::MapKind kind = model::MapKind::Lit;
    QPointF root;
    model::Veins veins;
    bool operator==(const Wish&) const = default;
  };

  model::Document& document_;
  model::JobRunner& jobs_;
  Wish wish_;
  MipImage picture_;
  quint64 running_ = 0, lastRun_ = 0;
};

}  // namespace windfall::widgets
