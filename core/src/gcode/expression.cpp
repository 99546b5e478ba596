#include "gcode/blocks.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/numbers.hpp"
#include "gcode_reader/parser.hpp"

namespace sillon {
namespace {

constexpr int kMostNested = 100;
constexpr int kMostSteps = 20000;  // steps that matching one pattern may take; each step scans the whole text
constexpr std::size_t kLongestPattern = 200;
constexpr std::size_t kLongestMatched = 5000;
constexpr double kMostItems = 1000;  // items that a list may have
constexpr double kMost = 1e9;
constexpr int kDigits = 5;  // decimals of a number that is no integer

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

// A value in an expression.
struct Term {
  enum Kind { Number, Truth, Text, Nil } kind = Number;
  double number = 0;  ///< value; 0 or 1 for a truth
  bool whole = true;
  std::string text;  ///< text; for a number, its spelling as long as nothing was calculated with it
};

Term truth(bool value) { return {Term::Truth, value ? 1.0 : 0.0, true, {}}; }
Term number(double value, bool whole) { return {Term::Number, value, whole, {}}; }
Term words(std::string text) { return {Term::Text, 0, false, std::move(text)}; }

// Reads the text of a placeholder as a truth, a number or a text.
Term termOf(const FoundValue& value) {
  const std::string& text = value.text;
  if (text == "true" || text == "false") return truth(text == "true");
  double read = 0;
  if (!text.empty() && readNumber(text, read) == text.size()) {
    return {Term::Number, read, value.whole && text.find('.') == std::string::npos, text};
  }
  return words(text);
}

// Precedence of the operators, the loosest first.
constexpr int kOr = 0, kAnd = 1, kEqual = 2, kLess = 3, kPlus = 4, kTimes = 5;
struct Operator {
  std::string_view sign;
  int binds;
};
// Order of the list: an operator stands before every other one that it begins with, such as "<=" before "<".
constexpr Operator kOperators[] = {{"||", kOr},    {"or", kOr},    {"&&", kAnd},   {"and", kAnd},  {"==", kEqual},
                                   {"!=", kEqual}, {"<>", kEqual}, {"=~", kEqual}, {"!~", kEqual}, {"<=", kLess},
                                   {">=", kLess},  {"<", kLess},   {">", kLess},   {"+", kPlus},   {"-", kPlus},
                                   {"*", kTimes},  {"/", kTimes},  {"%", kTimes}};

// Spelling of a term in the output.
std::string shown(const Term& term) {
  if (term.kind == Term::Text || !term.text.empty()) return term.text;
  if (term.kind == Term::Truth) return term.number != 0 ? "true" : "false";
  return decimal(term.number, kDigits);
}

// Spelling of a term when it is compared with a text. Settings that are true or false stand in files as 1 and 0, so
// beside "true" or "false" these two become truths.
std::string asTextBeside(const Term& other, const Term& term) {
  const bool answer = other.kind == Term::Text && (other.text == "true" || other.text == "false");
  const bool flag = term.kind == Term::Number && (term.number == 0 || term.number == 1);
  return answer && flag ? shown(truth(term.number != 0)) : shown(term);
}

// A regular expression with characters, sets, groups, alternatives and the quantifiers * + ?. It tracks all places of
// the text at once, as a nondeterministic automaton does, so that no pattern takes exponential time.
class Pattern {
 public:
  Pattern(std::string_view pattern, std::string_view text) : rest_(pattern), text_(text) {}

  /// Matches the whole text. \return nothing if the pattern or the text is too long, or the pattern uses other syntax.
  std::optional<bool> fits() {
    if (rest_.size() > kLongestPattern || text_.size() > kLongestMatched) return std::nullopt;
    takes('^');
    if (rest_.ends_with('$') && !rest_.ends_with("\\$")) rest_.remove_suffix(1);
    Places begin(text_.size() + 1, 0);
    begin[0] = 1;
    const bool found = anyOf(begin).back() != 0;
    return failed_ || !rest_.empty() ? std::nullopt : std::optional(found);
  }

 private:
  // Flags before each character and at the end: 1 where a match may have arrived.
  using Places = std::vector<char>;

