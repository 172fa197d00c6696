#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "model/plant/grow/draw.h"
#include "model/plant/grow/lsystem.h"

namespace windfall::model::growth {

namespace {

constexpr std::size_t kChunk = 4096;  ///< part of the result's definition nowhere, but fixed all the same

/// Who stands before a module on its way to the root, and where brackets end (3.3).
struct Paths {
  std::vector<std::int32_t> before, partner;
  int depth = 0;
};

class Derivation {
 public:
  Derivation(const LSystem& system, std::uint64_t seed, const LSystemLimits& limits)
      : system_(system),
        seed_(seed),
        limits_(limits),
        open_(system.find("[")),
        close_(system.find("]")),
        cut_(system.find("%")) {
    for (const Rule& rule : system.rules) needsPaths_ = needsPaths_ || !rule.left.empty() || !rule.right.empty();
  }

  Result<ModuleString> axiom() const {
    ModuleString string;
    string.first.push_back(0);
    for (std::size_t i = 0; i < system_.axiom.size(); ++i) {
      const SuccessorModule& module = system_.axiom[i];
      for (const Expression& expression : module.parameters) {
        double value = 0;
        if (!expression.evaluate(nullptr, value) || !std::isfinite(value)) {
          return Error{RuleError(expression.line, expression.column, "this is no number").text()};
        }
        string.parameter.push_back(value);
      }
      string.symbol.push_back(module.symbol);
      string.id.push_back(mix(i));
      string.first.push_back(static_cast<std::uint32_t>(string.parameter.size()));
    }
    return string;
  }

  struct Step {
    ModuleString next;
    std::size_t wanted = 0;  ///< modules; where that is too many there is no `next`
    bool tooMany = false;
    std::optional<RuleError> error;
  };
  Step step(const ModuleString& now) {
    Step out;
    if (needsPaths_) findPaths(now);
    const std::size_t n = now.size(), chunks = (n + kChunk - 1) / kChunk;
    std::vector<std::int32_t> chosen(n, -1);
    std::vector<std::size_t> modules(chunks + 1, 0), parameters(chunks + 1, 0);
    std::vector<std::optional<RuleError>> errors(chunks);
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks; ++c) {
      double bound[kMostParameters];
      for (std::size_t i = c * kChunk; i < std::min(n, (c + 1) * kChunk) && !errors[c]; ++i) {
        chosen[i] = choose(now, i, bound, errors[c]);
        if (chosen[i] < 0) {
          modules[c + 1] += 1, parameters[c + 1] += now.first[i + 1] - now.first[i];
          continue;
        }
        for (const SuccessorModule& module : system_.rules[at(chosen[i])].successor) {
          modules[c + 1] += 1, parameters[c + 1] += module.parameters.size();
        }
      }
    }
    if (take(errors, out)) return out;
    for (std::size_t c = 0; c < chunks; ++c) modules[c + 1] += modules[c], parameters[c + 1] += parameters[c];
    out.wanted = modules[chunks];
    out.tooMany = modules[chunks] > limits_.modules || parameters[chunks] > limits_.parameters;
    if (out.tooMany) return out;

    ModuleString& next = out.next;
    next.symbol.resize(modules[chunks]);
    next.id.resize(modules[chunks]);
    next.first.resize(modules[chunks] + 1);
    next.parameter.resize(parameters[chunks]);
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks; ++c) {
      double bound[kMostParameters];
      std::size_t m = modules[c], p = parameters[c];
      for (std::size_t i = c * kChunk; i < std::min(n, (c + 1) * kChunk) && !errors[c]; ++i) {
        if (chosen[i] < 0) {
          next.symbol[m] = now.symbol[i], next.id[m] = now.id[i], next.first[m] = static_cast<std::uint32_t>(p);
          ++m;
          for (std::uint32_t k = now.first[i]; k < now.first[i + 1]; ++k) next.parameter[p++] = now.parameter[k];
          continue;
        }
        const Rule& rule = system_.rules[at(chosen[i])];
        matches(now, i, rule, bound);
        std::uint64_t position = 0;
        for (const SuccessorModule& module : rule.successor) {
          next.symbol[m] = module.symbol, next.id[m] = mix(now.id[i] ^ mix(++position));
          next.first[m] = static_cast<std::uint32_t>(p);
          ++m;
          for (const Expression& expression : module.parameters) {
            double& value = next.parameter[p++];
            if (!expression.evaluate(bound, value)) {
              errors[c] = RuleError(expression.line, expression.column, "division by zero");
            } else if (!std::isfinite(value)) {
              errors[c] = RuleError(expression.line, expression.column, "this is no number any more");
            }
          }
        }
      }
    }
    if (take(errors, out)) return out;
    next.first[next.size()] = static_cast<std::uint32_t>(next.parameter.size());
    if (cut_ < system_.names.size()) applyCuts(next);
    return out;
  }

