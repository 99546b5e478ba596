#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr int kLongestElement = 640;    ///< points
constexpr double kTurnPrice = 4.5;      ///< one U-turn, in mm that are laid late
constexpr double kDearTurn = 40;        ///< one that is added, at most, while the order is searched; a quarter at least
constexpr double kMissPrice = 30;       ///< one unit of a joint's cost, in mm that are laid late
constexpr double kDearer = 1.5;         ///< becomes that price each time that too much is misaligned
constexpr double kLeastGain = 1;        ///< least gain of a move [mm]
constexpr double kLeastShare = 0.5;     ///< least share of the gain that a move promised before others of its round
constexpr double kMostTurns = 0.11;     ///< share of the path's U-turns that may be added where the border hides them
constexpr double kMostInField = 0.015;  ///< elsewhere; some more come about when the path is relaxed
constexpr double kHidden = 3;           ///< spacings from the border within which nobody sees a U-turn
constexpr double kMostMisaligned = 0.0018;  ///< that may be added, as a share of the length before the path is relaxed
constexpr double kMoreMiss =
    0.016;  ///< misaligned length times `stitchAlignment` that may be added while it is searched
constexpr int kRounds = 40;
constexpr double kSteps = 8;     ///< of improve(), for the progress of the stage
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
        mostMiss_(kMoreMiss * 0.25 * params.spacing * tour_.size() * std::max(1.0, params.stitchAlignment)),
        pull_(switches_.size(), 0.0),
        refused_(switches_.size()),
        again_(switches_.size()),
        least_(linkLength_ * tour_.lateness()) {
    for (const Link& cut : path.cuts) ends_.emplace_back(tour_.elementAt(cut.a), tour_.elementAt(cut.b));
    for (const Switch& one : switches_)
      middles_.push_back((joining_.at(one.joint.i) + joining_.at(one.joint.j)) * 0.5f);
    atFirst_ = figuresOfPath();
    workLeft_ = static_cast<std::int64_t>(kWork * tour_.size());
  }

  // Bands of beads that hang from opposite sides meet in walls, which move at no gain, so that a search for gains stops
  // there. Joints drawn to one side and then to the other make the walls wander until they meet. U-turns that are dear
  // at first, then cheap and dear again lead across hills that no limit lets a search cross; the best order on the way
  // is kept.
  void improve() {
    const Vec2f along = meanLine();
    int steps = 0;
    const auto endStep = [&] {
      remember();
      run_.report(path_.begin + (path_.end - path_.begin) * ++steps / kSteps);
    };
    const auto search = [&](double turnPrice) {
      turnPrice_ = turnPrice;
      lookAtJoints();
      takeGains();
      endStep();
    };
    const auto draw = [&](double strength) {
      sweep(along, strength);
      sweep(along, -strength);
      endStep();
    };
    search(kDearTurn);
    draw(0.9);
    search(0.5 * kDearTurn);
    search(0.25 * kDearTurn);
    draw(0.3);
    draw(0.9);
    search(0.5 * kDearTurn);
    search(kDearTurn);
    undoFrom(best_);
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

  // Fewer U-turns than at first are worth little, so that alignment is not sold for them.
  [[nodiscard]] double worthOf(int turns) const { return (turns > 0 ? turnPrice_ : kTurnPrice) * turns; }

  [[nodiscard]] double priceOf(const Toll& toll) const {
    return worthOf(added_.turns + toll.turns) - worthOf(added_.turns) + missPrice_ * toll.miss;
  }

  // Cost of toggling two switches.
  [[nodiscard]] double costOf(int s, int t) const {
    Toll toll;
    double pulled = 0;
    for (const int k : {s, t}) {
      const Switch& one = switches_[k];
      const int sign = one.joint.on ? -1 : 1;
      toll.turns += sign * one.turns;
      toll.miss += sign * static_cast<double>(one.miss);
      pulled += sign * pull_[k];
    }
    return priceOf(toll) + pulled;
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
    int inField = 0;        ///< of these, where no border hides them
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
    Figures figures;
    double along = 0;
    for (std::size_t k = 1; k < line.size(); ++k) {
      along += static_cast<double>(length(line[k] - line[k - 1]));
      figures.misaligned += static_cast<double>(joining_.misalignment(line[k - 1], line[k]));
    }
    if (along > 0) figures.misaligned /= along;
    std::vector<Vec2f> turns;
    figures.turns = uTurnsOf(line, beads_.spacing, &turns);
    for (const Vec2f p : turns) {
      const Vec2 at{static_cast<double>(p.x), static_cast<double>(p.y)};
      const bool hidden = std::abs(beads_.border.nearest(at).distance) <= kHidden * static_cast<double>(beads_.spacing);
      figures.inField += hidden ? 0 : 1;
    }
    return figures;
  }

  [[nodiscard]] double score() const {
    return linkLength_ * tour_.lateness() + worthOf(added_.turns) + missPrice_ * added_.miss;
  }

  // Draws joints to one side; then lets go, and keeps what came of it if it is better.
  void sweep(Vec2f along, double strength) {
    if (run_.cancelled() || workLeft_ <= 0) return;
    const double before = score();
    const std::size_t done = done_.size();
    const auto turned = [&](double by) {
      for (std::size_t s = 0; s < pull_.size(); ++s) pull_[s] = by * static_cast<double>(dot(middles_[s], along));
      lookAtJoints();
      takeGains();
    };
    turned(strength);
    if (done_.size() > done) turned(0);
    std::fill(pull_.begin(), pull_.end(), 0.0);
    if (score() > before - kLeastGain) undoFrom(done);
  }

  // Keeps this order in mind if it is the most even so far of those within the limits.
  void remember() {
    const double late = linkLength_ * tour_.lateness();
    if (done_.size() == seen_ || late > least_ - kLeastGain) return;
    seen_ = done_.size();
    const Figures now = figuresOfPath();
    const auto within = [&](double share, int turns, int first) {
      return turns <= first + 1 + static_cast<int>(share * atFirst_.turns);
    };
    const double cost = late + kTurnPrice * std::max(0, now.turns - atFirst_.turns);
    if (now.misaligned > atFirst_.misaligned + kMostMisaligned) {
      missPrice_ *= kDearer;
    } else if (within(kMostTurns, now.turns, atFirst_.turns) && within(kMostInField, now.inField, atFirst_.inField) &&
               cost < least_) {
      least_ = cost;
      best_ = done_.size();
    }
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
    sides_.clear();
    for (int s = 0; s < static_cast<int>(switches_.size()); ++s) {
      const auto [low, high] = cutsOf(s);
      sides_.push_back({low, high, s});
      sides_.push_back({high, low, s});
    }
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& a, const Side& b) { return std::tie(a.at, a.of) < std::tie(b.at, b.of); });
    std::vector<Move> moves(next.size());
    std::vector<std::int64_t> work(next.size());
    int looked = 0;
    while (looked < static_cast<int>(next.size()) && workLeft_ > 0 && !run_.cancelled()) {
      const int batch = std::min(kBatch, static_cast<int>(next.size()) - looked);
      parallelFor(run_, batch, 8, [&](int begin, int end) {
        Tour::Split::Room room;
        for (int k = looked + begin; k < looked + end; ++k) moves[k] = bestWith(next[k], blocked, room, work[k]);
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
  [[nodiscard]] Move bestWith(int s, const std::vector<char>& blocked, Tour::Split::Room& room,
                              std::int64_t& work) const {
    const auto [low, high] = cutsOf(s);
    Move best{kLeastGain, s, -1, {}};
    if (low == high) return best;
    struct Partner {
      double atMost;  ///< gain of the move [mm]
      int other;
    };
    std::vector<Partner> partners;
    // A partner has one cut between the two of this one, and the other is not.
    const auto first =
        std::upper_bound(sides_.begin(), sides_.end(), low, [](int at, const Side& side) { return at < side.at; });
    for (auto side = first; side != sides_.end() && side->at < high; ++side) {
      const int t = side->of;
      if ((low <= side->other && side->other <= high) || !mayMeet(s, t)) continue;
      if (hopeless(s, t, blocked) || hopeless(t, s, blocked)) continue;
      if (std::find(refused_[s].begin(), refused_[s].end(), t) == refused_[s].end()) partners.push_back({0, t});
    }
    if (partners.empty()) return best;
    const Tour::Split split(tour_, low, high, room);
    work += tour_.work();
    for (Partner& partner : partners) {
      const auto [a, b] = ends_[partner.other];
      partner.atMost = linkLength_ * split.atMost(a, b) - costOf(s, partner.other);
    }
    std::sort(partners.begin(), partners.end(), [](const Partner& a, const Partner& b) {
      return std::tie(b.atMost, a.other) < std::tie(a.atMost, b.other);
    });
    for (const Partner& partner : partners) {
      if (partner.atMost <= best.gain) break;
      const int t = partner.other;
      const double costs = costOf(s, t);
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
    return length(middles_[s] - middles_[other]) > 4 * beads_.spacing;
  }

  // Earlier moves of the round may have changed what this one gains.
  void make(const Move& move) {
    again_[move.first] = 1;
    Cuts cuts{};
    if (!cutsOf(move, cuts)) return;
    const double gain = linkLength_ * tour_.gain(cuts);
    if (gain - costOf(move.first, move.second) < kLeastShare * move.gain) return;
    if (!toggle(move, gain)) {
      refused_[move.first].push_back(move.second);
      refused_[move.second].push_back(move.first);
      return;
    }
    tour_.exchange(cuts);
    for (const int s : {move.first, move.second}) {
      const Vec2f middle = middles_[s];
      for (int t = 0; t < static_cast<int>(again_.size()); ++t) {
        if (length(middles_[t] - middle) < kAround) again_[t] = 1;
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
    const bool tooMuch = toll.miss > 0 && added_.miss + toll.miss > mostMiss_;
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
  double mostMiss_;                        ///< cost of joints that may be added while the order is searched
  std::vector<std::pair<int, int>> ends_;  ///< of each switch, the elements after which it cuts
  struct Side {
    int at, other;  ///< places of the two cuts
    int of;         ///< switch
  };
  std::vector<Side> sides_;                ///< of all switches, in order of their places now
  std::vector<Vec2f> middles_;             ///< of the switches
  std::vector<double> pull_;               ///< extra cost of a joint for its side [mm]
  std::vector<std::vector<int>> refused_;  ///< partners with which a switch could not be toggled
  std::vector<char> again_;                ///< switches to be looked at, as something near them has changed
  std::vector<Move> done_;
  Toll added_;
  double turnPrice_ = 0;  ///< of a U-turn more than at first [mm]
  double least_;          ///< cost of the best order so far [mm]
  std::size_t best_ = 0;  ///< moves that lead to it
  std::size_t seen_ = 0;  ///< moves when an order was last looked at
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
