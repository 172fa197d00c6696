#include <charconv>
#include <cstdlib>

#include "model/plant/grow/lsystem_parser.h"

namespace windfall::model::growth {

namespace {

using Code = Expression::Code;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// Recursive descent over expr; depth is bounded so that hostile text cannot exhaust the stack.
class ExpressionReader {
 public:
  ExpressionReader(LineReader& reader, const Parameters& parameters, const Names& defined)
      : reader_(reader), parameters_(parameters), defined_(defined) {}

  Expression read() {
    reader_.skipSpace();
    out_.line = reader_.line(), out_.column = reader_.column();
    any();
    return std::move(out_);
  }

 private:
  void push(Code code, double value = 0) {
    const bool pushes = code == Code::Number || code == Code::Parameter;
    const bool keeps = code == Code::Negate || (code >= Code::Sin && code <= Code::Abs);
    height_ += pushes ? 1 : keeps ? 0 : -1;
    if (height_ > kDeepestExpression) failAt(reader_, "the expression is nested too deeply");
    out_.steps.push_back({code, value});
  }
  struct Depth {
    explicit Depth(ExpressionReader& owner) : owner_(owner) {
      if (++owner_.nested_ > kDeepestExpression) failAt(owner_.reader_, "the expression is nested too deeply");
    }
    ~Depth() { --owner_.nested_; }
    ExpressionReader& owner_;
  };

  bool word(std::string_view text) {
    reader_.skipSpace();
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (reader_.ahead(i) != text[i]) return false;
    }
    const char after = reader_.ahead(text.size());
    if (isLetter(after) || isDigit(after) || after == '_') return false;
    reader_.advance(text.size());
    return true;
  }
  void any() {
    const Depth depth(*this);
    both();
    while (word("or")) both(), push(Code::Or);
  }
  void both() {
    comparison();
    while (word("and")) comparison(), push(Code::And);
  }
  void comparison() {
    sum();
    static const std::pair<std::string_view, Code> kSigns[] = {{"<=", Code::LessEqual}, {">=", Code::GreaterEqual},
                                                               {"==", Code::Equal},     {"!=", Code::Unequal},
                                                               {"<", Code::Less},       {">", Code::Greater}};
    for (const auto& [sign, code] : kSigns) {
      if (!reader_.take(sign)) continue;
      sum();
      push(code);
      return;
    }
  }
  void sum() {
    product();
    for (;;) {
      const char sign = reader_.peek();
      // "->" ends the expression.
      if ((sign != '+' && sign != '-') || (sign == '-' && reader_.ahead(1) == '>')) return;
      reader_.advance();
      product();
      push(sign == '+' ? Code::Add : Code::Subtract);
    }
  }
  void product() {
    unary();
    for (;;) {
      const char sign = reader_.peek();
      if ((sign != '*' && sign != '/') || (sign == '*' && reader_.ahead(1) == '*')) return;
      const int column = reader_.column();
      reader_.advance();
      const std::size_t before = out_.steps.size();
      unary();
      if (sign == '/' && out_.steps.size() == before + 1 && out_.steps.back().code == Code::Number &&
          out_.steps.back().value == 0) {
        failAt(reader_.line(), column, "division by zero");
      }
      push(sign == '*' ? Code::Multiply : Code::Divide);
    }
  }
  void unary() {
    const Depth depth(*this);
    if (reader_.peek() == '-' && reader_.ahead(1) != '>') {
      reader_.advance();
      unary();
      push(Code::Negate);
      return;
    }
    atom();
    if (reader_.peek() == '*' && reader_.ahead(1) == '*') {
      reader_.advance(2);
      unary();
      push(Code::Power);
    }
  }
  void atom() {
    if (const std::optional<double> value = reader_.number()) {
      push(Code::Number, *value);
      return;
    }
    const int column = (reader_.skipSpace(), reader_.column());
    if (reader_.peek() == '(') {
      reader_.advance();
      any();
      if (!reader_.take(")")) failAt(reader_.line(), column, "'(' is never closed");
      return;
    }
    const std::string_view name = reader_.name();
    if (name.empty()) failAt(reader_, "unexpected " + found(reader_) + ", expected a number or a name");
    if (reader_.peek() == '(') {
      call(name, column);
      return;
    }
    for (std::size_t i = parameters_.size(); i-- > 0;) {
      if (parameters_[i] == name) {
        push(Code::Parameter, static_cast<double>(i));
        return;
      }
    }
    const auto known = defined_.find(name);
    if (known == defined_.end()) failAt(reader_.line(), column, "unknown name '" + std::string(name) + "'");
    push(Code::Number, known->second);
  }
  void call(std::string_view name, int column) {
    struct Function {
      std::string_view name;
      int arguments;
      Code code;
    };
    static const Function kFunctions[] = {{"sin", 1, Code::Sin},   {"cos", 1, Code::Cos},   {"exp", 1, Code::Exp},
                                          {"log", 1, Code::Log},   {"sqrt", 1, Code::Sqrt}, {"floor", 1, Code::Floor},
                                          {"pow", 2, Code::Power}, {"min", 2, Code::Min},   {"max", 2, Code::Max},
                                          {"abs", 1, Code::Abs}};
    for (const Function& function : kFunctions) {
      if (function.name != name) continue;
      const int open = reader_.column();
      reader_.take("(");
      int count = 0;
      do {
        any(), ++count;
      } while (reader_.take(","));
      if (!reader_.take(")")) failAt(reader_.line(), open, "'(' is never closed");
      if (count != function.arguments) {
        failAt(reader_.line(), column,
               "'" + std::string(name) + "' takes " + std::to_string(function.arguments) +
                   (function.arguments == 1 ? " argument, not " : " arguments, not ") + std::to_string(count));
      }
      push(function.code);
      return;
    }
    failAt(reader_.line(), column, "unknown function '" + std::string(name) + "'");
  }