  bool takes(char sign) {
    if (!rest_.starts_with(sign)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  // Adds places to a set. \return true if any was new.
  static bool grows(Places& by, const Places& more) {
    bool grew = false;
    for (std::size_t k = 0; k < by.size(); ++k) {
      grew = grew || more[k] > by[k];
      by[k] |= more[k];
    }
    return grew;
  }

  // Matches alternatives up to a closing bracket or the end.
  Places anyOf(const Places& from) {
    Places out(from.size(), 0);
    do {
      Places way = from;
      while (!failed_ && !rest_.empty() && rest_[0] != '|' && rest_[0] != ')') way = repeated(way);
      grows(out, way);
    } while (takes('|'));
    return out;
  }

  // Matches one item with its quantifier.
  Places repeated(const Places& from) {
    const std::string_view begin = rest_;
    Places out = once(from);
    const bool any = takes('*');
    if (any || takes('+')) {
      const std::string_view end = rest_;
      for (Places more = out; !failed_;) {
        rest_ = begin;
        more = once(more);
        if (!grows(out, more)) break;
      }
      rest_ = end;
    }
    if (any || takes('?')) grows(out, from);
    return out;
  }

  // Matches one character, set or group.
  Places once(const Places& from) {
    steps_ += 1 + static_cast<int>(from.size() / 64);
    failed_ = failed_ || steps_ > kMostSteps;
    if (failed_) return from;
    if (takes('(')) {
      Places inside = anyOf(from);
      failed_ = failed_ || !takes(')');
      return inside;
    }
    Set set;
    failed_ = std::string_view("*+?{}^$").find(rest_[0]) != std::string_view::npos;
    if (takes('.')) {
      set.set();
    } else if (takes('[')) {
      const bool other = takes('^');
      do {
        const int low = character(set);
        if (rest_.size() < 2 || rest_[1] == ']' || !takes('-')) continue;
        for (int c = character(set); c > low; --c) set.set(c);
      } while (!failed_ && !takes(']'));
      if (other) set.flip();
    } else {
      character(set);
    }
    Places out(from.size(), 0);
    for (std::size_t k = 0; k < text_.size(); ++k) {
      out[k + 1] = from[k] != 0 && set[static_cast<unsigned char>(text_[k])] ? 1 : 0;
    }
    return out;
  }

  using Set = std::bitset<256>;

  // Reads one character or class (\d, \w, \s) into a set. \return the character, 0 for a class.
  int character(Set& set) {
    const bool special = takes('\\');
    if (rest_.empty()) return failed_ = true, 0;
    const auto sign = static_cast<unsigned char>(rest_[0]);
    rest_.remove_prefix(1);
    if (!special || !(isLetter(static_cast<char>(sign)) || isDigit(static_cast<char>(sign)))) {
      set.set(sign);
      return sign;
    }
    failed_ = failed_ || (sign != 'd' && sign != 'w' && sign != 's');
    for (int c = 0; c < 128; ++c) {
      const char one = static_cast<char>(c);
      const bool blank = one == ' ' || (one >= '\t' && one <= '\r');
      if (sign == 's' ? blank : isDigit(one) || (sign == 'w' && isLetter(one))) set.set(c);
    }
    return 0;
  }

  std::string_view rest_;
  std::string_view text_;
  int steps_ = 0;
  bool failed_ = false;
};

// A recursive descent parser that evaluates an expression or an assignment while it reads.
class Evaluation {
 public:
  Evaluation(std::string_view text, const std::vector<TemplateValue>& values, std::vector<TemplateValue>& own)
      : rest_(text), values_(values), own_(own) {}

  // Evaluates one expression, and takes it off the text.
  std::optional<std::string> all(std::string_view& text) {
    const Term term = conditional();
    skip();
    text = rest_;
    if (failed_ || term.kind == Term::Nil || !(std::abs(term.number) < kMost)) return std::nullopt;
    return shown(term);
  }

  // Runs an assignment to a variable of the block, which shows nothing. \return false if the text is none.
  bool assigns(std::string_view& text) {
    const bool fresh = takes("local") || takes("global");
    const std::string_view name = word();
    const auto old =
        std::find_if(own_.begin(), own_.end(), [&](const TemplateValue& value) { return value.names.front() == name; });
    double index = -1;
    if (!fresh && takes("[")) {
      index = conditional().number;
      if (!takes("]")) return false;
    }
    skip();
    if (name.empty() || (!fresh && old == own_.end()) || rest_.starts_with("==") || !takes("=")) return false;
    TemplateValue made{{name}, {}};
    items(made);
    skip();
    text = rest_;
    if (failed_) return true;
    if (index >= 0) {  // one item of a list
      failed_ = !(index < static_cast<double>(old->values.size())) || made.values.empty();
      if (failed_) return true;
      old->values[toSize(index)] = made.values.front();
      old->whole = old->whole && made.whole;
    } else if (old != own_.end()) {
      *old = std::move(made);
    } else {
      own_.push_back(std::move(made));
    }
    return true;
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size())); }

