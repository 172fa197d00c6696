#include "sim/tree_bench.h"

#include <omp.h>

#include <memory>
#include <numbers>

#include "kernels/link_pose.h"
#include "sim/articulated.h"
#include "sim/sample_tree.h"
#include "sim/tree_field.h"
#include "sim/wind.h"

namespace windfall::sim {

namespace {

constexpr int kSteps = 10;

struct Scene {
  std::shared_ptr<const Tree> tree = std::make_shared<Tree>(sampleTree(tenThousandLinks()));
  WindField wind{vec3(-8, 0, -8), vec3(8, 12, 8), WindSettings{.speed = 8}, 1};
  Scene() { wind.advance(0); }
};

Contender coupled(std::shared_ptr<Scene> scene, int threads) {
  FactorSettings settings;
  settings.windSpeed = 8;
  auto field = std::make_shared<TreeField>(std::vector<TreeInstance>{{scene->tree, {}}}, settings, threads);
  Contender contender;
  contender.name = "coupled, prefactored, " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
  contender.items = static_cast<double>(field->size()) * kSteps;
  contender.run = [scene, field] {
    field->sampleAir(scene->wind.view());
    for (int i = 0; i < kSteps; ++i) field->solve();
  };
  return contender;
}

/// The same loads and the same implicit springs, factored anew in each step's pose: what a general engine does.
Contender articulated(std::shared_ptr<Scene> scene) {
  using Reference = ArticulatedTree<float>;
  const std::vector<LinkBody> bodies = bodiesOf(*scene->tree);
  const double beta = 2 * 0.03 / (2 * std::numbers::pi * firstFrequency(bodies));
  auto tree = std::make_shared<Reference>(bodies, static_cast<float>(beta));
  auto drag = std::make_shared<std::vector<LinkShape>>(bodies.size());
  const std::vector<Composite> composites = compositesOf(bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    (*drag)[i].woodDrag = static_cast<float>(bodies[i].woodDrag);
    (*drag)[i].leafDrag = static_cast<float>(bodies[i].leafDrag);
    tree->parts()[i].rotor.z = static_cast<float>(twistFloor(bodies[i], composites[i]));
    const glm::dvec3 weight(0, -9.81 * composites[i].mass, 0);
    const glm::dvec3 torque = glm::cross(composites[i].moment, glm::dvec3(0, -9.81, 0));
    tree->parts()[i].preStress = vec3(glm::transpose(bodies[i].axes) * torque);
  }
  Contender contender;
  contender.name = "articulated bodies each step, 1 thread";
  contender.items = static_cast<double>(bodies.size()) * kSteps;
  contender.run = [scene, tree, drag] {
    const WindView wind = scene->wind.view();
    for (int i = 0; i < kSteps; ++i) {
      for (std::size_t k = 0; k < tree->parts().size(); ++k) {
        Reference::Part& part = tree->parts()[k];
        const vec3 along = part.rotation * vec3(0, 0, 1);
        const vec3 u = windAt(wind, part.position + along * part.half);
        const V3<float> f =
            dragOf<float>((*drag)[k].woodDrag, (*drag)[k].leafDrag, {along.x, along.y, along.z}, {u.x, u.y, u.z});
        part.force = vec3(f.x, f.y - 9.81f * part.mass, f.z);
      }
      tree->stepImplicit(1.f / 60);
    }
  };
  return contender;
}

std::vector<Contender> stepContenders() {
  auto scene = std::make_shared<Scene>();
  std::vector<Contender> all{coupled(scene, 1)};
  if (const int threads = omp_get_max_threads(); threads > 1) all.push_back(coupled(scene, threads));
  all.push_back(articulated(scene));
  return all;
}

std::vector<Contender> windContenders() {
  auto field = std::make_shared<WindField>(vec3(-8, 0, -8), vec3(8, 12, 8), WindSettings{}, 1);
  auto time = std::make_shared<double>(0);
  const WindView view = field->view();
  const double nodes = static_cast<double>(view.nx) * view.ny * view.nz;
  Contender spread{"evaluated at 8 Hz, interpolated between", nullptr, nodes * 60};
  spread.run = [field, time] {
    for (int i = 0; i < 60; ++i) field->advance(*time += 1.0 / 60);
  };
  auto sum = std::make_shared<vec3>(0);
  const auto everywhere = [view](const auto& visit) {
    for (int z = 0; z < view.nz; ++z) {
      for (int y = 0; y < view.ny; ++y) {
        for (int x = 0; x < view.nx; ++x) visit(view.origin + vec3(x, y, z) / view.perMetre);
      }
    }
  };
  Contender direct{"evaluated each step", nullptr, nodes};
  direct.run = [field, sum, everywhere] {
    const WindMoment moment = field->moment(1);
    everywhere([&](const vec3& place) { *sum += vec3(windNode(moment, place, windProfile(place.y))); });
  };
  Contender lookup{"what a link asks for: lattice and small eddies", nullptr, nodes};
  lookup.run = [field, sum, everywhere] {
    const WindView now = field->view();
    everywhere([&](const vec3& place) { *sum += windAt(now, place + vec3(0.4f)); });
  };
  Contender tile{"a lookup in the tile of eddies", nullptr, nodes};
  tile.run = [field, sum, everywhere] {
    const WindView now = field->view();
    everywhere([&](const vec3& place) { *sum += eddyAt(now.eddies, place * 2.f); });
  };
  return {spread, direct, lookup, tile};
}

std::vector<Contender> factorContenders() {
  auto scene = std::make_shared<Scene>();
  auto field = std::make_shared<TreeField>(std::vector<TreeInstance>{{scene->tree, {}}}, FactorSettings{}, 1);
  Contender contender{"factorisation", nullptr, static_cast<double>(field->size())};
  contender.run = [field] { field->factorise(field->settings()); };
  return {contender};
}

}  // namespace

std::vector<Benchmark> treeBenchmarks() {
  return {{"trees", "a step of a broadleaf of 9,562 links in gusty wind", "ns per link and step", 1e9, stepContenders},
          {"wind", "the wind around a tree, brought to the next step", "ns per place and step", 1e9, windContenders},
          {"factor", "new stiffness or wind level of the same tree", "ns per link", 1e9, factorContenders}};
}

}  // namespace windfall::sim
