#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

#include "toolpath/even_order.hpp"

namespace sillon {
namespace {

constexpr double kUnit = 1024;  ///< units in the lateness of one link: whole numbers add up alike in any order

// Lateness of a link by its delay: half up to 30 s, half up to 120 s and a tenth up to 1000 s.
int latenessAfter(double seconds) {
  const auto share = [&](double limit) { return std::min(1.0, seconds / limit); };
  return static_cast<int>(kUnit * (0.5 * share(30) + 0.5 * share(120) + 0.1 * share(1000)));
}

}  // namespace

Tour::Tour(int size, std::vector<int> cuts, const std::vector<Link>& links, double pointSeconds)
    : size_(size),
      cuts_(std::move(cuts)),
      begin_(cuts_),
      length_(cuts_.size()),
      order_(cuts_.size()),
      rank_(cuts_.size()),
      orderedBegin_(cuts_) {
  // Elements begin in the order of the path.
  const int count = static_cast<int>(cuts_.size());
  for (int e = 0; e < count; ++e) {
    order_[e] = rank_[e] = e;
    length_[e] = (e + 1 < count ? cuts_[e + 1] : size_) - cuts_[e];
  }
  // Table of lateness by delay in steps of kLateStep points, as it is looked up for every link of every move.
  for (int k = 0; k <= size_ / kLateStep; ++k) late_.push_back(latenessAfter((k + 0.5) * kLateStep * pointSeconds));

  // Links within one element keep their delay in every order: leave them out. Others become bonds, the lower element
  // first.
  for (const Link& link : links) {
    int a = elementAt(link.a);
    int b = elementAt(link.b);
    if (a == b) continue;
    int offset = (link.a - cuts_[a]) - (link.b - cuts_[b]);
    if (a > b) {
      std::swap(a, b);
      offset = -offset;
    }
    bonds_.push_back({a, b, offset, 1});
  }
  // Merge all links of two elements into one bond with their number and mean offset, which bounds the work by elements
  // instead of points.
  std::sort(bonds_.begin(), bonds_.end(),
            [](const Bond& x, const Bond& y) { return std::tie(x.a, x.b, x.offset) < std::tie(y.a, y.b, y.offset); });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < bonds_.size();) {
    Bond bond = bonds_[k];
    std::int64_t sum = 0;
    for (bond.weight = 0; k < bonds_.size() && bonds_[k].a == bond.a && bonds_[k].b == bond.b; ++k, ++bond.weight)
      sum += bonds_[k].offset;
    bond.offset = static_cast<int>(sum / bond.weight);
    bonds_[kept++] = bond;
  }
  bonds_.resize(kept);

  // Compressed rows of neighbours: those of element e lie from firstBeside_[e] to firstBeside_[e + 1]. Each bond is
  // entered at both of its elements.
  firstBeside_.assign(cuts_.size() + 1, 0);
  for (const Bond& bond : bonds_) {
    ++firstBeside_[bond.a + 1];
    ++firstBeside_[bond.b + 1];
  }
  for (std::size_t e = 0; e < cuts_.size(); ++e) firstBeside_[e + 1] += firstBeside_[e];
  beside_.resize(2 * bonds_.size());
  std::vector<int> at(firstBeside_.begin(), firstBeside_.end() - 1);
  for (const Bond& bond : bonds_) {
    beside_[at[bond.a]++] = {bond.b, bond.offset, bond.weight};
    beside_[at[bond.b]++] = {bond.a, -bond.offset, bond.weight};
    // Lateness is kept up to date as a sum; moves only add their difference.
    now_ += static_cast<std::int64_t>(bond.weight) * lateRound(std::abs(begin_[bond.a] - begin_[bond.b] + bond.offset));
  }
}

// Binary search, as cuts_ ascends in the initial order.
int Tour::elementAt(int place) const {
  return static_cast<int>(std::upper_bound(cuts_.begin(), cuts_.end(), place) - cuts_.begin()) - 1;
}

int Tour::placeNow(int place) const {
  const int e = elementAt(place);
  return begin_[e] + place - cuts_[e];
}