  LineReader& reader_;
  const Parameters& parameters_;
  const Names& defined_;
  Expression out_;
  int height_ = 0, nested_ = 0;
};

}  // namespace

void failAt(int line, int column, const std::string& message) { throw ParseFailure{{line, column, message}}; }
void failAt(const LineReader& reader, const std::string& message) { failAt(reader.line(), reader.column(), message); }

std::string found(LineReader& reader) {
  return reader.atEnd() ? "end of the line" : "'" + std::string(1, reader.peek()) + "'";
}

void LineReader::skipSpace() {
  while (place_ < text_.size() && (text_[place_] == ' ' || text_[place_] == '\t' || text_[place_] == '\r')) ++place_;
}
bool LineReader::atEnd() {
  skipSpace();
  return place_ >= text_.size();
}
char LineReader::peek() {
  skipSpace();
  return ahead(0);
}
bool LineReader::take(std::string_view word) {
  skipSpace();
  if (text_.substr(place_, word.size()) != word) return false;
  place_ += word.size();
  return true;
}
std::string_view LineReader::name() {
  skipSpace();
  if (!isLetter(ahead(0))) return {};
  const std::size_t from = place_;
  while (isLetter(ahead(0)) || isDigit(ahead(0)) || ahead(0) == '_') ++place_;
  return text_.substr(from, place_ - from);
}
std::optional<double> LineReader::number() {
  skipSpace();
  if (!isDigit(ahead(0)) && !(ahead(0) == '.' && isDigit(ahead(1)))) return {};
  double value = 0;
  const char* begin = text_.data() + place_;
  const auto [end, problem] = std::from_chars(begin, text_.data() + text_.size(), value);
  if (problem != std::errc()) failAt(*this, "this number is too large");
  place_ += static_cast<std::size_t>(end - begin);
  return value;
}

Expression readExpression(LineReader& reader, const Parameters& parameters, const Names& defined) {
  return ExpressionReader(reader, parameters, defined).read();
}

}  // namespace windfall::model::growth
