#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr int kLongestElement = 640;  ///< longest element [points]
constexpr double kTurnPrice = 4.5;    ///< price of one U-turn, in mm that are laid late
constexpr double kDearTurn = 40;      ///< highest price of an added U-turn, in mm laid late; the lowest is a quarter
constexpr double kMissPrice = 30;     ///< price of one unit of a joint's cost, in mm that are laid late
constexpr double kDearer = 1.5;       ///< factor by which kMissPrice rises each time that too much is misaligned
constexpr double kLeastGain = 1;      ///< least gain of a move [mm]
constexpr double kLeastShare = 0.5;   ///< share of a promised gain that must be left after other moves of the round
constexpr double kMostTurnsShare = 0.11;  ///< share of U-turns that may be added in all: the border hides most of them
constexpr double kMostInField = 0.015;    ///< share of them that may be added in the field; relaxation adds a few more
constexpr double kHidden = 3;             ///< spacings from the border within which nobody sees a U-turn
constexpr double kMostMisaligned = 0.0018;  ///< misaligned share of the length that may be added, before relaxation
constexpr double kMoreMiss = 0.016;  ///< share of misaligned length times `stitchAlignment` added on the way, at most
// Bounds on the search. Work is counted in links and elements instead of seconds, so that the result depends on nothing
// but the input. Three times the work makes keychain 5.2 / 0.0 % late instead of 8.7 / 0.7 %.
constexpr int kRounds = 40;         ///< most rounds of moves per search
constexpr double kSteps = 8;        ///< steps of improve(), for the progress of the stage
constexpr double kWork = 100;       ///< elements that may be looked at per point of the path
constexpr int kBatch = 256;         ///< switches between two checks of the work that is left
constexpr float kMoveReach = 2.5f;  ///< reach around a move within which switches are looked at again [mm]

// Cuts the path into elements, which keep their order within. Elements begin after the places at which switches cut, as
// only these may be exchanged; long ones are divided, so that one mean offset stands for all links of two elements.
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

// Costs of a change of joints besides its order: U-turns added, and the cost of the joints.
struct Toll {
  int turns = 0;
  double miss = 0;
};

// Two switches that are toggled together: one exchange of blocks W X Y Z -> W Z Y X, a double bridge move.
struct Move {
  double gain = 0;  ///< less lateness, minus its cost [mm]
  int first = -1;
  int second = -1;
  Toll toll;
};

// Local search over double bridge moves of one path, with changing prices and pulls to leave local optima.
class OrderSearch {
 public:
  OrderSearch(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining,
              const RunContext& run)
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

  // Runs the whole schedule. Bands of beads that hang from opposite sides meet in walls, which move at no gain, so that
  // a plain search for gains stops there. Joints drawn to one side and then to the other make the walls wander until
  // they meet. A price of U-turns that starts high, falls to a quarter and rises again leads across hills that no fixed
  // limit lets a search cross. The best order on the way is kept.
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
    // The schedule: a strict search first, then pulls and cheaper turns in alternation, then strict searches that take
    // back turns which gain too little. At the end, go back to the best order that remember() saw.
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
  // Places now of the two cuts of a switch, the lower one first.
  [[nodiscard]] std::pair<int, int> cutsOf(int s) const {
    const int a = tour_.endOf(ends_[s].first);
    const int b = tour_.endOf(ends_[s].second);
    return {std::min(a, b), std::max(a, b)};
  }

  // Sorts the four cuts of a move, and tells whether those of the two switches alternate along the path. Only then does
  // toggling both leave one cycle.
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

  // Price of a number of added U-turns. U-turns saved count little, so that alignment is not sold for them.
  [[nodiscard]] double worthOf(int turns) const { return (turns > 0 ? turnPrice_ : kTurnPrice) * turns; }

  // Price of a toll on top of what the moves so far have added [mm].
  [[nodiscard]] double priceOf(const Toll& toll) const {
    return worthOf(added_.turns + toll.turns) - worthOf(added_.turns) + missPrice_ * toll.miss;
  }

  // Estimates the cost of toggling two switches, from the figures of each on its own [mm].
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

  // Mean direction of the path, up to its sign: the mean of squared directions as complex numbers, as in Eq. 1 to 4.
  [[nodiscard]] Vec2f meanLine() const {
    Vec2f sum{};
    for (std::size_t k = 0; k + 1 < path_.points.size(); k += kPointsPerLink) {
      const Vec2f v = joining_.at(path_.points[k + 1]) - joining_.at(path_.points[k]);
      const float size = length(v);
      if (size > 0) sum = sum + Vec2f{v.x * v.x - v.y * v.y, 2 * v.x * v.y} * (1 / size);
    }
    const float size = length(sum);
    if (size <= 0) return {1, 0};
    // Half of the mean's angle, by the half-angle formulas.
    const float cosine = sum.x / size;
    const float x = std::sqrt(0.5f * std::max(0.0f, 1 + cosine));
    const float y = std::sqrt(0.5f * std::max(0.0f, 1 - cosine));
    return {x, sum.y < 0 ? -y : y};
  }

