#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr int kLongestElement = 640;        ///< points
constexpr double kTurnPrice = 4.5;          ///< one U-turn, in mm that are laid late
constexpr double kMissPrice = 15;           ///< one unit of a joint's cost, in mm that are laid late
constexpr double kLeastGain = 1;            ///< least gain of a move [mm]
constexpr double kLeastShare = 0.5;         ///< least share of the gain that a move promised before others of its round
constexpr double kMoreTurns = 0.02;         ///< share of the path's U-turns that may be added
constexpr double kMostTurns = 0.03;         ///< more, counted on the whole path, and a sweep is undone
constexpr double kMostMisaligned = 0.0013;  ///< likewise, as a share of the length
constexpr double kMoreMiss =
    0.002;                    ///< misaligned length times `stitchAlignment` that may be added, as a share of the path
constexpr double kSlack = 8;  ///< times these while joints are drawn to one side
constexpr double kDearer = 2.5;  ///< per try to keep the limits
constexpr int kTries = 5;
constexpr int kRounds = 40;
constexpr double kWork = 100;    ///< elements looked at per point of the path
constexpr int kBatch = 256;      ///< switches between two looks at the work that is left
constexpr float kAround = 2.5f;  ///< reach around a move in which switches are looked at again [mm]

// Joints cut after a place, and elements begin there.
std::vector<int> elementBegins(const PathOrder& path) {
  const int size = static_cast<int>(path.points.size());
  std::vector<int> cuts{0};
  for (const Link& cut : path.cuts) {
    cuts.push_back((cut.a + 1) % size);
    cuts.push_back((cut.b + 1) % size);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<int> all;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const int end = k + 1 < cuts.size() ? cuts[k + 1] : size;
    for (int at = cuts[k]; at < end; at += kLongestElement) all.push_back(at);
  }
  return all;
}

// Costs of a change of joints besides its order.
struct Toll {
  int turns = 0;
  double miss = 0;
};

// Two switches that are toggled at once, and what that adds.
struct Move {
  double gain = 0;  ///< [mm]
  int first = -1;
  int second = -1;
  Toll toll;
};

class Search {
 public:
  Search(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining, const RunContext& run)
      : beads_(beads),
        joining_(joining),
        run_(run),
        path_(path),
        switches_(path.switches),
        tour_(static_cast<int>(path.points.size()), elementBegins(path), path.links,
              0.25 * params.spacing / kEvenSpeed),
        linkLength_(0.25 * kPointsPerLink * params.spacing),
        missPrice_(kMissPrice * kUsualPrice / std::max(kUsualPrice, params.stitchAlignment)),
        pull_(switches_.size(), 0.0),
        refused_(switches_.size()),
        again_(switches_.size(), 1) {
    for (const Link& cut : path.cuts) ends_.emplace_back(tour_.elementAt(cut.a), tour_.elementAt(cut.b));
    atFirst_ = figuresOfPath();
    limit_.turns = static_cast<int>(kMoreTurns * atFirst_.turns);
    limit_.miss = kMoreMiss * 0.25 * params.spacing * tour_.size() * std::max(1.0, params.stitchAlignment);
    workLeft_ = static_cast<std::int64_t>(kWork * tour_.size());
  }

  // Bands of beads that hang from opposite sides meet in walls, which move at no gain, so that a search for gains stops
  // there. Joints drawn to one side and then to the other make the walls wander until they meet.
  void improve() {
    const Vec2f along = meanLine();
    sweep(along, 0);
    std::fill(again_.begin(), again_.end(), 1);
    const std::size_t done = done_.size();
    takeGains();
    if (done_.size() > done && !withinLimits()) undoFrom(done);
    for (const double strength : {0.3, 0.9}) {
      for (const double side : {1.0, -1.0}) sweep(along, side * strength);
    }
  }

  [[nodiscard]] Tour takeTour() { return std::move(tour_); }

 private:
  [[nodiscard]] std::pair<int, int> cutsOf(int s) const {
    const int a = tour_.endOf(ends_[s].first);
    const int b = tour_.endOf(ends_[s].second);
    return {std::min(a, b), std::max(a, b)};
  }

  // Puts the cuts of both in order, and tells whether each lies between those of the other.
  [[nodiscard]] bool cutsOf(const Move& move, Cuts& cuts) const {
    auto [a, c] = cutsOf(move.first);
    auto [b, d] = cutsOf(move.second);
    if (a > b) {
      std::swap(a, b);
      std::swap(c, d);
    }
    cuts = {a, b, c, d};
    return a < b && b < c && c < d;
  }

