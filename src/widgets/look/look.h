// The face of the window: Fusion with our own dark and light palettes, one accent, a grid of 4 pixels.
#pragma once

#include <QColor>
#include <QPalette>

class QApplication;

namespace windfall::widgets {

enum class Scheme { Dark, Light };

/// Every colour that our own painting uses.
struct Colors {
  QColor canvas;  ///< behind pictures
  QColor panel;   ///< docks and bars
  QColor field;   ///< numbers, lists, sliders' grooves
  QColor hover;   ///< under the pointer
  QColor border;  ///< the few lines that there are
  QColor text;
  QColor muted;     ///< labels, hints, icons at rest
  QColor accent;    ///< what is chosen, filled or running
  QColor onAccent;  ///< text on the accent
  QColor selected;  ///< background of what is chosen, behind normal text
  QColor warning, error;
};

const Colors& colors(Scheme scheme);
/// The colours that belong to a palette set by applyLook.
const Colors& colors(const QPalette& palette);

/// Sets style, palette and style sheet of the whole program; can be called again to switch.
void applyLook(QApplication& application, Scheme scheme);

/// Distance of the grid, px.
inline constexpr int kGrid = 4;

}  // namespace windfall::widgets
