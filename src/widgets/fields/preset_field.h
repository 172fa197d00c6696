// A choice of named settings: what fits shows its name, anything else a dash.
#pragma once

#include <vector>

#include "model/presets/preset.h"
#include "widgets/fields/choice_field.h"

namespace windfall::widgets {

/// The first choice is "Default"; the others are the presets of a domain. Resetting chooses the default.
class PresetField : public ChoiceField {
  Q_OBJECT
 public:
  explicit PresetField(const QString& domain, QWidget* parent = nullptr);

  /// What the choice makes of `now`; the default is `fresh`.
  template <class Settings>
  Settings chosen(int index, Settings now, const Settings& fresh) const {
    if (index <= 0 || index > static_cast<int>(presets_.size())) return fresh;
    Settings settings = now;
    // A library holds only presets that can be applied.
    return model::applyPreset(presets_[static_cast<std::size_t>(index) - 1], settings) ? settings : now;
  }

  /// Shows which choice `now` is.
  template <class Settings>
  void show(const Settings& now, const Settings& fresh) {
    for (int index = 0; index <= static_cast<int>(presets_.size()); ++index) {
      if (chosen(index, now, fresh) != now) continue;
      setValue(index);
      return;
    }
    setMixed();
  }

  /// Looks for presets anew: one was saved or imported.
  void reload();

  const std::vector<model::Preset>& presets() const { return presets_; }

 private:
  PresetField(const QString& domain, std::vector<model::Preset> presets, QWidget* parent);

  QString domain_;
  std::vector<model::Preset> presets_;
};

}  // namespace windfall::widgets
