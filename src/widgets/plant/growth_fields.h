// The growers' parameters in the plant inspector: method, age, crown, competition, rules, leaves, wood.
#pragma once

#include <QObject>
#include <functional>
#include <vector>

#include "model/document/document.h"
#include "widgets/fields/field_panel.h"

namespace windfall::widgets {

class ChoiceField;
class CrownEditor;
class NumberField;
class RulesEditor;
struct NumberSpec;

class GrowthFields : public QObject {
  Q_OBJECT
 public:
  /// Method and age go into `general`; the rest are groups of their own behind it.
  GrowthFields(model::Document& document, FieldPanel& panel, FieldGroup& general, QObject* parent = nullptr);

  /// The plant shown (0: none); what its method does not use is hidden.
  void show(model::AssetId plant);

 signals:
  /// The shown plant is of another method than the plain rule, or is so again.
  void methodShown(bool byRule);
  /// One line on what could not be done.
  void problem(const QString& text);

 private:
  using Change = std::function<void(model::GrowerSettings&)>;
  template <class T>
  using Member = T& (*)(model::GrowerSettings&);

  void edit(const Change& change, const QString& text, const QString& merge);
  template <class T>
  NumberField* number(FieldGroup* group, const QString& key, const QString& label, const NumberSpec& spec,
                      Member<T> member, const QString& help = {});
  template <class T>
  ChoiceField* choice(FieldGroup* group, const QString& key, const QString& label, const QStringList& names,
                      Member<T> member);
  void check(FieldGroup* group, const QString& key, const QString& label, Member<bool> member, const QString& help);
  void makeGeneral(FieldGroup& group);
  void makeCrown(FieldPanel& panel);
  void makeBranching(FieldPanel& panel);
  void makeCompetition(FieldPanel& panel);
  void makeRules(FieldPanel& panel);
  void makeFoliage(FieldPanel& panel);
  void makeWood(FieldPanel& panel);
  void importCrown();

  model::Document& document_;
  model::AssetId plant_;
  std::vector<std::function<void(const model::GrowerSettings&)>> shows_;
  NumberField* age_ = nullptr;
  CrownEditor* outline_ = nullptr;
  RulesEditor* rules_ = nullptr;
  QWidget* noMesh_ = nullptr;
  FieldGroup *crown_ = nullptr, *branching_ = nullptr, *competition_ = nullptr, *rulesGroup_ = nullptr,
             *foliage_ = nullptr, *wood_ = nullptr;
};

}  // namespace windfall::widgets