  /// Deepest bracket of a string.
  int depthOf(const ModuleString& string) const {
    int depth = 0, most = 0;
    for (const Symbol symbol : string.symbol) {
      if (symbol == open_) most = std::max(most, ++depth);
      if (symbol == close_) --depth;
    }
    return most;
  }

 private:
  static bool take(std::vector<std::optional<RuleError>>& errors, Step& out) {
    for (std::optional<RuleError>& error : errors) {
      if (!error) continue;
      out.error = std::move(error);
      return true;
    }
    return false;
  }

  void findPaths(const ModuleString& now) {
    paths_.before.assign(now.size(), -1);
    paths_.partner.assign(now.size(), -1);
    std::vector<std::pair<std::int32_t, std::int32_t>> stack;
    std::int32_t last = -1;
    for (std::size_t i = 0; i < now.size(); ++i) {
      paths_.before[i] = last;
      const auto self = static_cast<std::int32_t>(i);
      if (now.symbol[i] == open_) {
        stack.emplace_back(self, last);
      } else if (now.symbol[i] == close_ && !stack.empty()) {
        paths_.partner[at(stack.back().first)] = self;
        last = stack.back().second;
        stack.pop_back();
      } else {
        last = self;
      }
    }
  }

  bool ignored(Symbol symbol) const { return symbol < system_.ignored.size() && system_.ignored[symbol] != 0; }

  static bool bind(const ModuleString& now, std::size_t i, const PatternModule& pattern, double* bound) {
    const std::uint32_t from = now.first[i];
    if (now.symbol[i] != pattern.symbol || now.first[i + 1] - from != static_cast<std::uint32_t>(pattern.parameters))
      return false;
    for (int k = 0; k < pattern.parameters; ++k)
      bound[pattern.first + k] = now.parameter[from + static_cast<std::uint32_t>(k)];
    return true;
  }

  bool matches(const ModuleString& now, std::size_t i, const Rule& rule, double* bound) const {
    if (!bind(now, i, rule.self, bound)) return false;
    std::int32_t place = static_cast<std::int32_t>(i);
    for (std::size_t k = rule.left.size(); k-- > 0;) {
      do {
        place = paths_.before[at(place)];
      } while (place >= 0 && ignored(now.symbol[at(place)]));
      if (place < 0 || !bind(now, at(place), rule.left[k], bound)) return false;
    }
    std::size_t next = i;
    for (const PatternModule& pattern : rule.right) {
      for (++next; next < now.size(); ++next) {
        if (now.symbol[next] == open_) {
          next = at(paths_.partner[next]);
        } else if (!ignored(now.symbol[next])) {
          break;
        }
      }
      if (next >= now.size() || now.symbol[next] == close_ || !bind(now, next, pattern, bound)) return false;
    }
    return true;
  }

