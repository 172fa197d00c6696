#include "widgets/plant/motion_plot.h"

#include <QLocale>
#include <QPainter>
#include <QPainterPath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "widgets/look/look.h"
#include "widgets/plant/frequency.h"

namespace windfall::widgets {
namespace {

constexpr double kShownSeconds = 20;
constexpr double kInterval = 1.0 / 30;  // s between the samples that the frequency is taken of
constexpr int kMeasureEvery = 15;       // frames

}  // namespace

MotionPlot::MotionPlot(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

void MotionPlot::start(const QString& branch) {
  branch_ = branch;
  record_.clear();
  frequency_ = 0;
  unmeasured_ = 0;
  update();
}

void MotionPlot::add(double time, vec3 displacement) {
  if (!record_.empty() && time == record_.back().time) return;
  if (!record_.empty() && time < record_.back().time) start(branch_);
  record_.push_back({time, displacement});
  while (time - record_.front().time > kShownSeconds) record_.pop_front();
  if (++unmeasured_ >= kMeasureEvery) measure();
  update();
}

void MotionPlot::measure() {
  unmeasured_ = 0;
  mean_ = vec3(0);
  for (const Sample& sample : record_) mean_ += sample.displacement;
  mean_ /= static_cast<float>(record_.size());
  // The main axis of the motion, by power iteration on its covariance.
  mat3 spread(0);
  for (const Sample& sample : record_) {
    const vec3 d = sample.displacement - mean_;
    spread += glm::outerProduct(d, d);
  }
  vec3 axis = axis_;
  for (int i = 0; i < 8; ++i) {
    const vec3 next = spread * axis;
    if (glm::length(next) < 1e-12f) break;
    axis = glm::normalize(next);
  }
  axis_ = glm::dot(axis, axis_) < 0 ? -axis : axis;

  std::vector<float> samples;
  std::size_t i = 0;
  for (double time = record_.front().time; time <= record_.back().time; time += kInterval) {
    while (i + 1 < record_.size() && record_[i + 1].time < time) ++i;
    const Sample &a = record_[i], &b = record_[std::min(i + 1, record_.size() - 1)];
    const double gap = b.time - a.time;
    const auto share = static_cast<float>(gap > 0 ? std::clamp((time - a.time) / gap, 0.0, 1.0) : 0);
    samples.push_back(glm::dot(glm::mix(a.displacement, b.displacement, share) - mean_, axis_));
  }
  frequency_ = dominantFrequency(samples, kInterval);
}

void MotionPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colors& look = colors(palette());
  const QFontMetricsF metrics(font());
  const QLocale locale;
  const QRectF text(0, 0, width() - 2.0 * kGrid, metrics.height());
  painter.setPen(look.muted);
  painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
                   branch_.isEmpty() ? tr("Choose a branch to see how its tip moves") : tr("Tip of %1").arg(branch_));
  const QRectF plot(0, text.bottom() + kGrid, text.width(), height() - text.bottom() - 2.0 * kGrid);
  painter.setPen(Qt::NoPen);
  painter.setBrush(look.field);
  painter.drawRoundedRect(plot, 3, 3);
  painter.setPen(QPen(look.border, 1));
  painter.drawLine(QPointF(plot.left(), plot.center().y()), QPointF(plot.right(), plot.center().y()));
  if (branch_.isEmpty() || record_.size() < 2) return;

  float largest = 1e-4f;
  for (const Sample& sample : record_) largest = std::max(largest, std::abs(glm::dot(sample.displacement, axis_)));
  QPainterPath line;
  for (std::size_t i = 0; i < record_.size(); ++i) {
    const double x = plot.right() - (record_.back().time - record_[i].time) / kShownSeconds * plot.width();
    const double share = static_cast<double>(glm::dot(record_[i].displacement, axis_) / largest);
    const QPointF point(x, plot.center().y() - share * (plot.height() / 2 - 2));
    i == 0 ? line.moveTo(point) : line.lineTo(point);
  }
  painter.setBrush(Qt::NoBrush);
  painter.strokePath(line, QPen(look.accent, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  const double metres = static_cast<double>(largest);
  QString numbers = metres < 0.01 ? tr("± %1 mm").arg(locale.toString(metres * 1000, 'f', 1))
                                  : tr("± %1 cm").arg(locale.toString(metres * 100, 'f', 1));
  if (frequency_ > 0) numbers = tr("%1 Hz   %2").arg(locale.toString(frequency_, 'f', 2), numbers);
  painter.setPen(look.text);
  painter.drawText(text, Qt::AlignRight | Qt::AlignVCenter, numbers);
}

}  // namespace windfall::widgets
