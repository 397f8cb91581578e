// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse/sheets.h"

#include <map>
#include <queue>

#include "base/atomic.h"
#include "base/sort_unique.h"
#include "base/union_find.h"

namespace medial {
namespace {

// Returns the thickness of the thickest facet of each sheet, at the sheet's lowest facet.
Array<float> peaks(const Sheets& sheets, std::span<const float> thickness, const Run& run) {
  auto peak = array<float>(thickness.size(), 0, run);
  parallel_chunks(static_cast<int64_t>(thickness.size()), run,
                  [&](int64_t begin, int64_t end, int) {
                    int32_t sheet = -1;
                    float highest = 0;
                    for (int64_t f = begin; f < end; ++f) {
                      if (sheets.of_facet[f] < 0) continue;
                      if (sheets.of_facet[f] != sheet) {
                        if (sheet >= 0) raise(peak[sheet], highest);
                        sheet = sheets.of_facet[f];
                        highest = 0;
                      }
                      highest = std::max(highest, thickness[f]);
                    }
                    if (sheet >= 0) raise(peak[sheet], highest);
                  });
  return peak;
}

// Drops sheets, the thinnest first. A sheet is identified by its lowest facet, and a group of
// united sheets by the lowest one of them.
class Dropper {
 public:
  Dropper(const Sheets& sheets, std::span<const float> peak) {
    for (size_t f = 0; f < sheets.of_facet.size(); ++f) {
      if (sheets.of_facet[f] == static_cast<int32_t>(f)) number(static_cast<int32_t>(f), peak[f]);
    }
    for (size_t i = 0; i < sheets.junctions.size(); ++i) {
      const auto& [edge, facet] = sheets.junctions[i];
      if (i == 0 || sheets.junctions[i - 1].edge != edge) meetings_.emplace_back();
      meetings_.back().push_back(number_.at(sheets.of_facet[facet]));
    }
    for (auto& meeting : meetings_) std::sort(meeting.begin(), meeting.end());
    sort_unique(meetings_);
    for (size_t m = 0; m < meetings_.size(); ++m) {
      for (const int32_t sheet : meetings_[m]) {
        auto& own = groups_[sheet].meetings;
        if (own.empty() || own.back() != m) own.push_back(m);
      }
    }
  }

  // Returns the lowest facet and the value of each sheet.
  std::vector<std::pair<int32_t, float>> drop_all() {
    for (size_t s = 0; s < groups_.size(); ++s) push(static_cast<int32_t>(s));
    while (!queue_.empty()) {
      const auto [peak, sheet] = queue_.top();
      queue_.pop();
      Group& group = groups_[sheet];
      if (group.dropped || group.into >= 0 || group.peak != peak) continue;
      group.dropped = true;
      for (const int32_t member : group.members) values_[member].second = peak;
      // The order decides what unites, so it may not depend on how the group came together.
      std::sort(group.meetings.begin(), group.meetings.end());
      for (const size_t m : group.meetings) join_at(m);
    }
    return values_;
  }

 private:
  struct Group {
    float peak = 0;
    int32_t into = -1;  // the group that it has become part of, or -1
    bool dropped = false;
    std::vector<int32_t> members;  // numbers of the sheets in it
    std::vector<size_t> meetings;
  };

  void number(int32_t lowest_facet, float peak) {
    const auto sheet = static_cast<int32_t>(groups_.size());
    number_[lowest_facet] = sheet;
    values_.emplace_back(lowest_facet, HUGE_VALF);
    groups_.push_back({.peak = peak, .members = {sheet}, .meetings = {}});
  }
  int32_t group_of(int32_t sheet) {
    while (groups_[sheet].into >= 0) {
      int32_t& into = groups_[sheet].into;
      if (groups_[into].into >= 0) into = groups_[into].into;
      sheet = into;
    }
    return sheet;
  }
  void push(int32_t sheet) {
    if (groups_[sheet].peak < HUGE_VALF) queue_.emplace(groups_[sheet].peak, sheet);
  }

  // Returns the group of each facet that is left at a junction.
  std::vector<int32_t> left_at(size_t meeting) {
    std::vector<int32_t> left;
    for (const int32_t sheet : meetings_[meeting]) {
      const int32_t group = group_of(sheet);
      if (!groups_[group].dropped) left.push_back(group);
    }
    return left;
  }

