// The atlas as it would be exported: its picture with the leaves' rectangles, and how it is packed.
#pragma once

#include <QWidget>

#include "model/document/document.h"
#include "model/document/job.h"
#include "model/leaf/atlas.h"

class QLabel;

namespace windfall::widgets {

class CheckField;
class ChoiceField;
class ImagePane;
class NumberField;

/// Packs anew in the background when something that it shows has changed and it is visible. Settings are edits of the
/// document; which map, ground and mip level are looked at is not.
class AtlasPanel : public QWidget {
  Q_OBJECT
 public:
  AtlasPanel(model::Document& document, model::JobRunner& jobs, QWidget* parent = nullptr);
  bool isComputing() const { return running_ != 0; }
  /// What is shown; null before the first was packed.
  const model::Atlas* atlas() const { return atlas_.get(); }
  ImagePane& pane() { return *pane_; }
  ChoiceField* mip() const { return mip_; }
  ChoiceField* ground() const { return ground_; }
  ChoiceField* packer() const { return packer_; }
  ChoiceField* sizeField() const { return size_; }
  NumberField* leafPixels() const { return leafPixels_; }

 signals:
  void exportRequested(bool elsewhere);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* buildFields();
  void refresh();
  void pack();
  void showPicture();
  void edit(const QString& text, const QString& merge, const std::function<void(model::AtlasSettings&)>& change);

  model::Document& document_;
  model::JobRunner& jobs_;
  ImagePane* pane_;
  QLabel* note_;
  ChoiceField *size_, *packer_, *map_, *mip_, *ground_;
  NumberField *leafPixels_, *padding_, *mips_;
  CheckField *rotate_, *outlines_;
  std::shared_ptr<const model::Atlas> atlas_;
  bool stale_ = true;
  quint64 running_ = 0, lastRun_ = 0;
};

}  // namespace windfall::widgets
