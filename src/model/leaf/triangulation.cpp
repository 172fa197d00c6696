#include "model/leaf/triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <algorithm>

namespace windfall::model {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Faces = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                               CGAL::Exact_predicates_tag>;

}  // namespace

bool contains(const Polygon& polygon, QPointF place) {
  bool inside = false;
  for (size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const QPointF a = polygon[i], b = polygon[before];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    if (place.x() < (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside;
}

Triangulation triangulate(const Polygon& polygon, const std::vector<QPointF>& inside,
                          const std::vector<std::pair<std::uint32_t, std::uint32_t>>& lines) {
  Triangulation result;
  if (polygon.size() < 3) return result;
  result.points = polygon;
  result.points.insert(result.points.end(), inside.begin(), inside.end());
  Delaunay delaunay;
  std::vector<Delaunay::Vertex_handle> handles;
  for (std::uint32_t i = 0; i < result.points.size(); ++i) {
    const std::size_t before = delaunay.number_of_vertices();
    handles.push_back(delaunay.insert({result.points[i].x(), result.points[i].y()}));
    if (delaunay.number_of_vertices() > before) handles.back()->info() = i;
  }
  // Vertices that crossings make have no number yet.
  const std::size_t given = delaunay.number_of_vertices();
  const auto connect = [&](std::size_t a, std::size_t b) {
    if (handles[a] != handles[b]) delaunay.insert_constraint(handles[a], handles[b]);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) connect(i, (i + 1) % polygon.size());
  for (const auto& [a, b] : lines) connect(a, b);
  if (delaunay.number_of_vertices() > given) {
    for (auto vertex = delaunay.finite_vertices_begin(); vertex != delaunay.finite_vertices_end(); ++vertex) {
      const bool ours = std::find(handles.begin(), handles.end(), Delaunay::Vertex_handle(vertex)) != handles.end();
      if (ours) continue;
      vertex->info() = static_cast<std::uint32_t>(result.points.size());
      result.points.emplace_back(vertex->point().x(), vertex->point().y());
    }
  }
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    QPointF middle(0, 0);
    std::uint32_t corners[3];
    for (int k = 0; k < 3; ++k) {
      corners[k] = face->vertex(k)->info();
      middle += result.points[corners[k]] / 3;
    }
    if (!contains(polygon, middle)) continue;
    result.corners.insert(result.corners.end(), corners, corners + 3);
  }
  return result;
}

}  // namespace windfall::model