  // Unites the groups at a junction if exactly two of its facets are left, and each goes on in the
  // other.
  void join_at(size_t meeting) {
    const auto left = left_at(meeting);
    if (left.size() == 2 && left[0] != left[1] && !branches(left[0], left[1])) {
      unite(left[0], left[1]);
    }
  }

  // Returns whether nothing but two groups is left at a junction of three facets or more. There one
  // branches from the other, so it does not go on in it elsewhere: chains of fins round a line of
  // centres would all become one sheet, and none of them would go.
  bool branches(int32_t a, int32_t b) {
    if (groups_[a].meetings.size() > groups_[b].meetings.size()) std::swap(a, b);
    return std::any_of(groups_[a].meetings.begin(), groups_[a].meetings.end(), [&](size_t meeting) {
      const auto left = left_at(meeting);
      const auto one_of_both = [&](int32_t group) { return group == a || group == b; };
      return left.size() > 2 && std::all_of(left.begin(), left.end(), one_of_both);
    });
  }

  void unite(int32_t a, int32_t b) {
    const auto add = [](auto& list, auto& other) {
      if (list.size() < other.size()) std::swap(list, other);
      list.insert(list.end(), other.begin(), other.end());
    };
    Group &first = groups_[std::min(a, b)], &second = groups_[std::max(a, b)];
    second.into = std::min(a, b);
    first.peak = std::max(first.peak, second.peak);
    add(first.members, second.members);
    add(first.meetings, second.meetings);
    push(second.into);
  }

  std::vector<Group> groups_;
  std::map<int32_t, int32_t> number_;
  std::vector<std::pair<int32_t, float>> values_;
  std::vector<std::vector<int32_t>> meetings_;  // per junction: the sheet of each of its facets
  using Peak = std::pair<float, int32_t>;
  std::priority_queue<Peak, std::vector<Peak>, std::greater<>> queue_;
};

// Raises the values of facets that had to wait for others. All values in a sheet are equal at
// first, so waiting matters from the junctions on.
void wait_at_junctions(const InnerComplex& complex, const Collapse& collapse, const Sheets& sheets,
                       Array<float>& value) {
  std::vector<int32_t> raised;
  const auto raise_to = [&](int32_t facet, float to) {
    if (value[facet] >= to) return;
    value[facet] = to;
    raised.push_back(facet);
  };
  for (const auto& [edge, facet] : sheets.junctions) {
    const int32_t last = shared_load(collapse.partner[edge]);
    if (last >= 0) raise_to(last, value[facet]);
  }
  while (!raised.empty()) {
    const int32_t f = raised.back();
    raised.pop_back();
    for (const Corner& c : complex.ring(f)) {
      const int32_t last = shared_load(collapse.partner[c.edge]);
      if (last >= 0) raise_to(last, value[f]);
    }
  }
}

}  // namespace

Sheets find_sheets(const InnerComplex& complex, const Collapse& collapse, const Run& run) {
  SharedUnionFind sets(complex.dual.size(), run);
  auto junctions = parallel_append<AtJunction>(complex.facets(), run,
                                               [&](int64_t id, std::vector<AtJunction>& out, int) {
                                                 const auto f = static_cast<int32_t>(id);
                                                 if (collapse.facet_gone[f]) return;
                                                 for (const Corner& c : complex.ring(f)) {
                                                   const Incident& at = collapse.facets_at[c.edge];
                                                   if (at.count() > 2) out.push_back({c.edge, f});
                                                   if (at.count() == 2 && at.other_than(f) < f)
                                                     sets.unite(f, at.other_than(f));
                                                 }
                                               });
  std::sort(junctions.begin(), junctions.end());
  Sheets sheets{std::move(sets).representatives(run), std::move(junctions)};
  parallel_for(complex.facets(), run, [&](int64_t f) {
    if (collapse.facet_gone[f]) sheets.of_facet[f] = -1;
  });
  return sheets;
}

Array<float> drop_values(const InnerComplex& complex, const Collapse& collapse,
                         const Sheets& sheets, std::span<const float> thickness, const Run& run) {
  auto of_sheet = peaks(sheets, thickness, run);
  for (const auto& [lowest, value] : Dropper(sheets, of_sheet).drop_all()) {
    of_sheet[lowest] = value;
  }
  auto value = array<float>(thickness.size(), run);
  parallel_for(complex.facets(), run, [&](int64_t f) {
    const int32_t sheet = sheets.of_facet[f];
    value[f] = sheet < 0 ? 0 : of_sheet[sheet];
  });
  wait_at_junctions(complex, collapse, sheets, value);
  return value;
}

}  // namespace medial
