// Reads rules: one line after the other, with the place of every error.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "model/plant/grow/lsystem.h"

namespace windfall::model::growth {

/// The characters of one line, without its comment.
class LineReader {
 public:
  LineReader(std::string_view text, int line) : text_(text), line_(line) {}

  int line() const { return line_; }
  int column() const { return static_cast<int>(place_) + 1; }
  void skipSpace();
  /// After white space.
  bool atEnd();
  char peek();
  /// Whether it stands anywhere in what is left.
  bool holds(std::string_view word) const { return text_.substr(place_).find(word) != std::string_view::npos; }
  char ahead(std::size_t count) const { return place_ + count < text_.size() ? text_[place_ + count] : '\0'; }
  void advance(std::size_t count = 1) { place_ += count; }
  bool take(std::string_view word);
  /// A name of letters, digits and '_' that begins with a letter; empty where there is none.
  std::string_view name();
  std::optional<double> number();

 private:
  std::string_view text_;
  int line_;
  std::size_t place_ = 0;
};

/// Thrown inside the parser only.
struct ParseFailure {
  RuleError error;
};
[[noreturn]] void failAt(const LineReader& reader, const std::string& message);
[[noreturn]] void failAt(int line, int column, const std::string& message);
/// "'x'", or "the end of the line".
std::string found(LineReader& reader);

using Names = std::map<std::string, double, std::less<>>;
using Parameters = std::vector<std::string>;

/// expr of the grammar; names are the rule's parameters, then defined ones.
Expression readExpression(LineReader& reader, const Parameters& parameters, const Names& defined);

}  // namespace windfall::model::growth
