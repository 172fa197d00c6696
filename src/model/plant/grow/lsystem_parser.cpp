#include "model/plant/grow/lsystem_parser.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace windfall::model::growth {

namespace {

constexpr std::string_view kSigns = "[]+-&^\\/|$!~'%";
constexpr std::size_t kMostRules = 1000;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

class Parser {
 public:
  explicit Parser(double age) { defined_["age"] = age; }

  void readLine(std::string_view text, int line) {
    LineReader reader(text.substr(0, text.find("//")), line);
    if (reader.atEnd()) return;
    if (reader.peek() == '#') {
      directive(reader);
    } else if (reader.take("axiom:")) {
      if (hasAxiom_) failAt(line, 1, "there is an axiom already");
      hasAxiom_ = true;
      out_.axiom = successor(reader, {});
    } else {
      rule(reader);
    }
  }

  LSystem finish(int lines) {
    if (!hasAxiom_) failAt(std::max(lines, 1), 1, "there is no axiom; write \"axiom: F\"");
    out_.ignored.resize(out_.names.size(), 0);
    out_.rulesOf.resize(out_.names.size());
    for (std::size_t i = 0; i < out_.rules.size(); ++i)
      out_.rulesOf[out_.rules[i].self.symbol].push_back(static_cast<int>(i));
    const auto known = [&](const char* name, double& value) {
      if (const auto found = defined_.find(name); found != defined_.end()) value = found->second;
    };
    known("angle", out_.angle), known("step", out_.step), known("width", out_.width), known("bend", out_.bend);
    if (!(out_.step > 0 && out_.step <= 100)) failAt(1, 1, "step must be above 0 and at most 100 m");
    if (!(out_.width > 0 && out_.width <= 100)) failAt(1, 1, "width must be above 0 and at most 100 m");
    return std::move(out_);
  }

 private:
  Symbol intern(const std::string& name) {
    const auto found = std::find(out_.names.begin(), out_.names.end(), name);
    if (found != out_.names.end()) return static_cast<Symbol>(found - out_.names.begin());
    out_.names.push_back(name);
    return static_cast<Symbol>(out_.names.size() - 1);
  }

  /// A symbol, or nothing where none begins.
  std::optional<Symbol> symbol(LineReader& reader) {
    const char c = reader.peek();
    if (isLetter(c)) {
      std::string name(1, c);
      reader.advance();
      while (isDigit(reader.ahead(0))) name += reader.ahead(0), reader.advance();
      return intern(name);
    }
    if (c == '\0' || kSigns.find(c) == std::string_view::npos) return {};
    reader.advance();
    return intern(std::string(1, c));
  }

  void directive(LineReader& reader) {
    const int column = reader.column();
    reader.take("#");
    const std::string word(reader.name());
    if (word == "define") {
      const int place = (reader.skipSpace(), reader.column());
      const std::string name(reader.name());
      if (name.empty()) failAt(reader, "unexpected " + found(reader) + ", expected a name");
      if (name == "age") failAt(reader.line(), place, "'age' is given by the plant");
      defined_[name] = constant(reader);
    } else if (word == "seed") {
      const double value = constant(reader);
      if (!(value >= 0 && value <= 9007199254740992.0) || value != std::floor(value)) {
        failAt(reader.line(), column, "the seed must be a whole number");
      }
      out_.seed = static_cast<std::uint64_t>(value), out_.hasSeed = true;
    } else if (word == "iterations") {
      const double value = constant(reader);
      if (!(value >= 0 && value <= 1000) || value != std::floor(value)) {
        failAt(reader.line(), column, "iterations must be a whole number, 0 to 1000");
      }
      out_.iterations = static_cast<int>(value);
    } else if (word == "ignore") {
      while (const std::optional<Symbol> one = symbol(reader)) {
        out_.ignored.resize(std::max<std::size_t>(out_.ignored.size(), *one + 1u), 0);
        out_.ignored[*one] = 1;
      }
    } else {
      failAt(reader.line(), column, "unknown directive '#" + word + "'");
    }
    if (!reader.atEnd()) failAt(reader, "unexpected " + found(reader));
  }

  double constant(LineReader& reader) {
    const Expression expression = readExpression(reader, {}, defined_);
    double value = 0;
    if (!expression.evaluate(nullptr, value)) failAt(expression.line, expression.column, "division by zero");
    if (!std::isfinite(value)) failAt(expression.line, expression.column, "this is no number");
    return value;
  }

  PatternModule pattern(LineReader& reader, Parameters& parameters) {
    const int column = (reader.skipSpace(), reader.column());
    const std::optional<Symbol> one = symbol(reader);
    if (!one) failAt(reader, "unexpected " + found(reader) + ", expected a module");
    PatternModule module;
    module.symbol = *one;
    module.first = static_cast<int>(parameters.size());
    if (out_.names[*one] == "[" || out_.names[*one] == "]") failAt(reader.line(), column, "brackets have no rules");
    if (reader.ahead(0) != '(') return module;
    const int open = reader.column();
    reader.advance();
    do {
      const int place = (reader.skipSpace(), reader.column());
      const std::string name(reader.name());
      if (name.empty())
        failAt(reader, reader.atEnd() ? "'(' is never closed"
                                      : "unexpected " + found(reader) + ", expected a parameter's name");
      if (std::find(parameters.begin(), parameters.end(), name) != parameters.end()) {
        failAt(reader.line(), place, "the parameter '" + name + "' is named twice");
      }
      parameters.push_back(name);
      ++module.parameters;
    } while (reader.take(","));
    if (parameters.size() > kMostParameters) failAt(reader.line(), open, "a rule has at most 64 parameters");
    if (!reader.take(")")) failAt(reader.line(), open, "'(' is never closed");
    return module;
  }

