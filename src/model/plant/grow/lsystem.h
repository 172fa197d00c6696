// L-systems: bracketed, stochastic, parametric, context-sensitive (Prusinkiewicz, Lindenmayer 1990; growers.md, 3).
// The language is described in docs/lsystem.md.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "model/plant/grow/grown.h"
#include "model/progress.h"
#include "sim/result.h"

namespace windfall::model::growth {

/// Where a text is wrong; lines and columns count from 1.
struct RuleError {
  int line = 0, column = 0;
  std::string message;
  RuleError(int atLine, int atColumn, std::string_view what);
  /// "2:8: '(' is never closed".
  std::string text() const { return std::to_string(line) + ":" + std::to_string(column) + ": " + message; }
};

/// An expression as code for a small stack machine; nothing of the host can be called from it.
struct Expression {
  enum class Code : std::uint8_t {
    Number,
    Parameter,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Negate,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    Unequal,
    And,
    Or,
    Sin,
    Cos,
    Exp,
    Log,
    Sqrt,
    Floor,
    Abs,
    Min,
    Max,
  };
  struct Step {
    Code code;
    double value = 0;  ///< the number, or the parameter's index
  };
  std::vector<Step> steps;
  int line = 0, column = 0;

  /// False for a division by zero; `parameters` are those of the rule.
  bool evaluate(const double* parameters, double& value) const;
};

inline constexpr int kMostParameters = 64, kDeepestExpression = 64;

/// A symbol of the alphabet: a character, and digits behind a letter.
using Symbol = std::uint16_t;

struct PatternModule {
  Symbol symbol = 0;
  int parameters = 0;  ///< how many it must have
  int first = 0;       ///< index of its first one among the rule's
};

struct SuccessorModule {
  Symbol symbol = 0;
  std::vector<Expression> parameters;
};

struct Rule {
  std::vector<PatternModule> left;  ///< context, nearest last
  PatternModule self;
  std::vector<PatternModule> right;
  Expression condition, weight;  ///< without steps: true, and 1
  std::vector<SuccessorModule> successor;
  int line = 0;
};

struct LSystem {
  std::vector<std::string> names;  ///< of the symbols
  std::vector<SuccessorModule> axiom;
  std::vector<Rule> rules;
  std::vector<std::vector<int>> rulesOf;  ///< by symbol
  std::vector<char> ignored;              ///< by symbol: skipped in contexts
  std::uint64_t seed = 0;
  int iterations = 5;
  double angle = 25, step = 0.1, width = 0.01, bend = 0;  ///< what the turtle uses where a module has no parameter
  bool hasSeed = false;

  Symbol find(std::string_view name) const;  ///< names.size() where there is none
};

/// What a text may hold at most.
inline constexpr std::size_t kLongestRules = 65536;

struct Parsed {
  LSystem system;
  std::vector<RuleError> errors;  ///< empty: all is well
};
/// `age` 0..1 is what the name `age` means in expressions.
Parsed parseRules(std::string_view text, double age = 1);

/// A string of modules: symbols, and their parameters one after the other.
struct ModuleString {
  std::vector<Symbol> symbol;
  std::vector<std::uint64_t> id;     ///< for draws (3.2)
  std::vector<std::uint32_t> first;  ///< of its parameters; one more than there are modules
  std::vector<double> parameter;
  std::size_t size() const { return symbol.size(); }
};

/// What a derivation may cost (3.5).
struct LSystemLimits {
  std::size_t modules = 2'000'000;
  std::size_t parameters = 8'000'000;
  std::size_t work = 12'000'000;  ///< modules of all generations together
  std::size_t links = 200'000;
  int depth = 1'000;  ///< of brackets
  int generations = 1'000;
};

struct Derived {
  ModuleString modules;
  int generation = 0;               ///< that `modules` is
  std::vector<std::size_t> counts;  ///< modules of every generation, from 0 on
  std::string stopped;              ///< why it is not the one that was wanted; empty: it is
};
/// In parallel over fixed chunks; the same bits for any number of threads. Errors name the rule's line.
Result<Derived> derive(const LSystem& system, int generations, std::uint64_t seed, const LSystemLimits& limits,
                       Progress& progress);

/// Names of all modules, in order ("F[+X]F").
std::string namesOf(const LSystem& system, const ModuleString& modules);

/// Walks the string: F and G make links, ! sets their width, ~ hangs leaves. `radius` is 0 where no ! came before.
/// In parallel where no module looks at the world ($, bend) and the string is long.
Result<Grown> interpret(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits,
                        Progress& progress);
/// The two ways of doing it; equal but for rounding.
Result<Grown> interpretInOrder(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits);
Result<Grown> interpretInParallel(const LSystem& system, const ModuleString& modules, const LSystemLimits& limits);

}  // namespace windfall::model::growth