// Rank now of the first element that begins at `place` or later.
int Tour::rankAt(int place) const {
  return static_cast<int>(std::lower_bound(orderedBegin_.begin(), orderedBegin_.end(), place) - orderedBegin_.begin());
}

double Tour::lateness() const { return static_cast<double>(now_) / kUnit; }

// Sums the change over links between different blocks: links within a block keep their delay. All blocks but the
// longest are looked at, which finds each such link, as one of its ends is in another block.
double Tour::gain(const Cuts& cuts) const {
  const int x = cuts[1] - cuts[0];
  const int y = cuts[2] - cuts[1];
  const int z = cuts[3] - cuts[2];
  // Places that each block W, X, Y, Z moves by when X and Z change places.
  const std::array<int, 4> shift{0, z + y, z - x, -(x + y)};
  const std::array<int, 4> lengths{size_ - (cuts[3] - cuts[0]), x, y, z};
  const int longest = static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
  const auto blockOf = [&](int place) {
    return place < cuts[0] || place >= cuts[3] ? 0 : 1 + (place >= cuts[1] ? 1 : 0) + (place >= cuts[2] ? 1 : 0);
  };
  std::int64_t gained = 0;
  const auto look = [&](int from, int to, int block) {
    if (block == longest) return;
    for (int r = rankAt(from), end = rankAt(to); r < end; ++r) {
      const int e = order_[r];
      for (int k = firstBeside_[e]; k < firstBeside_[e + 1]; ++k) {
        const Beside& beside = beside_[k];
        const int there = begin_[beside.other];
        const int other = blockOf(there);
        // A link between two of the shorter blocks is found from both ends; count it once.
        if (other == block || (other != longest && e > beside.other)) continue;
        const int apart = begin_[e] - there + beside.offset;
        gained += static_cast<std::int64_t>(beside.weight) *
                  (lateRound(std::abs(apart)) - lateRound(std::abs(apart + shift[block] - shift[other])));
      }
    }
  };
  look(0, cuts[0], 0);
  look(cuts[3], size_, 0);
  for (std::size_t block = 1; block < 4; ++block) look(cuts[block - 1], cuts[block], static_cast<int>(block));
  return static_cast<double>(gained) / kUnit;
}

// Performs W X Y Z -> W Z Y X. Only elements from the first to the last cut change their places.
void Tour::exchange(const Cuts& cuts) {
  now_ -= static_cast<std::int64_t>(std::llround(gain(cuts) * kUnit));
  std::array<int, 4> ranks{};
  for (std::size_t k = 0; k < 4; ++k) ranks[k] = rankAt(cuts[k]);
  std::vector<int> blocks;
  // Write the three blocks in reverse order, and number their elements anew.
  for (std::size_t k = 3; k > 0; --k)
    blocks.insert(blocks.end(), order_.begin() + ranks[k - 1], order_.begin() + ranks[k]);
  int place = cuts[0];
  for (int r = ranks[0]; r < ranks[3]; ++r) {
    const int e = order_[r] = blocks[r - ranks[0]];
    rank_[e] = r;
    begin_[e] = orderedBegin_[r] = place;
    place += length_[e];
  }
}

// Takes the difference of lateness at the begin and the end of each link's range, and sums up over places: linear in
// links and places, where one sum for each place would be quadratic.
std::vector<double> Tour::latenessOfBegins(const std::vector<Link>& links) const {
  std::vector<std::int64_t> steps(size_ + 1, 0);
  for (const Link& link : links) {
    int a = placeNow(link.a);
    int b = placeNow(link.b);
    if (a > b) std::swap(a, b);
    // A path that begins between the two places goes the other way round.
    const int other = late(size_ - (b - a)) - late(b - a);
    steps[a + 1] += other;
    steps[b + 1] -= other;
  }
  std::vector<double> sums(size_);
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] = static_cast<double>(sum += steps[k]) / kUnit;
  return sums;
}

