// Skeletons for tests: made from code, from the shared bone tables and from .prim files.
#pragma once

#include <QFile>
#include <QHash>
#include <cmath>

#include "kernels/random.h"
#include "model/plant/prim_format.h"
#include "support/suite.h"

namespace windfall::test {

inline model::Segment segment(vec3 a, vec3 b, float radius, int parent) {
  model::Segment s;
  s.a = a, s.b = b;
  s.ra = s.rb = radius;
  s.parent = parent;
  return s;
}

/// A trunk of `links` with two side axes a link that turn about it, and leaves on their ends.
inline model::SkeletonGraph smallTree(int links = 6) {
  model::SkeletonGraph graph;
  vec3 foot(0);
  int below = -1;
  for (int i = 0; i < links; ++i) {
    const float f = static_cast<float>(i), r = 0.05f * (1 - f / static_cast<float>(links + 1));
    const vec3 top = foot + vec3(0.04f * std::sin(f), 0.4f, 0.03f * std::cos(2 * f));
    const int own = static_cast<int>(graph.segments.size());
    graph.segments.push_back(segment(foot, top, r, below));
    for (int k = 0; k < 2; ++k) {
      const float angle = 2.4f * f + 3.1f * static_cast<float>(k);
      const vec3 out = vec3(std::cos(angle), 0.6f, std::sin(angle)) * 0.25f;
      graph.segments.push_back(segment(top, top + out, 0.4f * r, own));
      const vec3 end = top + out + vec3(out.x, 0.3f * out.y, out.z);
      graph.segments.push_back(segment(top + out, end, 0.25f * r, static_cast<int>(graph.segments.size()) - 1));
      model::LeafOrgan leaf;
      leaf.segment = static_cast<int>(graph.segments.size()) - 1;
      leaf.base = end, leaf.tip = end + vec3(0.06f, 0.02f, 0), leaf.width = 0.04f;
      leaf.normal = glm::normalize(vec3(-0.02f, 0.06f, 0));
      graph.leaves.push_back(leaf);
    }
    below = own, foot = top;
  }
  model::BudOrgan bud;
  bud.segment = below, bud.centre = foot, bud.radius = 0.004f;
  graph.buds.push_back(bud);
  finishGraph(graph);
  return graph;
}

/// A bone table of the shared data (Z up there) with radii 2.5 mm * (tips carried)^(1/2.3); empty if absent.
inline model::SkeletonGraph boneTable(const QString& name) {
  model::SkeletonGraph graph;
  QFile file(sharedData("trees/" + name + ".bones.csv"));
  if (file.fileName().isEmpty() || !file.open(QIODevice::ReadOnly)) return graph;
  QByteArray titles = file.readLine();
  while (titles.startsWith('#')) titles = file.readLine();
  const QList<QByteArray> header = titles.trimmed().split(',');
  const auto column = [&](const char* title) { return header.indexOf(title); };
  QHash<QByteArray, int> index;
  std::vector<QByteArray> parents;
  while (!file.atEnd()) {
    const QList<QByteArray> row = file.readLine().trimmed().split(',');
    if (row.size() < header.size()) continue;
    const auto point = [&](const char* prefix) {
      const auto at = [&](const char* axis) { return row[column(qPrintable(QString(prefix) + axis))].toFloat(); };
      return vec3(at("x"), at("z"), -at("y"));
    };
    index[row[column("bone")]] = static_cast<int>(graph.segments.size());
    parents.push_back(row[column("parent")]);
    graph.segments.push_back(segment(point("head_"), point("tail_"), 0, -1));
  }
  for (std::size_t i = 0; i < parents.size(); ++i) graph.segments[i].parent = index.value(parents[i], -1);
  Result<model::SkeletonGraph> sorted = sortedGraph(graph);
  graph = *sorted;
  std::vector<int> tips(graph.segments.size(), 0);
  for (std::size_t i = graph.segments.size(); i-- > 0;) {
    model::Segment& s = graph.segments[i];
    tips[i] = std::max(tips[i], 1);
    s.ra = s.rb = 0.0025f * std::pow(static_cast<float>(tips[i]), 1 / 2.3f);
    if (s.parent >= 0) tips[static_cast<std::size_t>(s.parent)] += tips[i];
  }
  finishGraph(graph);
  return graph;
}

/// A .prim of the shared data; no segments if absent or unreadable.
inline model::SkeletonGraph primFile(const QString& name) {
  QFile file(sharedData("prim/" + name));
  if (file.fileName().isEmpty() || !file.open(QIODevice::ReadOnly)) return {};
  Result<model::PrimFile> read = model::readPrim(file.readAll());
  return read ? std::move(read->graph) : model::SkeletonGraph{};
}

/// The five plants of plant_meshing.md, without stubs; those that are there.
inline std::vector<std::pair<QString, model::SkeletonGraph>> realPlants() {
  std::vector<std::pair<QString, model::SkeletonGraph>> plants;
  for (const char* name : {"default_502_v4.prim", "herb_101_v4.prim"}) {
    plants.emplace_back(name, withoutStubs(primFile(name)));
  }
  for (const char* name : {"japanese_maple", "white_birch", "quaking_aspen"}) {
    plants.emplace_back(name, withoutStubs(boneTable(name)));
  }
  std::erase_if(plants, [](const auto& plant) { return plant.second.segments.empty(); });
  return plants;
}

}  // namespace windfall::test
