#include "widgets/plant/branch_model.h"

#include <QFont>
#include <QLocale>
#include <algorithm>
#include <glm/geometric.hpp>

namespace windfall::widgets {

void BranchModel::setPlant(const model::LoadedPlant& plant) {
  beginResetModel();
  plant_ = plant;
  nodes_.clear();
  top_.clear();
  nodeOfBone_.clear();
  edited_.clear();
  branchCount_ = 0;
  if (plant_.geometry && plant_.bodies) {
    const auto& branches = plant_.bodies->branches;
    const std::size_t bones = plant_.geometry->bones.size();
    branchCount_ = static_cast<int>(branches.size());
    nodeOfBone_.assign(bones, -1);
    edited_.assign(bones, false);
    nodes_.resize(branches.size());
    for (int b = 0; b < branchCount_; ++b) {
      const int parent = branches[static_cast<std::size_t>(b)].parent;
      nodes_[static_cast<std::size_t>(b)].parent = parent;
      std::vector<int>& siblings = parent < 0 ? top_ : nodes_[static_cast<std::size_t>(parent)].children;
      nodes_[static_cast<std::size_t>(b)].row = static_cast<int>(siblings.size());
      siblings.push_back(b);
    }
    for (int b = 0; b < branchCount_; ++b) {
      for (const int bone : branches[static_cast<std::size_t>(b)].bones) {
        std::vector<int>& children = nodes_[static_cast<std::size_t>(b)].children;
        const auto node = static_cast<int>(nodes_.size());
        const auto row = static_cast<int>(children.size());
        nodeOfBone_[static_cast<std::size_t>(bone)] = node;
        children.push_back(node);
        nodes_.push_back({b, row, bone, {}});
      }
    }
  }
  endResetModel();
}

void BranchModel::setEdited(const std::set<QString>& bones) {
  if (!plant_.geometry) return;
  for (std::size_t i = 0; i < edited_.size(); ++i) {
    const bool edited = bones.contains(plant_.geometry->bones[i].name);
    if (edited == edited_[i]) continue;
    edited_[i] = edited;
    const int node = nodeOfBone_[i];
    if (node < 0) continue;
    const int branch = nodes_[static_cast<std::size_t>(node)].parent;
    for (const int changed : {node, branch}) {
      const QModelIndex row =
          createIndex(nodes_[static_cast<std::size_t>(changed)].row, Name, static_cast<quintptr>(changed));
      emit dataChanged(row, row, {Qt::FontRole, Qt::ToolTipRole});
    }
  }
}

std::vector<std::size_t> BranchModel::links(const QModelIndex& index) const {
  const Node* node = nodeAt(index);
  std::vector<std::size_t> links;
  if (node == nullptr) return links;
  const auto add = [&](int bone) {
    const int link = plant_.bodies->linkOfBone[static_cast<std::size_t>(bone)];
    if (link >= 0) links.push_back(static_cast<std::size_t>(link));
  };
  if (node->bone >= 0) {
    add(node->bone);
  } else {
    for (const int bone : plant_.bodies->branches[static_cast<std::size_t>(branchAt(index))].bones) add(bone);
  }
  return links;
}

QModelIndex BranchModel::branchIndex(int branch) const {
  if (branch < 0 || branch >= branchCount_) return {};
  return createIndex(nodes_[static_cast<std::size_t>(branch)].row, 0, static_cast<quintptr>(branch));
}

QModelIndex BranchModel::branchOfLink(std::size_t link) const {
  if (!plant_.bodies || link >= plant_.bodies->boneOfLink.size()) return {};
  const int bone = plant_.bodies->boneOfLink[link];
  const int node = bone < 0 ? -1 : nodeOfBone_[static_cast<std::size_t>(bone)];
  return node < 0 ? QModelIndex() : branchIndex(nodes_[static_cast<std::size_t>(node)].parent);
}

QModelIndex BranchModel::indexOfLink(std::size_t link) const {
  if (!plant_.bodies || link >= plant_.bodies->boneOfLink.size()) return {};
  const int bone = plant_.bodies->boneOfLink[link];
  const int node = bone < 0 ? -1 : nodeOfBone_[static_cast<std::size_t>(bone)];
  if (node < 0) return {};
  return createIndex(nodes_[static_cast<std::size_t>(node)].row, 0, static_cast<quintptr>(node));
}

int BranchModel::branchAt(const QModelIndex& index) const {
  if (!index.isValid()) return -1;
  const auto node = static_cast<int>(index.internalId());
  return isBranch(node) ? node : -1;
}

const BranchModel::Node* BranchModel::nodeAt(const QModelIndex& index) const {
  return index.isValid() ? &nodes_[index.internalId()] : nullptr;
}

QModelIndex BranchModel::index(int row, int column, const QModelIndex& parent) const {
  const Node* node = nodeAt(parent);
  const std::vector<int>& rows = node == nullptr ? top_ : node->children;
  if (row < 0 || row >= static_cast<int>(rows.size()) || column < 0 || column >= ColumnCount) return {};
  return createIndex(row, column, static_cast<quintptr>(rows[static_cast<std::size_t>(row)]));
}

QModelIndex BranchModel::parent(const QModelIndex& index) const {
  const Node* node = nodeAt(index);
  return node == nullptr ? QModelIndex() : branchIndex(node->parent);
}

int BranchModel::rowCount(const QModelIndex& parent) const {
  if (parent.column() > 0) return 0;
  const Node* node = nodeAt(parent);
  return static_cast<int>(node == nullptr ? top_.size() : node->children.size());
}

int BranchModel::columnCount(const QModelIndex&) const { return ColumnCount; }

bool BranchModel::isEdited(int node) const {
  const int bone = nodes_[static_cast<std::size_t>(node)].bone;
  if (bone >= 0) return edited_[static_cast<std::size_t>(bone)];
  const auto& bones = plant_.bodies->branches[static_cast<std::size_t>(node)].bones;
  return std::any_of(bones.begin(), bones.end(), [this](int b) { return edited_[static_cast<std::size_t>(b)]; });
}

QString BranchModel::text(int node, int column) const {
  const QLocale locale;
  if (isBranch(node)) {
    const model::Branch& branch = plant_.bodies->branches[static_cast<std::size_t>(node)];
    switch (column) {
      case Name:
        return branch.name;
      case Length:
        return tr("%1 m").arg(locale.toString(branch.length, 'f', 2));
      case Order:
        return locale.toString(branch.order);
      default:
        return {};
    }
  }
  const model::Bone& bone =
      plant_.geometry->bones[static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].bone)];
  switch (column) {
    case Name:
      return bone.name;
    case Length:
      return tr("%1 m").arg(locale.toString(static_cast<double>(glm::length(bone.tail - bone.head)), 'f', 2));
    default:
      return {};
  }
}

QVariant BranchModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const auto node = static_cast<int>(index.internalId());
  if (role == Qt::DisplayRole) return text(node, index.column());
  if (role == Qt::TextAlignmentRole && index.column() != Name) return QVariant(Qt::AlignRight | Qt::AlignVCenter);
  if (role == Qt::FontRole && index.column() == Name && isEdited(node)) {
    QFont font;
    font.setBold(true);
    return font;
  }
  if (role == Qt::ToolTipRole && isEdited(node)) return tr("Edited");
  return {};
}

QVariant BranchModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole && section != Name) return QVariant(Qt::AlignRight | Qt::AlignVCenter);
  if (role != Qt::DisplayRole) return {};
  switch (section) {
    case Name:
      return tr("Branch");
    case Length:
      return tr("Length");
    case Order:
      return tr("Order");
    default:
      return {};
  }
}

}  // namespace windfall::widgets
