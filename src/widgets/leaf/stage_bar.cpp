#include "widgets/leaf/stage_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/slider.h"
#include "widgets/leaf/legend.h"
#include "widgets/look/icon.h"
#include "widgets/look/look.h"

namespace windfall::widgets {

using model::Stage;

StageChip::StageChip(const QString& title, QWidget* parent) : QAbstractButton(parent) {
  setText(title);
  setCheckable(true);
  setFocusPolicy(Qt::NoFocus);
  setCursor(Qt::PointingHandCursor);
  setState(StageState::Unknown);
}

void StageChip::setState(StageState state) {
  state_ = state;
  const QString states[] = {tr("not computed yet"), tr("automatic"), tr("edited by hand"), tr("out of date")};
  setToolTip(tr("%1: %2").arg(text(), states[int(state)]));
  update();
}

QSize StageChip::sizeHint() const { return {fontMetrics().horizontalAdvance(text()) + 32, 26}; }

void StageChip::paintEvent(QPaintEvent*) {
  const Colors& c = colors(palette());
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF body = QRectF(rect()).adjusted(1, 1, -1, -1);
  painter.setPen(Qt::NoPen);
  if (isChecked() || underMouse()) {
    painter.setBrush(isChecked() ? c.selected : c.hover);
    painter.drawRoundedRect(body, 4, 4);
  }
  const QPointF dot(13, height() / 2.0);
  switch (state_) {
    case StageState::Unknown:
      painter.setPen(QPen(c.muted, 1.25));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(dot, 2.5, 2.5);
      break;
    case StageState::Automatic:
      painter.setBrush(c.accent);
      painter.drawEllipse(dot, 3, 3);
      break;
    case StageState::Edited:
      painter.setPen(QPen(c.accent, 1.5));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(dot, 4, 4);
      painter.setPen(Qt::NoPen);
      painter.setBrush(c.accent);
      painter.drawEllipse(dot, 1.75, 1.75);
      break;
    case StageState::OutOfDate:
      painter.setBrush(c.warning);
      painter.drawEllipse(dot, 3, 3);
      break;
  }
  painter.setPen(isChecked() ? c.text : c.muted);
  painter.drawText(rect().adjusted(23, 0, -4, 0), Qt::AlignLeft | Qt::AlignVCenter, text());
}

QString StageBar::title(Stage stage) {
  switch (stage) {
    case Stage::Photo:
      return tr("Photo");
    case Stage::Mask:
      return tr("Mask");
    case Stage::Contour:
      return tr("Contour");
    case Stage::Veins:
      return tr("Veins");
    case Stage::Distance:
      return tr("Distance");
    case Stage::Regions:
      return tr("Regions");
    case Stage::Superpixels:
      return tr("Superpixels");
    case Stage::Variants:
      return tr("Variants");
    case Stage::Maps:
      return tr("Maps");
    case Stage::Atlas:
      return tr("Atlas");
  }
  return {};
}

namespace {

/// The › between two stages.
class Separator : public QWidget {
 public:
  explicit Separator(QWidget* parent) : QWidget(parent) { setFixedSize(8, 26); }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QColor color = colors(palette()).muted;
    color.setAlphaF(0.7f);
    painter.setPen(QPen(color, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(QPolygonF({QPointF(2.5, 9), QPointF(6, 13), QPointF(2.5, 17)}));
  }
};

}  // namespace

StageBar::StageBar(QWidget* parent) : QWidget(parent), opacity_(new Slider(this)), field_(new ComboBox(this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, kGrid, 3 * kGrid, kGrid);
  row->setSpacing(0);
  for (int i = int(Stage::Photo); i <= int(Stage::Atlas); ++i) {
    if (i > 0) row->addWidget(new Separator(this));
    auto* chip = new StageChip(title(Stage(i)), this);
    chip->setAutoExclusive(true);
    row->addWidget(chip);
    chips_.push_back(chip);
    connect(chip, &QAbstractButton::clicked, this, [this, i] { emit chosen(Stage(i)); });
  }
  row->addStretch(1);
  for (int i = 0; i <= int(model::LeafField::Margin); ++i) field_->addItem(fieldTitle(model::LeafField(i)));
  field_->setToolTip(tr("Which field is laid over the photo"));
  field_->hide();
  row->addWidget(field_);
  row->addSpacing(3 * kGrid);
  connect(field_, &QComboBox::currentIndexChanged, this, &StageBar::fieldChanged);
  auto* label = new QLabel(tr("Overlay"), this);
  label->setProperty("hint", true);
  label->setMinimumWidth(0);
  row->addWidget(label);
  row->addSpacing(2 * kGrid);
  opacity_->setFixedWidth(96);
  opacity_->setToolTip(tr("How strongly the stage covers the photo"));
  opacity_->setPosition(0.85);
  row->addWidget(opacity_);
  connect(opacity_, &Slider::dragged, this, &StageBar::opacityChanged);
  setStage(Stage::Photo);
}

void StageBar::setStage(Stage stage) {
  chip(stage)->setChecked(true);
  field_->setVisible(stage == Stage::Distance);
}

model::LeafField StageBar::field() const { return model::LeafField(std::max(0, field_->currentIndex())); }

void StageBar::setField(model::LeafField field) { field_->setCurrentIndex(int(field)); }

void StageBar::setState(Stage stage, StageState state) { chip(stage)->setState(state); }

double StageBar::opacity() const { return opacity_->position(); }

void StageBar::setOpacity(double opacity) {
  opacity_->setPosition(opacity);
  emit opacityChanged(opacity_->position());
}

void StageBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colors(palette()).panel);
}

}  // namespace windfall::widgets
