// Draws the wood of trees with adaptive detail: what is chosen, how finely, and one indirect multi-draw
// (plant_meshing.md, 6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/result.h"
#include "widgets/render/bark_layers.h"
#include "widgets/render/content.h"
#include "widgets/render/detail_grids.h"
#include "widgets/render/detail_selector.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/view.h"

namespace windfall::render {

/// The camera of a view at a tolerance in px, with the view's frustum.
DetailCamera detailCamera(const View& view, float tolerance);
/// Of a shadow map whose texels have a size of `texel` m: a tolerance of one texel, and nothing is out of sight.
DetailCamera shadowDetailCamera(float texel);

/// What was chosen last.
struct DetailCounts {
  std::array<std::uint32_t, kDetailGrids> runs{};
  std::size_t vertices = 0, triangles = 0;
};

class DetailPass {
 public:
  enum class Chooser { Gpu, Cpu };
  /// Where lists go: the picture and the shadow map choose for themselves.
  enum class Target { Picture, Shadow };

  Status compile();
  /// Trees with `detail` >= 0; uploads their rings.
  Status setContent(const SceneContent& content);
  /// Compute shaders on a GPU, the CPU where OpenGL itself runs in software; `compile` sets it.
  void setChooser(Chooser chooser) { chooser_ = chooser; }
  Chooser chooser() const { return chooser_; }
  bool empty() const { return trees_.empty(); }

  /// Chooses levels with the bones that are bound (storage 0); `bones` are the same for the CPU.
  void choose(Target target, const DetailCamera& camera, std::span<const mat4> bones);
  /// Draw calls made. The frame's uniforms and highlights (storage 1) are bound by the caller.
  int draw(bool highQuality);
  int drawShadow(const mat4& lightMatrix);
  /// The last choice for the picture; on a GPU this waits for it.
  DetailCounts counts() const;
  /// The last choice, for tests: runs grid by grid, and rings (those that no run uses are of any value on the CPU).
  std::vector<DetailRun> runs(Target target) const;
  std::vector<SkinnedRing> rings(Target target) const;
  /// The buffer of skinned rings and where in it the last choice lies, for tests.
  void bindRings(Target target) const;

 private:
  static constexpr int kSlots = 3;
  struct Lists {
    Buffer memory;  ///< rings, runs and commands of each slot
    std::byte* mapped = nullptr;
    std::array<GLsync, kSlots> fences{};
    int slot = 0;
    Lists() = default;
    ~Lists();
    Lists(const Lists&) = delete;
    Lists& operator=(const Lists&) = delete;
    void release();
  };
  Status allocate();
  void chooseOnGpu(Lists& lists, const DetailCamera& camera);
  void chooseOnCpu(Lists& lists, const DetailCamera& camera, std::span<const mat4> bones);
  /// Draws the grids `first` to `last`; `fence` remembers when it was done.
  void drawGrids(const Lists& lists, std::size_t first, std::size_t last) const;
  static void fence(Lists& lists);
  Lists& lists(Target target) { return lists_[target == Target::Picture ? 0 : 1]; }
  const Lists& lists(Target target) const { return lists_[target == Target::Picture ? 0 : 1]; }
  std::size_t slotOffset(const Lists& lists) const { return slotBytes_ * static_cast<std::size_t>(lists.slot); }
  std::array<GridCommand, kDetailGrids> commands(const Lists& lists) const;

  Chooser chooser_ = Chooser::Gpu;
  DetailGrids grids_;
  std::vector<DetailTree> trees_;
  DetailSelector selector_;
  Lists lists_[2];
  Buffer gridVertices_, gridIndices_, template_, rings_, entries_, chains_, treeTable_, keys_, cursors_;
  Barks barks_;
  VertexArray array_;
  Program wood_[2][2];  ///< [high quality][every bark has a picture]
  Program thin_[2];     ///< of stems narrower than two pixels
  Program shadow_, skin_, count_, offset_, list_;
  std::size_t ringCount_ = 0, entryCount_ = 0, largestRings_ = 0, largestEntries_ = 0;
  std::size_t runOffset_ = 0, commandOffset_ = 0, slotBytes_ = 0;
};

}  // namespace windfall::render