  // Takes a sign or a whole word off the text, if it comes next.
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

  // Takes a name off the text; empty if none comes next.
  std::string_view word() {
    skip();
    std::size_t size = 0;
    while (size < rest_.size() && (isLetter(rest_[size]) || (size > 0 && isDigit(rest_[size])))) ++size;
    const std::string_view name = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return name;
  }

  [[nodiscard]] const TemplateValue* variable(std::string_view name) const {
    for (const std::vector<TemplateValue>* list : {&std::as_const(own_), &values_}) {
      for (const TemplateValue& value : *list) {
        if (std::find(value.names.begin(), value.names.end(), name) != value.names.end()) return &value;
      }
    }
    return nullptr;
  }

  void add(TemplateValue& list, const Term& term) {
    if (term.kind == Term::Nil || static_cast<double>(list.values.size()) >= kMostItems) fail();
    list.values.push_back(shown(term));
    list.whole = list.whole && term.whole;
  }

  // Reads the value of an assignment: one item, (several, items), repeat(count, item), or a copy of another list.
  void items(TemplateValue& out) {
    const std::string_view begin = rest_;
    if (takes("repeat")) {
      const std::vector<Term> told = takes("(") ? arguments() : std::vector<Term>{};
      if (told.size() != 2 || !(told[0].number >= 0 && told[0].number <= kMostItems)) return void(fail());
      for (double k = 0; k < std::trunc(told[0].number); ++k) add(out, told[1]);
      return;
    }
    if (takes("(")) {
      for (const Term& term : arguments()) add(out, term);
      if (ends()) return;
    } else if (const TemplateValue* other = variable(word()); other != nullptr && ends()) {
      out.values = other->values;
      out.whole = other->whole;
      return;
    }
    rest_ = begin;
    failed_ = false;
    out.values.clear();
    add(out, conditional());
  }

  // Tells whether a statement can end here.
  bool ends() {
    skip();
    return rest_.empty() || rest_[0] == ';' || rest_[0] == '}' || rest_[0] == 'e';
  }

  // Reads arguments behind an opening bracket, up to the closing one.
  std::vector<Term> arguments() {
    std::vector<Term> out;
    if (takes(")")) return out;
    do out.push_back(conditional());
    while (!failed_ && takes(","));
    if (!takes(")")) fail();
    return out;
  }

  // Reads a ? b : c, or anything that binds more tightly.
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

  // Reads a part of the expression. A skipped part, such as the branch not taken, need not have a value.
  template <class Read>
  Term unread(bool skipped, Read&& read) {
    skipped_ += skipped ? 1 : 0;
    Term term = read();
    skipped_ -= skipped ? 1 : 0;
    return term;
  }

  // Reads operators of one precedence, from left to right; those that bind more tightly are read first.
  Term binary(int binds) {
    if (binds > kTimes) return unary();
    Term left = binary(binds + 1);
    while (!failed_) {
      const auto* sign = std::find_if(std::begin(kOperators), std::end(kOperators), [&](const Operator& candidate) {
        return candidate.binds == binds && takes(candidate.sign);
      });
      if (sign == std::end(kOperators)) break;
      if (sign->sign == "=~" || sign->sign == "!~") {
        const bool found = matches(shown(left));
        left = truth(found == (sign->sign == "=~"));
        continue;
      }
      const bool known = (binds == kOr && left.number != 0) || (binds == kAnd && left.number == 0);
      const Term right = unread(known, [&] { return binary(binds + 1); });
      left = applied(sign->sign, left, right);
    }
    return left;
  }

  // Reads a pattern between slashes or quotes.
  std::string_view pattern() {
    skip();
    const char quote = rest_.empty() ? ' ' : rest_[0];
    std::size_t end = quote == '/' || quote == '"' ? 1 : rest_.size();
    while (end < rest_.size() && rest_[end] != quote) end += rest_[end] == '\\' ? 2 : 1;
    if (end >= rest_.size()) return fail(), std::string_view();
    const std::string_view found = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return found;
  }

