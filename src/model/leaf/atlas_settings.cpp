#include "model/leaf/atlas_settings.h"

#include <algorithm>
#include <array>

namespace windfall::model {

namespace {
const std::array<const char*, 4> kNames{"plain", "gltf", "unity", "unreal"};
constexpr int kLeastGap = 8;  // px, doubled for each mip level that must stay clean
}  // namespace

int AtlasSettings::gap() const {
  const int wanted = mipLevels > 0 ? kLeastGap << std::min(mipLevels, 12) : 0;
  return std::max(padding, size > 0 ? std::min(wanted, size / 8) : wanted);
}

QString nameOf(AtlasPacker packer) { return QString::fromLatin1(kNames[static_cast<size_t>(packer)]); }

std::optional<AtlasPacker> packerOf(const QString& name) {
  for (size_t i = 0; i < kNames.size(); ++i) {
    if (name == QLatin1String(kNames[i])) return static_cast<AtlasPacker>(i);
  }
  return std::nullopt;
}

}  // namespace windfall::model
