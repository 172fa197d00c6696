// Leaves far away: clusters and boughs drawn as cards, pictures that were painted from the same leaves.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/result.h"
#include "widgets/render/card_pictures.h"
#include "widgets/render/card_set.h"
#include "widgets/render/content.h"
#include "widgets/render/gl_object.h"
#include "widgets/render/leaf_sort.h"

namespace windfall::render {

class LeafPass;

/// From where, and when, cards are chosen.
struct CardSight {
  mat4 viewProjection{1};
  vec3 eye{0};
  float pixelsPerRadian = 1000;
  float below = 1.5f;  ///< px of a leaf's length; 0: no cards
  float season = 0;
  bool whole = false;       ///< a picture to keep: what is missing is made first, however long it takes
  std::size_t pace = 5000;  ///< leaves that may be painted in a frame otherwise
};

class LeafCards {
 public:
  LeafCards() = default;
  ~LeafCards();
  LeafCards(const LeafCards&) = delete;
  LeafCards& operator=(const LeafCards&) = delete;

  Status compile();
  /// Notes the trees; nothing is reckoned before their leaves are small on the screen.
  void setContent(const SceneContent& content, const LeafPass& leaves);
  /// Before the leaves are sorted, with the bones bound (storage 0): makes what is missing and settles which clusters
  /// are cards. What they bind the leaves' passes to: nothing where there are no cards.
  LeafCardBinding choose(const CardSight& sight, std::span<const mat4> bones, const LeafPass& leaves);
  /// After it: lists the cards by the leaves that are there.
  void list(const CardSight& sight);
  /// Draw calls made.
  int draw(bool highQuality, float season);
  int drawShadow(const mat4& lightMatrix, float texelsPerMetre);
  bool active() const { return active_; }
  /// Cards are wanted that are not there yet.
  bool unfinished() const { return unfinished_; }
  /// Cards in the last lists, boughs and clusters; waits for the device.
  std::size_t listed() const;

 private:
  struct Kind {
    float length = 0, radius = 0;  ///< m: mean leaf, round the foot
    std::vector<std::uint32_t> firstLinks;
  };
  bool wanted(float length, float radius, const std::vector<std::uint32_t>& firstLinks, const CardSight& sight,
              std::span<const mat4> bones) const;
  bool planned(const CardSight& sight, std::span<const mat4> bones);
  void upload();
  void paint(const CardSight& sight, const std::vector<bool>& wanted, const LeafPass& leaves);
  void dispatch(const Program& program, const CardSight& sight) const;
  int drawPlants(float scale) const;
  void stopPlanning();

  std::shared_ptr<SceneContent> source_;
  std::vector<Kind> kinds_;
  std::future<CardSet> planning_;
  std::shared_ptr<std::atomic<bool>> stop_;
  std::optional<CardSet> set_;
  std::vector<CardPictures> pictures_;  ///< of each plant
  std::vector<bool> shown_;
  CardPainter painter_;
  Program fade_, list_, shadow_, cards_[2];
  Buffer nodes_, instances_, states_, lists_, ofLeaf_, commands_, fresh_;
  VertexArray array_;
  float pixelsPerRadian_ = 1000;
  int frames_ = 0;  ///< drawn of this content
  bool active_ = false, failed_ = false, unfinished_ = false;
};

}  // namespace windfall::render