  bool matches(const std::string& text) {
    const std::string_view wanted = pattern();
    if (failed_) return false;
    const std::optional<bool> found = Pattern(wanted, text).fits();
    if (!found) fail();
    return found.value_or(false);
  }

  // Applies a binary operator.
  Term applied(std::string_view sign, const Term& a, const Term& b) {
    if (skipped_ == 0 && (a.kind == Term::Nil || b.kind == Term::Nil)) return fail();
    if (sign == "||" || sign == "or") return truth(a.number != 0 || b.number != 0);
    if (sign == "&&" || sign == "and") return truth(a.number != 0 && b.number != 0);
    if (sign == "==" || sign == "!=" || sign == "<>") {
      const bool text = a.kind == Term::Text || b.kind == Term::Text;
      return truth((text ? asTextBeside(b, a) == asTextBeside(a, b) : a.number == b.number) == (sign == "=="));
    }
    if (sign == "+" && (a.kind == Term::Text || b.kind == Term::Text)) {
      return words(shown(a) + shown(b));
    }
    if (a.kind == Term::Text && b.kind == Term::Text && (sign[0] == '<' || sign[0] == '>')) {
      return applied(sign, number(a.text.compare(b.text), true), number(0, true));
    }
    if (skipped_ == 0 && (a.kind == Term::Text || b.kind == Term::Text)) return fail();
    if (sign == "<") return truth(a.number < b.number);
    if (sign == ">") return truth(a.number > b.number);
    if (sign == "<=") return truth(a.number <= b.number);
    if (sign == ">=") return truth(a.number >= b.number);
    const bool whole = a.whole && b.whole;
    if (sign == "+") return number(a.number + b.number, whole);
    if (sign == "-") return number(a.number - b.number, whole);
    if (sign == "*") return number(a.number * b.number, whole);
    if (b.number == 0) return skipped_ > 0 ? Term{} : fail();
    if (sign == "%") return number(std::fmod(a.number, b.number), whole);
    const double quotient = a.number / b.number;
    return number(whole ? std::trunc(quotient) : quotient, whole);
  }