// Prepares the gains of all moves that contain one pair of cuts. The pair makes two rings: [low, high), and the rest
// from `high` on. A third and a fourth cut open each ring, and the one is put into the other. A link within a ring
// depends on one of these two cuts only, so that sums for every cut can be made beforehand; links across the rings
// depend on both, and are kept in a list.
Tour::Split::Split(const Tour& tour, int low, int high, Room& room)
    : tour_(tour), low_(low), high_(high), added_(room.added_), across_(room.across_) {
  const std::size_t count = tour.order_.size();
  const int inside = high - low;
  const int outside = tour.size_ - inside;
  added_.assign(2 * count + 2, 0);
  across_.clear();
  // Both rings begin at the first cut, so that one comparison tells in which of them an element is.
  room.places_.resize(count);
  for (std::size_t e = 0; e < count; ++e) {
    const bool before = tour.begin_[e] < low;
    room.places_[e] = {tour.begin_[e] + (before ? tour.size_ : 0),
                       tour.rank_[e] + (before ? static_cast<int>(count) : 0)};
  }
  // For links within a ring, `added` holds differences by rank: a cut between the two ends of a link makes them as far
  // apart as the rest of the ring is long.
  std::int64_t* const added = added_.data() + 1;
  std::int64_t kept = 0;
  for (const Bond& bond : tour.bonds_) {
    const Room::Place a = room.places_[bond.a];
    const Room::Place b = room.places_[bond.b];
    const bool in = a.begin < high;
    if (in != (b.begin < high)) {
      across_.push_back({in ? a.begin : b.begin, in ? b.begin : a.begin, in ? bond.offset : -bond.offset, bond.weight});
      continue;
    }
    const int apart = std::abs(a.begin - b.begin + bond.offset);
    const int together = tour.lateRound(apart);
    kept += static_cast<std::int64_t>(bond.weight) * together;
    const int cut = bond.weight * (tour.lateRound(std::max(0, (in ? inside : outside) - apart)) - together);
    added[std::min(a.rank, b.rank)] += cut;
    added[std::max(a.rank, b.rank)] -= cut;
  }
  // Prefix sums turn the differences into the lateness that a cut at each rank adds.
  kept_ = kept;
  for (std::size_t k = 1; k < added_.size(); ++k) added_[k] += added_[k - 1];
}

// Finds out which of the two cuts is inside, and looks up the lateness of the links within both rings.
Tour::Split::Cut Tour::Split::cutAt(int a, int b) const {
  const bool aIn = tour_.endOf(a) > low_ && tour_.endOf(a) < high_;
  const int in = aIn ? a : b;
  const int out = aIn ? b : a;
  Cut cut{tour_.endOf(in), tour_.endOf(out), 0};
  std::size_t rankOut = tour_.rank_[out] + 1;
  if (cut.out < high_) {
    cut.out += tour_.size_;
    rankOut += tour_.order_.size();
  }
  cut.late = kept_ + added_[tour_.rank_[in] + 1] + added_[rankOut];
  return cut;
}

// Links across the rings add nothing negative, so that the gain without them is an upper bound.
double Tour::Split::atMost(int a, int b) const { return static_cast<double>(tour_.now_ - cutAt(a, b).late) / kUnit; }

// Adds the links across the rings one by one, and stops as soon as the gain falls below `least`.
double Tour::Split::gain(int a, int b, double least, std::int64_t& work) const {
  const Cut cut = cutAt(a, b);
  const int inside = high_ - low_;
  const int outside = tour_.size_ - inside;
  const std::int64_t most = tour_.now_ - static_cast<std::int64_t>(std::floor(least * kUnit));
  std::int64_t late = cut.late;
  std::size_t k = 0;
  for (; k < across_.size() && late <= most; ++k) {
    const Across& link = across_[k];
    // Places counted from the cuts at which the rings are opened.
    const int within = link.in - cut.in + (link.in < cut.in ? inside : 0);
    const int around = link.out - cut.out + (link.out < cut.out ? outside : 0);
    late += static_cast<std::int64_t>(link.weight) *
            tour_.lateRound(std::clamp(outside + within - around + link.offset, 0, tour_.size_));
  }
  work += static_cast<std::int64_t>(k);
  return static_cast<double>(tour_.now_ - late) / kUnit;
}

}  // namespace sillon
