// SPDX-License-Identifier: GPL-3.0-or-later
#include "cover/ball_exchange.h"

#include <cmath>

#include "base/parallel.h"
#include "base/rows.h"
#include "cover/ball_places.h"

namespace medial {
namespace {

constexpr int kRounds = 4;             // later rounds gain next to nothing
constexpr int64_t kCountsOfTask = 32;  // balls in one piece of work

// Balls that nearly touch count as touching.
bool touch(const Ball& a, const Ball& b) {
  return distance(a.centre, b.centre) <= (1 + kRoundingShare) * (a.radius + b.radius);
}

// This keeps, for each place, the distances to the nearest two of the chosen balls.
class NearestTwo {
 public:
  NearestTwo(const Exchange& exchange, std::span<const int32_t> chosen, const Run& run)
      : exchange_(exchange), near_(exchange.places.size()), limits_(near_.size()), run_(run) {
    update(chosen, -1);
    for (size_t i = 0; i < near_.size(); ++i) {
      limits_[i] = std::max(exchange.places[i].limit(exchange.bound), near_[i].away);
    }
  }

  // The ball in a slot is another one now; with slot -1, all are.
  void update(std::span<const int32_t> chosen, int32_t slot) {
    parallel_for(static_cast<int64_t>(near_.size()), {run_.threads}, [&](int64_t i) {
      Near& near = near_[i];
      if (slot < 0 || near.slot == slot || near.second_slot == slot) {
        near = {};
        for (size_t k = 0; k < chosen.size(); ++k) add(i, chosen, static_cast<int32_t>(k));
      } else {
        add(i, chosen, slot);
      }
    });
  }

  // Returns the places that need the ball in a slot: without it they would be farther from the
  // others than their limits.
  std::vector<int32_t> needing(int32_t slot) const {
    return rows_where(near_.size(), [&](int32_t i) {
      return near_[i].slot == slot && near_[i].second > limits_[i];
    });
  }

  bool serves(const Ball& ball, std::span<const int32_t> places) const {
    return std::all_of(places.begin(), places.end(),
                       [&](int32_t i) { return gap(ball, exchange_.places[i].at) <= limits_[i]; });
  }

 private:
  struct Near {
    double away = HUGE_VAL, second = HUGE_VAL;
    int32_t slot = -1, second_slot = -1;
  };

  void add(int64_t i, std::span<const int32_t> chosen, int32_t slot) {
    Near& near = near_[i];
    const double away = gap(exchange_.balls[chosen[slot]], exchange_.places[i].at);
    if (away < near.away) {
      near = {away, near.away, slot, near.slot};
    } else if (away < near.second) {
      near.second = away;
      near.second_slot = slot;
    }
  }

  const Exchange& exchange_;
  std::vector<Near> near_;
  std::vector<double> limits_;  // no place may be farther from the chosen balls
  const Run& run_;
};

// This counts what balls would add.
class Exchanger {
 public:
  Exchanger(const Exchange& exchange, std::vector<int32_t>& chosen, const SolidLattice& whole,
            const Run& run)
      : exchange_(exchange),
        chosen_(chosen),
        whole_(whole),
        rest_(whole),
        run_(run),
        near_(exchange, chosen, run) {
    for (const int32_t id : chosen) rest_.remove(ball(id).centre, ball(id).radius);
    most_ = counts(exchange.ids, rest_);
  }

  bool round() {
    bool changed = false;
    for (size_t slot = 0; slot < chosen_.size(); ++slot) {
      throw_if_cancelled(run_.progress);
      changed |= replace(static_cast<int32_t>(slot));
    }
    return changed;
  }

 private:
  const Ball& ball(int32_t id) const { return exchange_.balls[id]; }

  // Returns the lattice without the places of all chosen balls but one. What only that one holds
  // comes back.
  SolidLattice rest_without(int32_t slot) const {
    const Ball& old = ball(chosen_[slot]);
    SolidLattice rest(rest_);
    rest.restore(whole_, old.centre, old.radius);
    for (size_t i = 0; i < chosen_.size(); ++i) {
      const Ball& other = ball(chosen_[i]);
      if (static_cast<int32_t>(i) == slot || !touch(old, other)) continue;
      rest.remove(other.centre, other.radius);
    }
    return rest;
  }

  std::vector<int64_t> counts(std::span<const int32_t> ids, const SolidLattice& rest) const {
    std::vector<int64_t> result(ids.size());
    parallel_for(
        static_cast<int64_t>(ids.size()), {run_.threads},
        [&](int64_t i) { result[i] = rest.count(ball(ids[i]).centre, ball(ids[i]).radius); },
        kCountsOfTask);
    return result;
  }

  // A ball that does not touch the old one cannot add more without it than with it.
  bool replace(int32_t slot) {
    const Ball old = ball(chosen_[slot]);
    const SolidLattice rest = rest_without(slot);
    const int64_t own = rest.count(old.centre, old.radius);
    const auto needing = near_.needing(slot);
    const auto rows = rows_where(most_.size(), [&](int32_t row) {
      const Ball& other = ball(exchange_.ids[row]);
      const int64_t most = most_[row] + (touch(old, other) ? own : 0);
      return most > own && near_.serves(other, needing);
    });
    const auto gains = counts(rows_of(exchange_.ids, rows), rest);
    const auto best = std::max_element(gains.begin(), gains.end());
    if (gains.empty() || *best <= own) return false;
    chosen_[slot] = exchange_.ids[rows[best - gains.begin()]];
    rest_ = rest;
    rest_.remove(ball(chosen_[slot]).centre, ball(chosen_[slot]).radius);
    near_.update(chosen_, slot);
    for (size_t row = 0; row < most_.size(); ++row) {
      if (touch(old, ball(exchange_.ids[row]))) most_[row] += own;
    }
    for (size_t i = 0; i < rows.size(); ++i) most_[rows[i]] = gains[i];
    return true;
  }

  const Exchange& exchange_;
  std::vector<int32_t>& chosen_;
  const SolidLattice& whole_;
  SolidLattice rest_;  // without the places of the chosen balls
  const Run& run_;
  NearestTwo near_;
  std::vector<int64_t> most_;  // upper bounds of what each ball adds to the chosen ones
};

}  // namespace

void exchange_balls(const Exchange& exchange, std::vector<int32_t>& chosen,
                    const SolidLattice& whole, const Run& run) {
  Exchanger exchanger(exchange, chosen, whole, run);
  for (int round = 0; round < kRounds; ++round) {
    if (!exchanger.round()) return;
  }
}

}  // namespace medial
