#include "gcode/blocks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/numbers.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr int kMostNested = 100;
constexpr int kMostSteps = 20000;  // of a pattern
constexpr std::size_t kLongestPattern = 200;
constexpr double kMost = 1e9;
constexpr int kDigits = 5;  // of numbers that are no whole ones

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

struct Term {
  enum Kind { Number, Truth, Text } kind = Number;
  double number = 0;  ///< a truth is 0 or 1
  bool whole = true;
  std::string text;  ///< of a number: as it is written, where nothing was reckoned with it
};

Term truth(bool value) { return {Term::Truth, value ? 1.0 : 0.0, true, {}}; }

Term termOf(const FoundValue& value) {
  const std::string& text = value.text;
  if (text == "true" || text == "false") return truth(text == "true");
  double number = 0;
  if (!text.empty() && readNumber(text, number) == text.size()) {
    return {Term::Number, number, value.whole && text.find('.') == std::string::npos, text};
  }
  return {Term::Text, 0, false, text};
}

// Operators by how tightly they bind, the loosest first.
constexpr int kOr = 0, kAnd = 1, kEqual = 2, kLess = 3, kPlus = 4, kTimes = 5;
struct Operator {
  std::string_view sign;
  int binds;
};
// What begins with another one stands before it.
constexpr Operator kOperators[] = {{"||", kOr},    {"or", kOr},    {"&&", kAnd},   {"and", kAnd},  {"==", kEqual},
                                   {"!=", kEqual}, {"<>", kEqual}, {"=~", kEqual}, {"!~", kEqual}, {"<=", kLess},
                                   {">=", kLess},  {"<", kLess},   {">", kLess},   {"+", kPlus},   {"-", kPlus},
                                   {"*", kTimes},  {"/", kTimes},  {"%", kTimes}};

std::string shown(const Term& term) {
  if (term.kind == Term::Text || !term.text.empty()) return term.text;
  if (term.kind == Term::Truth) return term.number != 0 ? "true" : "false";
  return decimal(term.number, kDigits);
}

// As texts two terms are compared of which one is a text. Settings that are true or false stand in files as 1 and 0.
std::string asTextBeside(const Term& other, const Term& term) {
  const bool answer = other.kind == Term::Text && (other.text == "true" || other.text == "false");
  const bool flag = term.kind == Term::Number && (term.number == 0 || term.number == 1);
  return answer && flag ? shown(truth(term.number != 0)) : shown(term);
}

class Evaluation {
 public:
  Evaluation(std::string_view text, const std::vector<TemplateValue>& values) : rest_(text), values_(values) {}

  std::optional<std::string> all() {
    const Term term = conditional();
    skip();
    if (failed_ || !rest_.empty() || !(std::abs(term.number) < kMost)) return std::nullopt;
    return shown(term);
  }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

  bool takes(std::string_view sign) {
    skip();
    if (!rest_.starts_with(sign) || (sign == "<" && rest_.starts_with("<>"))) return false;
    const bool word = isLetter(sign[0]);
    if (word && rest_.size() > sign.size() && (isLetter(rest_[sign.size()]) || isDigit(rest_[sign.size()])))
      return false;
    rest_.remove_prefix(sign.size());
    return true;
  }

  Term fail() {
    failed_ = true;
    rest_ = {};
    return {};
  }

  Term conditional() {
    if (++nested_ > kMostNested) return fail();
    Term condition = binary(kOr);
    if (takes("?")) {
      const bool yes = condition.number != 0;
      Term first = unread(!yes, [&] { return conditional(); });
      if (!takes(":")) return fail();
      Term second = unread(yes, [&] { return conditional(); });
      condition = yes ? std::move(first) : std::move(second);
    }
    --nested_;
    return condition;
  }

  // What does not count need not have a value.
  template <class Read>
  Term unread(bool skipped, Read&& read) {
    skipped_ += skipped ? 1 : 0;
    Term term = read();
    skipped_ -= skipped ? 1 : 0;
    return term;
  }

  Term binary(int binds) {
    if (binds > kTimes) return unary();
    Term left = binary(binds + 1);
    while (!failed_) {
      const auto* sign = std::find_if(std::begin(kOperators), std::end(kOperators), [&](const Operator& candidate) {
        return candidate.binds == binds && takes(candidate.sign);
      });
      if (sign == std::end(kOperators)) break;
      if (sign->sign == "=~" || sign->sign == "!~") {
        const bool found = matches(left.text);
        left = truth(found == (sign->sign == "=~"));
        continue;
      }
      const bool known = (binds == kOr && left.number != 0) || (binds == kAnd && left.number == 0);
      const Term right = unread(known, [&] { return binary(binds + 1); });
      left = applied(sign->sign, left, right);
    }
    return left;
  }

