// Meshes of skeletons: closed, oriented, of few vertices, with bark that is not stretched (plant_meshing.md, 11).
#include "model/plant/surface.h"

#include <omp.h>

#include <QtTest>
#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

#include "support/skeleton_data.h"
#include "support/suite.h"

using namespace windfall;
using model::MeshSettings;
using model::SkeletonGraph;
using model::SurfaceMesh;

namespace {

struct Built {
  model::Chains chains;
  std::vector<model::ChainCurve> curves;
  model::RingSet rings;
  SurfaceMesh mesh;
};

Built build(const SkeletonGraph& graph, const MeshSettings& settings, const model::RingSettings& ringSettings = {}) {
  Built b;
  b.chains = findChains(graph);
  b.curves = makeCurves(graph, b.chains, model::CurveKind::Hermite);
  b.rings = makeRings(graph, b.chains, b.curves, ringSettings);
  b.mesh = meshRings(graph, b.chains, b.curves, b.rings, settings);
  return b;
}

std::vector<std::pair<QString, SkeletonGraph>> plants() {
  auto all = test::realPlants();
  all.emplace_back("made", test::smallTree());
  return all;
}

struct Flaws {
  std::size_t open = 0, doubled = 0, degenerate = 0, flipped = 0;
};

/// Edges by the places of their ends, chain by chain: seams are welded, chains are not.
Flaws flawsOf(const SurfaceMesh& mesh) {
  Flaws flaws;
  const auto same = [&](std::uint32_t a, std::uint32_t b) {
    return std::memcmp(&mesh.vertices[a].position, &mesh.vertices[b].position, sizeof(vec3)) == 0;
  };
  for (std::size_t c = 0; c + 1 < mesh.firstIndex.size(); ++c) {
    const std::uint32_t first = mesh.firstIndex[c], end = mesh.firstIndex[c + 1];
    std::vector<std::uint32_t> used(mesh.indices.begin() + first, mesh.indices.begin() + end);
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::map<std::array<float, 3>, std::uint32_t> welded;
    std::map<std::uint32_t, std::uint32_t> place;
    for (const std::uint32_t v : used) {
      const vec3 p = mesh.vertices[v].position;
      place[v] = welded.try_emplace({p.x, p.y, p.z}, v).first->second;
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::uint32_t i = first; i < end; i += 3) {
      std::uint32_t v[3];
      glm::dvec3 p[3];
      vec3 normal(0);
      for (std::uint32_t k = 0; k < 3; ++k) {
        v[k] = place[mesh.indices[i + k]];
        p[k] = glm::dvec3(mesh.vertices[v[k]].position);
        normal += mesh.vertices[mesh.indices[i + k]].normal;
      }
      const glm::dvec3 face = glm::cross(p[1] - p[0], p[2] - p[0]);
      flaws.degenerate += same(v[0], v[1]) || same(v[1], v[2]) || same(v[2], v[0]) || !(glm::length(face) > 0);
      flaws.flipped += glm::dot(face, glm::dvec3(normal)) < 0;
      for (int k = 0; k < 3; ++k) flaws.doubled += ++edges[{v[k], v[(k + 1) % 3]}] > 1;
    }
    for (const auto& [edge, count] : edges) flaws.open += !edges.contains({edge.second, edge.first});
  }
  return flaws;
}

}  // namespace

class PlantSurfaceTest : public QObject {
  Q_OBJECT
 private slots:
  void vertexCountsAreTheNotes();
  void meshesAreClosedAndOriented();
  void openMeshesAreOpenAtTheirBasesOnly();
  void barkIsNotStretched();
  void repeatsChangeByCrossFadingOnly();
  void bakedBarkRepeatsWhole();
  void weightsAreOfTwoAndSumToOne();
  void normalsMeetAtJunctions();
  void lessDetailIsFewerTriangles();
  void threadsDoNotMatter();
};

void PlantSurfaceTest::vertexCountsAreTheNotes() {
  const std::map<QString, int> expected{{"default_502_v4.prim", 2393},
                                        {"herb_101_v4.prim", 483},
                                        {"japanese_maple", 41221},
                                        {"white_birch", 19633},
                                        {"quaking_aspen", 2680}};
  MeshSettings plain;
  plain.tolerance = 1e-3f;
  plain.merge = plain.widthFactor = plain.evenBark = plain.dome = plain.seats = plain.capBases = plain.blendNormals =
      false;
  int plantsSeen = 0;
  for (const auto& [name, plant] : test::realPlants()) {
    // The note's chains start on their parents' curves, without a joint at heads beside them.
    SkeletonGraph graph = plant;
    const Built first = build(graph, plain, {.collars = false, .flare = 0});
    for (std::size_t c = 0; c < first.curves.size(); ++c) {
      graph.segments[first.chains.links[first.chains.chains[c].first]].a = first.curves[c].pivot.point;
    }
    const Built b = build(graph, plain, {.collars = false, .flare = 0});
    const double ratio = static_cast<double>(b.mesh.vertices.size()) / expected.at(name);
    QVERIFY2(std::abs(ratio - 1) < 0.02, qPrintable(QStringLiteral("%1: %2").arg(name).arg(b.mesh.vertices.size())));
    ++plantsSeen;
  }
  if (plantsSeen == 0) QSKIP("the real plants are not there");
}

