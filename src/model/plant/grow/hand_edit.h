// What an artist does to a skeleton by hand, kept so that it can be done again when the plant grows anew.
#pragma once

#include <QString>
#include <QVector3D>
#include <QtGlobal>
#include <vector>

namespace windfall::model {

enum class HandEditKind {
  Prune,    ///< cuts a branch off
  Bend,     ///< turns all that a node carries about the node's parent
  Draw,     ///< a new branch along a line
  Thicken,  ///< multiplies the radius of a branch from a node on
  Move,     ///< drags a node; its neighbours on the branch follow
  Graft,    ///< sets a part of the artist's library on
};

/// A node of a part: parents before children, -1 for the first, which lies at the origin and points up.
struct PartNode {
  QVector3D position;  ///< m
  int parent = -1;
  double radius = 0.01;  ///< m
  bool operator==(const PartNode&) const = default;
};

/// Positions in the plant's space, m. The node is found again by its number in the grower, where that still is near
/// `place`, else by the place alone.
struct HandEdit {
  HandEditKind kind = HandEditKind::Prune;
  int node = -1;                ///< the grower's number of the node
  QVector3D place;              ///< of that node when the edit was made
  double age = 0;               ///< of the plant then, years
  double stub = 0;              ///< Prune: share of the link that stays, 0..1
  QVector3D axis;               ///< Bend: of the turn, through the node's parent
  double angle = 0;             ///< Bend: degrees. Graft: roll about its direction
  double factor = 1;            ///< Thicken: of the radius. Graft: of the part's size
  double radius = 0;            ///< Draw: at the base, m; 0: as the branch there allows
  QVector3D offset;             ///< Move: where the node goes. Graft: the direction that the part points in
  std::vector<QVector3D> line;  ///< Draw: from the branch outwards, without its own node
  std::vector<PartNode> part;   ///< Graft
  bool operator==(const HandEdit&) const = default;
};

}  // namespace windfall::model