  Term unary() {
    if (++nested_ > kMostNested) return fail();
    Term term;
    if (takes("-")) {
      term = unary();
      if (skipped_ == 0 && (term.kind == Term::Text || term.kind == Term::Nil)) return fail();
      term = number(-term.number, term.whole);
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

  // Reads a bracket, a text, a number, a name or a call.
  Term primary() {
    skip();
    if (takes("(")) {
      Term term = conditional();
      return takes(")") ? term : fail();
    }
    if (rest_.empty()) return fail();
    if (rest_[0] == '"') {
      std::string text;
      const std::string_view inside = pattern();
      for (std::size_t k = 0; k < inside.size(); ++k) {
        const bool special = inside[k] == '\\' && k + 1 < inside.size();
        if (special) ++k;
        text += special && inside[k] == 'n' ? '\n' : inside[k];
      }
      return words(std::move(text));
    }
    if (isDigit(rest_[0]) || rest_[0] == '.') {
      double value = 0;
      const std::size_t size = readNumber(rest_, value);
      if (size == 0) return fail();
      const bool whole = rest_.substr(0, size).find('.') == std::string_view::npos;
      rest_.remove_prefix(size);
      return number(value, whole);
    }
    std::string_view name = word();
    if (name.empty()) return fail();
    if (name == "true" || name == "false") return truth(name == "true");
    if (name == "nil") return {Term::Nil, 0, false, {}};
    if (takes("(")) return called(name);
    double index = 0;
    if (takes("[")) {
      if (name.ends_with('_')) name.remove_suffix(1);  // [temperature_[tool]]
      index = conditional().number;
      if (!takes("]")) return fail();
    }
    const bool counts = index >= 0 && index < kMostItems;
    std::optional<FoundValue> value;
    for (const std::vector<TemplateValue>* list : {&std::as_const(own_), &values_}) {
      if (counts && !value) value = templateValue(name, toSize(index), *list);
    }
    if (value) return termOf(*value);
    return skipped_ > 0 ? Term{} : fail();
  }

  // Calls a function whose name and opening bracket are read.
  Term called(std::string_view name) {
    if (name == "size" || name == "empty") {
      const TemplateValue* list = variable(word());
      if (list == nullptr || !takes(")")) return fail();
      const std::size_t count = list->values.size();
      return name == "size" ? number(static_cast<double>(count), true) : truth(count == 0);
    }
    if (name == "one_of") return oneOf();
    if (name == "interpolate_table") return interpolated();
    const std::vector<Term> told = arguments();
    if (failed_ || told.empty()) return fail();
    const Term& first = told.front();
    if (name == "is_nil" && told.size() == 1) return truth(first.kind == Term::Nil);
    for (const Term& term : told) {
      if (skipped_ == 0 && (term.kind == Term::Text || term.kind == Term::Nil)) return fail();
    }
    if ((name == "min" || name == "max") && told.size() == 2) {
      const Term& other = told.back();
      const bool larger = other.number > first.number;
      return number(larger == (name == "max") ? other.number : first.number, first.whole && other.whole);
    }
    if (name == "random" && told.size() == 2) return first;  // any value between both will do; always the same
    if ((name == "digits" || name == "zdigits") && (told.size() == 2 || told.size() == 3)) {
      return padded(told, name == "zdigits" ? '0' : ' ');
    }
    if (told.size() != 1 || (name != "int" && name != "round")) return fail();
    return number(name == "int" ? std::trunc(first.number) : std::round(first.number), true);
  }

  // Reads one_of(value, other, /pattern/, ~"pattern"): true if the value equals one or matches a pattern.
  Term oneOf() {
    const Term value = conditional();
    bool found = false;
    while (!failed_ && takes(",")) {
      skip();
      const bool regular = takes("~") || rest_.starts_with('/');
      const bool same = regular ? matches(shown(value)) : applied("==", value, conditional()).number != 0;
      found = found || same;
    }
    return takes(")") ? truth(found) : fail();
  }

  // Reads interpolate_table(x, (x0, y0), (x1, y1)): linear between the points, constant before and behind them.
  Term interpolated() {
    const double x = conditional().number;
    double beforeX = 0, beforeY = 0, value = 0;
    for (bool first = true; !failed_ && takes(","); first = false) {
      const std::vector<Term> point = takes("(") ? arguments() : std::vector<Term>{};
      if (point.size() != 2 || (!first && !(point[0].number > beforeX))) return fail();
      const double nowX = point[0].number, nowY = point[1].number;
      if (first || x >= nowX) {
        value = nowY;
      } else if (x > beforeX) {
        value = beforeY + (x - beforeX) * (nowY - beforeY) / (nowX - beforeX);
      }
      beforeX = nowX;
      beforeY = nowY;
    }
    return takes(")") ? number(value, false) : fail();
  }

  // Formats digits(value, least width, decimals), filled up on the left.
  Term padded(const std::vector<Term>& arguments, char filler) {
    const double width = arguments[1].number;
    const double decimals = arguments.size() == 3 ? arguments[2].number : 0;
    if (!(width >= 0 && width <= 20 && decimals >= 0 && decimals <= 6)) return fail();
    std::string text = fixed(arguments[0].number, static_cast<int>(decimals));
    const std::size_t at = filler == '0' && text.starts_with('-') ? 1 : 0;
    const std::size_t least = toSize(width);
    if (text.size() < least) text.insert(at, least - text.size(), filler);
    return words(std::move(text));
  }

  std::string_view rest_;
  const std::vector<TemplateValue>& values_;
  std::vector<TemplateValue>& own_;
  int nested_ = 0;
  int skipped_ = 0;  // number of skipped parts that enclose this one
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
  // The index may also stand behind the name: first_layer_temperature_0.
  const std::size_t line = name.rfind('_');
  if (found == values.end() && line != std::string_view::npos && line + 2 == name.size() && isDigit(name.back())) {
    index = name.back() - '0';
    found = find(name.substr(0, line));
  }
  if (found == values.end() || found->values.empty()) return std::nullopt;
  // An index beyond the end gives the first value, as in PrusaSlicer.
  return FoundValue{found->values[index < found->values.size() ? index : 0], found->whole};
}

std::optional<std::string> evaluated(std::string_view expression, const std::vector<TemplateValue>& values) {
  std::vector<TemplateValue> own;
  const std::optional<std::string> value = statement(expression, values, own);
  return expression.empty() ? value : std::nullopt;
}

std::optional<std::string> statement(std::string_view& text, const std::vector<TemplateValue>& values,
                                     std::vector<TemplateValue>& own) {
  Evaluation assignment(text, values, own);
  if (assignment.assigns(text)) return assignment.failed() ? std::nullopt : std::optional(std::string());
  return Evaluation(text, values, own).all(text);
}

}  // namespace sillon