void PlantSurfaceTest::meshesAreClosedAndOriented() {
  for (const auto& [name, graph] : plants()) {
    for (const double detail : {0.0, 0.5, 1.0}) {
      if (detail == 1 && graph.segments.size() > 400) continue;
      MeshSettings settings;
      settings.tolerance = model::toleranceOf(detail);
      settings.blendNormals = false;
      const Flaws flaws = flawsOf(build(graph, settings).mesh);
      const QString what = QStringLiteral("%1 at %2: open %3, doubled %4, degenerate %5, flipped %6")
                               .arg(name)
                               .arg(detail)
                               .arg(flaws.open)
                               .arg(flaws.doubled)
                               .arg(flaws.degenerate)
                               .arg(flaws.flipped);
      QVERIFY2(flaws.open + flaws.doubled + flaws.degenerate + flaws.flipped == 0, qPrintable(what));
    }
  }
}

void PlantSurfaceTest::openMeshesAreOpenAtTheirBasesOnly() {
  for (const auto& [name, graph] : plants()) {
    if (graph.segments.size() > 1500) continue;
    MeshSettings settings;
    settings.tolerance = 5e-5f;
    settings.capBases = settings.merge = settings.blendNormals = false;
    const Built b = build(graph, settings, {.collars = false, .flare = 0});
    const Flaws flaws = flawsOf(b.mesh);
    std::size_t bases = 0;
    for (const model::RingChain& chain : b.rings.chains) {
      bases += model::ringSides(b.rings.rings[chain.first].radius, settings.tolerance);
    }
    QCOMPARE(flaws.open, bases);
    QCOMPARE(flaws.doubled, std::size_t{0});
    QCOMPARE(flaws.degenerate, std::size_t{0});
  }
}

void PlantSurfaceTest::barkIsNotStretched() {
  // Along the branch a step of v is a step of arc length over the circumference.
  for (const auto& [name, graph] : plants()) {
    MeshSettings settings;
    settings.widthFactor = settings.dome = settings.capBases = false;
    const Built b = build(graph, settings);
    std::size_t edges = 0;
    for (std::size_t c = 0; c < b.chains.chains.size(); ++c) {
      const model::RingChain& info = b.rings.chains[c];
      struct Row {
        vec3 centre{0};
        float radius = 0, v = 0, along = 0;
      };
      // Rings again from the mesh: rows of equal v, their centre and radius.
      std::vector<Row> rows;
      std::uint32_t low = b.mesh.indices[b.mesh.firstIndex[c]], high = low;
      for (std::uint32_t i = b.mesh.firstIndex[c]; i < b.mesh.firstIndex[c + 1]; ++i) {
        low = std::min(low, b.mesh.indices[i]), high = std::max(high, b.mesh.indices[i]);
      }
      for (std::uint32_t v = low; v < high;) {
        std::uint32_t end = v;
        while (end < high && b.mesh.vertices[end].uv.y == b.mesh.vertices[v].uv.y) ++end;
        Row row;
        for (std::uint32_t k = v; k + 1 < end; ++k) row.centre += b.mesh.vertices[k].position;
        row.centre /= static_cast<float>(end - v - 1);
        row.radius = glm::length(b.mesh.vertices[v].position - row.centre);
        row.v = -b.mesh.vertices[v].uv.y;
        rows.push_back(row);
        v = end;
      }
      float along = b.rings.rings[info.first].along;
      for (std::size_t i = 1; i < rows.size(); ++i) {
        const float step = glm::length(rows[i].centre - rows[i - 1].centre);
        along += step;
        // Inside the parent nobody sees it, collars and roots spread, and bark thinner than the tolerance is a line.
        if (along - step < info.exit + 2 * rows[i].radius || along < 5 * rows[i].radius ||
            rows[i].radius < 2 * settings.tolerance)
          continue;
        const float r = 0.5f * (rows[i - 1].radius + rows[i].radius);
        const float stretch = (rows[i].v - rows[i - 1].v) * 6.2831853f * r / step;
        QVERIFY2(stretch > 0.9f && stretch < 1.1f,
                 qPrintable(QStringLiteral("%1, chain %2, row %3: %4; radii %5, %6 mm, step %7 mm")
                                .arg(name)
                                .arg(c)
                                .arg(i)
                                .arg(stretch)
                                .arg(1000 * rows[i - 1].radius)
                                .arg(1000 * rows[i].radius)
                                .arg(1000 * step)));
        ++edges;
      }
    }
    QVERIFY(edges > 10);
  }
}