  // A regular expression of signs, points, .* and (one|two).
  bool matches(std::string_view text) {
    skip();
    const std::size_t end = rest_.starts_with('/') ? rest_.find('/', 1) : std::string_view::npos;
    if (end == std::string_view::npos) return fail(), false;
    const std::string_view pattern = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    int steps = pattern.size() <= kLongestPattern ? 0 : kMostSteps;
    const bool found = fits(pattern, text, steps);
    if (steps >= kMostSteps) fail();
    return found;
  }

  // \param steps  kMostSteps: it takes too many, or is another kind of pattern.
  static bool fits(std::string_view pattern, std::string_view text, int& steps) {
    if (++steps >= kMostSteps) return false;
    if (pattern.empty()) return text.empty();
    if (pattern.starts_with(".*")) {
      for (std::size_t k = 0; k <= text.size() && steps < kMostSteps; ++k) {
        if (fits(pattern.substr(2), text.substr(k), steps)) return true;
      }
      return false;
    }
    const char sign = pattern[0];
    if (sign == '(') {
      const std::size_t close = pattern.find(')');
      if (close == std::string_view::npos) return steps = kMostSteps, false;
      std::string_view ways = pattern.substr(1, close - 1);
      for (bool more = true; more && steps < kMostSteps;) {
        const std::size_t bar = ways.find('|');
        if (fits(std::string(ways.substr(0, bar)).append(pattern.substr(close + 1)), text, steps)) return true;
        more = bar != std::string_view::npos;
        ways.remove_prefix(more ? bar + 1 : ways.size());
      }
      return false;
    }
    const bool special = std::string_view("\\*+?)[]{}|^$").find(sign) != std::string_view::npos;
    const bool repeated = pattern.size() > 1 && std::string_view("*+?{").find(pattern[1]) != std::string_view::npos;
    if (special || repeated) return steps = kMostSteps, false;
    if (text.empty() || (sign != '.' && sign != text[0])) return false;
    return fits(pattern.substr(1), text.substr(1), steps);
  }

  Term applied(std::string_view sign, const Term& a, const Term& b) {
    if (sign == "||" || sign == "or") return truth(a.number != 0 || b.number != 0);
    if (sign == "&&" || sign == "and") return truth(a.number != 0 && b.number != 0);
    if (sign == "==" || sign == "!=" || sign == "<>") {
      const bool text = a.kind == Term::Text || b.kind == Term::Text;
      return truth((text ? asTextBeside(b, a) == asTextBeside(a, b) : a.number == b.number) == (sign == "=="));
    }
    if (sign == "+" && (a.kind == Term::Text || b.kind == Term::Text)) {
      return {Term::Text, 0, false, shown(a) + shown(b)};
    }
    if (skipped_ == 0 && (a.kind == Term::Text || b.kind == Term::Text)) return fail();
    if (sign == "<") return truth(a.number < b.number);
    if (sign == ">") return truth(a.number > b.number);
    if (sign == "<=") return truth(a.number <= b.number);
    if (sign == ">=") return truth(a.number >= b.number);
    const bool whole = a.whole && b.whole;
    if (sign == "+") return {Term::Number, a.number + b.number, whole, {}};
    if (sign == "-") return {Term::Number, a.number - b.number, whole, {}};
    if (sign == "*") return {Term::Number, a.number * b.number, whole, {}};
    if (b.number == 0) return skipped_ > 0 ? Term{} : fail();
    if (sign == "%") return {Term::Number, std::fmod(a.number, b.number), whole, {}};
    const double quotient = a.number / b.number;
    return {Term::Number, whole ? std::trunc(quotient) : quotient, whole, {}};
  }

  Term unary() {
    if (++nested_ > kMostNested) return fail();
    Term term;
    if (takes("-")) {
      term = unary();
      term = {Term::Number, -term.number, term.whole, {}};
    } else if (takes("+")) {
      term = unary();
    } else if (takes("not") || takes("!")) {
      term = truth(unary().number == 0);
    } else {
      term = primary();
    }
    --nested_;
    return term;
  }