  [[nodiscard]] Vec2f middleOf(int s) const {
    const Joint& joint = switches_[s].joint;
    return (joining_.at(joint.i) + joining_.at(joint.j)) * 0.5f;
  }

  [[nodiscard]] double priceOf(const Toll& toll) const {
    return turnWeight_ * kTurnPrice * toll.turns + missWeight_ * missPrice_ * toll.miss;
  }

  // Cost of toggling one switch, whatever its partner.
  [[nodiscard]] double costOf(int s) const {
    const Switch& one = switches_[s];
    const double cost = priceOf({one.turns, static_cast<double>(one.miss)}) + pull_[s];
    return one.joint.on ? -cost : cost;
  }

  // Mean direction of the path, up to its sign.
  [[nodiscard]] Vec2f meanLine() const {
    Vec2f sum{};
    for (std::size_t k = 0; k + 1 < path_.points.size(); k += kPointsPerLink) {
      const Vec2f v = joining_.at(path_.points[k + 1]) - joining_.at(path_.points[k]);
      const float size = length(v);
      if (size > 0) sum = sum + Vec2f{v.x * v.x - v.y * v.y, 2 * v.x * v.y} * (1 / size);
    }
    const float size = length(sum);
    if (size <= 0) return {1, 0};
    const float cosine = sum.x / size;
    const float x = std::sqrt(0.5f * std::max(0.0f, 1 + cosine));
    const float y = std::sqrt(0.5f * std::max(0.0f, 1 - cosine));
    return {x, sum.y < 0 ? -y : y};
  }

  // Figures of the path as it will be once it is relaxed.
  struct Figures {
    int turns = 0;
    double misaligned = 0;  ///< share of the length
  };

  [[nodiscard]] Figures figuresOfPath() const {
    std::vector<Vec2f> line;
    const auto on = std::find_if(path_.points.begin(), path_.points.end(), [&](int p) { return joining_.onPath(p); });
    if (on == path_.points.end()) return {};
    int p = *on;
    do {
      line.push_back(joining_.at(p));
      p = joining_.after(p);
    } while (p != *on);
    line.push_back(joining_.at(p));
    Figures figures{uTurnsOf(line, beads_.spacing), 0};
    double along = 0;
    for (std::size_t k = 1; k < line.size(); ++k) {
      along += static_cast<double>(length(line[k] - line[k - 1]));
      figures.misaligned += static_cast<double>(joining_.misalignment(line[k - 1], line[k]));
    }
    if (along > 0) figures.misaligned /= along;
    return figures;
  }

  // Moves count turns and misaligned length near their joints only; this looks at the whole path.
  [[nodiscard]] bool withinLimits() const {
    const Figures now = figuresOfPath();
    return now.turns <= atFirst_.turns + 1 + static_cast<int>(kMostTurns * atFirst_.turns) &&
           now.misaligned <= atFirst_.misaligned + kMostMisaligned;
  }

  [[nodiscard]] double score() const {
    return linkLength_ * tour_.lateness() + kTurnPrice * added_.turns + missPrice_ * added_.miss;
  }

  [[nodiscard]] bool overTurns() const { return added_.turns > limit_.turns; }
  [[nodiscard]] bool overMiss() const { return added_.miss > limit_.miss; }

  // Draws joints to one side, if with any strength, and over the limits; then lets go, and keeps what came of it if it
  // is better.
  void sweep(Vec2f along, double strength) {
    if (run_.cancelled() || workLeft_ <= 0) return;
    const double before = score();
    const std::size_t done = done_.size();
    const Toll limit = limit_;
    for (int s = 0; s < static_cast<int>(pull_.size()); ++s)
      pull_[s] = strength * static_cast<double>(dot(middleOf(s), along));
    limit_ = {static_cast<int>(kSlack * limit.turns), kSlack * limit.miss};
    const std::int64_t rest = workLeft_ / 2;  // to come back within the limits
    workLeft_ -= rest;
    lookAtJoints();
    takeGains();
    workLeft_ += rest;
    limit_ = limit;
    std::fill(pull_.begin(), pull_.end(), 0.0);
    settle();
    if (score() > before - kLeastGain || overTurns() || overMiss() || !withinLimits()) undoFrom(done);
  }