void PlantSurfaceTest::repeatsChangeByCrossFadingOnly() {
  // u runs 0 to 1 round every ring, so that 2^k repeats close at the seam for every k; the shader fades between two.
  const Built b = build(test::smallTree(), {});
  for (const model::Vertex& vertex : b.mesh.vertices) {
    QVERIFY(vertex.repeats >= 0 && vertex.repeats < 12);
    QVERIFY(std::isfinite(vertex.uv.x) && std::isfinite(vertex.uv.y));
  }
  std::size_t seams = 0;
  for (std::size_t i = 1; i < b.mesh.vertices.size(); ++i) {
    for (std::size_t k = 3; k <= 48 && k <= i; ++k) {
      const model::Vertex &a = b.mesh.vertices[i - k], &z = b.mesh.vertices[i];
      if (a.uv.y != z.uv.y || a.position != z.position) continue;
      QVERIFY(std::abs(z.uv.x - a.uv.x - 1) < 1e-5f);
      ++seams;
      break;
    }
  }
  QVERIFY(seams > 30);
}

void PlantSurfaceTest::bakedBarkRepeatsWhole() {
  MeshSettings settings;
  settings.bakeRepeats = true;
  settings.tile = 0.05f;
  const Built b = build(test::smallTree(), settings);
  float most = 0;
  for (std::size_t i = 1; i < b.mesh.vertices.size(); ++i) {
    for (std::size_t k = 3; k <= 48 && k <= i; ++k) {
      const model::Vertex &a = b.mesh.vertices[i - k], &z = b.mesh.vertices[i];
      if (a.uv.y != z.uv.y || a.position != z.position) continue;
      const float repeats = z.uv.x - a.uv.x;
      QVERIFY(repeats > 0.5f && std::abs(repeats - std::round(repeats)) < 1e-4f);
      most = std::max(most, repeats);
      break;
    }
    QCOMPARE(b.mesh.vertices[i].repeats, 0.0f);
  }
  QVERIFY(most > 1.5f);
}

void PlantSurfaceTest::weightsAreOfTwoAndSumToOne() {
  for (const auto& [name, graph] : plants()) {
    const Built b = build(graph, {});
    for (const model::Vertex& vertex : b.mesh.vertices) {
      const float sum = vertex.weights[0] + vertex.weights[1] + vertex.weights[2] + vertex.weights[3];
      QVERIFY(std::abs(sum - 1) < 1e-6f);
      QVERIFY(vertex.weights[2] == 0 && vertex.weights[3] == 0);
      for (const std::uint32_t bone : vertex.bones) QVERIFY(bone < graph.segments.size());
    }
  }
}

void PlantSurfaceTest::normalsMeetAtJunctions() {
  // A stout parent along y, a child along x: where the child comes out, its normals are the parent's.
  SkeletonGraph graph;
  graph.segments = {test::segment({0, 0, 0}, {0, 1, 0}, 0.1f, -1), test::segment({0, 1, 0}, {0, 2, 0}, 0.1f, 0),
                    test::segment({0, 1, 0}, {1, 1, 0}, 0.04f, 0)};
  finishGraph(graph);
  MeshSettings settings;
  settings.merge = false;
  const Built b = build(graph, settings, {.flare = 0});
  const auto child = static_cast<std::size_t>(b.chains.ofSegment[2]);
  std::size_t near = 0;
  for (std::uint32_t i = b.mesh.firstIndex[child]; i < b.mesh.firstIndex[child + 1]; ++i) {
    const model::Vertex& vertex = b.mesh.vertices[b.mesh.indices[i]];
    const vec3 radial(vertex.position.x, 0, vertex.position.z);
    const float distance = glm::length(radial);
    if (distance > 0.1001f || distance < 0.07f) continue;
    QVERIFY(glm::dot(vertex.normal, radial / distance) > 0.999f);
    ++near;
  }
  QVERIFY(near > 3);
}

void PlantSurfaceTest::lessDetailIsFewerTriangles() {
  for (const auto& [name, graph] : plants()) {
    std::size_t before = 0;
    for (const double detail : {0.0, 0.3, 0.6}) {
      MeshSettings settings;
      settings.tolerance = model::toleranceOf(detail);
      const std::size_t now = build(graph, settings).mesh.indices.size();
      QVERIFY2(now > before, qPrintable(name));
      before = now;
    }
  }
}

void PlantSurfaceTest::threadsDoNotMatter() {
  SkeletonGraph graph = test::boneTable("white_birch");
  if (graph.segments.empty()) graph = test::smallTree(60);
  const int before = omp_get_max_threads();
  std::vector<SurfaceMesh> meshes;
  for (const int threads : {1, 2, 8}) {
    omp_set_num_threads(threads);
    meshes.push_back(build(graph, {.gnarl = 0.1f}).mesh);
  }
  omp_set_num_threads(before);
  for (const SurfaceMesh& mesh : meshes) {
    QCOMPARE(mesh.vertices.size(), meshes[0].vertices.size());
    QVERIFY(mesh.indices == meshes[0].indices);
    const std::size_t bytes = mesh.vertices.size() * sizeof(model::Vertex);
    QVERIFY(std::memcmp(mesh.vertices.data(), meshes[0].vertices.data(), bytes) == 0);
  }
}

WINDFALL_SUITE(PlantSurfaceTest)
#include "plant_surface.moc"