  bool atArrow(LineReader& reader) { return reader.peek() == '-' && reader.ahead(1) == '>'; }

  std::vector<PatternModule> patterns(LineReader& reader, Parameters& parameters) {
    std::vector<PatternModule> all;
    for (char c = reader.peek(); c != '\0' && c != '<' && c != '>' && c != ':' && c != ';' && !atArrow(reader);
         c = reader.peek()) {
      all.push_back(pattern(reader, parameters));
    }
    return all;
  }

  void rule(LineReader& reader) {
    if (out_.rules.size() >= kMostRules) failAt(reader, "there are more than 1,000 rules");
    Rule made;
    made.line = reader.line();
    Parameters parameters;
    const int column = (reader.skipSpace(), reader.column());
    if (!reader.holds("->")) failAt(reader.line(), column, "expected '->'");
    std::vector<PatternModule> self = patterns(reader, parameters);
    if (reader.peek() == '<') {
      if (self.empty()) failAt(reader, "there is nothing before '<'");
      reader.advance();
      made.left = std::move(self);
      self = patterns(reader, parameters);
    }
    if (reader.peek() == '>') {
      reader.advance();
      made.right = patterns(reader, parameters);
      if (made.right.empty()) failAt(reader, "there is nothing behind '>'");
    }
    if (self.empty()) failAt(reader, "unexpected " + found(reader) + ", expected a module");
    if (self.size() > 1)
      failAt(reader.line(), column, "a rule rewrites one module; contexts stand before '<' and behind '>'");
    made.self = self[0];
    if (reader.take(":")) made.condition = readExpression(reader, parameters, defined_);
    if (reader.take(";")) {
      made.weight = readExpression(reader, parameters, defined_);
      double value = 0;
      const bool fixed =
          std::none_of(made.weight.steps.begin(), made.weight.steps.end(),
                       [](const Expression::Step& step) { return step.code == Expression::Code::Parameter; });
      if (fixed && (!made.weight.evaluate(nullptr, value) || !(value > 0))) {
        failAt(made.weight.line, made.weight.column, "the weight must be above 0");
      }
    }
    if (!reader.take("->")) failAt(reader, "unexpected " + found(reader) + ", expected '->'");
    made.successor = successor(reader, parameters);
    out_.rules.push_back(std::move(made));
  }

  std::vector<SuccessorModule> successor(LineReader& reader, const Parameters& parameters) {
    std::vector<SuccessorModule> modules;
    std::vector<int> open;
    while (!reader.atEnd()) {
      const int column = reader.column();
      const std::optional<Symbol> one = symbol(reader);
      if (!one) failAt(reader, "unexpected " + found(reader) + ", expected a module");
      SuccessorModule module;
      module.symbol = *one;
      const std::string& name = out_.names[*one];
      if (name == "[") open.push_back(column);
      if (name == "]") {
        if (open.empty()) failAt(reader.line(), column, "']' closes nothing");
        open.pop_back();
      }
      if (reader.ahead(0) == '(') {
        const int bracket = reader.column();
        reader.advance();
        do {
          if (reader.atEnd()) failAt(reader.line(), bracket, "'(' is never closed");
          module.parameters.push_back(readExpression(reader, parameters, defined_));
        } while (reader.take(","));
        if (!reader.take(")")) {
          if (reader.atEnd()) failAt(reader.line(), bracket, "'(' is never closed");
          failAt(reader, "unexpected " + found(reader) + ", expected ',' or ')'");
        }
        if (module.parameters.size() > kMostParameters)
          failAt(reader.line(), bracket, "a module has at most 64 parameters");
      }
      modules.push_back(std::move(module));
    }
    if (!open.empty()) failAt(reader.line(), open.back(), "'[' is never closed");
    return modules;
  }

  LSystem out_;
  Names defined_;
  bool hasAxiom_ = false;
};

}  // namespace

Symbol LSystem::find(std::string_view name) const {
  return static_cast<Symbol>(std::find(names.begin(), names.end(), name) - names.begin());
}

Parsed parseRules(std::string_view text, double age) {
  Parsed parsed;
  if (text.size() > kLongestRules) {
    parsed.errors.emplace_back(1, 1, "the rules are longer than 64 KB");
    return parsed;
  }
  Parser parser(age);
  int line = 0;
  constexpr std::size_t kMostErrors = 20;
  for (std::size_t from = 0; from <= text.size() && parsed.errors.size() < kMostErrors;) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    ++line;
    try {
      parser.readLine(text.substr(from, end - from), line);
    } catch (const ParseFailure& failure) {
      parsed.errors.push_back(failure.error);
    }
    from = end + 1;
  }
  if (!parsed.errors.empty()) return parsed;
  try {
    parsed.system = parser.finish(line);
  } catch (const ParseFailure& failure) {
    parsed.errors.push_back(failure.error);
  }
  return parsed;
}

}  // namespace windfall::model::growth