  Term primary() {
    skip();
    if (takes("(")) {
      Term term = conditional();
      return takes(")") ? term : fail();
    }
    if (rest_.empty()) return fail();
    if (rest_[0] == '"') {
      const std::size_t end = rest_.find('"', 1);
      if (end == std::string_view::npos) return fail();
      Term term{Term::Text, 0, false, std::string(rest_.substr(1, end - 1))};
      rest_.remove_prefix(end + 1);
      return term;
    }
    if (isDigit(rest_[0]) || rest_[0] == '.') {
      double number = 0;
      const std::size_t size = readNumber(rest_, number);
      if (size == 0) return fail();
      const bool whole = rest_.substr(0, size).find('.') == std::string_view::npos;
      rest_.remove_prefix(size);
      return {Term::Number, number, whole, {}};
    }
    std::size_t size = 0;
    while (size < rest_.size() && (isLetter(rest_[size]) || isDigit(rest_[size]))) ++size;
    if (size == 0) return fail();
    const std::string_view name = rest_.substr(0, size);
    rest_.remove_prefix(size);
    if (name == "true" || name == "false") return truth(name == "true");
    if (takes("(")) return called(name);
    double index = 0;
    if (takes("[")) {
      index = conditional().number;
      if (!takes("]")) return fail();
    }
    const std::optional<FoundValue> value =
        index >= 0 && index < 1000 ? templateValue(name, static_cast<std::size_t>(index), values_) : std::nullopt;
    if (value) return termOf(*value);
    return skipped_ > 0 ? Term{} : fail();
  }

  Term called(std::string_view name) {
    std::vector<Term> arguments;
    do {
      arguments.push_back(conditional());
      if (skipped_ == 0 && arguments.back().kind == Term::Text) return fail();
    } while (!failed_ && takes(","));
    if (!takes(")")) return fail();
    Term& first = arguments.front();
    if ((name == "min" || name == "max") && arguments.size() == 2) {
      const Term& other = arguments.back();
      const bool whole = first.whole && other.whole;
      return {Term::Number,
              name == "min" ? std::min(first.number, other.number) : std::max(first.number, other.number),
              whole,
              {}};
    }
    if (name == "random" && arguments.size() == 2) return first;  // any between the two will do; always the same
    if ((name == "digits" || name == "zdigits") && (arguments.size() == 2 || arguments.size() == 3)) {
      return padded(arguments, name == "zdigits" ? '0' : ' ');
    }
    if (arguments.size() != 1 || (name != "int" && name != "round")) return fail();
    return {Term::Number, name == "int" ? std::trunc(first.number) : std::round(first.number), true, {}};
  }

  // digits(value, signs at least, digits behind the point)
  Term padded(const std::vector<Term>& arguments, char filler) {
    const double width = arguments[1].number;
    const double decimals = arguments.size() == 3 ? arguments[2].number : 0;
    if (!(width >= 0 && width <= 20 && decimals >= 0 && decimals <= 6)) return fail();
    std::string text = fixed(arguments[0].number, static_cast<int>(decimals));
    const std::size_t at = filler == '0' && text.starts_with('-') ? 1 : 0;
    const auto least = static_cast<std::size_t>(width);
    if (text.size() < least) text.insert(at, least - text.size(), filler);
    return {Term::Text, 0, false, text};
  }

  std::string_view rest_;
  const std::vector<TemplateValue>& values_;
  int nested_ = 0;
  int skipped_ = 0;  // parts around this one that do not count
  bool failed_ = false;
};

}  // namespace

std::optional<FoundValue> templateValue(std::string_view name, std::size_t index,
                                        const std::vector<TemplateValue>& values) {
  const auto find = [&](std::string_view wanted) {
    return std::find_if(values.begin(), values.end(), [&](const TemplateValue& value) {
      return std::find(value.names.begin(), value.names.end(), wanted) != value.names.end();
    });
  };
  auto found = find(name);
  // first_layer_temperature_0
  const std::size_t line = name.rfind('_');
  if (found == values.end() && line != std::string_view::npos && line + 2 == name.size() && isDigit(name.back())) {
    index = static_cast<std::size_t>(name.back() - '0');
    found = find(name.substr(0, line));
  }
  if (found == values.end() || index >= found->values.size()) return std::nullopt;
  return FoundValue{found->values[index], found->whole};
}

std::optional<std::string> evaluated(std::string_view expression, const std::vector<TemplateValue>& values) {
  return Evaluation(expression, values).all();
}

}  // namespace sillon