  /// Index of the rule that rewrites module i, or -1.
  std::int32_t choose(const ModuleString& now, std::size_t i, double* bound, std::optional<RuleError>& error) const {
    const std::vector<int>& candidates = system_.rulesOf[now.symbol[i]];
    if (candidates.empty()) return -1;
    bool inContext = false;
    double total = 0;
    std::int32_t only = -1, count = 0;
    // First who matches, then the draw among them in the same order.
    const auto visit = [&](auto&& each) {
      for (const int index : candidates) {
        const Rule& rule = system_.rules[at(index)];
        const bool context = !rule.left.empty() || !rule.right.empty();
        if (!matches(now, i, rule, bound)) continue;
        double holds = 1, weight = 1;
        if (!rule.condition.steps.empty() && !rule.condition.evaluate(bound, holds)) {
          error = RuleError(rule.condition.line, rule.condition.column, "division by zero");
          return;
        }
        if (holds == 0) continue;
        if (!rule.weight.steps.empty() &&
            (!rule.weight.evaluate(bound, weight) || !(weight > 0) || !std::isfinite(weight))) {
          error = RuleError(rule.weight.line, rule.weight.column, "the weight must be above 0");
          return;
        }
        if (each(index, context, weight)) return;
      }
    };
    visit([&](int index, bool context, double weight) {
      if (context && !inContext) inContext = true, total = 0, count = 0;
      if (context == inContext) total += weight, ++count, only = index;
      return false;
    });
    if (error || count == 0) return -1;
    if (count == 1) return only;
    double drawn = unit(mix(mix(seed_) ^ now.id[i])) * total;
    std::int32_t result = only;
    visit([&](int index, bool context, double weight) {
      if (context != inContext) return false;
      result = index;
      drawn -= weight;
      return drawn < 0;
    });
    return result;
  }

  /// Removes what stands behind a % up to the end of its branch, with the % itself.
  void applyCuts(ModuleString& string) const {
    if (std::find(string.symbol.begin(), string.symbol.end(), cut_) == string.symbol.end()) return;
    ModuleString kept;
    kept.first.push_back(0);
    for (std::size_t i = 0; i < string.size(); ++i) {
      if (string.symbol[i] == cut_) {
        int depth = 0;
        for (++i; i < string.size(); ++i) {
          if (string.symbol[i] == open_) ++depth;
          if (string.symbol[i] == close_ && depth-- == 0) break;
        }
        if (i >= string.size()) break;
      }
      kept.symbol.push_back(string.symbol[i]);
      kept.id.push_back(string.id[i]);
      kept.parameter.insert(kept.parameter.end(), string.parameter.begin() + string.first[i],
                            string.parameter.begin() + string.first[i + 1]);
      kept.first.push_back(static_cast<std::uint32_t>(kept.parameter.size()));
    }
    string = std::move(kept);
  }

  const LSystem& system_;
  std::uint64_t seed_;
  const LSystemLimits& limits_;
  Symbol open_, close_, cut_;
  bool needsPaths_ = false;
  Paths paths_;
};

/// "5,640,211".
std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

}  // namespace

Result<Derived> derive(const LSystem& system, int generations, std::uint64_t seed, const LSystemLimits& limits,
                       Progress& progress) {
  Derivation derivation(system, seed, limits);
  Result<ModuleString> axiom = derivation.axiom();
  if (!axiom) return axiom.error();
  Derived derived;
  derived.modules = std::move(*axiom);
  derived.counts.push_back(derived.modules.size());
  std::size_t work = derived.modules.size();
  const auto stop = [&](int generation, const std::string& why) {
    derived.stopped = "generation " + std::to_string(generation) + " " + why + "; showing generation " +
                      std::to_string(generation - 1);
  };
  for (int generation = 1; generation <= generations; ++generation) {
    if (progress.cancelled()) return Error{"cancelled", true};
    if (generation > limits.generations) {
      stop(generation, "is more than " + grouped(static_cast<std::size_t>(limits.generations)));
      break;
    }
    Derivation::Step step = derivation.step(derived.modules);
    if (step.error) return Error{step.error->text()};
    if (step.tooMany) {
      stop(generation, "would make " + grouped(step.wanted) + " modules (limit " + grouped(limits.modules) + ")");
      break;
    }
    work += step.next.size();
    if (work > limits.work) {
      stop(generation,
           "is too much work: all generations together make more than " + grouped(limits.work) + " modules");
      break;
    }
    if (derivation.depthOf(step.next) > limits.depth) {
      stop(generation, "nests brackets deeper than " + grouped(static_cast<std::size_t>(limits.depth)));
      break;
    }
    derived.modules = std::move(step.next);
    derived.generation = generation;
    derived.counts.push_back(derived.modules.size());
    progress.report(static_cast<double>(generation) / generations);
  }
  return derived;
}

std::string namesOf(const LSystem& system, const ModuleString& modules) {
  std::string text;
  for (const Symbol symbol : modules.symbol) text += system.names[symbol];
  return text;
}

}  // namespace windfall::model::growth
