#include "widgets/look/icon.h"

#include <QApplication>
#include <QFile>
#include <QIconEngine>
#include <QPainter>
#include <QPixmapCache>
#include <QSvgRenderer>

#include "widgets/look/look.h"

namespace windfall::widgets {

namespace {

QString pathOf(const QString& name) { return QStringLiteral(":/icons/%1.svg").arg(name); }

void draw(QPainter& painter, const QString& name, const QColor& color, const QRectF& rect) {
  QFile file(pathOf(name));
  if (!file.open(QIODevice::ReadOnly)) return;
  QByteArray svg = file.readAll();
  svg.replace("currentColor", color.name().toLatin1());
  QSvgRenderer renderer(svg);
  const double side = std::min(rect.width(), rect.height());
  QRectF square(0, 0, side, side);
  square.moveCenter(rect.center());
  painter.save();
  painter.setOpacity(painter.opacity() * color.alphaF());
  renderer.render(&painter, square);
  painter.restore();
}

class LineIconEngine : public QIconEngine {
 public:
  explicit LineIconEngine(QString name) : name_(std::move(name)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    draw(*painter, name_, colorFor(mode, state), rect);
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    const QColor color = colorFor(mode, state);
    const QString key = QStringLiteral("windfall/%1/%2x%3/%4")
                            .arg(name_)
                            .arg(size.width())
                            .arg(size.height())
                            .arg(color.name(QColor::HexArgb));
    QPixmap pixmap;
    if (QPixmapCache::find(key, &pixmap)) return pixmap;
    pixmap = QPixmap(size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    draw(painter, name_, color, QRectF(QPointF(), QSizeF(size)));
    painter.end();
    QPixmapCache::insert(key, pixmap);
    return pixmap;
  }
  QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal) override {
    return pixmap(size, mode, state);
  }
  QIconEngine* clone() const override { return new LineIconEngine(name_); }
  QString key() const override { return QStringLiteral("windfall-line"); }
  QString iconName() override { return name_; }

 private:
  static QColor colorFor(QIcon::Mode mode, QIcon::State state) {
    const Colors& c = colors(QApplication::palette());
    if (mode == QIcon::Disabled) {
      QColor faint = c.muted;
      faint.setAlphaF(0.45f);
      return faint;
    }
    return state == QIcon::On ? c.accent : c.text;
  }

  QString name_;
};

}  // namespace

QIcon icon(const QString& name) { return QFile::exists(pathOf(name)) ? QIcon(new LineIconEngine(name)) : QIcon(); }

QPixmap iconPixmap(const QString& name, int size, const QColor& color, qreal devicePixelRatio) {
  QPixmap pixmap(QSize(size, size) * devicePixelRatio);
  pixmap.setDevicePixelRatio(devicePixelRatio);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  draw(painter, name, color, QRectF(0, 0, size, size));
  return pixmap;
}

}  // namespace windfall::widgets