  // Makes what is over its limit dearer until it is no more.
  void settle() {
    for (int k = 0; k < kTries; ++k) {
      lookAtJoints();
      takeGains();
      if (overTurns()) turnWeight_ *= kDearer;
      if (overMiss()) missWeight_ *= kDearer;
      if (!overTurns() && !overMiss()) break;
    }
    turnWeight_ = missWeight_ = 1;
  }

  void undoFrom(std::size_t first) {
    for (; done_.size() > first; done_.pop_back()) {
      const Move& move = done_.back();
      Cuts cuts{};
      if (!cutsOf(move, cuts)) return;
      joining_.toggle(switches_[move.second].joint);
      joining_.toggle(switches_[move.first].joint);
      tour_.exchange(cuts);
      added_ = {added_.turns - move.toll.turns, added_.miss - move.toll.miss};
    }
  }

  // Nearly all moves undo one joint and make another, and there are far fewer joints than switches.
  void lookAtJoints() {
    for (std::size_t s = 0; s < again_.size(); ++s) again_[s] = switches_[s].joint.on ? 1 : 0;
    for (std::vector<int>& some : refused_) some.clear();
  }

  void takeGains() {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Move> moves = bestMoves();
      if (moves.empty()) return;
      for (const Move& move : moves) make(move);
    }
  }

  // Joints come first: most moves undo one. Those of rings find all that could take their place.
  std::vector<int> nextToLookAt() {
    std::vector<int> next;
    for (const bool on : {true, false}) {
      for (int s = 0; s < static_cast<int>(again_.size()); ++s) {
        if (again_[s] != 0 && switches_[s].joint.on == on && (on || switches_[s].ring < 0)) next.push_back(s);
      }
    }
    std::fill(again_.begin(), again_.end(), 0);
    return next;
  }

  // The best move of each switch that is to be looked at, best first. Moves of a batch are found on all threads.
  std::vector<Move> bestMoves() {
    const std::vector<int> next = nextToLookAt();
    std::vector<char> blocked;
    for (const Switch& one : switches_) blocked.push_back(joining_.blocked(one.joint) ? 1 : 0);
    std::vector<Move> moves(next.size());
    std::vector<std::int64_t> work(next.size());
    int looked = 0;
    while (looked < static_cast<int>(next.size()) && workLeft_ > 0 && !run_.cancelled()) {
      const int batch = std::min(kBatch, static_cast<int>(next.size()) - looked);
      parallelFor(run_, batch, 8, [&](int begin, int end) {
        for (int k = looked + begin; k < looked + end; ++k) moves[k] = bestWith(next[k], blocked, work[k]);
      });
      for (int k = 0; k < batch; ++k) workLeft_ -= work[looked++];
    }
    if (run_.cancelled()) return {};
    std::erase_if(moves, [](const Move& move) { return move.second < 0; });
    std::sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
      return std::tie(b.gain, a.first, a.second) < std::tie(a.gain, b.first, b.second);
    });
    return moves;
  }

  // Partners with the highest bounds come first, so that few need an exact gain: a third of the time.
  [[nodiscard]] Move bestWith(int s, const std::vector<char>& blocked, std::int64_t& work) const {
    const auto [low, high] = cutsOf(s);
    Move best{kLeastGain, s, -1, {}};
    if (low == high) return best;
    const Tour::Split split(tour_, low, high);
    work += tour_.work();
    struct Partner {
      double atMost;  ///< gain of the move [mm]
      int other;
    };
    std::vector<Partner> partners;
    for (int t = 0; t < static_cast<int>(switches_.size()); ++t) {
      const auto [a, b] = cutsOf(t);
      const bool interlaced = (low < a && a < high && high < b) || (a < low && low < b && b < high);
      if (!interlaced || !mayMeet(s, t) || hopeless(s, t, blocked) || hopeless(t, s, blocked)) continue;
      if (std::find(refused_[s].begin(), refused_[s].end(), t) != refused_[s].end()) continue;
      const double atMost = linkLength_ * split.atMost(ends_[t].first, ends_[t].second) - costOf(s) - costOf(t);
      if (atMost > kLeastGain) partners.push_back({atMost, t});
    }
    std::sort(partners.begin(), partners.end(), [](const Partner& a, const Partner& b) {
      return std::tie(b.atMost, a.other) < std::tie(a.atMost, b.other);
    });
    for (const Partner& partner : partners) {
      if (partner.atMost <= best.gain) break;
      const int t = partner.other;
      const double costs = costOf(s) + costOf(t);
      const double least = (best.gain + costs) / linkLength_;
      const double gain = linkLength_ * split.gain(ends_[t].first, ends_[t].second, least, work) - costs;
      if (gain > best.gain) best = {gain, s, t, {}};
    }
    return best;
  }

  // A joint of rings only takes the place of another one between the same two; elsewhere it would add its two U-turns.
  [[nodiscard]] bool mayMeet(int s, int t) const {
    const Switch& a = switches_[s];
    const Switch& b = switches_[t];
    const bool added = (a.ring >= 0 && !a.joint.on) || (b.ring >= 0 && !b.joint.on);
    return !added || (a.ring == b.ring && a.joint.on != b.joint.on);
  }

  // Tells whether a switch stays blocked when the other is toggled: only a joint beside it can be what blocks it.
  [[nodiscard]] bool hopeless(int s, int other, const std::vector<char>& blocked) const {
    if (blocked[s] == 0) return false;
    if (!switches_[other].joint.on) return true;
    return length(middleOf(s) - middleOf(other)) > 4 * beads_.spacing;
  }

  // Earlier moves of the round may have changed what this one gains.
  void make(const Move& move) {
    again_[move.first] = 1;
    Cuts cuts{};
    if (!cutsOf(move, cuts)) return;
    const double gain = linkLength_ * tour_.gain(cuts);
    if (gain - costOf(move.first) - costOf(move.second) < kLeastShare * move.gain) return;
    if (!toggle(move, gain)) {
      refused_[move.first].push_back(move.second);
      refused_[move.second].push_back(move.first);
      return;
    }
    tour_.exchange(cuts);
    for (const int s : {move.first, move.second}) {
      const Vec2f middle = middleOf(s);
      for (int t = 0; t < static_cast<int>(again_.size()); ++t) {
        if (length(middleOf(t) - middle) < kAround) again_[t] = 1;
      }
    }
  }

  // Toggles both, what is undone first, unless something stands against it or the turns that it really adds cost more.
  bool toggle(Move move, double gain) {
    if (!switches_[move.first].joint.on) std::swap(move.first, move.second);
    Joint& a = switches_[move.first].joint;
    Joint& b = switches_[move.second].joint;
    const int before = uTurnsNear(beads_, joining_, a, b);
    if (!joining_.toggle(a)) return false;
    if (!joining_.toggle(b)) {
      joining_.toggle(a);
      return false;
    }
    const auto made = [](const Joint& joint, double value) { return joint.on ? value : -value; };
    const Toll toll{uTurnsNear(beads_, joining_, a, b) - before,
                    made(a, static_cast<double>(switches_[move.first].miss)) +
                        made(b, static_cast<double>(switches_[move.second].miss))};
    const double pulled = made(a, pull_[move.first]) + made(b, pull_[move.second]);
    const bool tooMuch = (toll.turns > 0 && added_.turns + toll.turns > limit_.turns) ||
                         (toll.miss > 0 && added_.miss + toll.miss > limit_.miss);
    if (tooMuch || gain - priceOf(toll) - pulled < kLeastGain) {
      joining_.toggle(b);
      joining_.toggle(a);
      return false;
    }
    move.toll = toll;
    done_.push_back(move);
    added_ = {added_.turns + toll.turns, added_.miss + toll.miss};
    return true;
  }

  const Beads& beads_;
  Joining& joining_;
  const RunContext& run_;
  const PathOrder& path_;
  std::vector<Switch>& switches_;
  Tour tour_;
  double linkLength_;                      ///< [mm]
  double missPrice_;                       ///< of a unit of a joint's cost [mm]
  std::vector<std::pair<int, int>> ends_;  ///< of each switch, the elements after which it cuts
  std::vector<double> pull_;               ///< extra cost of a joint for its side [mm]
  std::vector<std::vector<int>> refused_;  ///< partners with which a switch could not be toggled
  std::vector<char> again_;                ///< switches to be looked at, as something near them has changed
  std::vector<Move> done_;
  Toll added_;
  Toll limit_;
  double turnWeight_ = 1;
  double missWeight_ = 1;
  Figures atFirst_;
  std::int64_t workLeft_ = 0;
};

}  // namespace

Tour searchOrder(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining,
                 const RunContext& run) {
  Search search(beads, params, path, joining, run);
  search.improve();
  return search.takeTour();
}

}  // namespace sillon
