// How branches are solved: the part of the scene's inspector that few need.
#include <cmath>

#include "widgets/fields/choice_field.h"
#include "widgets/fields/number_field.h"
#include "widgets/scene/scene_inspector.h"

namespace windfall::widgets {

void SceneInspector::addSolver() {
  using Solver = sim::SolverSettings;
  const auto part = &model::Scene::solver;
  FieldGroup* group = addGroup("solver", tr("Swaying"));
  auto* method = group->add(
      new ChoiceField(tr("Method"), {tr("Coupled"), tr("Analytic"), tr("Forces (thesis)"), tr("As published")}, 0));
  keep("solver.method", method);
  method->setToolTip(
      tr("Coupled: branches and trunk move each other, the most lifelike.\n"
         "Analytic: every joint by itself, the fastest for huge trees.\n"
         "Forces, As published: earlier methods, to compare with; their trees sway at wrong rates."));
  connect(method, &ChoiceField::edited, this, [this, part](int index) {
    Solver solver = document_.project().scene.solver;
    solver.method = static_cast<sim::TreeMethod>(index);
    document_.setScene(part, solver, model::Aspect::Solver, tr("Choose how branches are solved"));
  });
  auto* bases = group->add(new CheckField(tr("Moving bases"), Solver().axisMotion));
  keep("solver.axisMotion", bases);
  bases->setToolTip(tr("Analytic method: a branch feels how the branch that carries it moves"));
  connect(bases, &CheckField::edited, this, [this, part](bool on) {
    Solver solver = document_.project().scene.solver;
    solver.axisMotion = on;
    document_.setScene(part, solver, model::Aspect::Solver, tr("Change how branches follow their base"));
  });
  auto* damping = group->add(new NumberField(
      tr("Damping"), {.maximum = 15, .defaultValue = 3, .decimals = 1, .unit = "%", .hardMaximum = 100}));
  keep("solver.damping", damping);
  damping->setToolTip(tr("Damping inside the wood, as a share of the critical one; the air adds its own"));
  connect(damping, &NumberField::edited, this, [this, part, damping](double value) {
    Solver solver = document_.project().scene.solver;
    solver.structuralDamping = static_cast<float>(value / 100);
    document_.setScene(part, solver, model::Aspect::Solver, tr("Change the damping of branches"), damping->gesture());
  });
  shows_.push_back([method, bases, damping](const model::Scene& scene) {
    method->setValue(static_cast<int>(scene.solver.method));
    bases->setValue(scene.solver.axisMotion);
    bases->setEnabled(scene.solver.method == sim::TreeMethod::Analytic);
    damping->setValue(std::round(static_cast<double>(scene.solver.structuralDamping) * 1e5) / 1e3);
  });
}

}  // namespace windfall::widgets