  // Figures of the path by which orders are held to the limits.
  struct Figures {
    int turns = 0;
    int inField = 0;        ///< U-turns among them that no border hides
    double misaligned = 0;  ///< misaligned share of the length
  };

  // Measures the whole path as it is now; U-turns are counted on it as relaxation will leave it.
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
    // Misaligned length as a share of all length.
    double along = 0;
    for (std::size_t k = 1; k < line.size(); ++k) {
      along += static_cast<double>(length(line[k] - line[k - 1]));
      figures.misaligned += static_cast<double>(joining_.misalignment(line[k - 1], line[k]));
    }
    if (along > 0) figures.misaligned /= along;
    // U-turns on the smoothed path, and how many of them lie in the field.
    std::vector<Vec2f> turns;
    figures.turns = uTurnsOf(line, beads_.spacing, &turns);
    for (const Vec2f p : turns) {
      const Vec2 at{static_cast<double>(p.x), static_cast<double>(p.y)};
      const bool hidden = std::abs(beads_.border.nearest(at).distance) <= kHidden * static_cast<double>(beads_.spacing);
      figures.inField += hidden ? 0 : 1;
    }
    return figures;
  }

  // The figure that a search minimises, without pulls: late length plus the price of U-turns and joints [mm].
  [[nodiscard]] double score() const {
    return linkLength_ * tour_.lateness() + worthOf(added_.turns) + missPrice_ * added_.miss;
  }

  // Draws joints to one side by a cost that grows along the direction; then lets go, and keeps what came of it if it is
  // better.
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

  // Keeps this order in mind if it is the most even so far of those within the limits. Where too much is misaligned,
  // joints become dearer for the rest of the search.
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
    } else if (within(kMostTurnsShare, now.turns, atFirst_.turns) &&
               within(kMostInField, now.inField, atFirst_.inField) && cost < least_) {
      least_ = cost;
      best_ = done_.size();
    }
  }

  // Takes moves back, the last one first, until `first` of them are left. An exchange and a toggle are their own
  // inverses.
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

  // Marks the joints that are on to be looked at: nearly all moves undo one joint and make another, and there are far
  // fewer joints than switches.
  void lookAtJoints() {
    for (std::size_t s = 0; s < again_.size(); ++s) again_[s] = switches_[s].joint.on ? 1 : 0;
    for (std::vector<int>& some : refused_) some.clear();
  }

  // Makes moves in rounds, best first, until none gains.
  void takeGains() {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<Move> moves = bestMoves();
      if (moves.empty()) return;
      for (const Move& move : moves) make(move);
    }
  }

  // Takes the switches that are marked. Joints come first, as most moves undo one. Possible joints of rings are left
  // out: the ring's own joint finds all that could take its place.
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

  // Finds the best move of each switch that is marked, best first; ties go to the lower index. Moves of a batch are
  // found on all threads.
  std::vector<Move> bestMoves() {
    const std::vector<int> next = nextToLookAt();
    std::vector<char> blocked;
    for (const Switch& one : switches_) blocked.push_back(joining_.blocked(one.joint) ? 1 : 0);
    // Sort the ends of all switches by their places, so that the partners of a switch are one range.
    sides_.clear();
    for (int s = 0; s < static_cast<int>(switches_.size()); ++s) {
      const auto [low, high] = cutsOf(s);
      sides_.push_back({low, high, s});
      sides_.push_back({high, low, s});
    }
    std::sort(sides_.begin(), sides_.end(),
              [](const SwitchEnd& a, const SwitchEnd& b) { return std::tie(a.at, a.of) < std::tie(b.at, b.of); });
    // Look at batches until the work is used up. The work is summed up between batches only, so that threads do not
    // matter.
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

  // Finds the best partner of one switch. Partners with the highest bounds come first, so that few need an exact gain:
  // this takes a third of the time.
  [[nodiscard]] Move bestWith(int s, const std::vector<char>& blocked, Tour::Split::Room& room,
                              std::int64_t& work) const {
    const auto [low, high] = cutsOf(s);
    Move best{kLeastGain, s, -1, {}};
    if (low == high) return best;
    struct ExchangePartner {
      double atMost;  ///< upper bound of the move's gain [mm]
      int other;
    };
    std::vector<ExchangePartner> partners;
    // A partner's cuts alternate with those of this switch: one lies between them, and the other does not.
    const auto first =
        std::upper_bound(sides_.begin(), sides_.end(), low, [](int at, const SwitchEnd& side) { return at < side.at; });
    for (auto side = first; side != sides_.end() && side->at < high; ++side) {
      const int t = side->of;
      if ((low <= side->other && side->other <= high) || !mayMeet(s, t)) continue;
      if (hopeless(s, t, blocked) || hopeless(t, s, blocked)) continue;
      if (std::find(refused_[s].begin(), refused_[s].end(), t) == refused_[s].end()) partners.push_back({0, t});
    }
    if (partners.empty()) return best;
    // Bound each partner's gain from above (Tour::Split::atMost).
    const Tour::Split split(tour_, low, high, room);
    work += tour_.work();
    for (ExchangePartner& partner : partners) {
      const auto [a, b] = ends_[partner.other];
      partner.atMost = linkLength_ * split.atMost(a, b) - costOf(s, partner.other);
    }
    std::sort(partners.begin(), partners.end(), [](const ExchangePartner& a, const ExchangePartner& b) {
      return std::tie(b.atMost, a.other) < std::tie(a.atMost, b.other);
    });
    // Branch and bound: stop at the first partner whose bound is no better than the best exact gain.
    for (const ExchangePartner& partner : partners) {
      if (partner.atMost <= best.gain) break;
      const int t = partner.other;
      const double costs = costOf(s, t);
      const double least = (best.gain + costs) / linkLength_;
      const double gain = linkLength_ * split.gain(ends_[t].first, ends_[t].second, least, work) - costs;
      if (gain > best.gain) best = {gain, s, t, {}};
    }
    return best;
  }

  // Tells whether two switches may be toggled together: a joint of rings only takes the place of another one between
  // the same two, as elsewhere it would add its two U-turns.
  [[nodiscard]] bool mayMeet(int s, int t) const {
    const Switch& a = switches_[s];
    const Switch& b = switches_[t];
    const bool added = (a.ring >= 0 && !a.joint.on) || (b.ring >= 0 && !b.joint.on);
    return !added || (a.ring == b.ring && a.joint.on != b.joint.on);
  }

  // Tells whether a switch stays blocked when the other is toggled: only a joint beside it can block it.
  [[nodiscard]] bool hopeless(int s, int other, const std::vector<char>& blocked) const {
    if (blocked[s] == 0) return false;
    if (!switches_[other].joint.on) return true;
    return length(middles_[s] - middles_[other]) > 4 * beads_.spacing;
  }

  // Makes a move if enough of its gain is left: earlier moves of the round may have changed what it gains.
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
    // Look again at all switches near the two joints: their turns or room may have changed.
    for (const int s : {move.first, move.second}) {
      const Vec2f middle = middles_[s];
      for (int t = 0; t < static_cast<int>(again_.size()); ++t) {
        if (length(middles_[t] - middle) < kMoveReach) again_[t] = 1;
      }
    }
  }

  // Toggles both joints, the one that is on first. Takes them back where something stands against one, or where the
  // turns that are counted on the path cost more than the move gains.
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
  double linkLength_;                      ///< length of bead that one link stands for [mm]
  double missPrice_;                       ///< price of a unit of a joint's cost [mm]
  double mostMiss_;                        ///< cost of joints that may be added during the search
  std::vector<std::pair<int, int>> ends_;  ///< by switch: the elements after which it cuts
  struct SwitchEnd {
    int at, other;  ///< places of the two cuts
    int of;         ///< number of the switch
  };
  std::vector<SwitchEnd> sides_;           ///< ends of all switches, in order of their places now
  std::vector<Vec2f> middles_;             ///< middle of each switch
  std::vector<double> pull_;               ///< extra cost of a joint for its side [mm]
  std::vector<std::vector<int>> refused_;  ///< partners with which a switch could not be toggled
  std::vector<char> again_;                ///< switches to look at, as something near them has changed
  std::vector<Move> done_;                 ///< moves made so far, in order
  Toll added_;                             ///< toll of these moves together
  double turnPrice_ = 0;                   ///< price of a U-turn beyond those at first [mm]
  double least_;                           ///< cost of the best order so far [mm]
  std::size_t best_ = 0;                   ///< number of moves that lead to the best order
  std::size_t seen_ = 0;                   ///< number of moves when an order was last measured
  Figures atFirst_;
  std::int64_t workLeft_ = 0;
};

}  // namespace

Tour searchOrder(const Beads& beads, const ToolpathParams& params, PathOrder& path, Joining& joining,
                 const RunContext& run) {
  OrderSearch search(beads, params, path, joining, run);
  search.improve();
  return search.takeTour();
}

}  // namespace sillon
