#include <cmath>

#include "model/plant/grow/lsystem.h"

namespace windfall::model::growth {

RuleError::RuleError(int atLine, int atColumn, std::string_view what) : line(atLine), column(atColumn), message(what) {}

bool Expression::evaluate(const double* parameters, double& value) const {
  std::array<double, kDeepestExpression + 1> stack;
  std::size_t top = 0;
  for (const Step& step : steps) {
    double& a = stack[top >= 2 ? top - 2 : 0];
    double& b = stack[top >= 1 ? top - 1 : 0];
    switch (step.code) {
      case Code::Number:
        stack[top++] = step.value;
        break;
      case Code::Parameter:
        stack[top++] = parameters[static_cast<std::size_t>(step.value)];
        break;
      case Code::Add:
        a += b, --top;
        break;
      case Code::Subtract:
        a -= b, --top;
        break;
      case Code::Multiply:
        a *= b, --top;
        break;
      case Code::Divide:
        if (b == 0) return false;
        a /= b, --top;
        break;
      case Code::Power:
        a = std::pow(a, b), --top;
        break;
      case Code::Negate:
        b = -b;
        break;
      case Code::Less:
        a = a < b, --top;
        break;
      case Code::LessEqual:
        a = a <= b, --top;
        break;
      case Code::Greater:
        a = a > b, --top;
        break;
      case Code::GreaterEqual:
        a = a >= b, --top;
        break;
      case Code::Equal:
        a = a == b, --top;
        break;
      case Code::Unequal:
        a = a != b, --top;
        break;
      case Code::And:
        a = a != 0 && b != 0, --top;
        break;
      case Code::Or:
        a = a != 0 || b != 0, --top;
        break;
      case Code::Sin:
        b = std::sin(b);
        break;
      case Code::Cos:
        b = std::cos(b);
        break;
      case Code::Exp:
        b = std::exp(b);
        break;
      case Code::Log:
        b = std::log(b);
        break;
      case Code::Sqrt:
        b = std::sqrt(b);
        break;
      case Code::Floor:
        b = std::floor(b);
        break;
      case Code::Abs:
        b = std::abs(b);
        break;
      case Code::Min:
        a = std::min(a, b), --top;
        break;
      case Code::Max:
        a = std::max(a, b), --top;
        break;
    }
  }
  value = stack[0];
  return true;
}

}  // namespace windfall::model::growth
