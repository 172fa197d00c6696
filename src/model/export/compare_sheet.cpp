#include "model/export/compare_sheet.h"

#include <QCoreApplication>
#include <QFont>
#include <QPainter>
#include <algorithm>

#include "model/progress_part.h"

namespace windfall::model {

namespace {

constexpr int kSeeds = 3;
constexpr QRgb kGround = qRgb(119, 119, 119);  // L* 50

QString text(const char* source) { return QCoreApplication::translate("CompareSheet", source); }

/// The leaf's part of the photo, as large as its textures.
QImage photograph(const LeafStages& stages) {
  return stages.photo.copy(stages.frame)
      .scaled(stages.alpha.size(), Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
      .convertToFormat(QImage::Format_RGBA8888);
}

}  // namespace

QImage compareSheet(const std::vector<std::vector<SheetPicture>>& rows) {
  size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  std::vector<int> widths(columns, 0);
  std::vector<int> heights;
  int largest = 1;
  for (const auto& row : rows) {
    heights.push_back(0);
    for (size_t c = 0; c < row.size(); ++c) {
      widths[c] = std::max(widths[c], row[c].image.width());
      heights.back() = std::max(heights.back(), row[c].image.height());
      largest = std::max({largest, row[c].image.width(), row[c].image.height()});
    }
  }
  const int gap = std::max(4, largest / 32), label = std::max(16, largest / 24);
  int width = gap, height = gap;
  for (const int w : widths) width += w + gap;
  for (const int h : heights) height += h + label + gap;
  QImage sheet(width, height, QImage::Format_RGB32);
  sheet.fill(kGround);
  QPainter painter(&sheet);
  QFont font;
  font.setPixelSize(std::max(9, label * 5 / 8));
  painter.setFont(font);
  painter.setPen(Qt::white);
  int top = gap;
  for (size_t r = 0; r < rows.size(); ++r) {
    int left = gap;
    for (size_t c = 0; c < rows[r].size(); ++c) {
      const SheetPicture& picture = rows[r][c];
      painter.drawImage(left, top, picture.image);
      painter.drawText(QRect(left, top + heights[r], widths[c], label), Qt::AlignCenter, picture.label);
      left += widths[c] + gap;
    }
    top += heights[r] + label + gap;
  }
  return sheet;
}

Result<QImage> compareMethods(const LeafStages& target, const std::vector<LeafStages>& examples,
                              const SynthesisParameters& parameters, quint64 seed, Progress& progress) {
  std::vector<std::vector<SheetPicture>> rows;
  int made = 0;
  for (const bool guided : {false, true}) {
    const LeafStages& shown = guided && !examples.empty() ? examples.front() : target;
    const bool second = guided && examples.empty();
    std::vector<SheetPicture> row{{second             ? text("The photograph")
                                   : guided           ? text("Colours from")
                                   : examples.empty() ? text("The photograph")
                                                      : text("Shape from"),
                                   photograph(shown)}};
    for (int i = 0; i < kSeeds; ++i) {
      ProgressPart part(progress, made / (2.0 * kSeeds), (made + 1) / (2.0 * kSeeds));
      SynthesisParameters mine = parameters;
      mine.guided = guided;
      const quint64 own = seed + static_cast<quint64>(i);
      const LeafStages& example = examples.empty() ? target : examples[static_cast<size_t>(i) % examples.size()];
      Result<QImage> image = synthesize(target, example, mine, own, part);
      if (!image) return image.error();
      row.push_back({(guided ? text("Guided, seed %1") : text("Classic, seed %1")).arg(own), std::move(*image)});
      ++made;
    }
    rows.push_back(std::move(row));
  }
  return compareSheet(rows);
}

}  // namespace windfall::model
